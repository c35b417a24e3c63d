// SPDX-License-Identifier: MIT
// SpindleSync: motion along straight legs that follows the revolutions of a spindle.
//
//   turns of the encoder ──► SpindleWatch ──► FollowedLeg ──► place on the leg under way
//                            filtered         FollowedLeg ──► place on the next one, which begins before it is over
//
// A leg begins at rest, catches up, follows, and comes to rest at its end. In every period it takes the jerk that a
// linear law asks for, as far as it can still stop at the end, meet the spindle without passing it, and keep its
// limits. So samples, and all their differences, keep them, however the spindle turns.
#pragma once

#include <cmath>

namespace splinefeed::linuxcnc {

struct LegLimits {
    double velocity = 0.0, acceleration = 0.0, jerk = 0.0; ///< along the leg; a jerk of 0: no limit
};

struct LegState {
    double at = 0.0, speed = 0.0, acceleration = 0.0;
};

/// Revolutions without the steps of an encoder: a critically damped filter that follows a constant speed exactly.
class SpindleWatch {
public:
    void start(double turns, double per_s) noexcept;
    void take(double turns, double period_s) noexcept;
    [[nodiscard]] double turns() const noexcept { return turns_; }
    [[nodiscard]] double per_s() const noexcept { return per_s_; }
    [[nodiscard]] double per_s2() const noexcept { return per_s2_; }

private:
    double turns_ = 0.0, per_s_ = 0.0, per_s2_ = 0.0;
};

class FollowedLeg {
public:
    FollowedLeg() = default;
    /// @param both_ways it may turn back, and go beyond its end
    FollowedLeg(double length, const LegLimits& limits, double period_s, bool both_ways = false) noexcept;

    void follow(const LegState& target, double most_speed) noexcept; ///< a period on; target: at its end
    void brake() noexcept;                                           ///< a period on, to rest
    bool ease(const LegLimits& limits) noexcept;                     ///< has lower limits from now on, if it can
    [[nodiscard]] const LegState& state() const noexcept { return now_; }
    [[nodiscard]] double left() const noexcept { return length_ - now_.at; }
    [[nodiscard]] double part() const noexcept { return now_.at / length_; } ///< that is done
    [[nodiscard]] bool rests() const noexcept { return now_.speed == 0.0 && now_.acceleration == 0.0; }
    [[nodiscard]] bool at_end() const noexcept;
    [[nodiscard]] bool ends() const noexcept { return ends_; } ///< it brakes because of its end
    [[nodiscard]] double top_speed() const noexcept;           ///< that it comes to, whatever it does now

private:
    [[nodiscard]] LegState moved(double jerk) const noexcept;
    [[nodiscard]] LegState stopped(LegState from, double within_s) const noexcept;
    [[nodiscard]] bool below(const LegState& state, double most_speed) const noexcept;
    [[nodiscard]] bool stops(const LegState& state) const noexcept;
    [[nodiscard]] bool forward(const LegState& state) const noexcept;
    template <class Allowed>
    [[nodiscard]] double bounded(double wanted, double safe, Allowed allowed) const noexcept;

    double length_ = 0.0, period_s_ = 0.001;
    LegLimits limits_{};
    LegState now_{};
    bool both_ways_ = false;
    bool ends_ = false;
};

/// The leg under way, and the next one.
class SpindleSync {
public:
    /// What a leg needs. Where another one begins before it is over, `shares` is set for both: each has a part of
    /// the acceleration and jerk, so their sum keeps the limits.
    struct Leg {
        double length = 0.0, pitch = 0.0; ///< mm, mm a revolution
        LegLimits limits{};
        bool shares = false;
        bool both_ways = false;
    };

    void start(double period_s) noexcept;                            ///< nothing moves
    void begin(const Leg& leg, double turns, double per_s) noexcept; ///< the first leg. The index was just passed
    void join(const Leg& leg) noexcept;                              ///< the next leg
    void leave() noexcept;           ///< the first leg is over; the joined one is the first
    void run(double turns) noexcept; ///< a period of the first leg
    void run_joined() noexcept;      ///< and of the next one, behind it
    void brake() noexcept;
    void go_on() noexcept; ///< a period of the first leg to its end, without the spindle
    /// Whether the next leg may begin: the first one comes to its end, and no more than this is left of it.
    [[nodiscard]] bool may_join(double most_left) const noexcept;
    [[nodiscard]] bool joined() const noexcept { return joined_; }
    [[nodiscard]] bool rests() const noexcept { return first_.rests() && (!joined_ || second_.rests()); }
    [[nodiscard]] bool too_fast() const noexcept {
        return std::fabs(watch_.per_s()) * leg_.pitch > leg_.limits.velocity;
    }
    [[nodiscard]] const FollowedLeg& first() const noexcept { return first_; }
    [[nodiscard]] const FollowedLeg& second() const noexcept { return second_; }

private:
    [[nodiscard]] static LegLimits part_of(const Leg& leg, double part) noexcept;

    SpindleWatch watch_{};
    Leg leg_{}, next_{};
    FollowedLeg first_{}, second_{};
    double cap_ = 0.0;  // of the speed of the first leg, while the next one is under way
    double from_ = 0.0; // turns at which the first leg begins
    double period_s_ = 0.001;
    bool joined_ = false;
    bool eased_ = true; // the first leg has the limits of one that ends
};

} // namespace splinefeed::linuxcnc
