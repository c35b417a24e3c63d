// SPDX-License-Identifier: MIT
#include "host_sim/drive/ring_motion.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double one_place_s = 1e-9; // a hold on the curve to a joint stands at the joint, whatever is rounded
constexpr double still = 1e-4;       // a rate below is rounding: its square is time of the ring

} // namespace

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
