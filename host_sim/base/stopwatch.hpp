// SPDX-License-Identifier: MIT
// Stopwatch: the time between two places of a program.
#pragma once

#include <chrono>

namespace splinefeed::host {

/// Adds what passes between its construction and destruction.
class Stopwatch {
public:
    using Clock = std::chrono::steady_clock;
    explicit Stopwatch(Clock::duration& sum) : sum_(&sum), start_(Clock::now()) {}
    ~Stopwatch() { *sum_ += Clock::now() - start_; }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    Clock::duration* sum_;
    Clock::time_point start_;
};

} // namespace splinefeed::host
