// SPDX-License-Identifier: MIT
#include "spindle_sync.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::linuxcnc {

namespace {

constexpr double watch_per_s = 150.0; // an encoder of 400 counts a turn is smooth, a change is followed in 0.02 s
constexpr double follow_per_s = 150.0;
constexpr double end_mm = 1e-10; // of a difference of third order in 0.25 ms it is 6 mm/s^3
constexpr double never = 1e9;
constexpr int halvings = 44;
constexpr double ending =
    0.45; // of the limits, where two legs share them: the second one can do what the first one asks
constexpr double beginning = 0.55;
constexpr double least_cap = 0.01; // of the speed of a leg that comes to its end, while the next one is under way

LegState advanced(LegState s, double jerk, double t) noexcept {
    s.at += t * (s.speed + t * (s.acceleration / 2.0 + t * jerk / 6.0));
    s.speed += t * (s.acceleration + t * jerk / 2.0);
    s.acceleration += t * jerk;
    return s;
}

} // namespace

void SpindleWatch::start(double turns, double per_s) noexcept {
    turns_ = turns;
    per_s_ = per_s;
    per_s2_ = 0.0;
}

void SpindleWatch::take(double turns, double period_s) noexcept {
    const double kept = std::exp(-watch_per_s * period_s);
    const double new_part = 1.0 - kept;
    const double predicted = turns_ + period_s * (per_s_ + 0.5 * period_s * per_s2_);
    const double off = turns - predicted;
    turns_ = predicted + (1.0 - kept * kept * kept) * off;
    per_s_ += period_s * per_s2_ + 1.5 * new_part * new_part * (1.0 + kept) / period_s * off;
    per_s2_ += new_part * new_part * new_part / (period_s * period_s) * off;
}

bool FollowedLeg::ease(const LegLimits& limits) noexcept {
    FollowedLeg eased(length_, limits, period_s_);
    eased.now_ = now_;
    const bool can = std::fabs(now_.acceleration) <= limits.acceleration && eased.stops(now_) &&
                     eased.below(now_, limits.velocity) && eased.forward(now_);
    *this = can ? eased : *this;
    return can;
}

// Without a jerk limit an acceleration may change from one limit to the other in a period.
FollowedLeg::FollowedLeg(double length, const LegLimits& limits, double period_s, bool both_ways) noexcept
    : length_(length), period_s_(period_s), limits_(limits), both_ways_(both_ways) {
    const double most = 2.0 * limits.acceleration / period_s;
    limits_.jerk = limits.jerk > 0.0 ? std::min(limits.jerk, most) : most;
}

LegState FollowedLeg::moved(double jerk) const noexcept {
    return advanced(now_, jerk, period_s_);
}

// The fastest way to rest: an acceleration against the speed is built up, held, and taken back.
LegState FollowedLeg::stopped(LegState s, double within_s) const noexcept {
    const auto& [velocity, most, jerk] = limits_;
    const double against = s.speed + s.acceleration * std::fabs(s.acceleration) / (2.0 * jerk) < 0.0 ? 1.0 : -1.0;
    const double v = -against * s.speed;
    const double a = -against * s.acceleration;
    const double peak_sq = std::max(jerk * v + 0.5 * a * a, 0.0);
    const double peak = std::min(std::sqrt(peak_sq), most);
    const double held_s = std::max(peak_sq - most * most, 0.0) / (jerk * most);
    const double times[] = {std::max((a + peak) / jerk, 0.0), held_s, peak / jerk};
    const double signs[] = {against, 0.0, -against};
    for (int i = 0; i < 3; ++i) {
        const double t = std::min(times[i], within_s);
        s = advanced(s, signs[i] * jerk, t);
        if (!(within_s > times[i])) {
            return s;
        }
        within_s -= t;
    }
    return {s.at, 0.0, 0.0};
}

bool FollowedLeg::below(const LegState& s, double most_speed) const noexcept {
    const double rises = std::max(s.acceleration, 0.0);
    return s.speed + rises * rises / (2.0 * limits_.jerk) <= most_speed;
}

bool FollowedLeg::forward(const LegState& s) const noexcept {
    const double falls = std::min(s.acceleration, 0.0);
    return s.speed - falls * falls / (2.0 * limits_.jerk) >= (both_ways_ ? -limits_.velocity : 0.0);
}

bool FollowedLeg::stops(const LegState& s) const noexcept {
    return both_ways_ || stopped(s, never).at <= length_;
}

double FollowedLeg::top_speed() const noexcept {
    const double rises = std::max(now_.acceleration, 0.0);
    return now_.speed + rises * rises / (2.0 * limits_.jerk);
}

bool FollowedLeg::at_end() const noexcept {
    return rests() && left() <= end_mm;
}

// The jerk next to the wanted one, towards the safe one, that is allowed; or the safe one.
template <class Allowed>
double FollowedLeg::bounded(double wanted, double safe, Allowed allowed) const noexcept {
    if (allowed(moved(wanted))) {
        return wanted;
    }
    double refused = wanted;
    const int steps = allowed(moved(safe)) ? halvings : 0;
    for (int i = 0; i < steps; ++i) {
        const double middle = 0.5 * (refused + safe);
        (allowed(moved(middle)) ? safe : refused) = middle;
    }
    return safe;
}

