// SPDX-License-Identifier: MIT
#include "host_sim/config/machine_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/base/toml_checker.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/config/axis_name.hpp"
#include "host_sim/config/drive_address.hpp"
#include "host_sim/config/machine_keys.hpp"
#include "host_sim/config/program_pins_section.hpp"
#include "host_sim/config/spindle_section.hpp"
#include "host_sim/config/toml_setting.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <toml++/toml.h>
#include <vector>

namespace splinefeed::host {

namespace {

constexpr double counter_limit = 2147483647.0;

/// Reads one file.
class MachineReader {
public:
    /// @param problems  gets what is wrong, and the reading goes on; null: the first problem ends it
    explicit MachineReader(const std::string& file, std::vector<std::string>* problems = nullptr)
        : file_(file), check_(file, "docs/reference/files.md", problems) {
        for (const FileTable* table : {&axis_table, &path_table, &step_line_table}) {
            check_.name_table(*table);
        }
    }

    [[nodiscard]] MachineDescription machine(const toml::table& root) const {
        check_.require_known(root, machine_table);
        MachineDescription machine;
        machine.file = file_;
        check_.attempt([&] {
            if (const toml::node* node = root.get("name")) {
                machine.name = check_.text(*node, "name");
            }
        });
        check_.attempt([&] { check_.take(root, machine_table, sample_period.key, machine.settings.sample_period_us); });
        check_.attempt([&] { drives_at_end(root, machine.drives_on_at_end); });
        check_.attempt([&] { path(root, machine.settings, machine.tolerances); });
        check_.attempt([&] { step(root, machine.step); });
        check_.attempt([&] { machine.spindle = read_spindle(check_, root); });
        check_.attempt([&] { machine.lines = read_program_pins(check_, root, machine.spindle); });
        check_.attempt([&] { axes(root, machine); });
        machine.tolerances.rules = path_rules(machine.settings, machine.tolerances.joint_mm);
        for (unsigned k = 0; k < machine.tolerances.rotary.size(); ++k) {
            machine.tolerances.rotary[k] = machine.settings.axis[k].rotary;
        }
        return machine;
    }

private:
    [[nodiscard]] double number(const toml::node& node, std::string_view key, const NumberRange& range) const {
        const double value = check_.finite(node, key);
        if (value < range.low || value > range.high) {
            check_.fail(node, "{} is {}; it must lie between {} and {} {}", key, value, range.low, range.high,
                        range.unit);
        }
        return value;
    }

    /// Which of the two names of the row it is.
    [[nodiscard]] bool is_first(const toml::node& node, const FileKey& row) const {
        const std::string name = check_.text(node, row.key);
        if (name != row.names[0] && name != row.names[1]) {
            check_.fail(node, "{} is {}; it must be '{}' or '{}'", row.key, in_quotes(name), row.names[0],
                        row.names[1]);
        }
        return name == row.names[0];
    }

    void drives_at_end(const toml::table& root, std::optional<bool>& on) const {
        if (const toml::node* node = root.get("drives_at_end")) {
            on = is_first(*node, machine_table.row("drives_at_end"));
        }
    }

    /// Reads what a table has of these numbers. @param where  the table, for messages
    template <class Settings, std::size_t n>
    void numbers(const toml::table& table, std::string_view where, const MachineNumber<Settings> (&rows)[n],
                 Settings& out) const {
        for (const MachineNumber<Settings>& row : rows) {
            check_.attempt([&] {
                if (const toml::node* node = table.get(row.key)) {
                    out.*row.value = number(*node, row.key, {row.low, row.high, row.unit});
                } else if (row.without == WithoutKey::refused) {
                    check_.fail(table, "{} has no {}; add a number between {} and {} {}", where, row.key, row.low,
                                row.high, row.unit);
                }
            });
        }
    }

    void path(const toml::table& root, MachineSettings& settings, PathTolerances& tolerances) const {
        const toml::node* node = root.get("path");
        if (node == nullptr) {
            check_.fail_file("there is no [path]; write [path] and below it max_feed_mm_s = 100");
        }
        const toml::table& table = check_.table(*node, "path");
        check_.require_known(table, path_table);
        numbers(table, "[path]", path_numbers, settings);
        for (const PathToleranceKey& tolerance : path_tolerance_keys) {
            check_.attempt([&] {
                if (const toml::node* given = table.get(tolerance.key)) {
                    tolerances.*tolerance.value = number(*given, tolerance.key, {0.0, tolerance.high, tolerance.unit});
                }
            });
        }
    }

