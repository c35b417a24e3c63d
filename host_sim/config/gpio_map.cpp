// SPDX-License-Identifier: MIT
#include "host_sim/config/gpio_map.hpp"

#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/base/toml_text.hpp"
#include "host_sim/config/gpio_map_lines.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

using namespace hal::gpio;

namespace {

constexpr std::array<std::string_view, 2> level_names{"low", "high"};
constexpr std::array<std::string_view, 4> bias_names{"as-is", "disabled", "pull-up", "pull-down"};
constexpr std::array<std::string_view, 5> input_roles{"e-stop", "limit", "home", "drive-fault", "probe"};
constexpr std::int64_t default_debounce_us = 1000;
constexpr double least_speed_mm_s = 0.001;

class Reader {
public:
    Reader(const std::string& file, const MachineDescription& machine, const std::string& chip)
        : check_(file, "docs/reference/gpio.md"), machine_(machine), lines_(check_, chip, map_.chips) {
        for (int k = 0; k < machine.settings.axes; ++k) {
            axis_names_.push_back(machine.axis_name[static_cast<std::size_t>(k)]);
        }
    }

    LineMap map(const toml::table& root) {
        check_.require_known(root, {"consumer", "axis", "enable", "brake", "input", "home", "thread"}, "the map");
        if (const toml::node* consumer = root.get("consumer")) {
            constexpr std::size_t longest = 31; // the kernel has 32 bytes, with a zero
            map_.consumer = check_.text(*consumer, "consumer");
            if (map_.consumer.size() > longest) {
                check_.fail(*consumer, fmt::format("consumer must have at most {} letters", longest));
            }
        }
        axes(root);
        if (const toml::node* node = root.get("enable")) {
            enable(check_.table(*node, "enable"));
        }
        if (const toml::node* node = root.get("brake")) {
            brake(check_.table(*node, "brake"));
        }
        for (const toml::table* table : check_.tables(root, "input")) {
            input(*table);
        }
        if (const toml::node* node = root.get("home")) {
            for (const auto& [key, value] : check_.table(*node, "home")) {
                home(value, axis_named(value, key.str(), fmt::format("[home.{}]", key.str())));
            }
        }
        if (const toml::node* node = root.get("thread")) {
            thread(check_.table(*node, "thread"));
        }
        return map_;
    }

private:
    // Which axis of the machine it is.
    [[nodiscard]] std::size_t axis_named(const toml::node& node, std::string_view name, std::string_view where) const {
        const auto found = std::find(axis_names_.begin(), axis_names_.end(), name);
        if (found == axis_names_.end()) {
            check_.fail(node, fmt::format("{}: the machine has no axis {}; its axes are {}", where, in_quotes(name),
                                          listed(axis_names_)));
        }
        return static_cast<std::size_t>(found - axis_names_.begin());
    }

    [[nodiscard]] bool level(const toml::table& table, std::string_view key, bool otherwise) const {
        const toml::node* const node = table.get(key);
        return node != nullptr ? check_.choice(*node, key, level_names) == 1 : otherwise;
    }

    void axes(const toml::table& root) {
        const toml::node* const node = root.get("axis");
        if (node != nullptr && node->is_array_of_tables()) {
            check_.fail(*node, "[[axis]] is of a machine file; here it is [axis.x], with the axis in its name");
        }
        static const toml::table none;
        const toml::table& axes = node != nullptr ? check_.table(*node, "axis") : none;
        for (const auto& [key, value] : axes) {
            static_cast<void>(axis_named(value, key.str(), fmt::format("[axis.{}]", key.str())));
        }
        for (std::size_t k = 0; k < axis_names_.size(); ++k) { // in the machine's order, and with it the bits
            const toml::node* const given = axes.get(axis_names_[k]);
            if (given == nullptr) {
                check_.fail_file(fmt::format("there is no [axis.{}]; each axis of the machine needs one, with its step "
                                             "and direction",
                                             axis_names_[k]));
            }
            axis(check_.table(*given, fmt::format("axis.{}", axis_names_[k])), k);
        }
    }

    void axis(const toml::table& table, std::size_t k) {
        constexpr std::array<std::array<std::string_view, 2>, 2> keys{{{"step", "direction"}, {"step2", "direction2"}}};
        const StepMotors& motors = machine_.motors[k];
        const std::string where = fmt::format("[axis.{}]", axis_names_[k]);
        check_.require_known(table, {"step", "direction", "step2", "direction2"}, where);
        for (const std::string_view key : keys[1]) {
            if (const toml::node* second = table.get(key); second != nullptr && motors.count < 2) {
                check_.fail(*second,
                            fmt::format("{} is of a second motor, and axis {} has one; write motors = 2 in the "
                                        "machine file, or leave it out",
                                        key, axis_names_[k]));
            }
        }
        AxisLines& lines = map_.axis[k];
        lines.motors = static_cast<unsigned>(motors.count);
        for (std::size_t m = 0; m < lines.motors; ++m) {
            // Idle levels: no pulse, and downwards.
            const auto line = [&](std::string_view key, bool idle) {
                const toml::node& node = check_.required(
                    table, key, where,
                    m == 0 ? GpioMapLines::what : std::string_view("a line, as the machine file says motors = 2"));
                return lines_.output(node, fmt::format("{} of {}", key, where), idle);
            };
            lines.motor[m].step = line(keys[m][0], motors.invert_step);
            lines.motor[m].direction = line(keys[m][1], motors.invert_direction[m]);
        }
    }

