// SPDX-License-Identifier: MIT
// Interruption: lets whoever asked for a long computation end it.
#pragma once

#include <chrono>
#include <functional>

namespace splinefeed::host {

/// While an object exists, the computations of its thread call its function about every 50 ms. What it throws ends
/// them. Objects may be nested: the innermost one counts.
class Interruption {
public:
    static constexpr std::chrono::milliseconds period{50};

    /// @param check  throws to end the computation
    explicit Interruption(std::function<void()> check);
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption();

    /// Called by computations, at each of their steps. Throws what the function throws. Cost: a nanosecond.
    static void point() {
        if (current_ != nullptr) {
            current_->look();
        }
    }

private:
    static constexpr unsigned steps_a_look = 64; // at the clock

    void look();

    static thread_local Interruption* current_; // null: nobody wants to end what the thread does
    Interruption* outer_;
    std::function<void()> check_;
    unsigned steps_ = 0;
    std::chrono::steady_clock::time_point due_;
};

} // namespace splinefeed::host