    void step(const toml::table& root, StepSettings& settings) const {
        const toml::table* const part = check_.part(root, step_line_table, "step");
        if (part == nullptr) {
            return;
        }
        const toml::table& table = *part;
        constexpr double ticks_us[] = {0.0, 10.0, 40.0}; // of the engines
        const toml::node* node = table.get("engine");
        const std::size_t engine = node == nullptr ? 0 : check_.choice(*node, "engine", engine_names);
        const bool intervals = engine == 0;
        settings.interpolated = engine == 2;
        settings.tick_us = ticks_us[engine];
        if (const toml::node* tick = table.get("tick_us")) {
            if (intervals) {
                check_.fail(*tick, "tick_us is of engine = 'fixed-rate' or 'interpolated'; leave it out, or state one");
            }
            settings.tick_us = check_.finite(*tick, "tick_us");
            if (StepTiming::make({.tick_us = settings.tick_us}).error() != Error::none || settings.tick_us == 0.0) {
                check_.fail(*tick, "tick_us is {}; it must be a multiple of 0.25 from 0.25 to 1000", settings.tick_us);
            }
        }
        for (const StepTime& time : step_times) {
            check_.attempt([&] {
                if (const toml::node* given = table.get(time.key)) {
                    settings.*time.value = number(*given, time.key, {time.least_us, longest_step_time_us, "us"});
                }
            });
        }
        check_.attempt([&] { check_.take(table, step_line_table, "step_on_edge", settings.step_on_edge); });
    }

    void motors(const toml::table& table, StepMotors& motors) const {
        if (const toml::node* count = table.get("motors")) {
            const WholeRange range = TomlChecker::whole_range(axis_table.row("motors"));
            const auto value = TomlChecker::whole_of(*count);
            if (!value || *value < range.low || *value > range.high) {
                check_.fail(*count, "motors must be {} or {}", range.low, range.high);
            }
            motors.count = static_cast<int>(*value);
        }
        check_.take(table, axis_table, "invert_step", motors.invert_step);
        const toml::node* invert = table.get("invert_direction");
        if (invert == nullptr) {
            return;
        }
        const toml::array* each = invert->as_array();
        if (each == nullptr) {
            motors.invert_direction.fill(check_.flag(*invert, "invert_direction"));
            return;
        }
        if (each->size() != static_cast<std::size_t>(motors.count)) {
            check_.fail(*invert,
                        "invert_direction has {} values; it must have one for each of {} motors, or be true or "
                        "false for all",
                        each->size(), motors.count);
        }
        for (std::size_t i = 0; i < each->size(); ++i) {
            motors.invert_direction[i] = check_.flag((*each)[i], "invert_direction");
        }
    }

    void axes(const toml::table& root, MachineDescription& machine) const {
        const toml::node* node = root.get("axis");
        const toml::array* array = node != nullptr ? node->as_array() : nullptr;
        if (node == nullptr) {
            check_.fail_file("there is no [[axis]]; a machine has one to six");
        }
        if (array == nullptr || array->empty()) {
            check_.fail(*node, "axis must be one to six tables, each with [[axis]] above it");
        }
        if (array->size() > static_cast<std::size_t>(max_axes)) {
            check_.fail((*array)[static_cast<std::size_t>(max_axes)], "there are {} axes; a machine has one to {}",
                        array->size(), max_axes);
        }
        machine.settings.axes = static_cast<int>(array->size());
        for (std::size_t k = 0; k < array->size(); ++k) {
            const toml::table* table = (*array)[k].as_table();
            if (table == nullptr) {
                check_.fail((*array)[k], "axis must be one to six tables, each with [[axis]] above it");
            }
            check_.attempt([&] { axis(*table, k, machine); });
        }
    }

    void axis(const toml::table& table, std::size_t k, MachineDescription& machine) const {
        check_.require_known(table, axis_table);
        const toml::node* name = table.get("name");
        if (name == nullptr) {
            check_.fail(table, "[[axis]] has no name; it must be one of x, y, z, a, b, c");
        }
        const std::string letter = axis_name_of(check_.text(*name, "name"));
        if (std::ranges::find(axis_name_letters, letter) == std::end(axis_name_letters)) {
            check_.fail(*name, "axis name {}; it must be one of x, y, z, a, b, c", in_quotes(letter));
        }
        for (std::size_t j = 0; j < k; ++j) {
            if (machine.axis_name[j] == letter) {
                check_.fail(*name, "there are two axes '{}'; each needs a name of its own", letter);
            }
        }
        const std::string where = fmt::format("axis {}", letter);
        machine.axis_name[k] = letter;
        machine.axis_line[k] = table.source().begin.line;
        AxisSettings& axis = machine.settings.axis[k];
        check_.attempt([&] {
            if (const toml::node* kind = table.get("kind")) {
                axis.rotary = !is_first(*kind, axis_table.row("kind"));
            }
        });
        numbers(table, where, axis_numbers, axis);
        check_.attempt([&] {
            if (const toml::node* window = table.get("standstill_window_mm")) {
                const FileKey& row = axis_table.row("standstill_window_mm");
                machine.standstill_window_mm[k] = number(*window, row.key, {row.low, row.high, row.unit});
            }
        });
        check_.attempt([&] {
            if (const toml::node* node = table.get("travel_mm")) {
                machine.travel[k] = travel(*node, axis.steps_per_mm);
            }
            travel_end(table, where, machine.travel[k], axis);
        });
        check_.attempt([&] { motors(table, machine.motors[k]); });
        check_.attempt([&] { check_.take(table, axis_table, "invert", machine.inverted[k]); });
        for (bool& direction : machine.motors[k].invert_direction) {
            direction = direction != machine.inverted[k];
        }
        check_.attempt([&] { drive(table, machine.drive[k], machine.axis_line[k]); });
    }

