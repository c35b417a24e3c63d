// SPDX-License-Identifier: MIT
#include "host_sim/convert/machine_source.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/convert/grbl_listing.hpp"
#include "host_sim/convert/grbl_machine.hpp"
#include "host_sim/convert/ini_text.hpp"
#include "host_sim/convert/klipper_machine.hpp"
#include "host_sim/convert/linuxcnc_machine.hpp"
#include "host_sim/convert/marlin_machine.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr MachineSource machine_sources[] = {
    {"grbl", "an answer of grbl to $$", is_grbl_listing,
     [](std::string_view text, const std::string& file, MachineAnswers& /*answers*/) {
         return grbl_sketch(text, file);
     }},
    {"linuxcnc", "an INI file of LinuxCNC",
     [](std::string_view text) {
         const IniText ini(text, {});
         return ini.has("TRAJ") || ini.has("EMCMOT");
     },
     linuxcnc_sketch},
    {"klipper", "a printer.cfg of Klipper",
     [](std::string_view text) { return IniText(text, {.colons = true}).has("printer"); },
     [](std::string_view text, const std::string& file, MachineAnswers& /*answers*/) {
         return klipper_sketch(text, file);
     }},
    {"marlin", "an answer of Marlin to M503", is_marlin_listing,
     [](std::string_view text, const std::string& file, MachineAnswers& /*answers*/) {
         return marlin_sketch(text, file);
     }},
};

/// Numbers with blanks or commas between them, each finite. Empty: it is none of these.
std::vector<double> answered_numbers(std::string_view text) {
    std::vector<double> out;
    std::string blanks(text);
    std::replace(blanks.begin(), blanks.end(), ',', ' ');
    for (const std::string_view part : split(blanks, ' ')) {
        double number = 0.0;
        if (part.empty()) {
            continue;
        }
        if (read_number(part, number) != NumberText::number) {
            return {};
        }
        out.push_back(number);
    }
    return out;
}

void ask_travel(SketchAxis& axis, MachineAnswers& answers) {
    answers.ask({axis.name + ".travel_mm",
                 fmt::format("From where to where may {} move, in mm, like 0 300?", axis.name), "no limit"},
                [&](std::string_view text) {
                    const std::vector<double> ends = answered_numbers(text);
                    if (ends.size() != 2 || ends[0] >= ends[1]) {
                        return "it must be two numbers, the lower one first, like 0 300";
                    }
                    axis.rows.push_back({"travel_mm",
                                         fmt::format("[{}, {}]", short_number(ends[0]), short_number(ends[1])),
                                         "answered"});
                    return "";
                });
}

void ask_steps(SketchAxis& axis, MachineAnswers& answers) {
    answers.ask({axis.name + ".steps_per_mm", fmt::format("How many steps are a mm of {}?", axis.name),
                 "1000, which matters to drives and step lines alone"},
                [&](std::string_view text) {
                    const std::vector<double> steps = answered_numbers(text);
                    if (steps.size() != 1 || !(steps[0] >= 0.001 && steps[0] <= 1e6)) {
                        return "it must be a number between 0.001 and 1000000";
                    }
                    axis.rows.push_back({"steps_per_mm", short_number(steps[0]), "answered"});
                    return "";
                });
}

void ask_jerk(MachineSketch& sketch, MachineAnswers& answers) {
    answers.ask({"jerk_per_acceleration",
                 "How many times its acceleration a second may the jerk of an axis be, 20 (soft) to 100 (hard)?",
                 "no limit of the jerk"},
                [&](std::string_view text) {
                    const std::vector<double> factor = answered_numbers(text);
                    if (factor.size() != 1 || !(factor[0] >= 1.0 && factor[0] <= 1000.0)) {
                        return "it must be a number between 1 and 1000";
                    }
                    for (SketchAxis& axis : sketch.axes) {
                        const SketchRow* const row = axis.find("max_acceleration_mm_s2");
                        const double jerk = std::strtod(row->value.c_str(), nullptr) * factor[0];
                        axis.rows.push_back(
                            {"max_jerk_mm_s3", short_number(std::max(jerk, 1.0)),
                             fmt::format("answered: {} times the acceleration", short_number(factor[0]))});
                    }
                    return "";
                });
}

} // namespace

const MachineSource* find_machine_source(std::string_view text) {
    const auto* const found =
        std::ranges::find_if(machine_sources, [text](const MachineSource& source) { return source.looks_like(text); });
    return found != std::end(machine_sources) ? found : nullptr;
}

std::string machine_source_names() {
    std::string out;
    for (const MachineSource& source : machine_sources) {
        out += fmt::format("{}{}", out.empty() ? "" : ", ", source.name);
    }
    return out;
}

const MachineSource& machine_source(std::string_view name, std::string_view text, const std::string& file) {
    if (name.empty() || name == "auto") {
        const MachineSource* const found = find_machine_source(text);
        if (found == nullptr) {
            throw InputError(file, 0, "what it is cannot be told; name it by --from: {}", machine_source_names());
        }
        return *found;
    }
    const auto* const found = std::ranges::find(machine_sources, name, &MachineSource::name);
    if (found == std::end(machine_sources)) {
        throw UsageError("--from {}: it must be one of {} and auto", in_quotes(name), machine_source_names());
    }
    return *found;
}

MachineSketch read_machine(const MachineSource& source, std::string_view text, const std::string& file,
                           MachineAnswers& answers) {
    MachineSketch out = source.read(text, file, answers);
    for (SketchAxis& axis : out.axes) {
        if (!axis.rotary && axis.find("travel_mm") == nullptr) {
            ask_travel(axis, answers);
        }
        if (axis.find("steps_per_mm") == nullptr) {
            ask_steps(axis, answers);
        }
    }
    if (std::ranges::none_of(out.axes, [](const SketchAxis& axis) { return axis.find("max_jerk_mm_s3") != nullptr; })) {
        ask_jerk(out, answers);
    }
    answers.close();
    return out;
}

} // namespace splinefeed::host
