// SPDX-License-Identifier: MIT
#include "host_sim/serve/serve_command.hpp"

#include "host_sim/base/abandon.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_output.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/ports/target_table.hpp"
#include "host_sim/run/output_table.hpp"
#include "host_sim/run/target_fit.hpp"
#include "host_sim/serve/serve_settings.hpp"
#include "host_sim/serve/served_target.hpp"
#include "host_sim/serve/server.hpp"
#include "host_sim/serve/simulated_tool.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

// Where an axis stands is said by the state file; without one all stand at 0, or at the end of travel beside it.
PerAxis<double> places_of(const MachineState& state, const MachineDescription& machine) {
    PerAxis<double> out{};
    for (const unsigned k : indices(machine.settings.axes)) {
        const double nearest =
            machine.travel[k] ? std::clamp(0.0, machine.travel[k]->low, machine.travel[k]->high) : 0.0;
        out[k] = state.position_mm[k].value_or(nearest);
    }
    return out;
}

/// Connects to it. The machine's limits become those that it carries.
std::unique_ptr<ServedMachine> make_target(const std::string& target, RunMachine& machine,
                                           const PerAxis<double>& told) {
    std::unique_ptr<RunTarget> made =
        target_kind(target, true).make(target, machine.machine, {.interrupted = &ServedTarget::gives_up});
    const PlanFigures figures = fit_to_target(machine.machine, ScalarKind::fixed, *made, false);
    return std::make_unique<ServedTarget>(std::move(made), machine.machine, figures.segment_ticks, told,
                                          [&machine, target] { return make_outputs(machine.machine, target); });
}

} // namespace

int run_serve(const ServeArguments& arguments) {
    const bool console = ::isatty(STDIN_FILENO) == 1;
    if (!has_sender_door()) {
        throw UsageError("this build of splinefeed has no sockets; build it where Boost is installed (Debian: apt-get "
                         "install libboost-dev)");
    }
    if (!arguments.tcp && !arguments.pty && !console) {
        throw UsageError("serve needs a place where senders connect; give --tcp 127.0.0.1:2300, or --pty FILE");
    }
    // First of all: threads that are started later have the same signals blocked.
    SignalWatch signals([] { abandon("interrupted before anything was moved; the drives were not enabled", 1); });
    const MachineChoice choice{arguments.machine, arguments.settings};
    RunMachine machine(choice, *input_format("gcode"));
    if (const std::string note = note_of(choice, machine.machine); !note.empty()) {
        tell("splinefeed: note: {}\n", printable(note));
    }
    const MachineState begins = machine.state(arguments.state.value_or(""), "");
    const PerAxis<double> told = places_of(begins, machine.machine);
    std::unique_ptr<ServedMachine> tool;
    if (arguments.target != "sim") {
        tool = make_target(arguments.target, machine, told);
    }
    ControllerSettings settings = serve_settings(machine);
    settings.probes = arguments.target == "sim"; // so far drives have none
    ServedMotion motion(machine.machine, settings);
    if (tool == nullptr) {
        tool = std::make_unique<SimulatedTool>(machine.machine, motion.segments_per_sample(), told,
                                               begins.unknown_why.empty());
    }
    std::optional<StateKeeper> state;
    if (arguments.state) {
        state.emplace(*arguments.state, machine.axes, begins);
    }
    signals.supervise(); // before anybody can connect
    Server server(settings, motion, *tool, state ? &*state : nullptr, begins, console);
    std::string places;
    if (arguments.tcp) {
        places += "serving tcp " + server.door().listen(*arguments.tcp) + "\n";
    }
    if (arguments.pty) {
        const std::string terminal = server.door().open_terminal(*arguments.pty);
        places += fmt::format("serving pty {} ({})\n", *arguments.pty, terminal);
    }
    if (console) {
        places += "type help for what can be typed here\n";
        server.door().watch_input([&server](std::string_view line) { server.type(line); });
    }
    print_whole(places, "the address");
    server.run(signals);
    const std::string unconfirmed = tool->finish();
    if (!unconfirmed.empty()) {
        tell("splinefeed: {}\n", printable(unconfirmed));
    }
    return unconfirmed.empty() ? 0 : 1;
}

} // namespace splinefeed::host