    void drive(const toml::table& table, std::string& address, std::uint64_t& line) const {
        if (const toml::node* drive = table.get("drive")) {
            address = check_.text(*drive, "drive");
            line = drive->source().begin.line;
            try {
                static_cast<void>(parse_drive_address(address));
            } catch (const AddressError& error) {
                check_.fail(*drive, "drive: {}", error.what());
            }
        }
    }

    void travel_end(const toml::table& table, std::string_view where, const std::optional<Travel>& travel,
                    AxisSettings& axis) const {
        const toml::node* zone = table.get("travel_end_zone_mm");
        const toml::node* velocity = table.get("travel_end_velocity_mm_s");
        if (zone == nullptr && velocity == nullptr) {
            return;
        }
        const toml::node& given = zone != nullptr ? *zone : *velocity;
        if (zone == nullptr || velocity == nullptr) {
            check_.fail(given, "{} must have both travel_end_zone_mm and travel_end_velocity_mm_s, or neither", where);
        }
        if (!travel) {
            check_.fail(given, "{} has a travel_end_zone_mm, but no travel_mm; give both, like travel_mm = [-10, 310]",
                        where);
        }
        axis.travel_low_mm = travel->low;
        axis.travel_high_mm = travel->high;
    }

    [[nodiscard]] Travel travel(const toml::node& node, double steps_per_mm) const {
        const toml::array* array = node.as_array();
        if (array == nullptr || array->size() != 2) {
            check_.fail(node, "travel_mm must be two numbers, the lowest and the highest position, like [-10, 310]");
        }
        const Travel travel{check_.finite((*array)[0], "travel_mm"), check_.finite((*array)[1], "travel_mm")};
        if (!position_representable(travel.low) || !position_representable(travel.high)) {
            check_.fail(node, "travel_mm must lie within +-1048576 mm");
        }
        if (!(travel.low < travel.high)) {
            check_.fail(node, "travel_mm is [{}, {}]; the second number must be the larger one", travel.low,
                        travel.high);
        }
        if (std::fmax(-travel.low, travel.high) * steps_per_mm > counter_limit) {
            check_.fail(node, "travel_mm times steps_per_mm must stay within +-2147483647 counts");
        }
        return travel;
    }

    const std::string& file_;
    TomlChecker check_;
};

} // namespace

MachineDescription parse_machine(std::string_view text, const std::string& file,
                                 const std::vector<std::string>& settings) {
    toml::table root = parse_toml(text, file);
    MachineDescription machine = MachineReader(file).machine(root); // what is wrong without them has a line
    if (settings.empty()) {
        return machine;
    }
    for (const std::string& setting : settings) {
        apply_setting(root, setting);
    }
    const std::string no_file;
    try {
        MachineDescription changed = MachineReader(no_file).machine(root);
        changed.file = file;
        changed.axis_line = machine.axis_line;
        changed.name += fmt::format(", with {}", fmt::join(settings, " ")); // the page of a run shows it
        return changed;
    } catch (const InputError& error) {
        throw UsageError("--set {}: {}", fmt::join(settings, " --set "), error.what());
    }
}

std::vector<std::string> machine_problems(std::string_view text, const std::string& file) {
    std::vector<std::string> problems;
    try {
        static_cast<void>(MachineReader(file, &problems).machine(parse_toml(text, file)));
    } catch (const InputError& error) { // no TOML
        problems.emplace_back(error.what());
    }
    return problems;
}

MachineDescription read_machine_file(const std::string& path, const std::vector<std::string>& settings) {
    return parse_machine(read_text_file(path, largest_machine_file), path, settings);
}

} // namespace splinefeed::host