    void enable(const toml::table& table) {
        check_.require_known(table, {"line", "active", "settle_ms"}, "[enable]");
        EnableLine enable;
        enable.active_level = level(table, "active", true);
        enable.line = lines_.output(check_.required(table, "line", "[enable]", GpioMapLines::what), "line of [enable]",
                                    !enable.active_level);
        check_.take(table, "settle_ms", {0, 60000}, enable.settle_ms);
        map_.enable = enable;
    }

    void brake(const toml::table& table) {
        check_.require_known(table, {"line", "released", "release_ms", "engage_ms"}, "[brake]");
        BrakeLine brake;
        brake.released_level = level(table, "released", true);
        brake.line = lines_.output(check_.required(table, "line", "[brake]", GpioMapLines::what), "line of [brake]",
                                   !brake.released_level);
        check_.take(table, "release_ms", {0, 5000}, brake.release_ms);
        check_.take(table, "engage_ms", {0, 5000}, brake.engage_ms);
        map_.brake = brake;
    }

    void input(const toml::table& table) {
        check_.require_known(table, {"role", "axis", "line", "active", "bias", "debounce_us"}, "[[input]]");
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
            check_.fail(*axis, fmt::format("an input of role {} has no axis; leave axis out", input_roles[kind]));
        }
        const bool alone = input.role == InputRole::home || input.role == InputRole::probe;
        for (const MappedInput& other : map_.inputs) {
            if (alone && other.role == input.role && other.axis == input.axis) {
                check_.fail(role, fmt::format("this is the second input of role {}{}; give one", input_roles[kind],
                                              has_axis ? " of this axis" : ""));
            }
        }
        input.active_level = level(table, "active", true);
        input.debounce_us = input.role == InputRole::e_stop ? 0 : static_cast<std::uint32_t>(default_debounce_us);
        check_.take(table, "debounce_us", {0, 100000}, input.debounce_us);
        const toml::node* const bias = table.get("bias");
        input.line =
            lines_.input(check_.required(table, "line", "[[input]]", GpioMapLines::what),
                         fmt::format("line of the input {}", input_roles[kind]),
                         bias != nullptr ? static_cast<Bias>(check_.choice(*bias, "bias", bias_names)) : Bias::as_is);
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
        check_.require_known(table, {"towards", "seek_mm_s", "latch_mm_s", "pull_off_mm", "position_mm"}, where);
        const bool has_switch = std::any_of(map_.inputs.begin(), map_.inputs.end(), [k](const MappedInput& input) {
            return input.role == InputRole::home && input.axis == static_cast<int>(k);
        });
        if (!has_switch) {
            check_.fail(node, fmt::format("{} has no switch; add [[input]] with role = \"home\" and axis = \"{}\"",
                                          where, axis_names_[k]));
        }
        const auto required = [&](std::string_view key, const NumberRange& range) {
            const toml::node& given = check_.required(
                table, key, where, fmt::format("a number from {} to {} {}", range.low, range.high, range.unit));
            return check_.number(given, key, range);
        };
        constexpr double farthest_mm = 1048576.0;
        constexpr double most_pull_off_mm = 1000.0;
        HomeSearch home;
        home.towards_high =
            check_.choice(check_.required(table, "towards", where, "\"low\" or \"high\""), "towards", level_names) == 1;
        home.seek_mm_s = required("seek_mm_s", {least_speed_mm_s, machine_.settings.axis[k].max_velocity_mm_s, "mm/s"});
        home.latch_mm_s = required("latch_mm_s", {least_speed_mm_s, home.seek_mm_s, "mm/s"});
        home.pull_off_mm = required("pull_off_mm", {least_speed_mm_s, most_pull_off_mm, "mm"});
        home.position_mm = required("position_mm", {-farthest_mm, farthest_mm, "mm"});
        map_.home[k] = home;
    }

    void thread(const toml::table& table) {
        check_.require_known(table, {"priority", "cpu", "spin_us", "tolerated_late_us", "stall_ms"}, "[thread]");
        constexpr std::int64_t most_cpu = 1023; // of cpu_set_t
        check_.take(table, "priority", {1, 98}, map_.thread.priority);
        check_.take(table, "spin_us", {0, 1000}, map_.thread.spin_us);
        check_.take(table, "tolerated_late_us", {0, 10000}, map_.thread.tolerated_late_us);
        check_.take(table, "stall_ms", {1, 10000}, map_.thread.stall_ms);
        if (const toml::node* cpu = table.get("cpu")) {
            map_.thread.cpu = static_cast<unsigned>(check_.whole(*cpu, "cpu", {0, most_cpu}));
        }
    }

    TomlChecker check_;
    const MachineDescription& machine_;
    std::vector<std::string_view> axis_names_;
    LineMap map_;
    GpioMapLines lines_;
};

} // namespace

LineMap parse_gpio_map(std::string_view text, const std::string& file, const MachineDescription& machine,
                       const std::string& chip) {
    return Reader(file, machine, chip).map(parse_toml(text, file));
}

LineMap read_gpio_map(const std::string& file, const MachineDescription& machine, const std::string& chip) {
    constexpr std::size_t largest = std::size_t{1} << 20;
    return parse_gpio_map(read_text_file(file, largest), file, machine, chip);
}

} // namespace splinefeed::host
