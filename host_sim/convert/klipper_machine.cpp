// SPDX-License-Identifier: MIT
#include "host_sim/convert/klipper_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/convert/ini_text.hpp"

#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::string_view printer_axes = "xyz";

/// Machines whose limits are those of x, y and z, and the axes whose motors are theirs.
struct PrinterKind {
    std::string_view name;
    std::string_view own_motors;
};
constexpr PrinterKind printer_kinds[] = {
    {"cartesian", "xyz"}, {"corexy", "z"}, {"corexz", "y"}, {"hybrid_corexy", "yz"}, {"hybrid_corexz", "yz"}};

constexpr IniRest printer_rest[] = {
    {"printer", "square_corner_velocity", ""}, // corner_text()
    {"printer", "minimum_cruise_ratio", "no such limit; max_jerk_mm_s3 makes short moves smooth"},
    {"printer", "max_accel_to_decel", "no such limit; max_jerk_mm_s3 makes short moves smooth"},
    {"extruder", "rotation_distance", "the extruder is no axis; --ignore E leaves its words out"},
    {"input_shaper", "shaper_freq_x", "no input shaper; max_jerk_mm_s3 excites a frame less"},
    {"input_shaper", "shaper_freq_y", "no input shaper; max_jerk_mm_s3 excites a frame less"},
};

class PrinterReader {
public:
    PrinterReader(std::string_view text, const std::string& file)
        : file_(file), config_(text, {.colons = true, .continues = true, .last_wins = true}), kind_(kind()) {}

    [[nodiscard]] MachineSketch sketch() const {
        MachineSketch out;
        out.made_of = fmt::format("a printer.cfg of Klipper ({})", kind_.name);
        out.name = name_of_source(file_);
        const SourceValue& feed = needed("printer", "max_velocity");
        out.path.push_back(
            {"max_feed_mm_s", short_number(limit(feed, "max_feed_mm_s", "max_velocity_mm_s")), source_of(feed)});
        for (const char letter : printer_axes) {
            out.axes.push_back(axis(letter));
        }
        add_step(out);
        add_rest(out);
        return out;
    }

private:
    [[nodiscard]] const PrinterKind& kind() const {
        const SourceValue& kinematics = needed("printer", "kinematics");
        const auto* const found =
            std::ranges::find(printer_kinds, std::string_view(kinematics.text), &PrinterKind::name);
        if (found == std::end(printer_kinds)) {
            refuse_value(file_, kinematics,
                         "its limits are not those of x, y and z; a machine file has only such axes");
        }
        return *found;
    }

    [[nodiscard]] const SourceValue& needed(std::string_view section, std::string_view key) const {
        const SourceValue* const value = config_.find(section, key);
        if (value == nullptr) {
            const bool includes = std::ranges::any_of(
                config_.sections(), [](const auto& each) { return each.first.starts_with("include "); });
            throw InputError(file_, 0, "there is no {} in [{}]; {}", key, section,
                             includes ? "put the files that it includes into it" : "add it");
        }
        return *value;
    }

    [[nodiscard]] double limit(const SourceValue& value, std::string_view key, std::string_view like) const {
        return in_range(file_, value, source_number(file_, value), key, axis_range(like));
    }

    [[nodiscard]] SketchAxis axis(char letter) const {
        SketchAxis out{std::string(1, letter), false, {}};
        for (const auto& [key, of_all, of_z] : {std::tuple{"max_velocity_mm_s", "max_velocity", "max_z_velocity"},
                                                {"max_acceleration_mm_s2", "max_accel", "max_z_accel"}}) {
            const SourceValue* const own = letter == 'z' ? config_.find("printer", of_z) : nullptr;
            const SourceValue& value = own != nullptr ? *own : needed("printer", of_all);
            out.rows.push_back({key, short_number(limit(value, key, key)), source_of(value)});
        }
        const std::string section = fmt::format("stepper_{}", letter);
        if (kind_.own_motors.find(letter) != std::string_view::npos) {
            add_motor(section, out);
        } else {
            out.rows.push_back(
                {"# steps_per_mm", "-", fmt::format("no motor of {} moves {} alone", kind_.name, letter)});
        }
        add_range(section, out);
        return out;
    }

