// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_map.hpp"

#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/config/axis_name.hpp"
#include "host_sim/config/gpio_map_keys.hpp"
#include "host_sim/config/gpio_map_pins.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace splinefeed::host {

using namespace hal::gpio;

namespace {

constexpr std::int64_t default_debounce_us = 1000;

class Reader {
public:
    Reader(const std::string& file, const MachineDescription& machine, const std::string& chip)
        : check_(file, "docs/reference/gpio.md"), machine_(machine), lines_(check_, chip, map_.chips) {
        for (int k = 0; k < machine.settings.axes; ++k) {
            axis_names_.push_back(machine.axis_name[static_cast<std::size_t>(k)]);
        }
    }

    PinMap map(const toml::table& root) {
        check_.require_known(root, map_table);
        if (const toml::node* consumer = root.get("consumer")) {
            map_.consumer = check_.text(*consumer, "consumer");
            if (const double longest = map_table.row("consumer").high;
                static_cast<double>(map_.consumer.size()) > longest) {
                check_.fail(*consumer, "consumer must have at most {} letters", longest);
            }
        }
        axes(root);
        if (const toml::table* const table = check_.part(root, enable_table, "enable")) {
            enable(*table);
        }
        if (const toml::table* const table = check_.part(root, brake_table, "brake")) {
            brake(*table);
        }
        for (const toml::table* table : check_.tables(root, "input")) {
            input(*table);
        }
        if (const toml::node* node = root.get("home")) {
            for (const auto& [k, value] : by_axis(check_.table(*node, "home"), "home")) {
                home(*value, k);
            }
        }
        if (const toml::table* const table = check_.part(root, thread_table, "thread")) {
            thread(*table);
        }
        return map_;
    }

private:
    // Which axis of the machine it is.
    [[nodiscard]] std::size_t axis_named(const toml::node& node, std::string_view name, std::string_view where) const {
        const auto found = std::ranges::find(axis_names_, axis_name_of(name));
        if (found == axis_names_.end()) {
            check_.fail(node, "{}: the machine has no axis {}; its axes are {}", where, in_quotes(name),
                        listed(axis_names_));
        }
        return static_cast<std::size_t>(found - axis_names_.begin());
    }

    /// The tables [OF.x], by the axes of the machine.
    [[nodiscard]] std::map<std::size_t, const toml::node*> by_axis(const toml::table& tables,
                                                                   std::string_view of) const {
        std::map<std::size_t, const toml::node*> out;
        for (const auto& [key, value] : tables) {
            const std::string where = fmt::format("[{}.{}]", of, key.str());
            if (!out.emplace(axis_named(value, key.str(), where), &value).second) {
                check_.fail(value, "{} is there with a small and with a capital letter; give one", where);
            }
        }
        return out;
    }

    void axes(const toml::table& root) {
        const toml::node* const node = root.get("axis");
        if (node != nullptr && node->is_array_of_tables()) {
            check_.fail(*node, "[[axis]] is of a machine file; here it is [axis.x], with the axis in its name");
        }
        static const toml::table none;
        const auto axes = by_axis(node != nullptr ? check_.table(*node, "axis") : none, "axis");
        for (std::size_t k = 0; k < axis_names_.size(); ++k) { // in the machine's order, and with it the bits
            const auto given = axes.find(k);
            if (given == axes.end()) {
                check_.fail_file("there is no [axis.{}]; each axis of the machine needs one, with its step "
                                 "and direction",
                                 axis_names_[k]);
            }
            axis(check_.table(*given->second, fmt::format("axis.{}", axis_names_[k])), k);
        }
    }

    void axis(const toml::table& table, std::size_t k) {
        constexpr std::array<std::array<std::string_view, 2>, 2> keys{{{"step", "direction"}, {"step2", "direction2"}}};
        const StepMotors& motors = machine_.motors[k];
        const std::string where = fmt::format("[axis.{}]", axis_names_[k]);
        check_.require_known(table, map_axis_table, where);
        for (const std::string_view key : keys[1]) {
            if (const toml::node* second = table.get(key); second != nullptr && motors.count < 2) {
                check_.fail(*second,
                            "{} is of a second motor, and axis {} has one; write motors = 2 in the "
                            "machine file, or leave it out",
                            key, axis_names_[k]);
            }
        }
        AxisPins& lines = map_.axis[k];
        lines.motors = static_cast<unsigned>(motors.count);
        for (std::size_t m = 0; m < lines.motors; ++m) {
            // Idle levels: no pulse, and downwards.
            const auto line = [&](std::string_view key, bool idle) {
                const toml::node& node = check_.required(
                    table, key, where,
                    m == 0 ? GpioMapPins::what : std::string_view("a line, as the machine file says motors = 2"));
                return lines_.output(node, fmt::format("{} of {}", key, where), idle);
            };
            lines.motor[m].step = line(keys[m][0], motors.invert_step);
            lines.motor[m].direction = line(keys[m][1], motors.invert_direction[m]);
        }
    }

    void enable(const toml::table& table) {
        EnablePin enable;
        check_.take(table, enable_table, "active", enable.active_level);
        enable.line = lines_.output(check_.required(table, "line", "[enable]", GpioMapPins::what), "line of [enable]",
                                    !enable.active_level);
        check_.take(table, enable_table, "settle_ms", enable.settle_ms);
        map_.enable = enable;
    }

