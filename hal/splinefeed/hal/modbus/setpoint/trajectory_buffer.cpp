// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/trajectory_buffer.hpp"

#include "splinefeed/base/units.hpp"

#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::int64_t units_per_q16 = units_per_count >> physical_bits;
static_assert(units_per_q16 << physical_bits == units_per_count);

std::int64_t q16_of(std::int64_t units) noexcept { // rounds to nearest, ties upwards
    const std::int64_t shifted = units + units_per_q16 / 2;
    return shifted / units_per_q16 - (shifted % units_per_q16 < 0 ? 1 : 0);
}

/// position start + b1 u + b2 u^2 + b3 u^3 over u = 0 to 1, in units.
struct Cubic {
    double b1;
    double b2;
    double b3;
    Cubic(const FeedSegment& segment, std::size_t axis) noexcept
        : b1(static_cast<double>(segment.start_velocity[axis])) {
        const auto distance = static_cast<double>(segment.end[axis] - segment.start[axis]);
        const auto last = static_cast<double>(segment.end_velocity[axis]);
        b2 = 3.0 * distance - 2.0 * b1 - last;
        b3 = b1 + last - 2.0 * distance;
    }
};

} // namespace

void TrajectoryBuffer::reset(std::size_t capacity) {
    ring_.resize(capacity);
    first_ = 0;
    count_ = 0;
    end_ticks_ = 0;
}

bool TrajectoryBuffer::push(const FeedSegment& segment) noexcept {
    if (count_ == ring_.size()) {
        return false;
    }
    ring_[(first_ + count_) % ring_.size()] = {end_ticks_, segment};
    ++count_;
    end_ticks_ += segment.duration_ticks;
    return true;
}

// Keeps the last segment: the axes stand at its end.
void TrajectoryBuffer::release(std::uint64_t before_us) noexcept {
    while (count_ > 1 && placed(1).begin_ticks <= before_us * ticks_per_us) {
        first_ = (first_ + 1) % ring_.size();
        --count_;
    }
}

std::uint64_t TrajectoryBuffer::end_us() const noexcept {
    return (end_ticks_ + ticks_per_us - 1) / ticks_per_us;
}

bool TrajectoryBuffer::ends_at_rest() const noexcept {
    return count_ == 0 || placed(count_ - 1).segment.ends_at_rest();
}

// The last segment that begins at that time or before. @pre the first one does
const TrajectoryBuffer::Placed& TrajectoryBuffer::at_ticks(std::uint64_t ticks) const noexcept {
    std::size_t low = 0;
    for (std::size_t beyond = count_; beyond - low > 1;) {
        const std::size_t middle = low + (beyond - low) / 2;
        (placed(middle).begin_ticks <= ticks ? low : beyond) = middle;
    }
    return placed(low);
}

TrajectoryPoint TrajectoryBuffer::at(int axis, std::uint64_t time_us) const noexcept {
    const auto k = static_cast<std::size_t>(axis);
    const std::uint64_t ticks = time_us * ticks_per_us;
    const Placed& earliest = placed(0);
    if (ticks <= earliest.begin_ticks) {
        return {q16_of(earliest.segment.start[k]), 0.0};
    }
    if (ticks >= end_ticks_) {
        return {q16_of(placed(count_ - 1).segment.end[k]), 0.0};
    }
    const Placed& here = at_ticks(ticks);
    const auto duration = static_cast<double>(here.segment.duration_ticks);
    const double u = static_cast<double>(ticks - here.begin_ticks) / duration;
    const Cubic cubic(here.segment, k);
    const double travelled = u * (cubic.b1 + u * (cubic.b2 + u * cubic.b3));
    const double velocity = cubic.b1 + u * (2.0 * cubic.b2 + 3.0 * u * cubic.b3);
    return {q16_of(here.segment.start[k] + std::llround(travelled)),
            velocity * ticks_per_s / (duration * static_cast<double>(units_per_count))};
}

double line_deviation_counts(const FeedSegment& segment, int axis, std::uint32_t period_us) noexcept {
    const Cubic cubic(segment, static_cast<std::size_t>(axis));
    const double share = static_cast<double>(period_us) * static_cast<double>(ticks_per_us) /
                         static_cast<double>(segment.duration_ticks);
    const double largest = std::fmax(std::fabs(2.0 * cubic.b2), std::fabs(2.0 * cubic.b2 + 6.0 * cubic.b3));
    return share * share * largest / (8.0 * static_cast<double>(units_per_count));
}

} // namespace splinefeed::hal::modbus
