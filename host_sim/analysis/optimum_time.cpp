// SPDX-License-Identifier: MIT
//
// TOPP-RA (Pham and Pham, 2018: backward the controllable sets, forward the fastest choice), with the axes'
// accelerations in integrated form. With the speed w = q' v of an axis, d(w^2)/dt = 2 w dw/dt, so over an interval in
// which the axis travels D (to and fro)
//
//   -2 B D <= q'_1^2 b_1 - q'_0^2 b_0 <= 2 A D
//
// follows from -B <= d|w|/dt <= A, A for speeding up and B for braking, whatever happens within: no derivative is
// replaced by a difference, and a coarse grid cannot make the bound too large. b_1 as a function of b_0 grows with it,
// from either end, so the largest b at every node is found by one backward and one forward pass; q'' enters by the
// speed limits of the nodes (path_grid.cpp). The sets of TOPP-RA are the intervals [0, reach].
//
// The time of an interval: each axis needs at least what it takes from w_0 to w_1 over D, at full acceleration up to a
// peak and down from it; the slowest axis counts, unless b linear in s is faster, 2 L / (v_0 + v_1): it is the case
// where no single axis accelerates in full all along. Between two nodes at their limits b follows the limits.
//
// Rounding of D is allowed for on the fast side: an axis that hardly moves must not bind by its noise.
#include "host_sim/analysis/optimum_time.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace splinefeed::host {

namespace {

constexpr double at_limit = 1.0 - 1e-9;

// Least time of one axis over `travel` from the speed w0 to w1, never above `most` (not below w0 and w1).
double axis_time(double travel, double w0, double w1, double most, double speeding, double braking) noexcept {
    const double up = 0.5 / speeding; // path per speed squared
    const double down = 0.5 / braking;
    const double peak_sq = (travel + up * w0 * w0 + down * w1 * w1) / (up + down);
    const double peak = peak_sq <= most * most ? std::sqrt(peak_sq) : most;
    const double ramps = (peak - w0) / speeding + (peak - w1) / braking;
    if (peak_sq <= most * most) {
        return ramps;
    }
    return ramps + (travel - up * (most * most - w0 * w0) - down * (most * most - w1 * w1)) / most;
}

} // namespace

OptimumTime::OptimumTime(const MachineSettings& machine, double direction_jump, ScalarKind scalar, std::size_t window)
    : grid_(machine, direction_jump, scalar), axes_(static_cast<unsigned>(machine.axes)), window_(window) {
    assert(window >= 4);
    for (unsigned k = 0; k < axes_; ++k) {
        speeding_[k] = machine.axis[k].max_acceleration_mm_s2;
        braking_[k] = machine.axis[k].braking_mm_s2();
    }
}

void OptimumTime::segment(const CurveSegment<double>& segment) {
    fresh_.clear();
    grid_.append(segment, fresh_);
    for (const PathInterval& interval : fresh_) {
        add(interval);
    }
}

void OptimumTime::add(const PathInterval& interval) {
    if (stages_.size() == window_) {
        advance(stages_.back().interval.exit_cap_sq, window_ / 2);
    }
    const double behind = stages_.empty() ? 0.0 : stages_.back().interval.exit_cap_sq;
    const double limit = interval.stop_before ? 0.0 : std::min(interval.entry_cap_sq, behind);
    stages_.push_back({interval, limit, std::numeric_limits<double>::infinity()});
    ++nodes_;
}

void OptimumTime::finish() {
    advance(0.0, stages_.size());
}

// Largest b at the start of a stage from which at most `end_sq` is reached at its end.
double OptimumTime::before(const Stage& stage, double end_sq) const noexcept {
    double start_sq = stage.limit_sq;
    for (unsigned k = 0; k < axes_; ++k) {
        const double entry = stage.interval.entry_slope[k];
        const double exit = stage.interval.exit_slope[k];
        const double most =
            exit * exit * end_sq + 2.0 * braking_[k] * (stage.interval.travel_mm[k] + stage.interval.noise_mm);
        if (entry * entry * start_sq > most) {
            start_sq = most / (entry * entry);
        }
    }
    return start_sq;
}

// Largest b at the end of an interval.
double OptimumTime::after(const PathInterval& interval, double start_sq) const noexcept {
    double end_sq = interval.exit_cap_sq;
    for (unsigned k = 0; k < axes_; ++k) {
        const double entry = interval.entry_slope[k];
        const double exit = interval.exit_slope[k];
        const double most = entry * entry * start_sq + 2.0 * speeding_[k] * (interval.travel_mm[k] + interval.noise_mm);
        if (exit * exit * end_sq > most) {
            end_sq = most / (exit * exit);
        }
    }
    return end_sq;
}

double OptimumTime::time(const PathInterval& interval, double start_sq, double end_sq) const noexcept {
    const double v0 = std::sqrt(start_sq);
    const double v1 = std::sqrt(end_sq);
    const double linear =
        v0 + v1 > 0.0 ? 2.0 * interval.length_mm / (v0 + v1) : std::numeric_limits<double>::infinity();
    if (start_sq >= interval.entry_cap_sq * at_limit && end_sq >= interval.exit_cap_sq * at_limit) {
        const double simpson =
            interval.length_mm / 6.0 * (1.0 / v0 + 4.0 / std::sqrt(interval.middle_cap_sq) + 1.0 / v1);
        return std::min(linear, simpson);
    }
    const double most = std::sqrt(std::max({interval.entry_cap_sq, interval.middle_cap_sq, interval.exit_cap_sq}));
    double least = interval.length_mm / most;
    for (unsigned k = 0; k < axes_; ++k) {
        const double entry = interval.entry_slope[k];
        const double exit = interval.exit_slope[k];
        const double middle = 1.5 * interval.travel_mm[k] / interval.length_mm - 0.25 * (entry + exit); // Simpson
        const double most_w = std::max({entry, exit, middle}) * most;
        if (most_w > 0.0) {
            const double travel = std::max(interval.travel_mm[k] - interval.noise_mm, 0.0);
            least = std::max(least, axis_time(travel, entry * v0, exit * v1, most_w, speeding_[k], braking_[k]));
        }
    }
    return std::min(linear, least);
}

// Backward from `end_sq` at the end of the window, then forward over the first `count` stages, which leave. What is
// known only grows: once a reach is what it was, so is everything before it.
void OptimumTime::advance(double end_sq, std::size_t count) {
    double reach = end_sq;
    for (std::size_t i = stages_.size(); i-- > 0;) {
        Stage& stage = stages_[i];
        reach = before(stage, reach);
        if (!(reach < stage.reach_sq)) {
            break;
        }
        stage.reach_sq = reach;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double next = i + 1 < stages_.size() ? stages_[i + 1].reach_sq : end_sq;
        const PathInterval& interval = stages_[i].interval;
        const double arrival = std::min(next, after(interval, start_sq_));
        seconds_ += time(interval, start_sq_, arrival);
        start_sq_ = arrival;
    }
    stages_.erase(stages_.begin(), stages_.begin() + static_cast<std::ptrdiff_t>(count));
}

} // namespace splinefeed::host
