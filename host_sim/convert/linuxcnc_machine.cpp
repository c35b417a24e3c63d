// SPDX-License-Identifier: MIT
#include "host_sim/convert/linuxcnc_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/base/trimmed_text.hpp"
#include "host_sim/convert/ini_text.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace splinefeed::host {

namespace {

constexpr std::string_view ini_letters = "XYZABCUVW"; // joint k without `coordinates=` is that of letter k
constexpr std::string_view our_letters = "XYZABC";
constexpr double endless = 1e6; // [mm]: LinuxCNC writes 1e99 for no limit

/// Limits of an axis and of its joints: the lowest of them counts.
struct IniLimit {
    std::string_view key;
    std::string_view ours;
};
constexpr IniLimit ini_limits[] = {{"MAX_VELOCITY", "max_velocity_mm_s"},
                                   {"MAX_ACCELERATION", "max_acceleration_mm_s2"},
                                   {"MAX_JERK", "max_jerk_mm_s3"}};
constexpr std::string_view needed_limits[] = {"MAX_VELOCITY", "MAX_ACCELERATION"};
constexpr std::string_view scales[] = {"SCALE", "STEP_SCALE", "INPUT_SCALE", "ENCODER_SCALE"};

/// Times of all joints' step lines [ns]; the longest counts.
constexpr std::string_view joint_step_keys[] = {"STEPLEN", "STEPSPACE", "DIRSETUP", "DIRHOLD"};

// Without a section: of each axis and joint.
constexpr IniRest ini_rest[] = {
    {"TRAJ", "MAX_LINEAR_ACCELERATION", "the axes limit the acceleration; there is no limit along the path"},
    {"", "BACKLASH", "backlash is not compensated"},
    {"", "COMP_FILE", "screws are not compensated"},
    {"", "HOME", "where a program begins behind --home; see [home.x]"},
    {"", "HOME_OFFSET", "[home.x]"},
    {"", "HOME_SEARCH_VEL", "seek_mm_s and towards of [home.x]"},
    {"", "HOME_LATCH_VEL", "latch_mm_s of [home.x]"},
};

class IniReader {
public:
    IniReader(std::string_view text, const std::string& file, MachineAnswers& answers) : file_(file), ini_(text, {}) {
        read_units(answers);
        read_joints();
    }

    [[nodiscard]] MachineSketch sketch() const {
        MachineSketch out;
        const SourceValue* const name = ini_.find("EMC", "MACHINE");
        out.made_of = "an INI file of LinuxCNC";
        out.name = name != nullptr && !name->text.empty() ? plain_name(name->text) : name_of_source(file_);
        if (const SourceValue* const period = ini_.find("EMCMOT", "SERVO_PERIOD")) {
            const double us =
                in_range(file_, *period, number(*period) / 1000.0, "sample_period_us", {50, 100000, "us"});
            out.head.push_back({"sample_period_us", fmt::format("{}", std::lround(us)), source_of(*period)});
        }
        for (const char letter : letters_) {
            out.axes.push_back(axis(letter));
        }
        add_path(out);
        for (std::size_t k = 0; k < std::size(joint_step_keys); ++k) {
            add_step(joint_step_keys[k], step_times[k], out);
        }
        add_spindle(out);
        add_rest(out);
        return out;
    }

private:
    [[nodiscard]] double number(const SourceValue& value) const {
        SourceValue first = value; // LinuxCNC leaves out what stands behind it
        first.text = first.text.substr(0, first.text.find_first_of(" \t"));
        return source_number(file_, first);
    }

    void read_units(MachineAnswers& answers) {
        if (const SourceValue* const unit = ini_.find("TRAJ", "LINEAR_UNITS")) {
            mm_ = linear_unit(*unit);
        } else {
            answers.ask({"units", "In which unit are its lengths, mm or inch?", "mm"}, [&](std::string_view text) {
                mm_ = text == "inch" ? 25.4 : 1.0;
                return text == "inch" || text == "mm" ? "" : "it must be mm or inch";
            });
        }
    }

    [[nodiscard]] double linear_unit(const SourceValue& unit) const {
        const std::string_view text = unit.text;
        if (text == "inch" || text == "in" || text == "imperial" || text == "INCH") {
            return 25.4;
        }
        if (text != "mm" && text != "metric" && text != "MM") {
            refuse_value(file_, unit, "it must be mm or inch");
        }
        return 1.0;
    }