void FollowedLeg::follow(const LegState& target, double most_speed) noexcept {
    const auto& [velocity, most, jerk] = limits_;
    most_speed = std::min(most_speed, velocity);
    const double low = std::max(-jerk, (-most - now_.acceleration) / period_s_);
    const double high = std::min(jerk, (most - now_.acceleration) / period_s_);
    const LegState coming = moved(0.0);
    const double off = target.at - coming.at;
    const double law = target.acceleration + follow_per_s * (follow_per_s * off + 2.0 * (target.speed - coming.speed));
    const double to_top = follow_per_s * (most_speed - coming.speed); // without it, speed would swing at its limit
    double chosen = std::clamp((std::min(law, to_top) - now_.acceleration) / period_s_, low, high);
    // It comes to the spindle's speed before its place, and takes its acceleration back before the speed is passed.
    const double side = off > 0.0 ? 1.0 : -1.0;
    const double of_law = std::min(most, limits_.jerk / follow_per_s) / (follow_per_s * follow_per_s);
    const bool near = std::fabs(off) < of_law; // so the law alone is within its limits
    const auto meets = [&](const LegState& s) {
        return near || side * stopped({s.at - target.at, s.speed - target.speed, s.acceleration}, never).at <= 0.0;
    };
    const auto releases = [&](const LegState& s) {
        const double a = s.acceleration - target.acceleration;
        return side * a >= 0.0 || side * (s.speed - target.speed) >= a * a / (2.0 * limits_.jerk);
    };
    chosen = bounded(chosen, side > 0.0 ? high : low, releases);
    chosen = bounded(chosen, side > 0.0 ? low : high, meets);
    chosen = bounded(chosen, low, [&](const LegState& s) { return below(s, most_speed); });
    ends_ = !stops(moved(chosen));
    chosen = bounded(chosen, low, [&](const LegState& s) { return stops(s); });
    chosen = bounded(chosen, high, [&](const LegState& s) { return forward(s); });
    const LegState next = moved(chosen);
    if (!stops(next) || !forward(next)) { // within the period the jerk has to change: on the way to rest it does
        brake();
    } else {
        now_ = next;
    }
}

void FollowedLeg::brake() noexcept {
    now_ = stopped(now_, period_s_);
}

void SpindleSync::start(double period_s) noexcept {
    period_s_ = period_s;
    joined_ = false;
}

LegLimits SpindleSync::part_of(const Leg& leg, double part) noexcept {
    part = leg.shares ? part : 1.0;
    return {leg.limits.velocity, part * leg.limits.acceleration, part * leg.limits.jerk};
}

void SpindleSync::begin(const Leg& leg, double turns, double per_s) noexcept {
    watch_.start(turns - per_s * period_s_, per_s);
    leg_ = leg;
    first_ = FollowedLeg(leg.length, part_of(leg, ending), period_s_, leg.both_ways);
    from_ = 0.0;
    eased_ = true;
}

void SpindleSync::join(const Leg& leg) noexcept {
    next_ = leg;
    second_ = FollowedLeg(leg.length, part_of(leg, beginning), period_s_);
    joined_ = true;
}

void SpindleSync::leave() noexcept {
    from_ += leg_.length / leg_.pitch;
    leg_ = next_;
    first_ = second_;
    joined_ = eased_ = false;
}

bool SpindleSync::may_join(double most_left) const noexcept {
    return !joined_ && leg_.shares && eased_ && first_.ends() && first_.left() <= most_left;
}

void SpindleSync::run(double turns) noexcept {
    watch_.take(turns, period_s_);
    eased_ = eased_ || first_.ease(part_of(leg_, ending));
    cap_ = std::max(first_.top_speed(), least_cap * leg_.limits.velocity);
    first_.follow({leg_.pitch * (watch_.turns() - from_), leg_.pitch * watch_.per_s(), leg_.pitch * watch_.per_s2()},
                  joined_ ? cap_ : leg_.limits.velocity);
}

// What the first leg lacks at its end, the second one takes.
void SpindleSync::run_joined() noexcept {
    const LegState& s = first_.state();
    const double ratio = next_.pitch / leg_.pitch;
    second_.follow({ratio * (leg_.pitch * (watch_.turns() - from_) - s.at),
                    ratio * (leg_.pitch * watch_.per_s() - s.speed),
                    ratio * (leg_.pitch * watch_.per_s2() - s.acceleration)},
                   next_.limits.velocity * (1.0 - cap_ / leg_.limits.velocity));
}

void SpindleSync::go_on() noexcept {
    first_.follow({2.0 * leg_.length + never, 0.0, 0.0}, leg_.limits.velocity);
}

void SpindleSync::brake() noexcept {
    first_.brake();
    if (joined_) {
        second_.brake();
    }
}

} // namespace splinefeed::linuxcnc
