// SPDX-License-Identifier: MIT
//
// With dR/dt = -sigma the curve sigma = sqrt(R / S) has the slope -1 / (2 S), so all phases have a constant slope a of
// 0 or +-1 / (2 S), and the way is sigma t + a t^2 / 2. A rise meets the curve where sigma^2 S = R:
//     (s + t / 2S)^2 S = R - s t - t^2 / 4S   =>   t = -2 S s + sqrt(2 S^2 s^2 + 2 S R)
#include "host_sim/drive/ring_motion.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splinefeed::host {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double same = 1e-10; // of the square of the rate: far above rounding, far below what anybody sees

double time_for(double way, double rate, double slope) noexcept {
    if (way <= 0.0) {
        return 0.0;
    }
    const double square = rate * rate + 2.0 * slope * way;
    const double sum = rate + std::sqrt(std::max(square, 0.0));
    return square < 0.0 || sum <= 0.0 ? never : 2.0 * way / sum;
}

constexpr double one_place_s = 1e-9; // a hold on the curve to a joint stands at the joint, whatever is rounded
constexpr double still = 1e-4;       // a rate below is rounding: its square is time of the ring

} // namespace

double TimeRate::largest(const Way& way) const noexcept {
    return way.ends_moving ? std::min(1.0, std::sqrt(way.ring_s / reserve_s_)) : 1.0;
}

void TimeRate::start(const Way& way) noexcept {
    rate_ = largest(way);
}

void TimeRate::pass_rest(const Way& way) noexcept {
    rate_ = std::min(rate_, largest(way));
}

TimeRate::Phase TimeRate::phase(const Way& way) noexcept {
    const double slope = 0.5 / reserve_s_;
    const double square = way.ring_s / reserve_s_;
    const Phase down{-slope, rate_ / slope, 0.0};
    if (way.holds) {
        return down;
    }
    if (way.ends_moving && rate_ * rate_ > square - same) {
        if (rate_ * rate_ < square + same) {
            rate_ = std::min(1.0, std::sqrt(square)); // on the curve: rounding does not add up
        }
        return {-slope, rate_ / slope, 0.0};
    }
    if (rate_ < 1.0) {
        Phase up{slope, (1.0 - rate_) / slope, 1.0};
        if (way.ends_moving) {
            const double twice = 2.0 * reserve_s_ * rate_;
            const double meets = std::sqrt(0.5 * twice * twice + 2.0 * reserve_s_ * way.ring_s) - twice;
            if (meets < up.time_s) {
                up = {slope, std::max(meets, 0.0), rate_ + slope * std::max(meets, 0.0)};
            }
        }
        return up;
    }
    return {0.0, way.ends_moving ? way.ring_s - reserve_s_ : never, 1.0};
}

TimeRate::Passed TimeRate::pass(double time_s, const Way& way) noexcept {
    Passed passed;
    // Up, along at 1 and down are three phases; a few more may be of no length by rounding.
    for (int phases = 0; phases < 16 && passed.time_s < time_s; ++phases) {
        Way left = way;
        left.ring_s = std::max(way.ring_s - passed.way_s, 0.0);
        left.segment_s = std::max(way.segment_s - passed.way_s, 0.0);
        const Phase now = phase(left);
        const double to_end = time_for(left.segment_s, rate_, now.slope);
        const double left_s = time_s - passed.time_s;
        // On the curve both are the same instant.
        const bool ends_here = now.end_rate == 0.0 && !way.holds && left.segment_s >= left.ring_s;
        if (std::min(to_end, ends_here ? now.time_s : never) <= std::min(left_s, now.time_s)) {
            const double taken = std::min(to_end, now.time_s);
            rate_ = ends_here && now.time_s <= to_end ? 0.0 : std::max(rate_ + now.slope * taken, 0.0);
            return {passed.time_s + taken, way.segment_s, true};
        }
        const double taken = std::min(left_s, now.time_s);
        passed.time_s += taken;
        passed.way_s += rate_ * taken + 0.5 * now.slope * taken * taken;
        rate_ = taken == now.time_s ? now.end_rate : rate_ + now.slope * taken;
        if (way.holds && rate_ == 0.0) {
            break;
        }
    }
    passed.way_s = std::min(passed.way_s, way.segment_s);
    return passed;
}