    /// The axes of the machine, and the joints of each.
    void read_joints() {
        const SourceValue* const kinematics = ini_.find("KINS", "KINEMATICS");
        const std::string words = kinematics != nullptr ? kinematics->text : "trivkins";
        const std::string module = words.substr(0, words.find(' '));
        if (module != "trivkins") {
            refuse_value(
                file_, *kinematics,
                "its joints are no axes of the machine; write the limits of its axes by hand, in a machine file");
        }
        const std::size_t at = words.find("coordinates=");
        std::string order(ini_letters);
        if (at != std::string::npos) {
            order = capitals(words.substr(at + 12, words.find(' ', at) - at - 12));
        }
        const SourceValue* const coordinates = ini_.find("TRAJ", "COORDINATES");
        if (coordinates == nullptr) {
            throw InputError(file_, 0, "there is no COORDINATES in [TRAJ]; add it, like COORDINATES = X Y Z");
        }
        for (const char letter : capitals(coordinates->text)) {
            if (our_letters.find(letter) == std::string_view::npos) {
                refuse_value(file_, *coordinates, "the axes of a machine here are X, Y, Z, A, B and C");
            }
            if (letters_.find(letter) == std::string::npos) {
                letters_ += letter;
            }
        }
        order_ = std::move(order);
    }

    static std::string capitals(std::string_view text) {
        std::string out;
        for (const char c : text) {
            if (c != ' ' && c != '\t') {
                out += upper_case(c);
            }
        }
        return out;
    }

    /// Of an axis and its joints, that of the axis first. In old files an axis has a number, too.
    [[nodiscard]] std::vector<std::string> sections_of(char letter) const {
        std::vector<std::string> out{fmt::format("AXIS_{}", letter)};
        for (std::size_t k = 0; k < order_.size(); ++k) {
            if (order_[k] == letter) {
                out.push_back(fmt::format("JOINT_{}", k));
            }
        }
        out.push_back(fmt::format("AXIS_{}", ini_letters.find(letter)));
        std::erase_if(out, [this](const std::string& section) { return !ini_.has(section); });
        return out;
    }

    [[nodiscard]] bool is_rotary(char letter) const {
        for (const std::string& section : sections_of(letter)) {
            if (const SourceValue* const type = ini_.find(section, "TYPE")) {
                return type->text == "ANGULAR";
            }
        }
        return letter >= 'A' && letter <= 'C';
    }

    /// Of the lengths of a section: mm, or degrees.
    [[nodiscard]] double unit_of(const std::string& section, bool rotary) const {
        if (!rotary) {
            const SourceValue* const own = ini_.find(section, "UNITS");
            return own != nullptr ? linear_unit(*own) : mm_;
        }
        const SourceValue* const angle = ini_.find("TRAJ", "ANGULAR_UNITS");
        const std::string_view unit = angle != nullptr ? std::string_view(angle->text) : "degree";
        return unit.starts_with("rad") ? 180.0 / std::numbers::pi : unit.starts_with("g") ? 0.9 : 1.0;
    }

    [[nodiscard]] SketchAxis axis(char letter) const {
        SketchAxis out{std::string(1, lower_case(letter)), is_rotary(letter), {}};
        const std::vector<std::string> sections = sections_of(letter);
        for (const IniLimit& limit : ini_limits) {
            add_limit(limit, letter, sections, out);
        }
        add_scale(sections, out);
        add_range(sections, out);
        const auto joints = std::ranges::count(order_, letter);
        if (joints > 1) {
            out.rows.push_back(
                {joints == 2 ? "motors" : "# motors", std::to_string(joints),
                 joints == 2 ? "joints of this axis" : "joints of this axis; a machine file has 1 or 2"});
        }
        return out;
    }

    void add_limit(const IniLimit& limit, char letter, const std::vector<std::string>& sections,
                   SketchAxis& out) const {
        const SourceValue* lowest = nullptr;
        double least = 0.0;
        for (const std::string& section : sections) {
            const SourceValue* const value = ini_.find(section, limit.key);
            const double here = value != nullptr ? number(*value) * unit_of(section, out.rotary) : 0.0;
            const bool is_none = limit.key == "MAX_JERK" && (here <= 0.0 || here > 1e9);
            if (value != nullptr && !is_none && (lowest == nullptr || here < least)) {
                lowest = value;
                least = here;
            }
        }
        if (lowest != nullptr) {
            const double checked = in_range(file_, *lowest, least, limit.ours, axis_range(limit.ours));
            out.rows.push_back({std::string(limit.ours), short_number(checked), source_of(*lowest)});
        } else if (std::ranges::find(needed_limits, limit.key) != std::end(needed_limits)) {
            throw InputError(file_, 0, "there is no {} of axis {}; add it to [AXIS_{}]", limit.key, letter, letter);
        }
    }

