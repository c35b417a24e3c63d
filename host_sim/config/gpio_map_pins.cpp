// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_map_pins.hpp"

#include "host_sim/config/line_keys.hpp"
#include "splinefeed/hal/gpio/chip_lookup.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::gpio;

std::string GpioMapPins::chip_path(const TomlChecker& check, const toml::node& node) {
    std::string path = check.text(node, "chip");
    if (!names_chip(path)) {
        check.fail(node,
                   "chip is {}; it must be its whole path, like \"/dev/gpiochip1\", or its label, like "
                   "\"label=pinctrl-bcm2711\"",
                   in_quotes(path));
    }
    return path;
}

std::string GpioMapPins::name(const toml::node& node, std::string_view key) const {
    std::string name = check_.text(node, key);
    if (const double longest = line_table.row("name").high; static_cast<double>(name.size()) > longest) {
        check_.fail(node, "{} is {}; names of lines have at most {} letters", key, in_quotes(name), longest);
    }
    return name;
}

unsigned GpioMapPins::offset(const toml::node& node, std::string_view key) const {
    return static_cast<unsigned>(check_.whole(node, key, TomlChecker::whole_range(line_table.row("offset"))));
}

GpioMapPins::Wanted GpioMapPins::wanted(const toml::node& node, std::string_view key) const {
    Wanted line = wanted_line(node, key);
    if (line.chip.empty()) {
        check_.fail(node,
                    "{} names no chip; write it as {{ chip = \"/dev/gpiochip0\", name = ... }}, or name "
                    "the chip of all lines, chip = \"/dev/gpiochip0\" in [lines]",
                    key);
    }
    return line;
}

GpioMapPins::Wanted GpioMapPins::wanted_line(const toml::node& node, std::string_view key) const {
    Wanted wanted{default_chip_, {}};
    if (TomlChecker::whole_of(node)) {
        wanted.line.offset = offset(node, key);
        return wanted;
    }
    if (node.is_string()) {
        wanted.line.name = name(node, key);
        return wanted;
    }
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        check_.fail(node, "{} must be {}", key, what);
    }
    check_.require_known(*table, line_table, key);
    if (const toml::node* given = table->get("chip")) {
        wanted.chip = chip_path(check_, *given);
    }
    if (const toml::node* given = table->get("offset")) {
        wanted.line.offset = offset(*given, "offset");
    }
    if (const toml::node* given = table->get("name")) {
        wanted.line.name = name(*given, "name");
    }
    if (wanted.line.name.empty() && !wanted.line.offset) {
        check_.fail(node, "{} has neither offset nor name; give one of both, or both", key);
    }
    return wanted;
}

// A line that is named here and given by its offset there is found when it is requested.
void GpioMapPins::require_unused(const toml::node& node, std::string_view key, const Wanted& line) {
    std::vector<std::string> ways;
    if (line.line.offset) {
        ways.push_back(fmt::format("line {}", *line.line.offset));
    }
    if (!line.line.name.empty()) {
        ways.push_back(fmt::format("line {}", in_quotes(line.line.name)));
    }
    for (const std::string& way : ways) {
        const auto [before, unused] = used_.emplace(std::pair(line.chip, way), std::string(key));
        if (!unused) {
            check_.fail(node,
                        "{} is {} of {}, which is {} already; each needs a line of its own (inputs may "
                        "share one, which each of them then names alike)",
                        key, way, line.chip, before->second);
        }
    }
}

std::size_t GpioMapPins::chip_index(const std::string& chip) {
    for (std::size_t i = 0; i < chips_.size(); ++i) {
        if (chips_[i].chip == chip) {
            return i;
        }
    }
    chips_.push_back({chip, {}, {}});
    return chips_.size() - 1;
}

template <class Request>
PinBit GpioMapPins::add(const toml::node& node, std::size_t chip, std::vector<Request>& requests,
                        const Request& request) const {
    if (requests.size() == most_lines || chip > UINT8_MAX) {
        check_.fail(node, "this is more than {} lines of {}; leave some out", most_lines, chips_[chip].chip);
    }
    requests.push_back(request);
    return {static_cast<std::uint8_t>(chip), static_cast<std::uint8_t>(requests.size() - 1)};
}

PinBit GpioMapPins::output(const toml::node& node, std::string_view key, bool safe_level) {
    const Wanted line = wanted(node, key);
    require_unused(node, key, line);
    const std::size_t chip = chip_index(line.chip);
    return add(node, chip, chips_[chip].outputs, OutputRequest{line.line, safe_level});
}

PinBit GpioMapPins::input(const toml::node& node, std::string_view key, Bias bias) {
    const Wanted line = wanted(node, key);
    for (const Input& other : inputs_) {
        if (other.wanted.chip == line.chip && other.wanted.line == line.line) {
            if (other.bias != bias) {
                check_.fail(node,
                            "{} shares its line with another input, and has another bias; a line has "
                            "one bias",
                            key);
            }
            return other.bit;
        }
    }
    require_unused(node, key, line);
    const std::size_t chip = chip_index(line.chip);
    const PinBit bit = add(node, chip, chips_[chip].inputs, InputRequest{line.line, bias});
    inputs_.push_back({line, bias, bit});
    return bit;
}

} // namespace splinefeed::host
