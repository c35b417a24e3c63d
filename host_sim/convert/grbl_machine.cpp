// SPDX-License-Identifier: MIT
#include "host_sim/convert/grbl_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/convert/grbl_listing.hpp"

#include "splinefeed/controller/setting_list.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

// Numbers of grbl that are keys of a machine file. Those of an axis are that of x.
constexpr std::int32_t step_length = 0;
constexpr std::int32_t drives_idle = 1;
constexpr std::int32_t inverted_steps = 2;
constexpr std::int32_t inverted_directions = 3;
constexpr std::int32_t soft_limits = 20;
constexpr std::int32_t homing = 22;
constexpr std::int32_t homes_low = 23;
constexpr std::int32_t max_rpm = 30;
constexpr std::int32_t min_rpm = 31;
constexpr std::int32_t velocity = 110;
constexpr std::int32_t travel = 130;
constexpr std::int32_t max_jerk = 800; // of splinefeed and of grblHAL
constexpr std::int32_t taken_over[] = {step_length, drives_idle, inverted_steps, inverted_directions,
                                       soft_limits, max_rpm,     min_rpm};
constexpr std::int32_t of_axes[] = {100, velocity, 120, travel, max_jerk};
constexpr std::int32_t always_on = 255;
constexpr unsigned home_is_zero = 3; // a bit of `homing`, in grblHAL alone
constexpr double most_travel_mm = 1048576.0;

/// Numbers that are no key: what is said of them. With a factor: they are that times what the key would be.
struct LeftOut {
    std::int32_t number;
    double factor;
    std::string_view text;
};
constexpr LeftOut not_taken_over[] = {
    {10, 0.0, "senders set what a status has"},
    {11, 0.0, "corners are rounded within default_tolerance_mm of [path], or within the P of G64"},
    {12, 0.0, "arcs stay arcs"},
    {13, 0.0, "senders set inches"},
    {24, per_minute, ""},
    {25, per_minute, ""},
    {26, 0.001, ""},
    {27, 1.0, ""},
    {32, 0.0, "there is no laser mode"},
};

class GrblReader {
public:
    GrblReader(std::string_view listing, const std::string& file) : file_(file), listing_(listing, file) {}

    [[nodiscard]] MachineSketch sketch() const {
        MachineSketch out;
        for (std::size_t column = 0; column < grbl_axes.size(); ++column) {
            if (has_axis(column)) {
                out.axes.push_back(axis(column));
            }
        }
        if (out.axes.empty()) {
            throw InputError(
                file_, 0,
                "there is no number of an axis, like $110=8000.000; save all that the controller answers to $$");
        }
        out.made_of = "an answer to $$";
        out.name = name_of_source(file_);
        if (const SourceValue* const idle = find(drives_idle)) {
            out.head.push_back(row("drives_at_end", listing_.whole(*idle) == always_on ? "\"on\"" : "\"off\"", *idle));
        }
        out.limit_path_by_axes();
        add_step(out);
        add_spindle(out);
        add_rest(out);
        return out;
    }

private:
    [[nodiscard]] const SourceValue* find(std::int32_t number) const { return listing_.find(number); }

    [[nodiscard]] bool has_axis(std::size_t column) const {
        return std::ranges::any_of(of_axes, [&](std::int32_t first) { return find(first, column) != nullptr; });
    }

    [[nodiscard]] static SketchRow row(std::string_view key, std::string value, const SourceValue& setting) {
        return {std::string(key), std::move(value), fmt::format("{}={}", setting.name, setting.text)};
    }

    void add_step(MachineSketch& out) const {
        constexpr StepTime key = step_times[0];
        if (const SourceValue* const length = find(step_length)) {
            const double us = listing_.value(*length, key.key, {key.least_us, longest_step_time_us, "us"});
            out.step.push_back(row(key.key, short_number(us), *length));
        }
    }

    void add_spindle(MachineSketch& out) const {
        const SourceValue* const high = find(max_rpm);
        const SourceValue* const low = find(min_rpm);
        const double rpm = high != nullptr ? listing_.value(*high, "max_rpm", {0.0, 1e6, "1/min"}) : 0.0;
        if (rpm == 0.0) {
            return;
        }
        out.spindle.push_back(row("max_rpm", short_number(rpm), *high));
        if (low != nullptr) {
            out.spindle.push_back(
                row("min_rpm", short_number(listing_.value(*low, "min_rpm", {0.0, rpm, "1/min"})), *low));
        }
    }

