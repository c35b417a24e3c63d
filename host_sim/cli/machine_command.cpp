// SPDX-License-Identifier: MIT
#include "host_sim/cli/job.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/serve/grbl_machine.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

// What the numbers are together, once each of them is right.
std::vector<std::string> problems_of(const std::string& text, const std::string& file) {
    std::vector<std::string> problems = machine_problems(text, file);
    if (problems.empty()) {
        try {
            static_cast<void>(plan_figures(ScalarKind::fixed, parse_machine(text, file)));
        } catch (const InputError& error) {
            problems.emplace_back(error.what());
        }
    }
    return problems;
}

void write_machine_of_grbl(const std::string& listing, const std::string& output) {
    const GrblMachine machine = machine_of_grbl(read_text_file(listing, largest_machine_file), listing);
    if (const std::vector<std::string> problems = problems_of(machine.text, {}); !problems.empty()) {
        throw InputError(listing, 0, "its numbers are no machine together: {}", problems.front());
    }
    OutputFile file(output.empty() ? "-" : output);
    file.append(machine.text);
    file.commit();
    if (machine.left_out > 0) {
        tell("splinefeed: note: numbers that are no keys of a machine file: {}; they are comments at its end\n",
             machine.left_out);
    }
}

int check_machine(const std::string& file) {
    const std::string text = read_text_file(file, largest_machine_file);
    const std::vector<std::string> problems = problems_of(text, file);
    if (!problems.empty()) {
        print_whole(fmt::format("{}\n", fmt::join(problems, "\n")), "the problems");
        return 1;
    }
    const MachineDescription machine = parse_machine(text, file);
    print_whole(
        fmt::format("{}: nothing is wrong; its axes are {}\n", printable(file),
                    fmt::join(machine.axis_name.begin(), machine.axis_name.begin() + machine.settings.axes, ", ")),
        "the answer");
    return 0;
}

} // namespace

int run_machine(const std::string& file, const MachineArguments& arguments) {
    if (!arguments.from_grbl) {
        if (!arguments.output.empty()) {
            throw UsageError("-o is of --from-grbl; a check writes no file: leave it out");
        }
        return check_machine(file);
    }
    write_machine_of_grbl(file, arguments.output);
    return 0;
}

} // namespace splinefeed::host
