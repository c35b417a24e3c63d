// SPDX-License-Identifier: MIT
// TargetRecord: how much motion a target of a run had buffered, and how late it was, over the time of the motion.
#pragma once

#include "host_sim/report/time_strips.hpp"

#include <cstdint>
#include <deque>

namespace splinefeed::host {

/// Memory: that of the strips, and the durations of the buffered segments. For one thread at a time.
class TargetRecord {
public:
    enum Channel : std::uint8_t { buffered_s, late_s, channels };

    /// The target got a segment.
    void handed(std::uint32_t duration_ticks);
    /// What the target says of itself. @param executed  segments so far
    void looked(std::uint64_t now_us, std::uint64_t executed);

    /// Of each time of the motion the least and the most. Late is the time in which there was motion to be executed,
    /// and the machine's clock did not go on: it is as fine as the target's answers.
    [[nodiscard]] const TimeStrips& strips() const noexcept { return strips_; }
    /// The least that was buffered while more was to come. Below 0: nothing was executed before all of it had come.
    [[nodiscard]] double least_s() const noexcept { return least_s_; }

private:
    static constexpr std::uint64_t bin_ticks = 80'000; // 10 ms

    TimeStrips strips_{channels, bin_ticks};
    std::deque<std::uint32_t> waiting_; // durations
    std::uint64_t waiting_ticks_ = 0;
    std::uint64_t executed_ = 0;
    std::uint64_t executed_ticks_ = 0;
    std::uint64_t looked_us_ = 0;
    double passed_us_ = 0.0; // with motion to be executed, since the target said that it went on
    double late_us_ = 0.0;
    double low_s_ = -1.0; // the least that was buffered since the target got a segment
    double least_s_ = -1.0;
    bool waits_ = false; // there was motion to be executed at the last look
};

} // namespace splinefeed::host
