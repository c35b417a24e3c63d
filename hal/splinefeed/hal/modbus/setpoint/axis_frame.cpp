// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/axis_frame.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

namespace splinefeed::hal::modbus {

namespace {

constexpr std::int64_t most = units_per_count * 0x7FFFFFFF; // three quarters of 2^63
constexpr std::int64_t q16_units = units_per_count >> physical_bits;

constexpr bool fits_frame(std::int64_t units) noexcept {
    return units >= -most && units <= most;
}

// Sum of two numbers within the range, empty if out of range. Halves avoid overflow.
std::optional<std::int64_t> sum(std::int64_t a, std::int64_t b) noexcept {
    const std::int64_t half = a / 2 + b / 2;
    return half > most / 2 || half < -most / 2 ? std::nullopt : std::optional(a + b);
}

} // namespace

bool AxisFrame::align(std::int64_t stands_q16, std::int64_t start) noexcept {
    if (stands_q16 > most / q16_units || stands_q16 < -most / q16_units || !fits_frame(start)) {
        return false;
    }
    const auto offset = sum(stands_q16 * q16_units, -velocity(start));
    if (!offset) {
        return false;
    }
    const std::int64_t before = offset_;
    offset_ = *offset;
    if (!position(start)) {
        offset_ = before;
        return false;
    }
    aligned_ = true;
    return true;
}

std::optional<std::int64_t> AxisFrame::position(std::int64_t of_axis) const noexcept {
    if (!fits_frame(of_axis)) {
        return std::nullopt;
    }
    const auto there = sum(velocity(of_axis), offset_);
    const bool holds =
        there && fits_frame(*there) && (target_ == nullptr || !raw_of(*target_, *there / q16_units).clamped);
    return holds ? there : std::nullopt;
}

bool AxisFrame::apply(FeedSegment& segment, std::size_t axis) const noexcept {
    const auto start = position(segment.start[axis]);
    const auto end = position(segment.end[axis]);
    if (!start || !end) {
        return false;
    }
    segment.start[axis] = *start;
    segment.end[axis] = *end;
    segment.start_velocity[axis] = velocity(segment.start_velocity[axis]);
    segment.end_velocity[axis] = velocity(segment.end_velocity[axis]);
    return true;
}

double AxisFrame::axis_counts(std::int64_t drive_q16) const noexcept {
    const double counts = static_cast<double>(drive_q16) / (1 << physical_bits) -
                          static_cast<double>(offset_) / static_cast<double>(units_per_count);
    return inverted_ ? -counts : counts;
}

} // namespace splinefeed::hal::modbus
