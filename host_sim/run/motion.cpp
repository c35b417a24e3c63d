// SPDX-License-Identifier: MIT
#include "host_sim/run/motion.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/output/place_text.hpp"
#include "host_sim/output/progress.hpp"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/resource.h>

namespace splinefeed::host {

namespace {

/// Of a path, as a part of a move: double and Fixed have digits enough.
template <Scalar S>
constexpr double rounding_of = std::same_as<S, float> ? 1e-6 : 0.0;

constexpr std::chrono::milliseconds wait_slice{1}; // for input, before the target is looked at again

} // namespace

template <Scalar S>
Motion<S>::Motion(const MotionArguments& arguments, const MachineDescription& description,
                  const MotionLimits<S>& limits, PathInput& input, const PathLimits& path_limits, Outputs& outputs,
                  Supervision* target)
    : quiet_(arguments.quiet), enforce_(arguments.enforce), description_(&description), limits_(&limits),
      input_(&input), outputs_(&outputs), report_(arguments.report), target_(target),
      deviation_(description.settings, input.tolerances().joint_mm, rounding_of<S>), exact_stop_(description.settings),
      optimum_(description.settings, to_double(limits.refinement.direction_jump)), share_(description.settings),
      steps_(limits, !arguments.quiet), feeder_(input),
      tee_(feeder_, input.name(),
           {.limits = &path_limits,
            .writer = outputs.curve(),
            .error = &error_,
            .deviation = input.within_tolerance() ? &deviation_ : nullptr,
            .optimum = &optimum_,
            .share = &share_}),
      planner_(tee_, limits, arguments.window_cells), trajectory_(planner_.trajectory()),
      machine_(description, limits.segments_per_sample, {.enforce = arguments.enforce, .trace = outputs.trace()}),
      events_(arguments.events.empty() ? std::vector<OperatorEvent>{} : read_event_file(arguments.events)) {}

template <Scalar S>
void Motion<S>::execute_all(std::optional<std::uint64_t> waypoints) {
    Progress progress({.quiet = quiet_, .waypoints = waypoints});
    FeedSegment segment;
    for (;;) {
        operate();
        obey_target();
        if (target_ != nullptr && target_->over()) {
            break;
        }
        if (paused_ && feeder_.wait_for_row(Clock::duration::zero())) {
            read();
        }
        if (dwell(segment)) {
            if (!execute(segment)) {
                break;
            }
            if (report_ != nullptr) {
                report_->stood(steps_.line(), segment.duration_ticks / (ticks_per_us * 1e6));
            }
            steps_.stood(segment);
        } else if (pull(segment)) {
            if (segments_ == 0 && tee_.failure()) {
                std::rethrow_exception(tee_.failure());
            }
            steps_.begin(segment, machine_.cycle_time_s());
            pass(segment.waypoint);
            if (!execute(segment)) {
                break;
            }
            if (report_ != nullptr) {
                report_->moved(segment.waypoint, segment.duration_ticks / (ticks_per_us * 1e6), share_.bound());
            }
            progress.update(feeder_.rows(), machine_.cycle_time_s());
        } else if (trajectory_.state() == Pull::held) {
            if (!stand()) {
                break;
            }
        } else if (trajectory_.state() != Pull::finished &&
                   feeder_.wait_for_row(late_ ? Clock::duration::zero() : wait_slice)) {
            read();
        } else if (trajectory_.state() == Pull::finished || !wait()) {
            break;
        }
    }
}

// The input pauses: a machine that moves cannot wait, one that stands does for a while.
template <Scalar S>
bool Motion<S>::late() const {
    return paused_ && target_->room() && (moves_ || Clock::now() > *paused_ + std::chrono::milliseconds(pause_ms));
}

// All that is known is travelled. False where nothing will ever move the machine.
template <Scalar S>
bool Motion<S>::wait() {
    paused_ = paused_.value_or(Clock::now());
    if (moves_ || !held_by_target_) {
        if (!late_ || moves_ || segments_ == 0) {
            return true;
        }
        FeedSegment segment;
        return !trajectory_.stand(segment) || execute(segment); // drives that wait for more before they begin get it
    }
    return false;
}

template <Scalar S>
std::string Motion<S>::run(std::optional<std::uint64_t> waypoints) {
    try {
        execute_all(waypoints);
    } catch (const OutputError& error) {
        if (target_ == nullptr || segments_ == 0) {
            throw;
        }
        // Nobody would know where the drives are: they come to rest at the end of what they have.
        static_cast<void>(target_->finish());
        throw OutputError(error.what() + target_->where());
    }
    if (tee_.failure()) {
        keep_failure(tee_.failure());
    } else if (const Status status = trajectory_.status(); !status.ok()) {
        keep_failure(std::make_exception_ptr(InputError(input_->name(), 0, describe(status.error()))));
    }
    if (trajectory_.activity() == Activity::aborted) {
        stopped_ = "aborted by an event";
    } else if (trajectory_.activity() == Activity::held && trajectory_.state() == Pull::held && !held_by_target_) {
        stopped_ = "held, and no event resumes it";
    }
    machine_.finish();
    optimum_.finish();
    require_tolerance();
    if (const auto& fault = machine_.fault()) {
        Fault whole = *fault;
        whole.waypoint = feeder_.whole_row(static_cast<std::uint32_t>(fault->waypoint));
        const auto row = static_cast<std::uint32_t>(whole.waypoint);
        stopped_ =
            describe(whole, input_->within_tolerance() && !input_->lines_within_tolerance() ? feeder_.name_of_row(row)
                                                                                            : std::string());
    }
    if (target_ == nullptr) {
        return stopped_.empty() ? stopped_ : stopped_ + where();
    }
    // Whatever ended the run: the drives come to rest at the end of what they have.
    if (!target_->finish()) {
        stopped_ = target_->ending();
        return stopped_;
    }
    return stopped_.empty() ? stopped_ : stopped_ + target_->where();
}

template <Scalar S>
bool Motion<S>::pull(FeedSegment& segment) {
    const Clock::time_point start = Clock::now();
    late_ = late();
    const bool item = trajectory_.next(segment, late_ ? UnderrunPolicy::drain : UnderrunPolicy::wait) == Pull::item;
    planning_ += Clock::now() - start;
    return item;
}

// What the operator does up to now. An event between two segments acts with the second.
template <Scalar S>
void Motion<S>::operate() {
    constexpr double same_s = 1e-9;
    for (; operated_ < events_.size() && events_[operated_].time_s <= machine_.cycle_time_s() + same_s; ++operated_) {
        switch (events_[operated_].operation) {
        case Operation::hold: trajectory_.hold(); break;
        case Operation::resume: trajectory_.resume(); break;
        case Operation::abort: trajectory_.abort(); break;
        case Operation::override_feed: trajectory_.override_feed(from_double<S>(events_[operated_].value)); break;
        }
    }
}

// Switches and the user's signals, in real time.
template <Scalar S>
void Motion<S>::obey_target() {
    if (target_ == nullptr) {
        return;
    }
    if (!held_by_target_ && target_->hold_asked()) {
        held_by_target_ = true;
        trajectory_.hold();
    }
    switch (target_->take_steering()) {
    case UserSteering::none: break;
    case UserSteering::hold:
        held_by_user_ = true;
        trajectory_.hold();
        break;
    case UserSteering::resume:
        held_by_user_ = false;
        if (!held_by_target_) {
            trajectory_.resume();
        }
        break;
    }
}

// Time passes while the machine is held; false where nothing will ever move it.
template <Scalar S>
bool Motion<S>::stand() {
    if (held_by_target_ || (operated_ == events_.size() && !held_by_user_)) {
        return false;
    }
    FeedSegment segment;
    return trajectory_.stand(segment) && execute(segment);
}

// Whether the program wants the machine to stand for another segment.
template <Scalar S>
bool Motion<S>::dwell(FeedSegment& segment) {
    if (moves_ || steps_.empty() || !steps_.stands(machine_.position_mm(), machine_.cycle_time_s())) {
        return false;
    }
    if (steps_.moved()) {
        return trajectory_.stand(segment);
    }
    steps_.at_start(segment);
    return true;
}

// The motion comes to a row: what is known of those before it can be forgotten.
template <Scalar S>
void Motion<S>::pass(std::uint32_t row) {
    if (row == row_) {
        return;
    }
    row_ = row;
    feeder_.passed(row);
    line_ = input_->gcode() != nullptr ? feeder_.line_of_row(row) : 0;
    if (outputs_->trace() != nullptr) {
        outputs_->trace()->set_line(line_);
    }
}

// Gives the curve one more waypoint, or tells it that there are none.
template <Scalar S>
void Motion<S>::read() {
    paused_.reset();
    if (read_all_) {
        throw std::logic_error("the curve asks for waypoints after its end");
    }
    try {
        typename CurveFeeder<S>::Pushed pushed;
        read_all_ = !feeder_.more(pushed);
        if (!read_all_ && pushed.on_path) {
            error_.waypoint(pushed.index, pushed.position);
        }
        if (!read_all_) {
            measure(pushed);
        }
    } catch (const InputError&) {
        read_all_ = true; // the curve ends with the waypoints before
        keep_failure(std::current_exception());
    }
}

template <Scalar S>
bool Motion<S>::execute(FeedSegment& segment) {
    segment.index = segments_++; // standstill before the first move is none of the trajectory's
    outputs_->segment(segment);
    bool rest = trajectory_.activity() == Activity::running;
    bool moves = false;
    bool ends_in_motion = false;
    for (unsigned k = 0; k < static_cast<unsigned>(limits_->axes); ++k) {
        rest = rest && segment.end_velocity[k] == 0;
        moves = moves || segment.start_velocity[k] != 0;
        ends_in_motion = ends_in_motion || segment.end_velocity[k] != 0;
    }
    rest = rest && moves;
    rests_ += rest ? 1U : 0U;
    // The machine executes one segment a poll, in virtual time: it is never behind.
    const bool done = machine_.submit(segment) && machine_.poll().phase != hal::PortPhase::fault;
    if (!done) {
        return false;
    }
    share_.segment(segment);
    if (target_ != nullptr && !target_->submit(segment)) {
        stopped_ = target_->ending();
        return false;
    }
    moves_ = ends_in_motion;
    return true;
}

// Moves of a program that the path follows within a tolerance.
template <Scalar S>
void Motion<S>::measure(const typename CurveFeeder<S>::Pushed& pushed) {
    const auto& program = pushed.program;
    steps_.add(program);
    if (report_ != nullptr) {
        tell(program, *report_);
    }
    if (ElementWriter* const writer = outputs_->elements()) {
        write(program, *writer);
    }
    if (program.start) {
        deviation_.start(program.position);
        exact_stop_.start(program.position);
    } else if (program.move != nullptr) {
        deviation_.move(program.move->programmed, program.move->line);
        exact_stop_.move(program.move->programmed);
    }
}

template <Scalar S>
void Motion<S>::write(const typename ElementFeeder<S>::Pushed& pushed, ElementWriter& writer) {
    if (pushed.start) {
        writer.start(pushed.position);
    }
    if (const SourceStep<S>* const move = pushed.move) {
        const double feed = move->rapid ? 0.0 : move->programmed.feed_mm_s;
        writer.move({&move->programmed, move->rapid, feed, move->line});
    }
    if (const SourceStep<S>* const step = pushed.step) {
        if (step->kind == StepKind::dwell) {
            writer.dwell(step->dwell_s, step->line);
        } else {
            writer.event(step->action, step->line);
        }
    }
}

template <Scalar S>
void Motion<S>::tell(const typename ElementFeeder<S>::Pushed& pushed, ProgramReport& report) {
    if (pushed.start) {
        report.start(pushed.position);
    }
    if (pushed.move != nullptr) {
        report.move(pushed.move->programmed, pushed.move->rapid, pushed.move->line);
    }
    const EventKind kind = pushed.step != nullptr ? pushed.step->action.kind : EventKind::message;
    if (pushed.step != nullptr && (kind == EventKind::tool_change || kind == EventKind::tool_set)) {
        report.tool(pushed.step->action.number);
    }
}

// A path that is too far from its moves is a fault, whatever else happened.
template <Scalar S>
void Motion<S>::require_tolerance() {
    if (!input_->within_tolerance()) {
        return;
    }
    if (trajectory_.state() == Pull::finished && stopped_.empty()) {
        deviation_.finish();
    }
    if (enforce_ && stopped_.empty()) {
        stopped_ = excess();
    }
}

// Where the path is too far from its moves; empty: nowhere.
template <Scalar S>
std::string Motion<S>::excess() const {
    const auto& excess = deviation_.excess();
    return excess ? describe(*excess, feeder_.name_of_move(excess->place.move, excess->place.line)) : std::string();
}

template <Scalar S>
ToleranceSummary Motion<S>::tolerance_summary() const {
    ToleranceSummary out;
    const auto place = [&](const PathDeviation::Place& of) {
        return ToleranceSummary::Place{of.distance, feeder_.number_of_move(of.move), of.line,
                                       feeder_.name_of_move(of.move, of.line)};
    };
    out.deviation = place(deviation_.linear());
    if (deviation_.has_rotary()) {
        out.rotary_deviation = place(deviation_.rotary());
    }
    out.excess = excess();
    const PathCounts counts = feeder_.tolerance_path()->counts();
    out.blended = counts.joints.blended;
    out.stopped = counts.joints.stopped;
    out.through = counts.joints.through;
    out.chains = counts.chains;
    out.elements = feeder_.rows() - (input_->lines_within_tolerance() && feeder_.rows() > 0 ? 1U : 0U);
    out.pieces = tee_.segments();
    out.exact_stop_s = exact_stop_.seconds() + steps_.summary().dwell_s;
    return out;
}

// Before the first move what is wrong is thrown; after it, it is why the machine stopped.
template <Scalar S>
void Motion<S>::keep_failure(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const InputError& error) {
        if (segments_ == 0) {
            throw;
        }
        stopped_ = error.what();
    }
}