void RingMotion::begin(std::uint32_t first, const PvtReference& reference) noexcept {
    PerAxis<std::int64_t> here{};
    for (std::size_t k = 0; k < axes_; ++k) {
        here[k] = std::llround(reference.counts[k] * map_units_per_count);
    }
    ring_.begin(first, here);
}

TimeRate::Way RingMotion::way() const noexcept {
    return {.ring_s = ring_.ahead_s(),
            .segment_s = ring_.empty() ? 0.0 : ring_.segment_ahead_s(),
            .ends_moving = !ring_.rests_ahead(),
            .holds = holds_};
}

void RingMotion::start() noexcept {
    holds_ = false;
    rate_.start(way());
}

void RingMotion::leave() noexcept {
    holds_ = false;
    rate_.stop();
}

bool RingMotion::end_before(std::uint32_t sequence) noexcept {
    const PvtRing::Left left = ring_.left_before(sequence);
    if (!left.rests && !rate_.stops_within(left.way_s)) {
        return false;
    }
    ring_.end_before(sequence);
    return true;
}

RingMotion::Outcome RingMotion::pass(std::uint64_t now_us, double duration_s, PvtReference& reference) {
    double left_s = duration_s;
    while (left_s > 0.0) {
        if (ring_.empty()) {
            return at_end(false, reference); // `end` took the rest away, at a joint
        }
        const TimeRate::Passed passed = rate_.pass(left_s, way());
        left_s = std::max(left_s - passed.time_s, 0.0);
        if (!passed.at_end) {
            ring_.pass(passed.way_s);
            refer(reference);
            if (!holds_ || rate_.rate() > 0.0) {
                return Outcome::moves;
            }
            if (ring_.segment_ahead_s() > one_place_s) {
                return Outcome::held;
            }
            const Outcome outcome = finish_segment(static_cast<double>(now_us) + duration_s * us_per_s, reference);
            return outcome == Outcome::moves ? Outcome::held : outcome;
        }
        const double end_us = static_cast<double>(now_us) + (duration_s - left_s) * us_per_s;
        if (const Outcome outcome = finish_segment(end_us, reference); outcome != Outcome::moves) {
            return outcome;
        }
    }
    return Outcome::moves;
}

void RingMotion::refer(PvtReference& reference) const noexcept {
    for (std::size_t k = 0; k < axes_; ++k) {
        const PvtRing::Jet jet = ring_.at(static_cast<int>(k));
        reference.counts[k] = jet.position;
        reference.counts_s[k] = jet.velocity * rate_.rate();
    }
}

RingMotion::Outcome RingMotion::finish_segment(double end_us, PvtReference& reference) {
    const ExecutedSegment executed{ring_.executed(), ring_.current(), end_us};
    ring_.pass(ring_.segment_ahead_s());
    refer(reference);
    ring_.finish();
    for (std::size_t k = 0; k < axes_; ++k) {
        reference.counts[k] = ring_.start(static_cast<int>(k));
    }
    if (observer_) {
        observer_(executed);
    }
    if (ring_.empty()) {
        return at_end(executed.segment.rest, reference);
    }
    if (executed.segment.rest) {
        rate_.pass_rest(way());
    }
    return Outcome::moves;
}

RingMotion::Outcome RingMotion::at_end(bool complete, const PvtReference& reference) const noexcept {
    if (complete) {
        return Outcome::complete;
    }
    return rate_.rate() < still || reference.rests() ? Outcome::held : Outcome::underflow;
}

} // namespace splinefeed::host
