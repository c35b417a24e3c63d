// SPDX-License-Identifier: MIT
#include "host_sim/config/machine_choice.hpp"

#include "host_sim/base/text_file.hpp"
#include "host_sim/config/doubtful_numbers.hpp"
#include "host_sim/config/machine_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "machine.toml";

// Where a machine file is looked for, the first one first.
std::vector<fs::path> usual_places(const std::string& program) {
    std::vector<fs::path> places;
    if (!program.empty() && program != "-") {
        places.push_back(fs::path(program).parent_path() / file_name);
    }
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name); // NOLINT: nobody changes the environment
        return std::string(value != nullptr ? value : "");
    };
    if (const std::string config = variable("XDG_CONFIG_HOME"); !config.empty()) {
        places.push_back(fs::path(config) / "splinefeed" / file_name);
    } else if (const std::string home = variable("HOME"); !home.empty()) {
        places.push_back(fs::path(home) / ".config" / "splinefeed" / file_name);
    }
    return places;
}

std::string found_file(const MachineChoice& choice) {
    if (!choice.file.empty()) {
        return choice.file == "default" ? std::string() : choice.file;
    }
    for (const fs::path& place : usual_places(choice.program)) {
        if (is_regular_file(place.string())) {
            return place.string();
        }
    }
    return {};
}

} // namespace

MachineDescription choose_machine(const MachineChoice& choice) {
    const std::string file = found_file(choice);
    return file.empty() ? default_machine(choice.settings) : read_machine_file(file, choice.settings);
}

std::string note_of(const MachineChoice& choice, const MachineDescription& machine) {
    std::vector<std::string> notes = doubtful_numbers(machine);
    if (choice.file.empty() && !machine.file.empty()) {
        notes.insert(
            notes.begin(),
            fmt::format("the machine is that of {}; -m names another one, -m default the default one", machine.file));
    }
    return fmt::format("{}", fmt::join(notes, "; "));
}

} // namespace splinefeed::host
