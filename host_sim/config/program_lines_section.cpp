// SPDX-License-Identifier: MIT
#include "host_sim/config/program_lines_section.hpp"

#include "host_sim/config/gpio_map_lines.hpp"
#include "host_sim/config/io_modules.hpp"

#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::array<std::string_view, 2> line_levels{"low", "high"};
constexpr std::array<std::string_view, 2> output_states{"off", "on"};
constexpr std::array<std::string_view, 4> line_biases{"as-is", "disabled", "pull-up", "pull-down"};

std::size_t choice_of(const TomlChecker& check, const toml::table& table, std::string_view key,
                      std::span<const std::string_view> names, std::size_t otherwise) {
    const toml::node* const node = table.get(key);
    return node != nullptr ? check.choice(*node, key, names) : otherwise;
}

/// The line of a table with `line` and `active`.
SwitchedLine switched_line(const TomlChecker& check, GpioMapLines& lines, const toml::table& table,
                           const std::string& where, bool safe_on) {
    SwitchedLine switched;
    switched.on_level = choice_of(check, table, "active", line_levels, 1) == 1;
    switched.line = lines.output(check.required(table, "line", where, GpioMapLines::what), "line of " + where,
                                 safe_on == switched.on_level);
    return switched;
}

/// The line or the coil of a table.
ProgramSwitch program_switch(const TomlChecker& check, GpioMapLines& lines, IoModules& modules,
                             const toml::table& table, const std::string& where, bool safe_on) {
    if (!modules.is_named(table, where)) {
        return switched_line(check, lines, table, where, safe_on);
    }
    return modules.coil(table, where, choice_of(check, table, "active", line_levels, 1) == 1);
}

/// [OF.KEY], off where it is safe.
std::optional<SwitchedLine> optional_line(const TomlChecker& check, GpioMapLines& lines, const toml::table& of,
                                          std::string_view of_name, std::string_view key) {
    const toml::node* const node = of.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::string where = fmt::format("[{}.{}]", of_name, key);
    const toml::table& table = check.table(*node, fmt::format("{}.{}", of_name, key));
    check.require_known(table, {"line", "active"}, where);
    return switched_line(check, lines, table, where, false);
}

/// [coolant.KEY], likewise.
std::optional<ProgramSwitch> coolant(const TomlChecker& check, GpioMapLines& lines, IoModules& modules,
                                     const toml::table& of, std::string_view key) {
    const toml::node* const node = of.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::string where = fmt::format("[coolant.{}]", key);
    const toml::table& table = check.table(*node, fmt::format("coolant.{}", key));
    check.require_known(table, {"line", "module", "coil", "active"}, where);
    return program_switch(check, lines, modules, table, where, false);
}

DigitalOutput digital_output(const TomlChecker& check, GpioMapLines& lines, IoModules& modules,
                             const toml::table& table, const ProgramLines& before) {
    check.require_known(table, {"number", "line", "module", "coil", "active", "safe"}, "[[output]]");
    const toml::node& number = check.required(table, "number", "[[output]]", "the P of M62 to M65");
    DigitalOutput output;
    output.number = static_cast<int>(check.whole(number, "number", {0, DigitalOutput::most}));
    if (before.output(output.number) != nullptr) {
        check.fail(number, fmt::format("this is the second output {}; give each a number of its own", output.number));
    }
    output.safe_on = choice_of(check, table, "safe", output_states, 0) == 1;
    output.line = program_switch(check, lines, modules, table, fmt::format("output {}", output.number), output.safe_on);
    return output;
}

/// The line of a table with `line`, `active` and `bias`.
SensedLine sensed_line(const TomlChecker& check, GpioMapLines& lines, const toml::table& table,
                       const std::string& where) {
    SensedLine sensed;
    sensed.active_level = choice_of(check, table, "active", line_levels, 1) == 1;
    sensed.line = lines.input(check.required(table, "line", where, GpioMapLines::what), "line of " + where,
                              static_cast<hal::gpio::Bias>(choice_of(check, table, "bias", line_biases, 0)));
    return sensed;
}

