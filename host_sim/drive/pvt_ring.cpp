// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_ring.hpp"

#include <algorithm>

namespace splinefeed::host {

using hal::modbus::PvtRefusal;
using hal::modbus::PvtSegment;
namespace pvt = hal::modbus::pvt;

namespace {

constexpr double velocity_units_per_unit = std::int64_t{1} << (PvtSegment::velocity_bits - PvtSegment::position_bits);
constexpr double map_ticks_per_s = ticks_per_s;

bool is_executable(const PvtSegment& segment, int axes) noexcept {
    const auto moves = [](std::int64_t velocity) {
        return velocity != 0;
    };
    return segment.duration_ticks >= pvt::shortest_ticks && segment.duration_ticks <= pvt::longest_ticks &&
           !(segment.rest && std::any_of(segment.end_velocity.begin(), segment.end_velocity.begin() + axes, moves));
}

} // namespace

PvtRing::PvtRing(int axes, std::uint16_t capacity) : ring_(capacity), axes_(axes) {
    begin(0, {});
}

void PvtRing::begin(std::uint32_t first, const PerAxis<std::int64_t>& position) noexcept {
    head_ = 0;
    size_ = 0;
    rests_ = 0;
    ticks_ = 0;
    executed_ = first;
    passed_ticks_ = 0.0;
    before_ = {};
    before_.duration_ticks = 1;
    before_.end = position;
}

PvtRefusal PvtRing::take(std::uint32_t first, std::span<const PvtSegment> segments) noexcept {
    // How far `next` lies beyond the first of them; those were taken already.
    const auto known = static_cast<std::int32_t>(next() - first);
    if (segments.empty()) {
        return PvtRefusal::none; // and of nothing there is no first
    }
    if (known < 0) {
        return PvtRefusal::gap;
    }
    if (static_cast<std::size_t>(known) >= segments.size()) {
        return PvtRefusal::none;
    }
    const std::span<const PvtSegment> fresh = segments.subspan(static_cast<std::size_t>(known));
    if (fresh.size() > free()) {
        return PvtRefusal::no_room;
    }
    if (!std::all_of(fresh.begin(), fresh.end(), [this](const PvtSegment& s) { return is_executable(s, axes_); })) {
        return PvtRefusal::malformed;
    }
    for (const PvtSegment& segment : fresh) {
        ring_[(head_ + size_) % ring_.size()] = segment;
        ++size_;
        ticks_ += segment.duration_ticks;
        rests_ += segment.rest ? 1U : 0U;
    }
    return PvtRefusal::none;
}

PvtRing::Left PvtRing::left_before(std::uint32_t sequence) const noexcept {
    const auto wanted = static_cast<std::int32_t>(sequence - executed_);
    const std::size_t least = passed_ticks_ > 0.0 ? 1 : 0;
    const std::size_t kept = std::min(size_, std::max(least, wanted > 0 ? static_cast<std::size_t>(wanted) : 0U));
    std::uint64_t ticks = ticks_;
    std::size_t rests = rests_;
    for (std::size_t i = kept; i < size_; ++i) {
        const PvtSegment& dropped = ring_[(head_ + i) % ring_.size()];
        ticks -= dropped.duration_ticks;
        rests -= dropped.rest ? 1U : 0U;
    }
    return {kept, (static_cast<double>(ticks) - passed_ticks_) / map_ticks_per_s, rests > 0};
}

void PvtRing::end_before(std::uint32_t sequence) noexcept {
    const std::size_t kept = left_before(sequence).segments;
    while (size_ > kept) {
        --size_;
        const PvtSegment& last = ring_[(head_ + size_) % ring_.size()];
        ticks_ -= last.duration_ticks;
        rests_ -= last.rest ? 1U : 0U;
    }
}

double PvtRing::ahead_s() const noexcept {
    return (static_cast<double>(ticks_) - passed_ticks_) / map_ticks_per_s;
}

double PvtRing::segment_ahead_s() const noexcept {
    return (static_cast<double>(current().duration_ticks) - passed_ticks_) / map_ticks_per_s;
}

void PvtRing::pass(double way_s) noexcept {
    passed_ticks_ = std::min(passed_ticks_ + way_s * map_ticks_per_s, static_cast<double>(current().duration_ticks));
}

void PvtRing::finish() noexcept {
    before_ = current();
    head_ = (head_ + 1) % ring_.size();
    --size_;
    ++executed_;
    ticks_ -= before_.duration_ticks;
    rests_ -= before_.rest ? 1U : 0U;
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
