// SPDX-License-Identifier: MIT
#include "host_sim/cli/job.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/config/machine_choice.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

namespace {

double measuring_time(const std::string& text) {
    constexpr double shortest_s = 0.1;
    constexpr double longest_s = 3600.0;
    double seconds = 0.0;
    if (read_number(text, seconds) != NumberText::number || seconds < shortest_s || seconds > longest_s) {
        throw UsageError("--seconds {}: it must be a number from 0.1 to 3600", in_quotes(text));
    }
    return seconds;
}

} // namespace

int report_link(const LinkArguments& arguments) {
    if (arguments.target.empty() || !target_kind(arguments.target).is_real) {
        throw UsageError("there is nothing to test; name the drives with --target modbus-tcp://HOST:PORT, "
                         "modbus-rtu://DEVICE, gpio:///dev/gpiochip0?map=FILE.toml, or modbus and -m MACHINE.toml");
    }
    const TargetKind& kind = target_kind(arguments.target);
    const double seconds = measuring_time(arguments.seconds);
    const MachineChoice choice{arguments.machine, arguments.settings};
    const MachineDescription machine = choose_machine(choice);
    const bool any_machine = machine.file.empty();
    tell_note(note_of(choice, machine));
    const LinkReport report = kind.report(arguments.target, machine, any_machine, seconds);
    print_whole(report.text, "the report");
    if (!report.trouble.empty()) {
        throw TargetError(report.trouble);
    }
    return 0;
}

} // namespace splinefeed::host
