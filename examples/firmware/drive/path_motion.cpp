// SPDX-License-Identifier: MIT
#include "drive/path_motion.hpp"

#include "splinefeed/number/wide_root.hpp"
#include "splinefeed/s5_pulse_train/unit_scale.hpp"

namespace firmware {

using splinefeed::UnitScale;
using splinefeed::Wide;

namespace {

constexpr std::uint32_t one_place = 8; // ticks, 1 us: a hold that is so near to a joint stands at it
using Segment = SegmentQueue::Segment;
constexpr std::int64_t position_units = splinefeed::units_per_count >> Segment::position_bits;
constexpr std::int64_t velocity_units = splinefeed::units_per_count >> Segment::velocity_bits;

constexpr bool is_within(std::int64_t value, std::int64_t bound) noexcept {
    return value < bound && value > -bound;
}

} // namespace

void PathMotion::begin(std::uint32_t first, const PerAxis<std::int64_t>& position) noexcept {
    queue_.begin(first);
    start_ = position;
    start_velocity_ = {};
    start_ticks_ = 1;
    passed_ = 0;
    loaded_ = false;
}

PathRate::Ahead PathMotion::ahead() const noexcept {
    return {queue_.ticks() - passed_, !queue_.rests_ahead(), holds_};
}

void PathMotion::start() noexcept {
    holds_ = false;
    rate_.start(ahead());
}

void PathMotion::leave() noexcept {
    holds_ = false;
    rate_.stop();
}

bool PathMotion::end_before(std::uint32_t sequence) noexcept {
    const SegmentQueue::Left left = queue_.left_before(sequence, passed_ > 0);
    if (!left.rests && !rate_.stops_within(left.ticks - passed_)) {
        return false;
    }
    queue_.drop_from(left);
    loaded_ = loaded_ && passed_ > 0;
    return true;
}

/// Prepares the front; false: it is faster than AxisCubic can say, and so than any board.
bool PathMotion::load() noexcept {
    if (loaded_) {
        return true;
    }
    const Segment& segment = queue_.front();
    const UnitScale to_duration = UnitScale::ratio(segment.duration_ticks, start_ticks_);
    for (unsigned k = 0; k < drive_axes; ++k) {
        std::int64_t way = 0; // both ends may be at the ends of their range
        const bool fits = !__builtin_sub_overflow(segment.end[k] * position_units, start_[k], &way);
        const std::int64_t v0 = scaled_by(start_velocity_[k], to_duration);
        const std::int64_t v1 = segment.end_velocity[k] * velocity_units;
        if (!fits || !is_within(way, std::int64_t{1} << 48) || !is_within(v0, std::int64_t{1} << 50) ||
            !is_within(v1, std::int64_t{1} << 50)) {
            fast_axis_ = k;
            return false;
        }
        cubic_[k] = {v0, 3 * way - 2 * v0 - v1, v0 + v1 - 2 * way};
    }
    loaded_ = true;
    return true;
}

void PathMotion::finish_segment() noexcept {
    const Segment& segment = queue_.front();
    for (unsigned k = 0; k < drive_axes; ++k) {
        start_[k] = segment.end[k] * position_units;
        start_velocity_[k] = segment.end_velocity[k] * velocity_units;
    }
    start_ticks_ = segment.duration_ticks;
    passed_ = 0;
    loaded_ = false;
    queue_.pass();
}

/// In a step of this duration and way, which began with the rate `before`, the axes stand after this distance: the rest
/// of the step. With a constant change of the rate its square is linear in the way.
std::uint32_t PathMotion::stop_at_rest(std::uint32_t ticks, std::uint32_t before, std::uint64_t way,
                                       std::uint64_t distance) noexcept {
    if (way == 0) {
        return ticks;
    }
    const auto square = [](std::uint64_t rate) {
        return static_cast<std::int64_t>(rate * rate >> 30);
    };
    const std::int64_t change = (square(rate_.rate()) - square(before)) * static_cast<std::int64_t>(distance);
    const std::int64_t there = square(before) + change / static_cast<std::int64_t>(way);
    const std::uint64_t root =
        splinefeed::square_root(Wide{0, static_cast<std::uint64_t>(there > 0 ? there : 0) << 30});
    const auto rate = static_cast<std::uint32_t>(root < PathRate::full ? root : PathRate::full);
    rate_.set_rate(rate);
    rate_.pass_rest(ahead());
    const std::uint64_t sum = std::uint64_t{before} + rate;
    const std::uint64_t taken = sum > 0 ? (distance << 31) / sum : ticks;
    return taken < ticks ? ticks - static_cast<std::uint32_t>(taken) : 0;
}

PathMotion::Outcome PathMotion::pass(std::uint32_t ticks, AxisPlaces& out) noexcept {
    while (ticks > 0) {
        if (queue_.empty()) { // `end` took the rest away, at a joint
            refer(out);
            return Outcome::held;
        }
        const std::uint32_t before = rate_.rate();
        const std::uint64_t way = rate_.pass(ticks, ahead());
        std::uint64_t left = way;
        bool rested = false;
        while (!rested && !queue_.empty() && left >= segment_left()) {
            if (!load()) {
                return Outcome::too_fast;
            }
            left -= segment_left();
            rested = queue_.front().rest;
            finish_segment();
        }
        if (queue_.empty()) {
            refer(out);
            return rested ? Outcome::complete : Outcome::held;
        }
        if (rested) {
            ticks = stop_at_rest(ticks, before, way, way - left);
            continue;
        }
        if (!load()) {
            return Outcome::too_fast;
        }
        passed_ += static_cast<std::uint32_t>(left);
        ticks = 0;
        if (holds_ && rate_.rate() == 0) {
            const bool at_joint = segment_left() <= one_place;
            const bool complete = at_joint && queue_.front().rest && queue_.next() - queue_.passed() == 1;
            if (at_joint) {
                finish_segment();
            }
            refer(out);
            return complete ? Outcome::complete : Outcome::held;
        }
    }
    refer(out);
    return Outcome::moves;
}

void PathMotion::refer(AxisPlaces& out) const noexcept {
    if (!loaded_) { // at a joint
        const UnitScale to_slot = UnitScale::ratio(slot_ticks, start_ticks_);
        for (unsigned k = 0; k < drive_axes; ++k) {
            out.position[k] = start_[k];
            out.velocity[k] = PathRate::part(scaled_by(start_velocity_[k], to_slot), rate_.rate());
        }
        return;
    }
    const std::uint32_t duration = queue_.front().duration_ticks;
    const auto u = static_cast<std::uint32_t>(splinefeed::divide(Wide{passed_, 0}, duration).quotient >> 32);
    const UnitScale to_slot = UnitScale::ratio(slot_ticks, duration);
    for (unsigned k = 0; k < drive_axes; ++k) {
        out.position[k] = start_[k] + cubic_[k].at(u);
        out.velocity[k] = PathRate::part(scaled_by(cubic_[k].slope(u), to_slot), rate_.rate());
    }
}

} // namespace firmware
