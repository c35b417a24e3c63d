// SPDX-License-Identifier: MIT
#include "host_sim/config/program_pins_section.hpp"

#include "host_sim/config/gpio_map_pins.hpp"
#include "host_sim/config/io_modules.hpp"
#include "host_sim/config/machine_keys.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// The line of a table with `line` and `active`.
SwitchedPin switched_line(const TomlChecker& check, GpioMapPins& lines, const toml::table& table,
                          const std::string& where, bool safe_on) {
    SwitchedPin switched;
    check.take(table, switched_table, "active", switched.on_level);
    switched.line = lines.output(check.required(table, "line", where, GpioMapPins::what), "line of " + where,
                                 safe_on == switched.on_level);
    return switched;
}

/// The line or the coil of a table.
ProgramSwitch program_switch(const TomlChecker& check, GpioMapPins& lines, IoModules& modules, const toml::table& table,
                             const std::string& where, bool safe_on) {
    if (!modules.is_named(table, where)) {
        return switched_line(check, lines, table, where, safe_on);
    }
    bool on_level = true;
    check.take(table, output_table, "active", on_level);
    return modules.coil(table, where, on_level);
}

/// [OF.KEY], off where it is safe.
std::optional<SwitchedPin> optional_line(const TomlChecker& check, GpioMapPins& lines, const toml::table& of,
                                         std::string_view of_name, std::string_view key) {
    const toml::node* const node = of.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::string where = fmt::format("[{}.{}]", of_name, key);
    const toml::table& table = check.table(*node, fmt::format("{}.{}", of_name, key));
    check.require_known(table, switched_table, where);
    return switched_line(check, lines, table, where, false);
}

/// [coolant.KEY], likewise.
std::optional<ProgramSwitch> coolant(const TomlChecker& check, GpioMapPins& lines, IoModules& modules,
                                     const toml::table& of, std::string_view key) {
    const toml::node* const node = of.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::string where = fmt::format("[coolant.{}]", key);
    const toml::table& table = check.table(*node, fmt::format("coolant.{}", key));
    check.require_known(table, coolant_line_table, where);
    return program_switch(check, lines, modules, table, where, false);
}

DigitalOutput digital_output(const TomlChecker& check, GpioMapPins& lines, IoModules& modules, const toml::table& table,
                             const ProgramPins& before) {
    check.require_known(table, output_table);
    const toml::node& number = check.required(table, "number", "[[output]]", "the P of M62 to M65");
    DigitalOutput output;
    output.number = check.value<int>(number, output_table.row("number"));
    if (before.output(output.number) != nullptr) {
        check.fail(number, "this is the second output {}; give each a number of its own", output.number);
    }
    check.take(table, output_table, "safe", output.safe_on);
    output.line = program_switch(check, lines, modules, table, fmt::format("output {}", output.number), output.safe_on);
    return output;
}

/// The line of a table with `line`, `active` and `bias`.
SensedPin sensed_line(const TomlChecker& check, GpioMapPins& lines, const toml::table& table,
                      const std::string& where) {
    SensedPin sensed;
    check.take(table, sensed_table, "active", sensed.active_level);
    hal::gpio::Bias bias = hal::gpio::Bias::as_is;
    check.take(table, sensed_table, "bias", bias);
    sensed.line = lines.input(check.required(table, "line", where, GpioMapPins::what), "line of " + where, bias);
    return sensed;
}

DigitalInput digital_input(const TomlChecker& check, GpioMapPins& lines, const IoModules& modules,
                           const toml::table& table, const ProgramPins& before) {
    check.require_known(table, input_table);
    const toml::node& number = check.required(table, "number", "[[input]]", "the P of M66");
    DigitalInput input;
    input.number = check.value<int>(number, input_table.row("number"));
    if (before.input(input.number) != nullptr) {
        check.fail(number, "this is the second input {}; give each a number of its own", input.number);
    }
    const std::string where = fmt::format("input {}", input.number);
    if (modules.is_named(table, where)) {
        bool active_level = true;
        check.take(table, input_table, "active", active_level);
        input.line = modules.bit(table, where, active_level);
    } else {
        input.line = sensed_line(check, lines, table, where);
    }
    return input;
}

std::optional<SpindlePins> spindle_lines(const TomlChecker& check, GpioMapPins& lines, const toml::table& table) {
    if (table.get("enable") == nullptr) {
        for (const std::string_view key : {"reverse", "at_speed", "spin_up_s", "spin_down_s"}) {
            if (const toml::node* const node = table.get(key)) {
                check.attempt([&] {
                    check.fail(*node,
                               "{} is of a spindle on lines; name the line that turns it on, "
                               "enable = {{ line = ... }}, or leave it out",
                               key);
                });
            }
        }
        return std::nullopt;
    }
    SpindlePins out;
    check.attempt([&] {
        if (const toml::node* const vfd = table.get("vfd")) {
            check.fail(*vfd, "[spindle] has vfd and enable; a spindle is turned by its inverter's registers or by "
                             "lines: leave one out");
        }
    });
    check.attempt([&] { out.enable = *optional_line(check, lines, table, "spindle", "enable"); });
    check.attempt([&] { out.reverse = optional_line(check, lines, table, "spindle", "reverse"); });
    check.attempt([&] {
        if (const toml::node* const node = table.get("at_speed")) {
            const toml::table& sensed = check.table(*node, "spindle.at_speed");
            check.require_known(sensed, sensed_table);
            out.at_speed = sensed_line(check, lines, sensed, "[spindle.at_speed]");
        }
    });
    check.attempt([&] {
        static_cast<void>(
            check.required(table, "spin_up_s", "[spindle]", "the time from standstill to the speed, 0 to 600 s"));
        check.take(table, spindle_table, "spin_up_s", out.spin_up_s);
        out.spin_down_s = out.spin_up_s;
    });
    check.attempt([&] { check.take(table, spindle_table, "spin_down_s", out.spin_down_s); });
    return out;
}

} // namespace

ProgramPins read_program_pins(const TomlChecker& check, const toml::table& root,
                              std::optional<SpindleDescription>& spindle) {
    std::string chip;
    check.attempt([&] {
        if (const toml::node* const node = root.get("lines")) {
            chip = "?"; // where it is wrong, the lines that need it are not
            const toml::table& table = check.table(*node, "lines");
            check.require_known(table, chip_table);
            const toml::node& path = check.required(table, "chip", "[lines]", "the chip of lines that name none");
            chip = GpioMapPins::chip_path(check, path);
        }
    });
    ProgramPins out;
    GpioMapPins lines(check, chip, out.chips);
    IoModules modules(check, root, out.modules);
    check.attempt([&] {
        if (const toml::table* const table = check.part(root, coolant_table, "coolant")) {
            check.attempt([&] { out.mist = coolant(check, lines, modules, *table, "mist"); });
            check.attempt([&] { out.flood = coolant(check, lines, modules, *table, "flood"); });
        }
    });
    check.attempt([&] {
        if (spindle) {
            spindle->lines = spindle_lines(check, lines, check.table(*root.get("spindle"), "spindle"));
        }
    });
    check.attempt([&] {
        for (const toml::table* const table : check.tables(root, "output")) {
            check.attempt([&] { out.outputs.push_back(digital_output(check, lines, modules, *table, out)); });
        }
    });
    check.attempt([&] {
        for (const toml::table* const table : check.tables(root, "input")) {
            check.attempt([&] { out.inputs.push_back(digital_input(check, lines, modules, *table, out)); });
        }
    });
    return out;
}

} // namespace splinefeed::host
