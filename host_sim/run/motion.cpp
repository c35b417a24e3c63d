// SPDX-License-Identifier: MIT
#include "host_sim/run/motion.hpp"

#include "host_sim/base/input_error.hpp"

#include <cmath>
#include <stdexcept>

namespace splinefeed::host {

namespace {

constexpr double float_rounding = 1e-6; // of a path, as a part of a move; double and Fixed have digits enough

constexpr std::chrono::milliseconds wait_slice{1}; // for input, before the target is looked at again

} // namespace

Motion::Motion(const MotionArguments& arguments, const MachineDescription& description, const PlanFigures& figures,
               PathInput& input, const PathLimits& path_limits, Outputs& outputs, LiveMachine& live)
    : asked_(arguments), description_(&description), figures_(&figures), input_(&input), outputs_(&outputs),
      live_(&live), deviation_(description.settings, input.tolerances().joint_mm,
                               input.scalar() == ScalarKind::float32 ? float_rounding : 0.0),
      exact_stop_(description.settings), optimum_(description.settings, figures.direction_jump, input.scalar()),
      share_(description.settings), length_(description.settings),
      program_(outputs.elements(), arguments.report, arguments.record),
      work_(asked_.measures && !live.is_real() && arguments.record == nullptr && input.within_tolerance()),
      watch_(input.name(), {.limits = &path_limits,
                            .writer = outputs.curve(),
                            .error = &error_,
                            .deviation = asked_.measures && input.within_tolerance() ? &deviation_ : nullptr,
                            .optimum = asked_.measures ? &optimum_ : nullptr,
                            .work = &work_,
                            .share = &share_}),
      path_(plan_path(input, description, watch_, arguments.planner)), feeder_(path_->feeder()),
      stream_(path_->stream()), steps_(figures, stream_, !arguments.quiet, live, arguments.terminal, arguments.record),
      machine_(description, figures.segments_per_sample,
               {.enforce = arguments.enforce,
                .measures = arguments.measures,
                .ticks_per_segment = arguments.enforce ? SimulationOptions{}.ticks_per_segment : 1,
                .trace = outputs.trace()}),
      events_(arguments.events.empty() ? std::vector<OperatorEvent>{} : read_event_file(arguments.events)) {
    if (asked_.record != nullptr) {
        deviation_.tell([this](std::uint64_t move, double mm) {
            asked_.record->deviates(feeder_.program()->number_of_move(move) - 1, mm);
        });
    }
}

void Motion::execute_all() {
    FeedSegment segment;
    for (;;) {
        operate();
        obey_machine();
        if (live_->over()) {
            break;
        }
        if (paused_ && !stream_.stands() && feeder_.wait_for_row(Clock::duration::zero())) {
            read();
        }
        const bool dwells = dwell(segment);
        if (steps_.take_change()) {
            keep_state();
        }
        if (dwells) {
            come_to(steps_.line());
            if (asked_.record != nullptr) {
                asked_.record->dwells(steps_.line());
            }
            if (!execute_first(segment, LimitKind::dwell)) {
                break;
            }
            if (asked_.report != nullptr) {
                asked_.report->stood(steps_.line(), segment.duration_ticks / (ticks_per_us * 1e6));
            }
            stood_s_ += segment.duration_ticks / (ticks_per_us * 1e6);
            steps_.stood(segment);
        } else if (pull(segment)) {
            steps_.begin(machine_.cycle_time_s());
            pass(segment.waypoint);
            if (!execute_first(segment)) {
                break;
            }
            if (asked_.report != nullptr) {
                asked_.report->moved(segment.waypoint, segment.duration_ticks / (ticks_per_us * 1e6), share_.bound());
            }
            show_progress();
        } else if (stream_.state() == Pull::held) {
            if (!stand()) {
                break;
            }
        } else if (stream_.stands()) {
            paused_.reset(); // the step for which it stands comes next
        } else if (stream_.state() != Pull::finished &&
                   feeder_.wait_for_row(late() ? Clock::duration::zero() : wait_slice)) {
            read();
        } else if (stream_.state() == Pull::finished || !wait()) {
            break;
        }
    }
}

// The input pauses: a machine that moves cannot wait, and goes on along what is known; behind a while the last move
// ends at rest.
Supply Motion::supply() const {
    if (!paused_ || !live_->has_room()) {
        return Supply::flows;
    }
    const bool pauses = Clock::now() > *paused_ + std::chrono::milliseconds(pause_ms);
    return pauses ? Supply::pauses : moves_ ? Supply::late : Supply::flows;
}

// All that is known is travelled. False where nothing will ever move the machine.
bool Motion::wait() {
    paused_ = paused_.value_or(Clock::now());
    if (moves_ || held_ != Held::by_machine) {
        if (!late() || moves_ || segments_ == 0) {
            return true;
        }
        FeedSegment segment;
        return !stream_.stand(segment) || execute(segment); // drives that wait for more before they begin get it
    }
    return false;
}

bool Motion::pull(FeedSegment& segment) {
    const Clock::time_point start = live_->is_real() ? Clock::now() : Clock::time_point{};
    supply_ = supply();
    if (supply_ == Supply::pauses && stream_.keeps_back()) {
        PathFeeder::Pushed stop;
        stop.stops = true;
        measure(stop);
    }
    const bool item = path_->next(segment, supply_) == Pull::item;
    planning_ += live_->is_real() ? Clock::now() - start : Clock::duration{};
    if (item && segments_ == 0 && path_->failure()) { // nothing has moved yet
        std::rethrow_exception(path_->failure());
    }
    return item;
}

// What the operator does up to now. An event between two segments acts with the second.
void Motion::operate() {
    constexpr double same_s = 1e-9;
    for (; operated_ < events_.size() && events_[operated_].time_s <= machine_.cycle_time_s() + same_s; ++operated_) {
        if (asked_.record != nullptr) {
            asked_.record->operated(machine_.cycle_time_s(), events_[operated_]);
        }
        switch (events_[operated_].operation) {
        case Operation::hold: stream_.hold(); break;
        case Operation::resume: stream_.resume(); break;
        case Operation::abort: stream_.abort(); break;
        case Operation::override_feed:
            steered_.override_feed = events_[operated_].value;
            stream_.override_feed(Fixed::from_double(events_[operated_].value));
            break;
        }
    }
}

// Switches and the user's signals, in real time.
void Motion::obey_machine() {
    if (held_ != Held::by_machine && live_->hold_asked()) {
        held_ = Held::by_machine;
        stream_.hold();
    }
    const UserSteering steering = live_->take_steering();
    switch (steering) {
    case UserSteering::none: break;
    case UserSteering::hold:
    case UserSteering::suspend:
    case UserSteering::held:
        held_ = held_ == Held::no ? Held::by_user : held_;
        stream_.hold();
        if (steering == UserSteering::suspend) {
            suspend_.ask();
        } else if (steering == UserSteering::held && !SignalWatch::interrupted()) {
            UserSuspend::tell_held();
        }
        break;
    case UserSteering::resume:
        steps_.go_on();
        suspend_.forget();
        if (held_ != Held::by_machine) {
            held_ = Held::no;
            stream_.resume();
        }
        break;
    }
    suspend_.follow(moves_, live_->submitted(), live_->executed(), live_->spindle_stands());
}

// Time passes while the machine is held; false where nothing will ever move it.
bool Motion::stand() {
    if (held_ == Held::by_machine || (operated_ == events_.size() && held_ == Held::no)) {
        return false;
    }
    if (asked_.record != nullptr) {
        asked_.record->waits(MotionRecord::Why::held);
    }
    FeedSegment segment;
    return stream_.stand(segment) && execute(segment);
}

// Whether the program wants the machine to stand for another segment.
bool Motion::dwell(FeedSegment& segment) {
    if (moves_ || held_ == Held::by_machine || steps_.empty()) {
        return false;
    }
    const bool stands = steps_.stands(machine_.cycle_time_s());
    if (const auto answer = steps_.take_answer()) {
        feeder_.program()->answer(*answer);
    }
    if (!stands) {
        return false;
    }
    if (steps_.moved()) {
        return stream_.stand(segment);
    }
    steps_.at_start(segment);
    return true;
}

// The motion comes to a row: what is known of those before it can be forgotten.
void Motion::pass(std::uint32_t row) {
    if (row == row_) {
        return;
    }
    row_ = row;
    feeder_.passed(row);
    passed_ = feeder_.whole_row(row) + 1;
    const std::uint64_t line = feeder_.line_of_row(row);
    if (asked_.record != nullptr) {
        const std::uint64_t moves = passed_ - (input_->lines_within_tolerance() ? 1U : 0U); // that end there
        const bool is_move = input_->within_tolerance() && moves > 0;
        asked_.record->come_to(passed_ - 1, input_->segments() == nullptr ? line : passed_,
                               is_move ? std::optional(moves - 1) : std::nullopt);
    }
    come_to(line);
}

// A line of a program.
void Motion::come_to(std::uint64_t line) {
    if (input_->gcode() == nullptr) {
        return;
    }
    line_ = line;
    if (outputs_->trace() != nullptr) {
        outputs_->trace()->set_line(line_);
    }
}

// Gives the curve one more waypoint, or tells it that there are none.
void Motion::read() {
    paused_.reset();
    if (read_all_) {
        throw std::logic_error("the curve asks for waypoints after its end");
    }
    try {
        PathFeeder::Pushed pushed;
        read_all_ = !feeder_.more(pushed);
        if (!read_all_ && pushed.on_path) {
            error_.waypoint(pushed.index, pushed.position);
            if (asked_.record != nullptr) {
                asked_.record->waypoint(pushed.position);
            }
        }
        if (!read_all_) {
            measure(pushed);
        }
    } catch (const InputError&) {
        read_all_ = true; // the curve ends with the waypoints before
        keep_failure(std::current_exception());
    }
}

// Executes a segment; before the first one the machine comes to where it begins.
bool Motion::execute_first(FeedSegment& segment, LimitKind standstill) {
    if (segments_ > 0 || asked_.start == nullptr) {
        return execute(segment, standstill);
    }
    PerAxis<double> to{};
    for (const unsigned k : indices(figures_->axes)) {
        to[k] = static_cast<double>(segment.start[k]) / static_cast<double>(units_per_count) /
                description_->settings.axis[k].steps_per_mm;
    }
    const auto from = asked_.start->move_from(to);
    return (!from || move_to(segment, *from, to)) && execute(segment, standstill);
}

// A straight line at the machine's limits, before the path. False: it was held, or the run is over.
bool Motion::move_to(FeedSegment& first, const PerAxis<double>& from, const PerAxis<double>& to) {
    way_.emplace(description_->settings, from, to, description_->settings.max_feed_mm_s);
    if (asked_.record != nullptr) {
        asked_.record->approach(true);
    }
    FeedSegment segment;
    for (;;) {
        obey_machine();
        if (held_ != Held::no) {
            way_->hold();
        } else {
            way_->resume();
        }
        if (!way_->next(segment) && (held_ != Held::by_user || !way_->stand(segment))) {
            break;
        }
        if (!execute(segment)) {
            return false;
        }
    }
    if (held_ == Held::by_machine) {
        return false;
    }
    way_.reset();
    if (asked_.record != nullptr) {
        asked_.record->approach(false);
    }
    first.start = segments_ > 0 ? segment.end : first.start; // to the last digit
    rests_ = 0;                                              // those of the path count
    at_end_ = false;
    return true;
}

bool Motion::execute(FeedSegment& segment, LimitKind standstill) {
    segment.index = segments_; // standstill before the first move is none of the trajectory's
    try {
        outputs_->segment(segment);
    } catch (const OutputError&) {
        failure_ = std::current_exception(); // the drives need it all the same
    }
    const bool begins_at_rest = segment.start_velocity == PerAxis<std::int64_t>{};
    const bool rest = stream_.activity() == Activity::running && segment.ends_at_rest() && !begins_at_rest;
    rests_ += rest ? 1U : 0U;
    at_end_ = rest || (begins_at_rest && segment.ends_at_rest() && at_end_);
    // The machine executes one segment a poll, in virtual time: it is never behind.
    const bool done = machine_.submit(segment) && machine_.poll().phase != hal::PortPhase::fault;
    if (!done) {
        return false;
    }
    steered_.standstill = held_ == Held::no && stream_.activity() == Activity::running ? standstill : LimitKind::hold;
    share_.segment(segment, steered_);
    if (!way_) {
        length_.add(segment);
    }
    if (asked_.record != nullptr) {
        asked_.record->segment(segment, share_);
    }
    if (asked_.kept != nullptr) {
        asked_.kept->add(segment, input_->gcode() != nullptr ? line_ : passed_, share_.binding_limit());
    }
    if (!live_->submit(segment, line_, passed_)) {
        stopped_ = live_->ending();
        return false;
    }
    ++segments_;
    moves_ = !segment.ends_at_rest();
    failure_ = failure_ ? failure_ : machine_.trace_failure();
    return !failure_;
}

// Moves of a program that the path follows within a tolerance.
void Motion::measure(const PathFeeder::Pushed& pushed) {
    steps_.add(pushed);
    program_.see(pushed);
    if (!asked_.measures) {
        return;
    }
    if (pushed.stops) {
        work_.add([this] { deviation_.stop(); });
    }
    if (pushed.start) {
        deviation_.start(pushed.position);
        exact_stop_.start(pushed.position);
    } else if (pushed.move != nullptr) {
        work_.add([this, move = pushed.move->move, line = pushed.move->line] {
            deviation_.move(move, line);
            exact_stop_.move(move);
        });
    }
}

} // namespace splinefeed::host
