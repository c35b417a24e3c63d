// SPDX-License-Identifier: MIT
#include "host_sim/convert/grbl_settings.hpp"

#include "host_sim/base/toml_text.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/convert/grbl_listing.hpp"

#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// Keys that lines say; of axes behind their name.
constexpr std::string_view said_keys[] = {
    "name", "drives_at_end", "path.max_feed_mm_s", "spindle.max_rpm", "spindle.min_rpm", "step.step_length_us"};
constexpr std::string_view said_of_axes[] = {
    "name",      "kind",   "max_velocity_mm_s", "max_acceleration_mm_s2", "max_jerk_mm_s3", "steps_per_mm",
    "travel_mm", "invert", "invert_step",
};

std::string number_text(double value) {
    std::string text = fmt::format("{:.9f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

class GrblWriter {
public:
    GrblWriter(std::string_view text, const std::string& file)
        : machine_(parse_machine(text, file)), document_(parse_toml(text, file)) {
        find_columns();
    }

    [[nodiscard]] GrblSettings settings() {
        put(0, machine_.step.step_length_us);
        if (machine_.drives_on_at_end) {
            put(1, *machine_.drives_on_at_end ? ControllerSettings::drives_stay_on : 25);
        }
        put(2, mask([this](unsigned k) { return machine_.motors[k].invert_step; }));
        put(3, mask([this](unsigned k) { return machine_.inverted[k]; }));
        put_travel();
        if (machine_.spindle && machine_.spindle->max_rpm > 0.0) {
            put(30, machine_.spindle->max_rpm);
            put(31, machine_.spindle->min_rpm);
        }
        put_axes(100, [](const AxisSettings& axis) { return axis.steps_per_mm; });
        put_axes(110, [](const AxisSettings& axis) { return axis.max_velocity_mm_s * per_minute; });
        put_axes(120, [](const AxisSettings& axis) { return axis.max_acceleration_mm_s2; });
        for (const auto& [column, k] : places_) {
            if (machine_.travel[k]) {
                put(130 + column, machine_.travel[k]->high - machine_.travel[k]->low);
            }
        }
        if (std::ranges::any_of(places_, [this](const Place& at) { return jerk(at.axis) > 0.0; })) {
            put_axes(800, [](const AxisSettings& axis) { return axis.max_jerk_mm_s3; });
        }
        find_left_out();
        return std::move(out_);
    }

private:
    struct Place {
        unsigned column = 0; ///< in grbl_axes
        unsigned axis = 0;
    };

    void put(unsigned number, double value) { out_.lines += fmt::format("${}={}\n", number, number_text(value)); }
    template <class Value>
    void put_axes(unsigned first, Value value) {
        for (const auto& [column, k] : places_) {
            put(first + column, value(machine_.settings.axis[k]));
        }
    }
    [[nodiscard]] double jerk(unsigned axis) const { return machine_.settings.axis[axis].max_jerk_mm_s3; }
    template <class Bit>
    [[nodiscard]] unsigned mask(Bit bit) const {
        unsigned out = 0;
        for (const auto& [column, k] : places_) {
            out |= bit(k) ? 1U << column : 0U;
        }
        return out;
    }

    /// Sorted by columns.
    void find_columns() {
        for (const unsigned k : indices(machine_.settings.axes)) {
            const std::string& name = machine_.axis_name[k];
            const auto column = static_cast<unsigned>(grbl_axes.find(lower_case(name[0])));
            places_.push_back({column, k});
            if (machine_.settings.axis[k].rotary != (column >= first_rotary_of_grbl)) {
                out_.left_out.push_back(fmt::format("axis {}: it is {}, and read back it is not", name,
                                                    column >= first_rotary_of_grbl ? "linear" : "rotary"));
            }
        }
        if (!std::ranges::is_sorted(places_, {}, &Place::column)) {
            out_.left_out.emplace_back("the order of the axes: grbl's is x, y, z, a, b, c");
            std::ranges::sort(places_, {}, &Place::column);
        }
    }

    /// As grblHAL has it: from minus its length to 0; with bit 3 of $22 from 0 on where the axis homes low by $23.
    void put_travel() {
        const unsigned limited = mask([this](unsigned k) { return machine_.travel[k].has_value(); });
        const unsigned from_zero =
            mask([this](unsigned k) { return machine_.travel[k] && machine_.travel[k]->low == 0.0; });
        if (from_zero != 0) {
            put(22, 9);
            put(23, from_zero);
        }
        put(20, limited != 0 ? 1 : 0);
        for (const auto& [column, k] : places_) {
            const std::optional<Travel>& range = machine_.travel[k];
            if (range && range->low != 0.0 && range->high != 0.0) {
                out_.left_out.push_back(fmt::format("travel_mm of axis {}: it neither begins nor ends at 0; $13{} says "
                                                    "that it has {} mm up to 0",
                                                    machine_.axis_name[k], column,
                                                    number_text(range->high - range->low)));
            } else if (!range && limited != 0) {
                out_.left_out.push_back(
                    fmt::format("axis {} has no travel_mm: a controller keeps the $13{} that it has",
                                machine_.axis_name[k], column));
            }
        }
    }

    /// Keys of the file for which grbl has no number.
    void find_left_out() {
        double fastest[2] = {};
        for (const auto& [column, k] : places_) {
            const AxisSettings& axis = machine_.settings.axis[k];
            fastest[axis.rotary ? 1 : 0] = std::max(fastest[axis.rotary ? 1 : 0], axis.max_velocity_mm_s);
        }
        if (machine_.settings.max_feed_mm_s != (fastest[0] > 0.0 ? fastest[0] : fastest[1])) {
            out_.left_out.emplace_back("path.max_feed_mm_s: grbl's is the velocity of the fastest axis");
        }
        std::vector<std::string> keys;
        add_keys(document_, "", keys);
        if (const toml::array* const axes = document_["axis"].as_array()) {
            for (const toml::node& node : *axes) {
                add_axis_keys(*node.as_table(), keys);
            }
        }
        if (!keys.empty()) {
            out_.left_out.push_back(fmt::format("keys for which grbl has no number: {}", fmt::join(keys, ", ")));
        }
    }
    static void add_keys(const toml::table& table, const std::string& before, std::vector<std::string>& out) {
        for (const auto& [name, node] : table) {
            const std::string key = before + std::string(name.str());
            const toml::table* const inner = node.as_table();
            if (inner != nullptr && before.empty()) {
                add_keys(*inner, key + ".", out);
            } else if (key != "axis" && std::ranges::find(said_keys, key) == std::end(said_keys)) {
                out.push_back(key);
            }
        }
    }
    static void add_axis_keys(const toml::table& axis, std::vector<std::string>& out) {
        for (const auto& [name, node] : axis) {
            if (std::ranges::find(said_of_axes, name.str()) == std::end(said_of_axes)) {
                out.push_back(fmt::format("{} of axis {}", name.str(), axis["name"].value_or(std::string())));
            }
        }
    }

    MachineDescription machine_;
    toml::table document_;
    std::vector<Place> places_;
    GrblSettings out_;
};

} // namespace

GrblSettings grbl_settings(std::string_view machine, const std::string& file) {
    return GrblWriter(machine, file).settings();
}

} // namespace splinefeed::host
