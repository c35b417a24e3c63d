// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/edge_clock.hpp"

#include <algorithm>

namespace splinefeed::hal::gpio {

void EdgeClock::start(std::uint64_t at_ns, std::int64_t motion_ns) noexcept {
    clock_.start(at_ns);
    begin_motion_ns_ = motion_ns;
    last_motion_ns_ = INT64_MIN;
}

std::int64_t EdgeClock::motion_ns(std::uint64_t now_ns) const noexcept {
    return begin_motion_ns_ + static_cast<std::int64_t>(clock_.time(now_ns));
}

std::uint64_t EdgeClock::planned_ns(std::int64_t motion_ns) const noexcept {
    return clock_.instant(motion_ns - begin_motion_ns_);
}

std::uint64_t EdgeClock::due_ns(std::int64_t motion_ns) const noexcept {
    const std::uint64_t planned = planned_ns(motion_ns);
    if (last_motion_ns_ == INT64_MIN) {
        return planned;
    }
    const auto gap = static_cast<std::uint64_t>(std::max<std::int64_t>(motion_ns - last_motion_ns_, 0));
    return std::max(planned, last_ns_ + std::min(gap, settings_.guard_ns));
}

std::uint64_t EdgeClock::absorb_delay(std::int64_t motion_ns, std::uint64_t now_ns) noexcept {
    const std::uint64_t planned = planned_ns(motion_ns);
    if (planned == never || now_ns <= planned + settings_.tolerated_ns) {
        return 0;
    }
    clock_.delay(now_ns - planned);
    schedule_slip_ns_ += now_ns - planned;
    return now_ns - planned;
}

std::uint64_t EdgeClock::late_ns(std::int64_t motion_ns, std::uint64_t at_ns) const noexcept {
    const std::uint64_t planned = planned_ns(motion_ns);
    return at_ns > planned ? at_ns - planned : 0;
}

std::uint64_t EdgeClock::made(std::int64_t motion_ns, std::uint64_t at_ns) noexcept {
    const std::uint64_t late = late_ns(motion_ns, at_ns);
    last_ns_ = at_ns;
    last_motion_ns_ = motion_ns;
    if (late > settings_.tolerated_ns) {
        clock_.delay(late);
        schedule_slip_ns_ += late;
    }
    return late;
}

} // namespace splinefeed::hal::gpio
