// SPDX-License-Identifier: MIT
#include "host_sim/report/target_record.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <utility>

namespace splinefeed::host {

void TargetRecord::handed(std::uint32_t duration_ticks) {
    if (low_s_ >= 0.0) {
        least_s_ = least_s_ < 0.0 ? low_s_ : std::min(least_s_, low_s_);
        low_s_ = -1.0;
    }
    waiting_.push_back(duration_ticks);
    waiting_ticks_ += duration_ticks;
}

void TargetRecord::looked(std::uint64_t now_us, std::uint64_t executed) {
    const std::uint64_t before_ticks = executed_ticks_;
    for (; executed_ < executed && !waiting_.empty(); ++executed_) {
        executed_ticks_ += waiting_.front();
        waiting_ticks_ -= waiting_.front();
        waiting_.pop_front();
    }
    if (executed_ == 0) { // the buffers are filled before the motion begins
        return;
    }
    passed_us_ += waits_ ? static_cast<double>(now_us - looked_us_) : 0.0;
    if (executed_ticks_ > before_ticks) {
        const double moved_us = static_cast<double>(executed_ticks_ - before_ticks) / ticks_per_us;
        late_us_ = std::max(late_us_ + std::exchange(passed_us_, 0.0) - moved_us, 0.0);
    }
    waits_ = !waiting_.empty();
    looked_us_ = now_us;
    const double left_s = static_cast<double>(waiting_ticks_) / (ticks_per_us * 1e6);
    low_s_ = low_s_ < 0.0 ? left_s : std::min(low_s_, left_s);
    const auto buffered = static_cast<float>(left_s);
    const auto late = static_cast<float>(late_us_ * 1e-6);
    const TimeStrips::Range values[channels]{{buffered, buffered}, {late, late}};
    for (std::uint64_t ticks = before_ticks + strips_.bin_ticks(); ticks < executed_ticks_;
         ticks += strips_.bin_ticks()) {
        strips_.add(ticks, 0.0, values, 0.0, 0.0, 0); // what it was there nobody said
    }
    strips_.add(executed_ticks_, 0.0, values, 0.0, 0.0, 0);
}

} // namespace splinefeed::host
