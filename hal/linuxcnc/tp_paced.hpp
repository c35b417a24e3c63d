// SPDX-License-Identifier: MIT
// PacedValue: an override or a limit that may change in every period, and that a plan follows at its own pace.
#pragma once

namespace splinefeed::linuxcnc {

/// Every change makes a plan anew, and a change that comes before its plan is made is in vain: a feed of 0 and 1 in
/// turn would creep, or never begin. So the value is passed on at most once in a time `pace_s`, and while it changes
/// more often, as its mean since then. At a pace of 0.1 s and more, where a plan is a search, a mean that is within 1 %
/// of what was passed on is noise, and changes nothing.
///
/// A swing is passed on at once: to 0 or from it, below half of what it was, or above twice of it. If one comes back
/// within 0.2 s, the pace is 0.1 s at least: within a pace of 4 ms a machine can neither start nor stop, so a feed of
/// 0.05 and 1 in turn would stay near 0.05.
class PacedValue {
public:
    explicit PacedValue(double value) noexcept : asked_(value), passed_(value), farthest_(value) {}

    /// A period with this value. @return whether value() is another one now
    bool take(double asked, double period_s, double pace_s) noexcept {
        since_passed_s_ += period_s;
        since_change_s_ += period_s;
        since_fall_s_ += period_s;
        since_rise_s_ += period_s;
        sum_s_ += asked * period_s;
        bool at_once = false;
        if (asked != asked_) {
            const bool was_high = high_;
            if (swings(asked)) {
                double& since_same_s = high_ ? since_rise_s_ : since_fall_s_;
                at_once = high_ == was_high || !(since_same_s < 2.0 * slow_s);
                swings_often_ = !at_once;
                since_same_s = 0.0;
            }
            restless_ = swings_often_ || since_change_s_ < pace_s;
            since_change_s_ = 0.0;
            asked_ = asked;
        }
        swings_often_ = swings_often_ && (since_fall_s_ < slow_s || since_rise_s_ < slow_s);
        pace_s = swings_often_ && pace_s < slow_s ? slow_s : pace_s;
        restless_ = restless_ && since_change_s_ < pace_s;
        const double value = restless_ && !at_once ? sum_s_ / since_passed_s_ : asked;
        if (value == passed_ || (!at_once && since_passed_s_ < pace_s)) {
            return false;
        }
        const double change = value > passed_ ? value - passed_ : passed_ - value;
        if (restless_ && !at_once && pace_s >= slow_s && change <= noise * passed_) {
            since_passed_s_ *= 0.5; // the older half of the mean fades
            sum_s_ *= 0.5;
            return false;
        }
        passed_ = value;
        since_passed_s_ = sum_s_ = 0.0;
        return true;
    }
    [[nodiscard]] double value() const noexcept { return passed_; }

private:
    static constexpr double slow_s = 0.1; // pace of a value that swings
    static constexpr double noise = 0.01; // of the value

    bool swings(double asked) noexcept {
        const bool at_zero = (asked > 0.0) != (asked_ > 0.0);
        if (at_zero || (high_ ? 2.0 * asked < farthest_ : asked > 2.0 * farthest_)) {
            high_ = asked > asked_;
            farthest_ = asked;
            return true;
        }
        farthest_ = (asked > farthest_) == high_ ? asked : farthest_;
        return false;
    }

    double asked_;    // in the last period
    double passed_;   // what the plan knows
    double farthest_; // the largest one since the last swing, or the smallest
    double sum_s_ = 0.0;
    double since_passed_s_ = 1.0; // long ago
    double since_change_s_ = 1.0;
    double since_fall_s_ = 1.0; // since the last swing
    double since_rise_s_ = 1.0;
    bool high_ = true;      // the last swing was a rise
    bool restless_ = false; // it changes more often than it is passed on
    bool swings_often_ = false;
};

} // namespace splinefeed::linuxcnc