DigitalInput digital_input(const TomlChecker& check, GpioMapLines& lines, const IoModules& modules,
                           const toml::table& table, const ProgramLines& before) {
    check.require_known(table, {"number", "line", "bias", "module", "input", "coil", "active"}, "[[input]]");
    const toml::node& number = check.required(table, "number", "[[input]]", "the P of M66");
    DigitalInput input;
    input.number = static_cast<int>(check.whole(number, "number", {0, DigitalInput::most}));
    if (before.input(input.number) != nullptr) {
        check.fail(number, fmt::format("this is the second input {}; give each a number of its own", input.number));
    }
    const std::string where = fmt::format("input {}", input.number);
    if (modules.is_named(table, where)) {
        input.line = modules.bit(table, where, choice_of(check, table, "active", line_levels, 1) == 1);
    } else {
        input.line = sensed_line(check, lines, table, where);
    }
    return input;
}

std::optional<SpindleLines> spindle_lines(const TomlChecker& check, GpioMapLines& lines, const toml::table& table) {
    constexpr NumberRange times{0.0, 600.0, "s"};
    const auto enable = optional_line(check, lines, table, "spindle", "enable");
    if (!enable) {
        for (const std::string_view key : {"reverse", "at_speed", "spin_up_s", "spin_down_s"}) {
            if (const toml::node* const node = table.get(key)) {
                check.fail(*node, fmt::format("{} is of a spindle on lines; name the line that turns it on, enable = "
                                              "{{ line = ... }}, or leave it out",
                                              key));
            }
        }
        return std::nullopt;
    }
    if (const toml::node* const vfd = table.get("vfd")) {
        check.fail(*vfd, "[spindle] has vfd and enable; a spindle is turned by its inverter's registers or by lines: "
                         "leave one out");
    }
    SpindleLines out;
    out.enable = *enable;
    out.reverse = optional_line(check, lines, table, "spindle", "reverse");
    if (const toml::node* const node = table.get("at_speed")) {
        const toml::table& sensed = check.table(*node, "spindle.at_speed");
        check.require_known(sensed, {"line", "active", "bias"}, "[spindle.at_speed]");
        out.at_speed = sensed_line(check, lines, sensed, "[spindle.at_speed]");
    }
    out.spin_up_s = check.number(
        check.required(table, "spin_up_s", "[spindle]", "the time from standstill to the speed, 0 to 600 s"),
        "spin_up_s", times);
    const toml::node* const down = table.get("spin_down_s");
    out.spin_down_s = down != nullptr ? check.number(*down, "spin_down_s", times) : out.spin_up_s;
    return out;
}

} // namespace

ProgramLines read_program_lines(const TomlChecker& check, const toml::table& root,
                                std::optional<SpindleDescription>& spindle) {
    std::string chip;
    if (const toml::node* const node = root.get("lines")) {
        const toml::table& table = check.table(*node, "lines");
        check.require_known(table, {"chip"}, "[lines]");
        const toml::node& path = check.required(table, "chip", "[lines]", "the chip of lines that name none");
        chip = GpioMapLines::chip_path(check, path);
    }
    ProgramLines out;
    GpioMapLines lines(check, chip, out.chips);
    IoModules modules(check, root, out.modules);
    if (const toml::node* const node = root.get("coolant")) {
        const toml::table& table = check.table(*node, "coolant");
        check.require_known(table, {"mist", "flood"}, "[coolant]");
        out.mist = coolant(check, lines, modules, table, "mist");
        out.flood = coolant(check, lines, modules, table, "flood");
    }
    if (spindle) {
        spindle->lines = spindle_lines(check, lines, check.table(*root.get("spindle"), "spindle"));
    }
    for (const toml::table* const table : check.tables(root, "output")) {
        out.outputs.push_back(digital_output(check, lines, modules, *table, out));
    }
    for (const toml::table* const table : check.tables(root, "input")) {
        out.inputs.push_back(digital_input(check, lines, modules, *table, out));
    }
    return out;
}

} // namespace splinefeed::host
