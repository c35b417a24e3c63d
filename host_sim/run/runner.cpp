// SPDX-License-Identifier: MIT
#include "host_sim/run/runner.hpp"

#include "host_sim/base/abandon.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/live/output_table.hpp"
#include "host_sim/live/target_fit.hpp"
#include "host_sim/output/outputs.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/ports/run_target.hpp"
#include "host_sim/ports/target_table.hpp"
#include "host_sim/run/motion.hpp"
#include "host_sim/run/path_watch.hpp"
#include "host_sim/run/program_look.hpp"
#include "host_sim/run/run_machine.hpp"
#include "host_sim/run/run_start.hpp"
#include "host_sim/run/what_would_help.hpp"
#include "host_sim/run/zero_range.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <unistd.h>
#include <utility>

namespace splinefeed::host {

namespace {

/// The whole curve of a file, to those who look at it, before anything moves.
std::optional<std::uint64_t> look(PathInput& input, const PathObservers& observers) {
    PathWatch watch(input.name(), observers);
    return look_through(input, watch);
}

/// The same. Where it leaves the travel, and another zero would help, the error says which.
std::optional<std::uint64_t> look_within(const RunArguments& arguments, const RunMachine& of, PathInput& input,
                                         const PathLimits& limits, const MachineState& begins) {
    try {
        return look(input, {.limits = &limits});
    } catch (const TravelError& error) {
        if (input.gcode() == nullptr || !input.reopens()) {
            throw;
        }
        const std::vector<ZeroRange> ranges = zero_ranges(arguments.path, of, begins);
        if (!leaves(ranges)) {
            throw;
        }
        throw InputError({}, 0, "{}; {}", error.what(), zero_advice(ranges));
    }
}

/// What can be found before anything moves. Returns the number of waypoints or moves, if it is known. In the simulated
/// machine what only the path of a program says is found where it is planned.
std::optional<std::uint64_t> look_before(const RunArguments& arguments, const RunMachine& of, PathInput& input,
                                         const PathLimits& limits, const MachineState& begins) {
    std::optional<std::uint64_t> rows;
    if (input.repeatable() && !target_kind(arguments.target).is_real && input.gcode() != nullptr) {
        rows = look_at_moves(input, limits, of.machine.settings.axes);
    }
    return input.repeatable() && !rows ? look_within(arguments, of, input, limits, begins) : rows;
}

void warn(const PathInput& input, bool quiet, RunResult* result) {
    if (result != nullptr) {
        result->notes = path_notes(input);
    } else if (const std::vector<std::string> notes = path_notes(input, "warning: "); !quiet && !notes.empty()) {
        tell("{}\n", fmt::join(notes, "\n"));
    }
}

/// Events that never happened: as a rule a time that was mistyped, or a run that was shorter than thought.
void warn_of_events(const MotionArguments& arguments, std::span<const OperatorEvent> events, double end_s) {
    constexpr std::size_t most = 3; // lines
    if (arguments.quiet) {
        return;
    }
    for (const OperatorEvent& event : events.first(std::min(events.size(), most))) {
        tell("{}:{}: warning: the event at {} s did not happen: the run ended at {:.6g} s\n",
             printable(arguments.events), event.line, event.time_s, end_s);
    }
    if (events.size() > most) {
        tell("{}: warning: nor did the {} events after them\n", printable(arguments.events), events.size() - most);
    }
}

void print(const Summary& summary, SummaryKind kind) {
    if (kind != SummaryKind::none) {
        print_whole(kind == SummaryKind::json ? to_json(summary) : to_text(summary), "the summary");
    }
}

/// Where the machine stands. A program in G-code that nobody told it begins there.
RunStart find_start(const RunArguments& arguments, const RunMachine& of, RunTarget& target, PathInput& input,
                    MachineState& begins, const PathLimits& limits) {
    RunStart start(of.machine, arguments.options, target.standing());
    const auto told = begins.position_mm;
    start.settle(begins.position_mm);
    if (input.gcode() != nullptr) { // others say themselves where they begin
        of.settle_places(begins, arguments.state);
        if (begins.position_mm != told) {
            input.begin_at(begins);
            if (input.repeatable()) { // it may leave the travel from there
                static_cast<void>(look_within(arguments, of, input, limits, begins));
            }
        }
    }
    tell_note(arguments.motion.quiet ? "" : start.note());
    return start;
}

/// A real target, and where its machine stands.
struct Connected {
    std::unique_ptr<RunTarget, DeleteInTime> target{};
    std::optional<RunStart> start{};
};

/// @param figures  become those that the target carries
/// @param begins  where the program begins, becomes where the machine stands
Connected connect(const RunArguments& arguments, RunMachine& of, PathInput& input, const PathLimits& limits,
                  PlanFigures& figures, MachineState& begins) {
    Connected out;
    out.target.reset(target_kind(arguments.target).make(arguments.target, of.machine, arguments.options).release());
    figures = fit_to_target(of.machine, arguments.path.scalar, *out.target, arguments.motion.quiet);
    out.start = find_start(arguments, of, *out.target, input, begins, limits);
    return out;
}

/// For those who think that the machine of their file moves.
void note_simulation(const RunArguments& arguments, const MachineDescription& machine) {
    if (!target_kind(arguments.target).is_real && arguments.motion.enforce && !arguments.motion.quiet &&
        machine.has_drives()) {
        tell("splinefeed: note: this is a simulation; to move the drives of {}, add --target modbus\n",
             printable(machine.file));
    }
}

MotionArguments motion_arguments_of(const RunArguments& arguments, const RunMachine& of) {
    MotionArguments out = arguments.motion;
    out.terminal = arguments.path.input == "-" ? -1 : STDIN_FILENO;
    out.begins = of.state(arguments.state, arguments.position, arguments.options.orders.home, arguments.zero);
    return out;
}

/// Whether the program is planned again, for what would help: where it can be, and somebody is told.
bool finds_help(const RunArguments& arguments, const PathInput& input, const Summary& summary) {
    const bool is_told =
        !arguments.outputs.report.empty() || arguments.result != nullptr || arguments.summary != SummaryKind::none;
    const std::optional<std::string>& tools = arguments.path.gcode.tools;
    const bool reopens = input.reopens() && (!tools || is_regular_file(*tools));
    return arguments.helps && !target_kind(arguments.target).is_real && reopens && summary.optimum_time_s && is_told;
}

void find_help(const RunArguments& arguments, const RunMachine& of, const MachineState& begins, const Motion& motion,
               std::optional<std::uint64_t> waypoints, Summary& summary) {
    summary.what_would_help = what_would_help({.path = &arguments.path,
                                               .machine = &of,
                                               .begins = &begins,
                                               .planner = arguments.motion.planner,
                                               .standing_s = motion.stood_s(),
                                               .waypoints = waypoints,
                                               .quiet = arguments.motion.quiet},
                                              summary);
}

/// Tells how it ended. Returns the exit status.
int conclude(const RunArguments& arguments, Summary summary, const std::string& stopped) {
    if (arguments.result != nullptr) {
        arguments.result->summary = std::move(summary);
        arguments.result->stopped = stopped;
    } else if (!stopped.empty()) {
        tell("splinefeed: {}\n", printable(stopped));
    }
    return stopped.empty() ? 0 : 1;
}

} // namespace

std::vector<std::string> path_notes(const PathInput& input, std::string_view mark) {
    std::vector<std::string> out;
    for (const std::string& note : input.dialect_notes()) {
        out.push_back(fmt::format("{}: {}", printable(input.name()), printable(note)));
    }
    if (input.segments() != nullptr) {
        for (const std::string& warning : input.segments()->warnings) {
            out.push_back(fmt::format("{}: {}{}", printable(input.name()), mark, warning));
        }
    }
    return out;
}

MachineChoice machine_of(const RunArguments& arguments) {
    return {arguments.machine, arguments.settings, arguments.path.input};
}

ReportFacts report_facts(const PathInput& input, const Summary& summary, const std::string& stopped) {
    return {.program = input.name(),
            .text_file = input.reopens() ? input.path() : std::string(),
            .unit = input.segments() == nullptr ? "line" : "segment",
            .stopped = stopped,
            .summary = &summary};
}

int run(const RunArguments& arguments) {
    // First of all: threads that are started later have the same signals blocked.
    std::optional<SignalWatch> signals;
    if (target_kind(arguments.target).is_real) {
        signals.emplace([] { abandon("interrupted before anything was moved; the drives were not enabled", 1); });
    }
    const auto begun = std::chrono::steady_clock::now();
    RunMachine of = arguments.described ? RunMachine(*arguments.described, arguments.path.format->is_gcode())
                                        : RunMachine(machine_of(arguments), *arguments.path.format);
    tell_note(arguments.motion.quiet ? "" : note_of(machine_of(arguments), of.machine));
    MachineDescription& machine = of.machine;
    PlanFigures figures = plan_figures(arguments.path.scalar, machine);
    PathInput input(arguments.path, signals ? PathUse::followed : PathUse::executed, of.path());
    if (!arguments.zero.empty() && input.gcode() == nullptr) {
        throw UsageError("--zero is of programs in G-code; other inputs have the machine's coordinates: leave it out");
    }
    std::optional<StateFile> state_file;
    if (arguments.motion.enforce && !arguments.state.empty()) { // plan changes nothing
        state_file.emplace(arguments.state, of.owner(arguments.target));
    }
    MotionArguments motion_arguments = motion_arguments_of(arguments, of);
    input.begin_at(motion_arguments.begins);
    if (!signals) {
        of.settle_places(motion_arguments.begins, arguments.state);
    }
    warn(input, arguments.motion.quiet, arguments.result);
    const PathLimits path_limits(machine);
    const std::optional<std::uint64_t> waypoints =
        look_before(arguments, of, input, path_limits, motion_arguments.begins);
    Connected real;
    std::optional<StateKeeper> state;
    if (signals) {
        real = connect(arguments, of, input, path_limits, figures, motion_arguments.begins);
        motion_arguments.start = &*real.start;
    }
    if (state_file) {
        motion_arguments.state = &state.emplace(*state_file, motion_arguments.begins);
    }
    std::optional<RunReport> report;
    if (!arguments.outputs.report.empty()) {
        motion_arguments.record = &report.emplace(arguments.outputs.report, machine, figures.segment_ticks).record();
    }
    std::optional<LiveMachine> live;
    if (signals) {
        live.emplace(*real.target, machine,
                     LiveMachine::Settings{.segment_ticks = figures.segment_ticks,
                                           .signals = &*signals,
                                           .state = motion_arguments.state,
                                           .record = report ? &report->record().target() : nullptr},
                     [&] { return input.gcode() != nullptr ? make_outputs(machine, arguments.target) : nullptr; });
    } else {
        live.emplace();
    }
    Outputs outputs(arguments.outputs, input.curve_name(), input.choice().closed, machine, input.gcode() != nullptr);
    note_simulation(arguments, machine);
    Motion motion(motion_arguments, machine, figures, input, path_limits, outputs, *live);
    const std::string stopped = motion.run(waypoints);
    outputs.commit();
    Summary summary = motion.summary();
    summary.places = of.places(motion_arguments.begins, input.gcode() != nullptr);
    if (finds_help(arguments, input, summary)) {
        find_help(arguments, of, motion_arguments.begins, motion, waypoints, summary);
    }
    if (!signals) {
        summary.planning_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    }
    if (report) {
        report->write(report_facts(input, summary, stopped));
    }
    warn_of_events(arguments.motion, motion.events_not_reached(), summary.cycle_time_s);
    print(summary, arguments.summary);
    live.reset(); // from here on a signal says nothing any more: the sentence is told once
    return conclude(arguments, std::move(summary), stopped);
}

int draw(const RunArguments& arguments) {
    PathInput input(arguments.path, PathUse::drawn, {});
    warn(input, arguments.motion.quiet, nullptr);
    if (const CurveFile* const curve = input.segments(); curve != nullptr && !input.choice().smooth) {
        Outputs outputs(arguments.outputs, input.curve_name(), curve->closed);
        outputs.curve()->segments(*curve);
        outputs.commit(curve->results.get());
        return 0;
    }
    if (input.repeatable()) {
        static_cast<void>(look(input, {}));
    }
    Outputs outputs(arguments.outputs, input.curve_name(), input.choice().closed);
    static_cast<void>(look(input, {.writer = outputs.curve()}));
    outputs.commit();
    return 0;
}

} // namespace splinefeed::host
