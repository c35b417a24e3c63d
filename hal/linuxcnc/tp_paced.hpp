// SPDX-License-Identifier: MIT
// PacedValue: an override or a limit that may change in every period, and that a plan follows at its own pace.
#pragma once

namespace splinefeed::linuxcnc {

/// Every change makes a plan anew, and a change that comes before its plan is made is in vain: a feed of 0 and 1 in
/// turn would creep, or never begin. So the value is passed on at most once in a time `pace_s`, and while it changes
/// more often, as its mean since then. Where it comes to 0, or from it, it is passed on at once, unless that has
/// happened shortly before, too.
class PacedValue {
public:
    explicit PacedValue(double value) noexcept : asked_(value), passed_(value) {}

    /// A period with this value. @return whether value() is another one now
    bool take(double asked, double period_s, double pace_s) noexcept {
        since_passed_s_ += period_s;
        since_change_s_ += period_s;
        since_stop_s_ += period_s;
        sum_s_ += asked * period_s;
        bool at_once = false;
        if (asked != asked_) {
            restless_ = since_change_s_ < pace_s;
            since_change_s_ = 0.0;
            if ((asked > 0.0) != (asked_ > 0.0)) {
                at_once = !(since_stop_s_ < pace_s);
                since_stop_s_ = 0.0;
            }
            asked_ = asked;
        }
        restless_ = restless_ && since_change_s_ < pace_s;
        const double value = restless_ && !at_once ? sum_s_ / since_passed_s_ : asked;
        if (value == passed_ || (!at_once && since_passed_s_ < pace_s)) {
            return false;
        }
        passed_ = value;
        since_passed_s_ = sum_s_ = 0.0;
        return true;
    }
    [[nodiscard]] double value() const noexcept { return passed_; }

private:
    double asked_;  // in the last period
    double passed_; // what the plan knows
    double sum_s_ = 0.0;
    double since_passed_s_ = 1.0; // long ago
    double since_change_s_ = 1.0;
    double since_stop_s_ = 1.0; // since it came to 0, or from it
    bool restless_ = false;
};

} // namespace splinefeed::linuxcnc
