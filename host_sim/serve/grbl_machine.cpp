// SPDX-License-Identifier: MIT
#include "host_sim/serve/grbl_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/serve/grbl_listing.hpp"

#include "splinefeed/controller/setting_list.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::string_view columns = "xyzabc";
constexpr std::size_t first_rotary = 3;

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
constexpr std::int32_t taken_over[] = {step_length, drives_idle, inverted_steps, inverted_directions,
                                       soft_limits, max_rpm,     min_rpm};
constexpr std::int32_t of_axes[] = {100, velocity, 120, travel};
constexpr std::int32_t always_on = 255;
constexpr unsigned home_is_zero = 3; // a bit of `homing`, in grblHAL alone
constexpr double per_minute = 60.0;
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

class MachineText {
public:
    MachineText(std::string_view listing, const std::string& file) : file_(file), listing_(listing, file) {}

    [[nodiscard]] GrblMachine machine() const {
        std::string axes;
        double most = 0.0; // feed [mm/s]: that of an axis in mm, if there is one
        for (std::size_t column = 0; column < columns.size(); ++column) {
            if (has_axis(column)) {
                axes += axis(column);
                most = column < first_rotary || most == 0.0 ? std::max(most, axis_number(velocity, column)) : most;
            }
        }
        if (axes.empty()) {
            throw InputError(
                file_, 0,
                "there is no number of an axis, like $110=8000.000; save all that the controller answers to $$");
        }
        GrblMachine out;
        out.text = fmt::format("# Made of an answer to $$ by splinefeed machine --from-grbl.\nname = \"{}\"\n"
                               "sample_period_us = 1000\n",
                               name());
        if (const GrblSetting* const idle = find(drives_idle)) {
            out.text += row("drives_at_end", listing_.whole(*idle) == always_on ? "\"on\"" : "\"off\"", *idle);
        }
        out.text += fmt::format("\n[path]\nmax_feed_mm_s = {}\n", short_number(most));
        out.text += step() + spindle() + axes;
        out.text += rest(out.left_out);
        return out;
    }

private:
    [[nodiscard]] const GrblSetting* find(std::int32_t number) const { return listing_.find(number); }

    [[nodiscard]] bool has_axis(std::size_t column) const {
        return std::ranges::any_of(of_axes, [&](std::int32_t first) { return find(first, column) != nullptr; });
    }

    [[nodiscard]] static std::string row(std::string_view key, std::string_view value, const GrblSetting& setting) {
        return fmt::format("{:<36} # ${}={}\n", fmt::format("{} = {}", key, value), setting.number,
                           printable(setting.value));
    }

    [[nodiscard]] std::string name() const {
        std::string stem = file_ == "-" ? "machine" : printable(std::filesystem::path(file_).stem().string());
        std::ranges::replace_if(
            stem, [](char c) { return c == '"' || c == '\\'; }, '_');
        return stem;
    }

    [[nodiscard]] std::string step() const {
        constexpr StepTime key = step_times[0];
        const GrblSetting* const length = find(step_length);
        if (length == nullptr) {
            return "";
        }
        const double us = listing_.value(*length, key.key, {key.least_us, longest_step_time_us, "us"});
        return "\n[step]\n" + row(key.key, short_number(us), *length);
    }

    [[nodiscard]] std::string spindle() const {
        const GrblSetting* const high = find(max_rpm);
        const GrblSetting* const low = find(min_rpm);
        const double rpm = high != nullptr ? listing_.value(*high, "max_rpm", {0.0, 1e6, "1/min"}) : 0.0;
        if (rpm == 0.0) {
            return "";
        }
        std::string out = "\n[spindle]\n" + row("max_rpm", short_number(rpm), *high);
        if (low != nullptr) {
            out += row("min_rpm", short_number(listing_.value(*low, "min_rpm", {0.0, rpm, "1/min"})), *low);
        }
        return out;
    }

    /// Of one of `of_axes`; null: it is not there.
    [[nodiscard]] const GrblSetting* find(std::int32_t first, std::size_t column) const {
        return find(first + static_cast<std::int32_t>(column));
    }