    /// Steps a rotation of the motor times its gears, over what the axis travels then.
    void add_motor(const std::string& section, SketchAxis& out) const {
        if (const SourceValue* const old = config_.find(section, "step_distance")) {
            const double steps =
                in_range(file_, *old, 1.0 / source_number(file_, *old), "steps_per_mm", axis_range("steps_per_mm"));
            out.rows.push_back({"steps_per_mm", short_number(steps), source_of(*old)});
        } else {
            const SourceValue& distance = needed(section, "rotation_distance");
            const SourceValue& microsteps = needed(section, "microsteps");
            const SourceValue* const full = config_.find(section, "full_steps_per_rotation");
            const SourceValue* const gears = config_.find(section, "gear_ratio");
            const double rotation = (full != nullptr ? source_number(file_, *full) : 200.0) *
                                    source_number(file_, microsteps) * (gears != nullptr ? ratio_of(*gears) : 1.0);
            const double steps = in_range(file_, distance, rotation / source_number(file_, distance), "steps_per_mm",
                                          axis_range("steps_per_mm"));
            out.rows.push_back(
                {"steps_per_mm", short_number(steps),
                 fmt::format("lines {} and {}: [{}] rotation_distance = {}, microsteps = {}{}", distance.line,
                             microsteps.line, section, distance.text, microsteps.text,
                             gears != nullptr ? fmt::format(", line {}: gear_ratio = {}", gears->line, gears->text)
                                              : "")});
        }
        for (const auto& [key, ours] : {std::pair{"step_pin", "invert_step"}, {"dir_pin", "invert_direction"}}) {
            const SourceValue* const pin = config_.find(section, key);
            if (pin != nullptr && pin->text.find('!') != std::string::npos) {
                out.rows.push_back({ours, "true", source_of(*pin)});
            }
        }
        if (config_.has(section + "1")) {
            const bool more = config_.has(section + "2");
            out.rows.push_back({more ? "# motors" : "motors", more ? "3" : "2",
                                more ? "a machine file has 1 or 2" : fmt::format("[{}1]", section)});
        }
    }

    /// "57:11, 2:1": of all gearboxes together.
    [[nodiscard]] double ratio_of(const SourceValue& gears) const {
        double out = 1.0;
        for (const std::string_view gear : split(gears.text, ',')) {
            const std::vector<std::string_view> teeth = split(gear, ':');
            double driven = 0.0;
            double driving = 0.0;
            if (teeth.size() != 2 || read_number(trimmed(teeth[0]), driven) != NumberText::number ||
                read_number(trimmed(teeth[1]), driving) != NumberText::number || !(driven > 0.0 && driving > 0.0)) {
                refuse_value(file_, gears, "it must be ratios like 57:11, 2:1");
            }
            out *= driven / driving;
        }
        return out;
    }

    void add_range(const std::string& section, SketchAxis& out) const {
        const SourceValue* const low = config_.find(section, "position_min");
        const SourceValue& high = needed(section, "position_max");
        const double from = low != nullptr ? source_number(file_, *low) : 0.0;
        const double to = source_number(file_, high);
        if (!(from < to)) {
            refuse_value(file_, high, fmt::format("it must be above position_min, {}", short_number(from)));
        }
        out.rows.push_back({"travel_mm", fmt::format("[{}, {}]", short_number(from), short_number(to)),
                            low != nullptr ? fmt::format("lines {} and {}: [{}] position_min = {}, position_max = {}",
                                                         low->line, high.line, section, low->text, high.text)
                                           : source_of(high) + ", without position_min"});
    }

    void add_step(MachineSketch& out) const {
        const SourceValue* const pulse = config_.find("stepper_x", "step_pulse_duration");
        if (pulse != nullptr) {
            const double us = in_range(file_, *pulse, source_number(file_, *pulse) * 1e6, step_times[0].key,
                                       {step_times[0].least_us, longest_step_time_us, "us"});
            out.step.push_back({step_times[0].key, short_number(us), source_of(*pulse)});
        }
    }

    void add_rest(MachineSketch& out) const {
        add_includes(config_, out);
        for (const IniRest& rest : printer_rest) {
            if (const SourceValue* const value = config_.find(rest.section, rest.key)) {
                out.rest.emplace_back(source_of(*value), rest.text.empty() ? corner_text(*value) : rest.text);
            }
        }
    }

    /// A corner of 90 degrees that is passed at that speed lies so far from its point, at the largest acceleration.
    [[nodiscard]] std::string corner_text(const SourceValue& value) const {
        const double mm_s = source_number(file_, value);
        const double mm = mm_s * mm_s * (std::sqrt(2.0) - 1.0) / source_number(file_, needed("printer", "max_accel"));
        return fmt::format("corners are rounded within default_tolerance_mm of [path]; {:.4f} is like that", mm);
    }

    const std::string& file_;
    IniText config_;
    const PrinterKind& kind_;
};

} // namespace

MachineSketch klipper_sketch(std::string_view text, const std::string& file) {
    return PrinterReader(text, file).sketch();
}

} // namespace splinefeed::host