    void add_scale(const std::vector<std::string>& sections, SketchAxis& out) const {
        for (const std::string& section : sections) {
            for (const std::string_view key : scales) {
                if (const SourceValue* const scale = ini_.find(section, key)) {
                    const double per_unit = number(*scale);
                    const double steps = in_range(file_, *scale, std::fabs(per_unit) / unit_of(section, out.rotary),
                                                  "steps_per_mm", axis_range("steps_per_mm"));
                    out.rows.push_back({"steps_per_mm", short_number(steps), source_of(*scale)});
                    if (per_unit < 0.0) {
                        out.rows.push_back({"invert", "true", "it is negative"});
                    }
                    return;
                }
            }
        }
    }

    void add_range(const std::vector<std::string>& sections, SketchAxis& out) const {
        for (const std::string& section : sections) {
            const SourceValue* const low = ini_.find(section, "MIN_LIMIT");
            const SourceValue* const high = ini_.find(section, "MAX_LIMIT");
            if (low == nullptr || high == nullptr) {
                continue;
            }
            const double from = number(*low) * unit_of(section, out.rotary);
            const double to = number(*high) * unit_of(section, out.rotary);
            if (from < -endless || to > endless) {
                return;
            }
            if (from >= to) {
                refuse_value(file_, *high, fmt::format("it must be above MIN_LIMIT, {}", low->text));
            }
            out.rows.push_back({"travel_mm", fmt::format("[{}, {}]", short_number(from), short_number(to)),
                                fmt::format("lines {} and {}: [{}] MIN_LIMIT = {}, MAX_LIMIT = {}", low->line,
                                            high->line, section, low->text, high->text)});
            return;
        }
    }

    void add_path(MachineSketch& out) const {
        for (const auto& [section, key] :
             {std::pair{"TRAJ", "MAX_LINEAR_VELOCITY"}, {"TRAJ", "MAX_VELOCITY"}, {"DISPLAY", "MAX_LINEAR_VELOCITY"}}) {
            if (const SourceValue* const feed = ini_.find(section, key)) {
                const double mm_s = in_range(file_, *feed, number(*feed) * mm_, "max_feed_mm_s", {0.001, 1e4, "mm/s"});
                out.path.push_back({"max_feed_mm_s", short_number(mm_s), source_of(*feed)});
                return;
            }
        }
        out.limit_path_by_axes();
    }

    void add_step(std::string_view key, const StepTime& time, MachineSketch& out) const {
        const SourceValue* longest = nullptr;
        double most = 0.0;
        for (const auto& [section, line] : ini_.sections()) {
            const SourceValue* const value = ini_.find(section, key);
            if (value != nullptr && (longest == nullptr || number(*value) > most)) {
                longest = value;
                most = number(*value);
            }
        }
        if (longest != nullptr) {
            const double us =
                in_range(file_, *longest, most / 1000.0, time.key, {time.least_us, longest_step_time_us, "us"});
            out.step.push_back({time.key, short_number(us), source_of(*longest)});
        }
    }

    void add_spindle(MachineSketch& out) const {
        const SourceValue* const high = ini_.find("SPINDLE_0", "MAX_FORWARD_VELOCITY");
        const SourceValue* const low = ini_.find("SPINDLE_0", "MIN_FORWARD_VELOCITY");
        if (high == nullptr) {
            return;
        }
        const double rpm = in_range(file_, *high, number(*high), "max_rpm", {1.0, 1e6, "1/min"});
        out.spindle.push_back({"max_rpm", short_number(rpm), source_of(*high)});
        if (low != nullptr) {
            const double least = in_range(file_, *low, number(*low), "min_rpm", {0.0, rpm, "1/min"});
            out.spindle.push_back({"min_rpm", short_number(least), source_of(*low)});
        }
    }

    void add_rest(MachineSketch& out) const {
        add_includes(ini_, out);
        for (const IniRest& rest : ini_rest) {
            if (!rest.section.empty()) {
                add_rest(rest.section, rest, out);
                continue;
            }
            for (const char letter : letters_) {
                for (const std::string& section : sections_of(letter)) {
                    add_rest(section, rest, out);
                }
            }
        }
    }

    void add_rest(std::string_view section, const IniRest& rest, MachineSketch& out) const {
        const SourceValue* const value = ini_.find(section, rest.key);
        if (value != nullptr && value->text.find_first_not_of("0.+-") != std::string::npos) {
            out.rest.emplace_back(source_of(*value), rest.text);
        }
    }

    const std::string& file_;
    IniText ini_;
    double mm_ = 1.0;     // of a unit
    std::string letters_; // of the axes
    std::string order_{}; // of the joints
};

} // namespace

MachineSketch linuxcnc_sketch(std::string_view text, const std::string& file, MachineAnswers& answers) {
    return IniReader(text, file, answers).sketch();
}

} // namespace splinefeed::host
