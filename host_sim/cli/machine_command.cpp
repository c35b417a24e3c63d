// SPDX-License-Identifier: MIT
#include "host_sim/cli/job.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/base/standard_streams.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/config/doubtful_numbers.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/convert/grbl_settings.hpp"
#include "host_sim/convert/limit_trial.hpp"
#include "host_sim/convert/machine_source.hpp"
#include "host_sim/planning/machine_limits.hpp"

#include <fmt/format.h>
#include <unistd.h>

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

MachineAnswers answers_of(const std::string& file, const MachineArguments& arguments) {
    if (!arguments.answers.empty()) {
        return {file, arguments.answers};
    }
    const bool asks = file != "-" && isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1;
    return {asks ? AnswerSource::terminal : AnswerSource::nobody, file};
}

void write_output(const std::string& text, const std::string& file) {
    OutputFile output(file.empty() ? "-" : file);
    output.append(text);
    output.commit();
}

int convert_machine(const std::string& file, const MachineArguments& arguments) {
    const std::string text = read_text_file(file, largest_machine_file);
    const MachineSource& source = machine_source(arguments.from, text, file);
    MachineAnswers answers = answers_of(file, arguments);
    const MachineSketch sketch = read_machine(source, text, file, answers);
    const std::string machine = machine_text(sketch);
    if (const std::vector<std::string> problems = problems_of(machine, {}); !problems.empty()) {
        throw InputError(file, 0, "its numbers are no machine together: {}", problems.front());
    }
    write_output(machine, arguments.output);
    for (const std::string& missing : answers.missing()) {
        tell_note(missing);
    }
    for (const std::string& doubt : doubtful_numbers(parse_machine(machine, file))) {
        tell("{}: warning: {}\n", printable(file), doubt);
    }
    if (!sketch.rest.empty()) {
        tell("splinefeed: note: numbers that are no keys of a machine file: {}; they are comments at its end\n",
             sketch.rest.size());
    }
    return 0;
}

int write_settings(const std::string& file, const MachineArguments& arguments) {
    if (arguments.to != "grbl") {
        throw UsageError("--to {}: it must be grbl", in_quotes(arguments.to));
    }
    if (!arguments.from.empty() || !arguments.answers.empty() || !arguments.tried.empty() || arguments.checks) {
        throw UsageError("--to takes a machine file, and no --from, --answers, --try or --check; make that first");
    }
    const GrblSettings settings = grbl_settings(read_text_file(file, largest_machine_file), file);
    write_output(settings.lines, arguments.output);
    for (const std::string& left_out : settings.left_out) {
        tell_note(left_out);
    }
    return 0;
}

int check_machine(const std::string& file) {
    const std::string text = read_text_file(file, largest_machine_file);
    std::vector<std::string> problems = problems_of(text, file);
    if (const MachineSource* const source = find_machine_source(text); source != nullptr && !problems.empty()) {
        problems = {fmt::format("{}: it is {}, no machine file; add -o MACHINE.toml, and it becomes one",
                                printable(file), source->what)};
    }
    if (!problems.empty()) {
        print_whole(fmt::format("{}\n", fmt::join(problems, "\n")), "the problems");
        return 1;
    }
    const MachineDescription machine = parse_machine(text, file);
    std::string answer =
        fmt::format("{}: nothing is wrong; its axes are {}\n", printable(file),
                    fmt::join(machine.axis_name.begin(), machine.axis_name.begin() + machine.settings.axes, ", "));
    for (const std::string& doubt : doubtful_numbers(machine)) {
        answer += fmt::format("{}: warning: {}\n", printable(file), doubt);
    }
    print_whole(answer, "the answer");
    return 0;
}

} // namespace

int run_machine(const std::string& file, const MachineArguments& arguments) {
    if (!arguments.to.empty()) {
        return write_settings(file, arguments);
    }
    if (!arguments.tried.empty()) {
        if (!arguments.from.empty() || !arguments.answers.empty()) {
            throw UsageError("--try takes a machine file; make that first, without --try");
        }
        write_output(limit_trial(read_machine_file(file), arguments.tried, arguments.tried_by), arguments.output);
        return 0;
    }
    if (arguments.checks && !arguments.output.empty()) {
        throw UsageError("--check writes no file: leave -o out, or --check");
    }
    const bool converts = !arguments.from.empty() || !arguments.output.empty();
    if (!converts && !arguments.answers.empty()) {
        throw UsageError("--answers is for a machine file that is made: add -o MACHINE.toml");
    }
    return converts ? convert_machine(file, arguments) : check_machine(file);
}

} // namespace splinefeed::host