    /// Of one of `of_axes`; null: it is not there.
    [[nodiscard]] const SourceValue* find(std::int32_t first, std::size_t column) const {
        return find(first + static_cast<std::int32_t>(column));
    }

    /// What the key has that machine files name as `$$` does. @pre  it is one of axis_numbers
    [[nodiscard]] double axis_number(std::int32_t first, std::size_t column) const {
        const std::string_view key = SettingList::key_of(first);
        const SourceValue* const setting = find(first, column);
        if (setting == nullptr) {
            throw InputError(file_, 0, "there is no ${}, {} of axis {}; save all that the controller answers to $$",
                             first + static_cast<std::int32_t>(column), key, grbl_axes[column]);
        }
        return listing_.value(*setting, key, axis_range(key), first == velocity ? per_minute : 1.0);
    }

    [[nodiscard]] bool has_bit(std::int32_t mask, std::size_t bit) const {
        const SourceValue* const bits = find(mask);
        return bits != nullptr && (listing_.whole(*bits) >> bit & 1) != 0;
    }

    [[nodiscard]] SketchAxis axis(std::size_t column) const {
        SketchAxis out;
        out.name = grbl_axes[column];
        out.rotary = column >= first_rotary_of_grbl;
        for (const std::int32_t first : of_axes) {
            const SourceValue* const setting = find(first, column);
            const bool is_limit = first != max_jerk || (setting != nullptr && source_number(file_, *setting) != 0.0);
            if (first != travel && is_limit) {
                const double number = axis_number(first, column);
                out.rows.push_back(row(SettingList::key_of(first), short_number(number), *setting));
            }
        }
        add_range(column, out);
        for (const auto& [mask, key] : {std::pair{inverted_steps, "invert_step"}, {inverted_directions, "invert"}}) {
            if (has_bit(mask, column)) {
                out.rows.push_back(row(key, "true", *find(mask)));
            }
        }
        return out;
    }

    /// The space of a machine ends at 0, where the home switch is; with grblHAL it may begin there.
    void add_range(std::size_t column, SketchAxis& out) const {
        const SourceValue* const length = find(travel, column);
        const double mm = length != nullptr ? listing_.value(*length, "travel_mm", {0.0, most_travel_mm, "mm"}) : 0.0;
        if (mm == 0.0) {
            return;
        }
        const bool from_zero = has_bit(homing, home_is_zero) && has_bit(homes_low, column);
        const std::string size = short_number(mm);
        const bool is_off = find(soft_limits) != nullptr && !has_bit(soft_limits, 0);
        out.rows.push_back(row(is_off ? "# without soft limits, $20=0: travel_mm" : "travel_mm",
                               from_zero ? "[0, " + size + "]" : "[-" + size + ", 0]", *length));
    }

    [[nodiscard]] static bool is_written(std::int32_t number) {
        const auto of_axis = [number](std::int32_t first) {
            return number >= first && number < first + static_cast<std::int32_t>(grbl_axes.size());
        };
        return std::ranges::find(taken_over, number) != std::end(taken_over) || std::ranges::any_of(of_axes, of_axis);
    }

    /// What a machine file does not say.
    void add_rest(MachineSketch& out) const {
        for (const auto& [number, setting] : listing_.settings()) {
            if (!is_written(number)) {
                out.rest.emplace_back(fmt::format("{}={}", setting.name, setting.text), meaning(number, setting));
            }
        }
    }

    [[nodiscard]] std::string meaning(std::int32_t number, const SourceValue& setting) const {
        const std::string_view key = SettingList::key_of(number);
        const auto* const known =
            std::ranges::find_if(not_taken_over, [&](const LeftOut& row) { return row.number == number; });
        if (known == std::end(not_taken_over)) {
            return key.empty() ? "not known here" : std::string(key);
        }
        if (known->factor == 0.0) {
            return std::string(known->text);
        }
        const std::size_t word = std::min(key.find(' '), key.size());
        const double here = listing_.value(setting, key.substr(0, word), {0.0, 1e9, ""}, known->factor);
        return fmt::format("{} = {}{}", key.substr(0, word), short_number(here), key.substr(word));
    }

    const std::string& file_;
    GrblListing listing_;
};

} // namespace

MachineSketch grbl_sketch(std::string_view listing, const std::string& file) {
    return GrblReader(listing, file).sketch();
}

} // namespace splinefeed::host
