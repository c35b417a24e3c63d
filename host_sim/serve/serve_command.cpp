// SPDX-License-Identifier: MIT
#include "host_sim/serve/serve_command.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_output.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/serve/serve_settings.hpp"
#include "host_sim/serve/server.hpp"

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
    const MachineChoice choice{arguments.machine, arguments.settings};
    const RunMachine machine(choice, *input_format("gcode"));
    if (const std::string note = note_of(choice, machine.machine); !note.empty()) {
        tell("splinefeed: note: {}\n", printable(note));
    }
    const MachineState begins = machine.state(arguments.state.value_or(""), "");
    const bool known = begins.unknown_why.empty();
    const ControllerSettings settings = serve_settings(machine);
    ServedMotion motion(machine.machine, settings);
    SimulatedTool tool(machine.machine, motion.segments_per_sample(), places_of(begins, machine.machine), known);
    std::optional<StateKeeper> state;
    if (arguments.state) {
        state.emplace(*arguments.state, machine.axes, begins);
    }
    SignalWatch signals({}); // before anybody can connect
    Server server(settings, motion, tool, state ? &*state : nullptr, begins, console);
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
    return 0;
}

} // namespace splinefeed::host