template <Scalar S>
std::string Motion<S>::where() const {
    PlaceText place("; the machine stands at", 6);
    const PerAxis<double> position = machine_.position_mm();
    for (unsigned k = 0; k < static_cast<unsigned>(limits_->axes); ++k) {
        place.add(description_->axis_name[k], position[k]);
    }
    return place.text() + fmt::format(", {:.6f} s after its start", machine_.cycle_time_s());
}

template <Scalar S>
Summary Motion<S>::summary() const {
    Summary summary;
    summary.cycle_time_s = machine_.cycle_time_s();
    summary.length_mm = length_to_mm(trajectory_.arc_length().travelled());
    summary.waypoints = feeder_.rows();
    summary.curve_segments = tee_.segments();
    summary.feed_segments = segments_;
    summary.scalar = scalar_name<S>();
    summary.curve = input_->curve_name();
    summary.max_speed_mm_s = machine_.max_path_speed_mm_s();
    double acceleration_sq = 0.0;
    for (int k = 0; k < limits_->axes; ++k) {
        const LimitUse& use = machine_.use(k);
        const AxisSettings& axis = description_->settings.axis[static_cast<unsigned>(k)];
        const bool has_jerk = axis.max_jerk_mm_s3 > 0.0;
        summary.limit_use.push_back({description_->axis_name[static_cast<unsigned>(k)], use.velocity, use.acceleration,
                                     has_jerk ? std::optional(use.jerk) : std::nullopt});
        acceleration_sq += axis.larger_acceleration_mm_s2() * axis.larger_acceleration_mm_s2();
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
    summary.program.line = line_;
    summary.limit_share = share_.shares();
    summary.planning_time_s = std::chrono::duration<double>(planning_ - optimum_.spent() - deviation_.spent()).count();
    summary.memory_bytes = {feeder_.bytes(), planner_.bytes(), sizeof(SegmentStream<S>)};
    summary.stopped = !stopped_.empty();
    summary.events = operated_;
    summary.events_not_reached = events_.size() - operated_;
    summary.window_limited = trajectory_.feed_plan().window_limited();
    summary.stops = rests_ > 0 ? rests_ - 1 : 0;
    const double duration_s = limits_->segment_ticks / (ticks_per_us * 1e6);
    summary.smoothing_bound_mm = duration_s * duration_s * std::sqrt(acceleration_sq) / 6.0;
    if (target_ != nullptr) {
        target_->describe(summary);
    }
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) == 0) {
        summary.peak_rss_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
    }
    return summary;
}

template class Motion<double>;
template class Motion<float>;
template class Motion<Fixed>;

} // namespace splinefeed::host
