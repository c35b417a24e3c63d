// SPDX-License-Identifier: MIT
#include "host_sim/base/abandon.hpp"

#include "host_sim/base/durable_file.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/base/standard_streams.hpp"

#include <algorithm>
#include <atomic>
#include <climits>
#include <poll.h>
#include <string>
#include <unistd.h>
#include <utility>

namespace splinefeed::host {

namespace {

constexpr int taken_within_ms = 100;

std::atomic<bool> abandoned{false};

// A pipe that has room takes PIPE_BUF bytes without waiting.
void say(std::string_view sentence) {
    std::string line = "splinefeed: " + printable(sentence);
    line.resize(std::min<std::size_t>(line.size(), PIPE_BUF - 1));
    line += '\n';
    await_told(std::chrono::milliseconds(taken_within_ms));
    erase_drawn_line();
    pollfd errors{STDERR_FILENO, POLLOUT, 0};
    if (poll(&errors, 1, taken_within_ms) == 1 && (errors.revents & POLLOUT) != 0) {
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
    }
}

} // namespace

void abandon(std::string_view sentence, int status) noexcept {
    while (abandoned.exchange(true)) {
        pause();
    }
    end_replacing();
    OutputFile::discard_all();
    say(sentence);
    _exit(status);
}

Deadline::Deadline(std::chrono::milliseconds time, std::string sentence)
    : thread_([this, time, text = std::move(sentence)] {
          std::unique_lock lock(mutex_);
          if (!ended_.wait_for(lock, time, [this] { return done_; })) {
              abandon(text, 1);
          }
      }) {}

Deadline::~Deadline() {
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
    }
    ended_.notify_one();
    thread_.join();
}

} // namespace splinefeed::host
