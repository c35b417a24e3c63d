// SPDX-License-Identifier: MIT
#include "host_sim/serve/serve_command.hpp"

#include "host_sim/base/abandon.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/live/live_machine.hpp"
#include "host_sim/live/output_table.hpp"
#include "host_sim/live/target_fit.hpp"
#include "host_sim/ports/target_table.hpp"
#include "host_sim/serve/serve_settings.hpp"
#include "host_sim/serve/server.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace splinefeed::host {

namespace {

// Where an axis stands is said by the state file; without one all stand at 0, or at the end of travel beside it.
LiveMachine::Settings places_of(const MachineState& state, const MachineDescription& machine) {
    LiveMachine::Settings out;
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
    std::optional<StateFile> state_file;
    if (arguments.state) {
        state_file.emplace(*arguments.state, machine.owner(arguments.target));
    }
    const MachineState begins = machine.state(arguments.state.value_or(""), "");
    LiveMachine::Settings live_settings = places_of(begins, machine.machine);
    const TargetKind& kind = target_kind(arguments.target);
    const std::unique_ptr<RunTarget, DeleteInTime> target(
        kind.make(arguments.target, machine.machine, {.interrupted = &LiveMachine::gives_up}).release());
    if (kind.is_real && !target->facts().has_feedback) {
        tell_note(note_unknown(begins, machine.machine, live_settings.told_mm));
    }
    live_settings.simulates = !kind.is_real;
    live_settings.segment_ticks = fit_to_target(machine.machine, ScalarKind::fixed, *target, false).segment_ticks;
    std::optional<StateKeeper> state;
    if (state_file) {
        state.emplace(*state_file, begins, StateKeeper::Writes::behind);
    }
    live_settings.state = state ? &*state : nullptr;
    LiveMachine live(*target, machine.machine, live_settings,
                     [&] { return make_outputs(machine.machine, arguments.target); });
    const SwitchFacts switches = target->facts().switches;
    const ControllerSettings settings = serve_settings(machine, switches);
    ServedMotion motion(machine.machine, settings);
    Server server(settings, motion, live, state ? &*state : nullptr, begins, console);
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
    print_whole(places, "the address"); // nobody is heard before, and a signal ends what waits for a reader
    signals.supervise();
    server.run(signals);
    const std::string& unconfirmed = live.finish();
    if (!unconfirmed.empty()) {
        tell("splinefeed: {}\n", printable(unconfirmed));
    }
    if (state) {
        signals.at_once([] { abandon("interrupted while the state file was written: it may know no place", 1); });
        state->finish();
        signals.supervise();
    }
    return unconfirmed.empty() ? 0 : 1;
}

} // namespace splinefeed::host