    void brake(const toml::table& table) {
        BrakePin brake;
        check_.take(table, brake_table, "released", brake.released_level);
        brake.line = lines_.output(check_.required(table, "line", "[brake]", GpioMapPins::what), "line of [brake]",
                                   !brake.released_level);
        check_.take(table, brake_table, "release_ms", brake.release_ms);
        check_.take(table, brake_table, "engage_ms", brake.engage_ms);
        map_.brake = brake;
    }

    void input(const toml::table& table) {
        check_.require_known(table, map_input_table);
        const toml::node& role = check_.required(table, "role", "[[input]]", listed(input_roles));
        const std::size_t kind = check_.choice(role, "role", input_roles);
        MappedInput input;
        input.role = static_cast<InputRole>(kind);
        const bool has_axis = input.role == InputRole::limit || input.role == InputRole::home;
        if (has_axis) {
            const toml::node& axis =
                check_.required(table, "axis", fmt::format("an input of role {}", input_roles[kind]),
                                "the axis whose switch it is, like \"x\"");
            input.axis = static_cast<int>(axis_named(axis, check_.text(axis, "axis"), "axis"));
        } else if (const toml::node* axis = table.get("axis")) {
            check_.fail(*axis, "an input of role {} has no axis; leave axis out", input_roles[kind]);
        }
        const bool alone = input.role == InputRole::home || input.role == InputRole::probe;
        for (const MappedInput& other : map_.inputs) {
            if (alone && other.role == input.role && other.axis == input.axis) {
                check_.fail(role, "this is the second input of role {}{}; give one", input_roles[kind],
                            has_axis ? " of this axis" : "");
            }
        }
        check_.take(table, map_input_table, "active", input.active_level);
        input.debounce_us = input.role == InputRole::e_stop ? 0 : static_cast<std::uint32_t>(default_debounce_us);
        check_.take(table, map_input_table, "debounce_us", input.debounce_us);
        Bias bias = Bias::as_is;
        check_.take(table, map_input_table, "bias", bias);
        input.line = lines_.input(check_.required(table, "line", "[[input]]", GpioMapPins::what),
                                  fmt::format("line of the input {}", input_roles[kind]), bias);
        for (const MappedInput& other : map_.inputs) {
            if (other.line != input.line) {
                continue;
            }
            if (other.active_level != input.active_level) {
                check_.fail(table,
                            "this input shares its line with another one that acts at the other level; give both "
                            "the same `active`");
            }
            if (other.role == input.role && other.axis == input.axis) {
                check_.fail(table, "this input is in the map already; leave it out");
            }
        }
        map_.inputs.push_back(input);
    }

    void home(const toml::node& node, std::size_t k) {
        const std::string where = fmt::format("[home.{}]", axis_names_[k]);
        const toml::table& table = check_.table(node, fmt::format("home.{}", axis_names_[k]));
        check_.require_known(table, home_table, where);
        const bool has_switch = std::ranges::any_of(map_.inputs, [k](const MappedInput& input) {
            return input.role == InputRole::home && input.axis == static_cast<int>(k);
        });
        if (!has_switch) {
            check_.fail(node, "{} has no switch; add [[input]] with role = \"home\" and axis = \"{}\"", where,
                        axis_names_[k]);
        }
        const auto required = [&](std::string_view key, double most = std::numeric_limits<double>::infinity()) {
            const FileKey& row = home_table.row(key);
            const NumberRange range{row.low, std::min(row.high, most), row.unit};
            const toml::node& given = check_.required(
                table, key, where, fmt::format("a number from {} to {} {}", range.low, range.high, range.unit));
            return check_.number(given, key, range);
        };
        HomeSearch home;
        home.towards_high = check_.value<bool>(check_.required(table, "towards", where, "\"low\" or \"high\""),
                                               home_table.row("towards"));
        home.seek_mm_s = required("seek_mm_s", machine_.settings.axis[k].max_velocity_mm_s);
        home.latch_mm_s = required("latch_mm_s", home.seek_mm_s);
        home.pull_off_mm = required("pull_off_mm");
        home.position_mm = required("position_mm");
        map_.home[k] = home;
    }

    void thread(const toml::table& table) {
        check_.take(table, thread_table, "priority", map_.thread.priority);
        check_.take(table, thread_table, "spin_us", map_.thread.spin_us);
        check_.take(table, thread_table, "tolerated_late_us", map_.thread.tolerated_late_us);
        check_.take(table, thread_table, "stall_ms", map_.thread.stall_ms);
        if (const toml::node* cpu = table.get("cpu")) {
            map_.thread.cpu = check_.value<unsigned>(*cpu, thread_table.row("cpu"));
        }
    }

    TomlChecker check_;
    const MachineDescription& machine_;
    std::vector<std::string_view> axis_names_;
    PinMap map_;
    GpioMapPins lines_;
};

} // namespace

PinMap parse_gpio_map(std::string_view text, const std::string& file, const MachineDescription& machine,
                      const std::string& chip) {
    PinMap map = Reader(file, machine, chip).map(parse_toml(text, file));
    map.file = file;
    return map;
}

PinMap read_gpio_map(const std::string& file, const MachineDescription& machine, const std::string& chip) {
    constexpr std::size_t largest = std::size_t{1} << 20;
    return parse_gpio_map(read_text_file(file, largest), file, machine, chip);
}

} // namespace splinefeed::host
