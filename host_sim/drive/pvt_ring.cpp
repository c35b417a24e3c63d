// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_ring.hpp"

#include <algorithm>

namespace splinefeed::host {

using hal::modbus::PvtSegment;

namespace {

constexpr double velocity_units_per_unit = std::int64_t{1} << (PvtSegment::velocity_bits - PvtSegment::position_bits);
constexpr double map_ticks_per_s = ticks_per_s;

} // namespace

PvtRing::PvtRing(int axes, std::uint16_t capacity) : storage_(capacity), queue_(storage_, axes) {
    begin(0, {});
}

void PvtRing::begin(std::uint32_t first, const PerAxis<std::int64_t>& position) noexcept {
    queue_.begin(first);
    passed_ticks_ = 0.0;
    before_ = {};
    before_.duration_ticks = 1;
    before_.end = position;
}

PvtRing::Left PvtRing::left_before(std::uint32_t sequence) const noexcept {
    const hal::modbus::SegmentQueue::Left left = queue_.left_before(sequence, begun());
    return {(static_cast<double>(left.ticks) - passed_ticks_) / map_ticks_per_s, left.rests};
}

double PvtRing::ahead_s() const noexcept {
    return (static_cast<double>(queue_.ticks()) - passed_ticks_) / map_ticks_per_s;
}

double PvtRing::segment_ahead_s() const noexcept {
    return (static_cast<double>(current().duration_ticks) - passed_ticks_) / map_ticks_per_s;
}

void PvtRing::pass(double way_s) noexcept {
    passed_ticks_ = std::min(passed_ticks_ + way_s * map_ticks_per_s, static_cast<double>(current().duration_ticks));
}

void PvtRing::finish() noexcept {
    before_ = current();
    queue_.pass();
    queue_.set_executed(queue_.passed());
    passed_ticks_ = 0.0;
}

double PvtRing::start(int axis) const noexcept {
    return static_cast<double>(before_.end[static_cast<unsigned>(axis)]) / map_units_per_count;
}

PvtRing::Jet PvtRing::at(int axis) const noexcept {
    const auto k = static_cast<unsigned>(axis);
    if (empty()) {
        return {start(axis), 0.0, 0.0};
    }
    const double ticks = current().duration_ticks;
    const double u = passed_ticks_ / ticks;
    const auto way = static_cast<double>(current().end[k] - before_.end[k]);
    const double v0 = static_cast<double>(before_.end_velocity[k]) / velocity_units_per_unit *
                      (ticks / static_cast<double>(before_.duration_ticks));
    const double v1 = static_cast<double>(current().end_velocity[k]) / velocity_units_per_unit;
    const double square = 3.0 * way - 2.0 * v0 - v1;
    const double cube = v0 + v1 - 2.0 * way;
    const double duration_s = ticks / map_ticks_per_s;
    return {start(axis) + ((cube * u + square) * u + v0) * u / map_units_per_count,
            ((3.0 * cube * u + 2.0 * square) * u + v0) / (map_units_per_count * duration_s),
            (6.0 * cube * u + 2.0 * square) / (map_units_per_count * duration_s * duration_s)};
}

} // namespace splinefeed::host
