// SPDX-License-Identifier: MIT
#include "host_sim/base/deadline.hpp"

#include "host_sim/base/abandon.hpp"

#include <utility>

namespace splinefeed::host {

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
