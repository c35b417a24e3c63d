// SPDX-License-Identifier: MIT
// PacedValue: an override or a limit that may change in every period, and that a plan follows at its own pace.
#pragma once

namespace splinefeed::linuxcnc {

/// Every change makes a plan anew, and a change that comes before its plan is made is in vain: a feed of 0 and 1 in
/// turn would creep, or never begin. So the value is passed on at most once in a time `pace_s`, and while it changes
/// more often, as its mean since then. Where it comes to 0, or from it, it is passed on at once. If it does so again
/// within 0.2 s, the pace is 0.1 s at least: within a pace of 4 ms a machine can neither start nor stop.
class PacedValue {
public:
    explicit PacedValue(double value) noexcept : asked_(value), passed_(value) {}

    /// A period with this value. @return whether value() is another one now
    bool take(double asked, double period_s, double pace_s) noexcept {
        since_passed_s_ += period_s;
        since_change_s_ += period_s;
        since_stop_s_ += period_s;
        since_go_s_ += period_s;
        sum_s_ += asked * period_s;
        bool at_once = false;
        if (asked != asked_) {
            if ((asked > 0.0) != (asked_ > 0.0)) {
                double& since_same_s = asked > 0.0 ? since_go_s_ : since_stop_s_;
                at_once = !(since_same_s < 2.0 * slow_s);
                stops_often_ = !at_once;
                since_same_s = 0.0;
            }
            restless_ = stops_often_ || since_change_s_ < pace_s;
            since_change_s_ = 0.0;
            asked_ = asked;
        }
        stops_often_ = stops_often_ && since_change_s_ < slow_s;
        pace_s = stops_often_ && pace_s < slow_s ? slow_s : pace_s;
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
    static constexpr double slow_s = 0.1; // pace of a value that is 0 and not 0 in turn

    double asked_;  // in the last period
    double passed_; // what the plan knows
    double sum_s_ = 0.0;
    double since_passed_s_ = 1.0; // long ago
    double since_change_s_ = 1.0;
    double since_stop_s_ = 1.0; // since it came to 0
    double since_go_s_ = 1.0;   // and from it
    bool restless_ = false;     // it changes more often than it is passed on
    bool stops_often_ = false;
};

} // namespace splinefeed::linuxcnc
