// SPDX-License-Identifier: MIT
#include "host_sim/base/standard_streams.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <unistd.h>

namespace splinefeed::host {

namespace {

constexpr int none_drawn = -1;
std::atomic<int> drawn{none_drawn}; // where there is a drawn line
std::atomic<bool> nobody_reads{false};
std::mutex present_mutex; // protects BackgroundTelling::present_

void write_told(std::string_view text) noexcept {
    erase_drawn_line();
    while (!text.empty()) {
        const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
        if (written > 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (written == 0 || errno != EINTR) {
            return;
        }
    }
}

} // namespace

// In the order of their numbers, so that each gets its own. Input that can only be written and output that can only be
// read are errors when they are used.
void keep_standard_streams() noexcept {
    constexpr int modes[] = {O_WRONLY, O_RDONLY, O_WRONLY};
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            static_cast<void>(open("/dev/null", modes[stream])); // NOLINT(cppcoreguidelines-pro-type-vararg)
        }
    }
}

void draw_line(int descriptor, std::string_view text) noexcept {
    drawn.store(text.empty() ? none_drawn : descriptor);
    constexpr std::string_view erase_rest = "\x1b[K"; // of the line
    std::array<char, 256> line{'\r'};
    const std::string_view shown = text.substr(0, std::min(text.size(), line.size() - 1 - erase_rest.size()));
    char* const end = std::ranges::copy(erase_rest, std::ranges::copy(shown, &line[1]).out).out;
    [[maybe_unused]] const ssize_t written =
        write(descriptor, line.data(), static_cast<std::size_t>(end - line.data()));
}

void erase_drawn_line() noexcept {
    if (const int descriptor = drawn.load(); descriptor != none_drawn) {
        draw_line(descriptor, {});
    }
}

// The thread has its share of it: where it is kept in a write, it outlives the object.
struct BackgroundTelling::Shared {
    std::mutex mutex; // protects the members below
    std::condition_variable changed;
    std::deque<std::string> waiting;
    std::size_t dropped = 0;
    bool writes = false;
    bool over = false;
};

std::shared_ptr<BackgroundTelling::Shared> BackgroundTelling::present_;

std::shared_ptr<BackgroundTelling::Shared> BackgroundTelling::present() noexcept {
    const std::lock_guard lock(present_mutex);
    return present_;
}

BackgroundTelling::BackgroundTelling() {
    const std::lock_guard lock(present_mutex);
    present_ = std::make_shared<Shared>();
    nobody_reads.store(false);
    thread_ = std::thread([shared = present_] { work(shared); });
}

BackgroundTelling::~BackgroundTelling() {
    await_told(std::chrono::seconds(1));
    std::shared_ptr<Shared> shared;
    {
        const std::lock_guard lock(present_mutex);
        shared = std::move(present_);
    }
    bool writes = false;
    {
        const std::lock_guard lock(shared->mutex);
        shared->over = true;
        writes = shared->writes;
    }
    nobody_reads.store(writes);
    shared->changed.notify_all();
    if (writes) {
        thread_.detach();
    } else {
        thread_.join();
    }
}

void BackgroundTelling::work(const std::shared_ptr<Shared>& shared) noexcept {
    std::unique_lock lock(shared->mutex);
    for (;;) {
        shared->changed.wait(lock, [&] { return shared->over || !shared->waiting.empty(); });
        if (shared->over) {
            return;
        }
        std::string text = std::move(shared->waiting.front());
        shared->waiting.pop_front();
        if (const std::size_t dropped = std::exchange(shared->dropped, 0); dropped > 0) {
            text.insert(0, fmt::format("splinefeed: {} messages were dropped here: nobody read them\n", dropped));
        }
        shared->writes = true;
        lock.unlock();
        write_told(text);
        lock.lock();
        shared->writes = false;
        shared->changed.notify_all();
    }
}

void tell(std::string_view text) noexcept {
    const std::shared_ptr<BackgroundTelling::Shared> shared = BackgroundTelling::present();
    if (shared == nullptr) {
        if (!nobody_reads.load()) {
            write_told(text);
        }
        return;
    }
    const std::lock_guard lock(shared->mutex);
    if (shared->waiting.size() == BackgroundTelling::most_waiting) {
        shared->waiting.pop_front();
        ++shared->dropped;
    }
    shared->waiting.emplace_back(text);
    shared->changed.notify_all();
}

void await_told(std::chrono::milliseconds most) noexcept {
    const std::shared_ptr<BackgroundTelling::Shared> shared = BackgroundTelling::present();
    if (shared != nullptr) {
        std::unique_lock lock(shared->mutex);
        shared->changed.wait_for(lock, most, [&] { return shared->waiting.empty() && !shared->writes; });
    }
}

void print_whole(std::string_view text, std::string_view what) {
    await_told(std::chrono::milliseconds(100)); // in the order of the calls, where both streams are one
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw OutputError("standard output: {} cannot be written; keep its reader running to the end", what);
    }
}

void tell_note(std::string_view note) {
    if (!note.empty()) {
        tell("splinefeed: note: {}\n", printable(note));
    }
}

} // namespace splinefeed::host
