// SPDX-License-Identifier: MIT
#include "host_sim/config/program_lines_section.hpp"

#include "host_sim/config/gpio_map_lines.hpp"

#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::array<std::string_view, 2> line_levels{"low", "high"};
constexpr std::array<std::string_view, 2> output_states{"off", "on"};

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
    switched.line =
        lines.output(check.required(table, "line", where, "a line"), "line of " + where, safe_on == switched.on_level);
    return switched;
}

std::optional<SwitchedLine> coolant_line(const TomlChecker& check, GpioMapLines& lines, const toml::table& coolant,
                                         std::string_view key) {
    const toml::node* const node = coolant.get(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::string where = fmt::format("[coolant.{}]", key);
    const toml::table& table = check.table(*node, fmt::format("coolant.{}", key));
    check.require_known(table, {"line", "active"}, where);
    return switched_line(check, lines, table, where, false);
}

DigitalOutput digital_output(const TomlChecker& check, GpioMapLines& lines, const toml::table& table,
                             const ProgramLines& before) {
    check.require_known(table, {"number", "line", "active", "safe"}, "[[output]]");
    const toml::node& number = check.required(table, "number", "[[output]]", "the P of M62 to M65");
    DigitalOutput output;
    output.number = static_cast<int>(check.whole(number, "number", {0, DigitalOutput::most}));
    if (before.output(output.number) != nullptr) {
        check.fail(number, fmt::format("this is the second output {}; give each a number of its own", output.number));
    }
    output.safe_on = choice_of(check, table, "safe", output_states, 0) == 1;
    output.line = switched_line(check, lines, table, fmt::format("output {}", output.number), output.safe_on);
    return output;
}

} // namespace

ProgramLines read_program_lines(const TomlChecker& check, const toml::table& root) {
    std::string chip;
    if (const toml::node* const node = root.get("lines")) {
        const toml::table& table = check.table(*node, "lines");
        check.require_known(table, {"chip"}, "[lines]");
        const toml::node& path = check.required(table, "chip", "[lines]", "the chip of lines that name none");
        chip = GpioMapLines::chip_path(check, path);
    }
    ProgramLines out;
    GpioMapLines lines(check, chip, out.chips);
    if (const toml::node* const node = root.get("coolant")) {
        const toml::table& coolant = check.table(*node, "coolant");
        check.require_known(coolant, {"mist", "flood"}, "[coolant]");
        out.mist = coolant_line(check, lines, coolant, "mist");
        out.flood = coolant_line(check, lines, coolant, "flood");
    }
    for (const toml::table* const table : check.tables(root, "output")) {
        out.outputs.push_back(digital_output(check, lines, *table, out));
    }
    return out;
}

} // namespace splinefeed::host