    /// What the key has that machine files name as `$$` does. @pre  it is one of axis_numbers
    [[nodiscard]] double axis_number(std::int32_t first, std::size_t column) const {
        const std::string_view key = SettingList::key_of(first);
        const auto* const row =
            std::ranges::find_if(axis_numbers, [key](const auto& number) { return number.key == key; });
        const GrblSetting* const setting = find(first, column);
        if (setting == nullptr) {
            throw InputError(file_, 0, "there is no ${}, {} of axis {}; save all that the controller answers to $$",
                             first + static_cast<std::int32_t>(column), key, columns[column]);
        }
        return listing_.value(*setting, key, {row->low, row->high, row->unit}, first == velocity ? per_minute : 1.0);
    }

    [[nodiscard]] bool has_bit(std::int32_t mask, std::size_t bit) const {
        const GrblSetting* const bits = find(mask);
        return bits != nullptr && (listing_.whole(*bits) >> bit & 1) != 0;
    }

    [[nodiscard]] std::string axis(std::size_t column) const {
        std::string out = fmt::format("\n[[axis]]\nname = \"{}\"\n", columns[column]);
        out +=
            column < first_rotary ? "" : fmt::format("{:<36} # degrees where the keys say mm\n", "kind = \"rotary\"");
        for (const std::int32_t first : of_axes) {
            if (first != travel) {
                const double number = axis_number(first, column);
                out += row(SettingList::key_of(first), short_number(number), *find(first, column));
            }
        }
        out += range(column);
        for (const auto& [mask, key] : {std::pair{inverted_steps, "invert_step"}, {inverted_directions, "invert"}}) {
            out += has_bit(mask, column) ? row(key, "true", *find(mask)) : "";
        }
        return out;
    }

    /// The space of a machine ends at 0, where the home switch is; with grblHAL it may begin there.
    [[nodiscard]] std::string range(std::size_t column) const {
        const GrblSetting* const length = find(travel, column);
        const double mm = length != nullptr ? listing_.value(*length, "travel_mm", {0.0, most_travel_mm, "mm"}) : 0.0;
        if (mm == 0.0) {
            return "";
        }
        const bool from_zero = has_bit(homing, home_is_zero) && has_bit(homes_low, column);
        const std::string size = short_number(mm);
        const std::string key = row("travel_mm", from_zero ? "[0, " + size + "]" : "[-" + size + ", 0]", *length);
        const bool is_off = find(soft_limits) != nullptr && !has_bit(soft_limits, 0);
        return is_off ? "# without soft limits, $20=0: " + key : key;
    }

    [[nodiscard]] static bool is_written(std::int32_t number) {
        const auto of_axis = [number](std::int32_t first) {
            return number >= first && number < first + static_cast<std::int32_t>(columns.size());
        };
        return std::ranges::find(taken_over, number) != std::end(taken_over) || std::ranges::any_of(of_axes, of_axis);
    }

    /// What a machine file does not say.
    [[nodiscard]] std::string rest(std::size_t& count) const {
        std::string out;
        for (const auto& [number, setting] : listing_.settings()) {
            if (!is_written(number)) {
                ++count;
                out += fmt::format("# {:<16} {}\n", fmt::format("${}={}", number, printable(setting.value)),
                                   meaning(setting));
            }
        }
        return out.empty()
                   ? ""
                   : "\n# What a machine file does not say. [home.x] and inputs are of the map file of GPIO lines.\n" +
                         out;
    }

    [[nodiscard]] std::string meaning(const GrblSetting& setting) const {
        const std::string_view key = SettingList::key_of(setting.number);
        const auto* const known =
            std::ranges::find_if(not_taken_over, [&](const LeftOut& row) { return row.number == setting.number; });
        if (known == std::end(not_taken_over)) {
            return key.empty() ? "not known here" : std::string(key);
        }
        if (known->factor == 0.0) {
            return std::string(known->text);
        }
        const std::size_t word = std::min(key.find(' '), key.size());
        const double number = listing_.value(setting, key.substr(0, word), {0.0, 1e9, ""}, known->factor);
        return fmt::format("{} = {}{}", key.substr(0, word), short_number(number), key.substr(word));
    }

    const std::string& file_;
    GrblListing listing_;
};

} // namespace

GrblMachine machine_of_grbl(std::string_view listing, const std::string& file) {
    return MachineText(listing, file).machine();
}

} // namespace splinefeed::host
