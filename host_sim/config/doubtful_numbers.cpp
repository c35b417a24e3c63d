// SPDX-License-Identifier: MIT
#include "host_sim/config/doubtful_numbers.hpp"

#include "host_sim/base/short_number.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// What it may be in, where it is below or above what machines have, and how many of the key's unit that is.
struct OtherUnit {
    std::string_view name;
    double factor;
};
template <class Of>
struct PlausibleNumber {
    std::string_view key;
    double Of::*value;
    double least;
    OtherUnit below;
    double most;
    OtherUnit above;
};
constexpr OtherUnit metres{"m/s", 1000.0};
constexpr OtherUnit minutes{"mm/min", 1.0 / 60.0};
constexpr PlausibleNumber<MachineSettings> plausible_path[] = {
    {"max_feed_mm_s", &MachineSettings::max_feed_mm_s, 0.5, metres, 2000.0, minutes},
};
constexpr PlausibleNumber<AxisSettings> plausible_axis[] = {
    {"max_velocity_mm_s", &AxisSettings::max_velocity_mm_s, 0.5, metres, 2000.0, minutes},
    {"max_acceleration_mm_s2",
     &AxisSettings::max_acceleration_mm_s2,
     5.0,
     {"m/s^2", 1000.0},
     100'000.0,
     {"mm/min^2", 1.0 / 3600.0}},
    {"max_jerk_mm_s3",
     &AxisSettings::max_jerk_mm_s3,
     100.0,
     {"m/s^3, or a jump of the velocity, as in Marlin", 1000.0},
     1e8,
     {"mm/min^3", 1.0 / 216'000.0}},
};

template <class Of, std::size_t n>
void add_doubts(const Of& of, const PlausibleNumber<Of> (&rows)[n], std::string_view where,
                std::vector<std::string>& out) {
    for (const PlausibleNumber<Of>& row : rows) {
        const double value = of.*row.value;
        if (value != 0.0 && (value < row.least || value > row.most)) { // 0: no such limit
            const OtherUnit& unit = value < row.least ? row.below : row.above;
            out.push_back(fmt::format("{}{} is {}: is that {}? Then it is {}", row.key, where, short_number(value),
                                      unit.name, short_number(value * unit.factor)));
        }
    }
}

} // namespace

std::vector<std::string> doubtful_numbers(const MachineDescription& machine) {
    std::vector<std::string> out;
    add_doubts(machine.settings, plausible_path, "", out);
    for (const unsigned k : indices(machine.settings.axes)) {
        if (!machine.settings.axis[k].rotary) {
            add_doubts(machine.settings.axis[k], plausible_axis, fmt::format(" of {}", machine.axis_name[k]), out);
        }
    }
    return out;
}

} // namespace splinefeed::host
