// SPDX-License-Identifier: MIT
// What a motion says of itself.
#include "host_sim/run/motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sys/resource.h>

namespace splinefeed::host {

// Of a real machine what it has done, not what is planned.
void Motion::show_progress() {
    if (!progress_ || !progress_->due()) {
        return;
    }
    if (!live_->is_real()) {
        progress_->show({line_ > 0 ? passed_ : feeder_.rows(), line_, machine_.cycle_time_s()});
        return;
    }
    const LiveMachine::Reached reached = live_->reached();
    std::string place;
    for (const RunTarget::AxisPlace& at : live_->places()) {
        place += at.known() ? fmt::format(" {}={:.3f}", description_->axis_name[at.axis], *at.known()) : std::string();
    }
    const double segment_s = figures_->segment_ticks / (ticks_per_us * 1e6);
    progress_->show({reached.moves, reached.line, static_cast<double>(live_->executed()) * segment_s, true, place});
}

// Where the path is too far from its moves; empty: nowhere.
std::string Motion::excess() const {
    const auto& excess = deviation_.excess();
    return excess ? describe(*excess, feeder_.program()->name_of_move(excess->place.move, excess->place.line))
                  : std::string();
}

ToleranceSummary Motion::tolerance_summary() const {
    ToleranceSummary out;
    const auto place = [&](const PathDeviation::Place& of) {
        return of.distance > 0.0 ? ToleranceSummary::Place{of.distance, feeder_.program()->number_of_move(of.move),
                                                           of.line, feeder_.program()->name_of_move(of.move, of.line)}
                                 : ToleranceSummary::Place{};
    };
    out.deviation = place(deviation_.linear());
    if (deviation_.has_rotary()) {
        out.rotary_deviation = place(deviation_.rotary());
    }
    out.excess = excess();
    const PlannedPath::Statistics path = path_->statistics();
    const PathCounts& counts = path.counts;
    out.blended = counts.joints.blended;
    // The path knows the stops that it asks for. Where the motion stands at a kink that is too sharp to be passed, that
    // is found when the arc length is measured.
    const std::uint64_t unrounded = counts.joints.stopped + counts.joints.through;
    const std::uint64_t stood = operated_ == 0 ? std::min(rests_, unrounded) : 0;
    out.stopped = std::max(counts.joints.stopped, stood);
    out.through = unrounded - out.stopped;
    out.chains = counts.chains;
    out.elements = feeder_.rows() - (input_->lines_within_tolerance() && feeder_.rows() > 0 ? 1U : 0U);
    out.pieces = path.curve_segments;
    out.exact_stop_s = exact_stop_.seconds() + steps_.summary().dwell_s;
    return out;
}

Summary Motion::summary() const {
    Summary summary;
    const PlannedPath::Statistics path = path_->statistics();
    summary.cycle_time_s = machine_.cycle_time_s();
    summary.length_mm = length_.is_part() || !stopped_.empty() ? length_.mm() : path.length_mm;
    summary.waypoints = feeder_.rows();
    summary.curve_segments = path.curve_segments;
    summary.feed_segments = segments_;
    summary.scalar = path.scalar;
    summary.jerk_scalar = path.jerk_scalar;
    summary.curve = input_->curve_name();
    summary.max_speed_mm_s = machine_.max_path_speed_mm_s();
    for (int k = 0; k < figures_->axes; ++k) {
        const LimitUse& use = machine_.use(k);
        const AxisSettings& axis = description_->settings.axis[static_cast<unsigned>(k)];
        const bool has_jerk = axis.max_jerk_mm_s3 > 0.0;
        summary.limit_use.push_back(
            {description_->axis_name[static_cast<unsigned>(k)], use.velocity, use.acceleration,
             has_jerk ? std::optional(use.jerk) : std::nullopt,
             has_jerk ? std::optional(1.0 - path.jerk_mm_s3[static_cast<unsigned>(k)] / axis.max_jerk_mm_s3)
                      : std::nullopt});
    }
    // Segments that came whole are not measured against the points they were made of.
    if (input_->segments() == nullptr && !input_->within_tolerance() && passes_waypoints(summary.curve)) {
        summary.waypoint_error_mm = error_.largest_mm();
    }
    if (stopped_.empty() && operated_ == 0) { // an override may be faster than what was programmed
        summary.optimum_time_s = optimum_.seconds() + steps_.summary().dwell_s;
    }
    if (input_->within_tolerance()) {
        summary.tolerance = tolerance_summary();
    }
    summary.program = steps_.summary();
    summary.program.line = live_->reached().line > 0 ? live_->reached().line : line_;
    summary.program.left_out = input_->left_out();
    summary.program.dialect = input_->dialect_choice();
    summary.limit_share = share_.shares();
    summary.planning_time_s = std::chrono::duration<double>(planning_).count();
    summary.memory_bytes = {path.curve_bytes, path.plan_bytes, path.stream_bytes};
    summary.stopped = !stopped_.empty();
    summary.events = operated_;
    summary.events_not_reached = events_.size() - operated_;
    summary.window_limited = path.window_limited;
    summary.searched_legs = path.searched_legs;
    summary.slow_legs = path.slow_legs;
    summary.stops = rests_ - (at_end_ ? 1U : 0U);
    const double duration_s = figures_->segment_ticks / (ticks_per_us * 1e6);
    summary.smoothing_bound_mm =
        duration_s * duration_s / 6.0 * std::sqrt(axis_totals(within_jerk(description_->settings)).acceleration_sq);
    live_->describe(summary);
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) == 0) {
        summary.peak_rss_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
    }
    return summary;
}

} // namespace splinefeed::host
