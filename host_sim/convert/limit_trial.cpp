// SPDX-License-Identifier: MIT
#include "host_sim/convert/limit_trial.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"

#include "splinefeed/number/vector.hpp"
#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// How a controller takes an acceleration [mm/s^2]: {0} is the axis, {1} the acceleration, {2} its number from 0.
struct TrialController {
    std::string_view name;
    std::string_view setting;
    bool in_program;        ///< else somebody types it before each round
    std::string_view place; ///< before each move, where its coordinates are those of the machine
    std::string_view comment_begin;
    std::string_view comment_end;
    double dwell_unit; ///< of P in G4, of a second
};
constexpr TrialController trial_table[] = {
    {"grbl", "$12{2}={1}", false, "G53 ", "(", ")", 1.0},
    {"linuxcnc", "halcmd setp ini.{0}.max_acceleration {1}", false, "G53 ", "(", ")", 1.0},
    {"klipper", "SET_VELOCITY_LIMIT ACCEL={1}", true, "", "; ", "", 1000.0},
    {"marlin", "M201 {0}{1}\nM204 P{1} T{1}", true, "", "; ", "", 1000.0},
};

/// Of the acceleration that the machine file has.
constexpr double trial_factors[] = {0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0};
constexpr double free_share = 0.1;     // of the travel at each end, where nothing moves
constexpr double return_share = 0.125; // of the velocity, on the way to the place that is compared
constexpr int trial_strokes = 10;
constexpr int rest_s = 3; // to look at the place

class TrialWriter {
public:
    TrialWriter(const MachineDescription& machine, unsigned axis, const TrialController& controller)
        : of_(controller), settings_(machine.settings.axis[axis]), name_(machine.axis_name[axis]),
          letter_(upper_case(name_.front())) {
        const Travel& space = *machine.travel[axis];
        const double margin = free_share * (space.high - space.low);
        low_ = space.low + margin;
        length_ = space.high - margin - low_;
    }

    [[nodiscard]] std::string text() const {
        std::string out = head();
        if (!of_.in_program) {
            return out + round(trial_factors[0]) + "M30\n";
        }
        for (const double factor : trial_factors) {
            out += comment(fmt::format("acceleration {} mm/s2", acceleration(factor)));
            out += setting(acceleration(factor)) + "\n" + round(factor);
        }
        return out + comment("the acceleration of the machine file again") + setting(acceleration(1.0)) + "\n";
    }

private:
    [[nodiscard]] double acceleration(double factor) const {
        return std::round(settings_.max_acceleration_mm_s2 * factor);
    }

    [[nodiscard]] std::string setting(double acceleration) const {
        const bool is_hal = of_.name == "linuxcnc"; // its pins have small letters
        return fmt::format(fmt::runtime(of_.setting), is_hal ? name_ : std::string(1, letter_), acceleration,
                           std::string_view("xyzabc").find(name_));
    }

    [[nodiscard]] std::string comment(std::string_view text) const {
        return fmt::format("{}{}{}\n", of_.comment_begin, text, of_.comment_end);
    }

    [[nodiscard]] std::string head() const {
        std::string out =
            comment(fmt::format("accelerations of {}, between {} and {} mm, up to {} mm/s", letter_, short_number(low_),
                                short_number(low_ + length_), short_number(settings_.max_velocity_mm_s)));
        out += comment("home the machine first; nothing may stand in the way; a hand lies on the emergency stop");
        if (of_.in_program) {
            out += comment("work zero must be machine zero");
        } else {
            out += comment("set one of these, run this program, look where it stands, set the next one:");
            for (const double factor : trial_factors) {
                out += comment(setting(acceleration(factor)));
            }
        }
        return out + "G21\nG90\n";
    }

    [[nodiscard]] std::string move(double to_mm, double speed_mm_s) const {
        return fmt::format("{}G1 {}{} F{}\n", of_.place, letter_, short_number(std::round(to_mm * 1000.0) / 1000.0),
                           std::max(1.0, std::round(speed_mm_s * 60.0)));
    }

    [[nodiscard]] std::string strokes(double length) const {
        const double middle = low_ + 0.5 * length_;
        std::string out;
        for (int stroke = 0; stroke < trial_strokes; ++stroke) {
            out += move(middle + 0.5 * length, settings_.max_velocity_mm_s);
            out += move(middle - 0.5 * length, settings_.max_velocity_mm_s);
        }
        return out;
    }

    /// Long strokes reach the velocity and hold it for 0.1 s; short ones reach the half of it.
    [[nodiscard]] std::string round(double factor) const {
        const double v = settings_.max_velocity_mm_s;
        const double braking = v * v / acceleration(factor); // way to the velocity and back to rest
        const double slow = return_share * v;
        return move(low_, slow) + strokes(std::min(length_, braking + 0.1 * v)) +
               strokes(std::min(length_, 0.25 * braking)) + move(low_, slow) +
               fmt::format("G4 P{}\n", rest_s * of_.dwell_unit);
    }

    const TrialController& of_;
    const AxisSettings& settings_;
    std::string name_;
    char letter_;
    double low_ = 0.0;
    double length_ = 0.0;
};

} // namespace

std::string trial_controllers() {
    std::string out;
    for (const TrialController& controller : trial_table) {
        out += fmt::format("{}{}", out.empty() ? "" : ", ", controller.name);
    }
    return out;
}

std::string limit_trial(const MachineDescription& machine, const std::string& axis, const std::string& controller) {
    const auto* const of = std::ranges::find(trial_table, controller, &TrialController::name);
    if (of == std::end(trial_table)) {
        throw UsageError("--for {}: it must be one of {}", in_quotes(controller), trial_controllers());
    }
    for (const unsigned k : indices(machine.settings.axes)) {
        if (machine.axis_name[k] != axis) {
            continue;
        }
        if (!machine.travel[k]) {
            throw UsageError("--try {}: the axis has no travel_mm; add it, so that the program stays within", axis);
        }
        return TrialWriter(machine, k, *of).text();
    }
    throw UsageError("--try {}: the axes of the machine are {}", in_quotes(axis),
                     fmt::join(machine.axis_name.begin(), machine.axis_name.begin() + machine.settings.axes, ", "));
}

} // namespace splinefeed::host
