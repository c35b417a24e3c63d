// SPDX-License-Identifier: MIT
// The planner of the page: planner PROGRAM MACHINE REPORT [NAME=VALUE...]. MACHINE is a machine file, or what another
// controller has ($$, M503, an INI file, a printer.cfg); empty: the default machine. What `splinefeed plan PROGRAM
// --summary json --report REPORT` prints goes to standard output. Status: 0, 1 or 2 as there.
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/convert/machine_source.hpp"
#include "host_sim/run/exit_status.hpp"
#include "host_sim/run/runner.hpp"

#include <algorithm>
#include <string>
#include <string_view>

using namespace splinefeed::host;

namespace {

struct Option {
    std::string_view name;
    void (*take)(const std::string& value, RunArguments& out);
};
constexpr Option options[] = {
    {"dialect",
     [](const std::string& value, RunArguments& out) {
         out.path.gcode.dialect = value;
     }},
    {"ignore",
     [](const std::string& value, RunArguments& out) {
         out.path.gcode.ignore = value;
     }},
    {"tolerance",
     [](const std::string& value, RunArguments& out) {
         out.path.curve.tolerance = value;
     }},
    {"zero",
     [](const std::string& value, RunArguments& out) {
         out.zero = value;
     }},
    {"set",
     [](const std::string& value, RunArguments& out) {
         out.settings.push_back(value);
     }},
};

MachineDescription machine_of(const std::string& file, const std::vector<std::string>& settings) {
    if (file.empty()) {
        return default_machine(settings);
    }
    const std::string text = read_text_file(file, largest_machine_file);
    const MachineSource* const source = find_machine_source(text);
    if (source == nullptr) {
        return parse_machine(text, file, settings);
    }
    MachineAnswers nobody(AnswerSource::nobody, file);
    return parse_machine(machine_text(read_machine(*source, text, file, nobody)), file, settings);
}

RunArguments arguments_of(int count, char** words) {
    RunArguments out;
    out.path.input = words[1];
    out.path.format = format_of_suffix(out.path.input.substr(out.path.input.rfind('.') + 1));
    if (out.path.format == nullptr) {
        throw UsageError("{}: the name does not say what it is; name a {} file", in_quotes(out.path.input),
                         input_formats(" or ", "."));
    }
    out.outputs.report = words[3];
    out.summary = SummaryKind::json;
    for (int i = 4; i < count; ++i) {
        const std::string_view word = words[i];
        const std::size_t equals = word.find('=');
        const auto* const option = std::ranges::find(options, word.substr(0, equals), &Option::name);
        if (option == std::end(options)) {
            throw UsageError("there is no option {}", in_quotes(word));
        }
        option->take(std::string(word.substr(equals + 1)), out);
    }
    if (out.path.format->is_gcode() && !out.path.gcode.dialect) {
        out.path.gcode.dialect = "auto";
    }
    out.described = machine_of(words[2], out.settings);
    return out;
}

} // namespace

int main(int count, char** words) {
    return exit_status([&] { return run(arguments_of(count, words)); });
}
