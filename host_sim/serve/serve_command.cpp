// SPDX-License-Identifier: MIT
#include "host_sim/serve/serve_command.hpp"

#include "host_sim/base/abandon.hpp"
#include "host_sim/base/input_error.hpp"
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
ServedTarget::Settings places_of(const MachineState& state, const MachineDescription& machine) {
    ServedTarget::Settings out;
    for (const unsigned k : indices(machine.settings.axes)) {
        const double nearest =
            machine.travel[k] ? std::clamp(0.0, machine.travel[k]->low, machine.travel[k]->high) : 0.0;
        out.told_mm[k] = state.position_mm[k].value_or(nearest);
        out.told |= state.position_mm[k] || state.unknown_why.empty() ? 1U << k : 0U;
    }
    return out;
}

// Of drives that cannot be asked.
std::string note_unknown(const MachineState& state, const MachineDescription& machine, const PerAxis<double>& told_mm) {
    std::string text;
    for (const unsigned k : indices(machine.settings.axes)) {
        if (!state.position_mm[k] && state.unknown_why.empty()) {
            text += fmt::format(" {}={:.4f}", machine.axis_name[k], told_mm[k]);
        }
    }
    return text.empty() ? text
                        : "nobody knows where the machine stands: it counts from" + text +
                              " mm ($H finds references, and --state keeps places)";
}

/// Connects to it. The machine's limits become those that it carries.
std::unique_ptr<ServedMachine> make_target(std::unique_ptr<RunTarget> made, const std::string& target,
                                           RunMachine& machine, ServedTarget::Settings settings) {
    settings.segment_ticks = fit_to_target(machine.machine, ScalarKind::fixed, *made, false).segment_ticks;
    return std::make_unique<ServedTarget>(std::move(made), machine.machine, settings,
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
    tell_note(note_of(choice, machine.machine));
    const MachineState begins = machine.state(arguments.state.value_or(""), "");
    const ServedTarget::Settings told = places_of(begins, machine.machine);
    std::unique_ptr<ServedMachine> tool;
    SwitchFacts switches{.probe = true, .no_home = {}}; // the simulated machine's, which touches nothing
    if (arguments.target != "sim") {
        std::unique_ptr<RunTarget> made =
            target_kind(arguments.target)
                .make(arguments.target, machine.machine, {.interrupted = &ServedTarget::gives_up});
        switches = made->switch_facts();
        tell_note(made->has_feedback() ? std::string() : note_unknown(begins, machine.machine, told.told_mm));
        tool = make_target(std::move(made), arguments.target, machine, told);
    }
    const ControllerSettings settings = serve_settings(machine, switches);
    ServedMotion motion(machine.machine, settings);
    if (tool == nullptr) {
        tool = make_simulated_tool(machine.machine, motion.segments_per_sample(), told.told_mm,
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
