// SPDX-License-Identifier: MIT
#include "splinefeed/controller/setting_list.hpp"

#include "splinefeed/number/wide.hpp"
#include "splinefeed/s0_program/axis_letters.hpp"

#include <bit>

namespace splinefeed {

namespace {

Decimal whole(std::int64_t value) noexcept {
    return {value * Decimal::one};
}

// A number of the machine, which is not negative, times `factor`, 100 at most. By integers: a firmware has no
// arithmetic in double.
Decimal of_double(double value, std::uint64_t factor = 1) noexcept {
    constexpr int digits = 52;
    constexpr std::uint64_t hidden = std::uint64_t{1} << digits;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int places = digits + 1023 - static_cast<int>(bits >> digits); // value = significand / 2^places
    const std::uint64_t significand = (bits & (hidden - 1)) | hidden;
    constexpr int fewest = 18; // from 2^35 on it is out of range
    const Wide raw = shift_right(multiply(significand, factor * Decimal::one), places > fewest ? places : fewest);
    return {raw.high == 0 && raw.low < Decimal::largest_raw ? static_cast<std::int64_t>(raw.low)
                                                            : Decimal::largest_raw};
}

template <class Bit>
Decimal bits(const ControllerSettings& settings, Bit bit) noexcept {
    std::int64_t mask = 0;
    for (const unsigned k : indices(settings.program.axes)) {
        mask |= bit(k) ? std::int64_t{1} << k : 0;
    }
    return whole(mask);
}

// In a struct: its names stay in it where sources are compiled as one.
struct SettingTable {
    struct Row {
        std::int32_t number;
        int decimals;
        std::string_view key;
        Decimal (*value)(const ControllerSettings&, const SenderSettings&);
    };
    using C = ControllerSettings;
    using S = SenderSettings;
    static constexpr Row rows[] = {
        {0, 0, "step_length_us of [step]",
         [](const C& c, const S&) {
             return whole(c.step_us);
         }},
        {1, 0, "drives_at_end",
         [](const C& c, const S&) {
             return whole(c.drives_stay_on ? 255 : 25);
         }},
        {2, 0, "invert_step of an axis",
         [](const C& c, const S&) {
             return bits(c, [&](unsigned k) { return c.wiring[k].invert_step; });
         }},
        {3, 0, "invert of an axis",
         [](const C& c, const S&) {
             return bits(c, [&](unsigned k) { return c.wiring[k].invert_direction; });
         }},
        {4, 0, "active of the line enable",
         [](const C&, const S&) {
             return Decimal{};
         }},
        {5, 0, "active of the limit switches",
         [](const C&, const S&) {
             return Decimal{};
         }},
        {6, 0, "active of the probe",
         [](const C&, const S&) {
             return Decimal{};
         }},
        {10, 0, "",
         [](const C&, const S& s) {
             return whole(s.report_mask);
         }},
        {11, 3, "",
         [](const C&, const S&) {
             return Decimal{Decimal::one / 100};
         }},
        {12, 3, "",
         [](const C&, const S&) {
             return Decimal{Decimal::one / 500};
         }},
        {13, 0, "",
         [](const C&, const S& s) {
             return whole(s.inches ? 1 : 0);
         }},
        {20, 0, "travel_mm of every axis",
         [](const C& c, const S&) {
             bool all = true;
             for (const unsigned k : indices(c.program.axes)) {
                 all = all && c.travel[k].limited;
             }
             return whole(all ? 1 : 0);
         }},
        {21, 0, "the limit switches",
         [](const C& c, const S&) {
             return whole(c.has_limits ? 1 : 0);
         }},
        {22, 0, "[home.x]",
         [](const C& c, const S&) {
             return whole(c.homes != 0 ? 1 : 0);
         }},
        {23, 0, "towards of [home.x]",
         [](const C& c, const S&) {
             return bits(c, [&](unsigned k) { return c.wiring[k].homes_low; });
         }},
        {24, 3, "latch_mm_s of [home.x]",
         [](const C& c, const S&) {
             return c.home_latch_mm_min;
         }},
        {25, 3, "seek_mm_s of [home.x]",
         [](const C& c, const S&) {
             return c.home_seek_mm_min;
         }},
        {26, 0, "debounce_us",
         [](const C& c, const S&) {
             return whole(c.debounce_ms);
         }},
        {27, 3, "pull_off_mm of [home.x]",
         [](const C& c, const S&) {
             return c.pull_off_mm;
         }},
        {30, 3, "max_rpm of [spindle]",
         [](const C& c, const S&) {
             return c.max_rpm;
         }},
        {31, 3, "min_rpm of [spindle]",
         [](const C& c, const S&) {
             return c.min_rpm;
         }},
        {32, 0, "",
         [](const C&, const S&) {
             return Decimal{};
         }},
    };

    // One for each axis, from `number` on.
    struct AxisRow {
        std::int32_t number;
        std::string_view key;
        Decimal (*value)(const ControllerSettings&, unsigned axis);
    };
    static constexpr AxisRow axis_rows[] = {
        {100, "steps_per_mm",
         [](const C& c, unsigned k) {
             return of_double(c.machine.axis[k].steps_per_mm);
         }},
        {110, "max_velocity_mm_s",
         [](const C& c, unsigned k) {
             return of_double(c.machine.axis[k].max_velocity_mm_s, 60);
         }},
        {120, "max_acceleration_mm_s2",
         [](const C& c, unsigned k) {
             return of_double(c.machine.axis[k].max_acceleration_mm_s2);
         }},
        {130, "travel_mm",
         [](const C& c, unsigned k) {
             return c.travel[k].high - c.travel[k].low;
         }},
    };
    static constexpr std::string_view columns = "xyzabc"; // as the status has them

    static constexpr const AxisRow* axis_row(std::int32_t number) noexcept {
        for (const AxisRow& row : axis_rows) {
            if (number >= row.number && number < row.number + static_cast<std::int32_t>(columns.size())) {
                return &row;
            }
        }
        return nullptr;
    }
};

void write_row(std::int32_t number, Decimal value, int decimals, AnswerText& out) noexcept {
    out.put('$').integer(number).put('=').decimal(value, decimals).end_line();
}

} // namespace

bool SettingList::find(std::int32_t number, Decimal& out) const noexcept {
    for (const SettingTable::Row& row : SettingTable::rows) {
        if (row.number == number) {
            out = row.value(*settings_, *sender_);
            return true;
        }
    }
    if (const SettingTable::AxisRow* const row = SettingTable::axis_row(number)) {
        const auto column = static_cast<std::size_t>(number - row->number);
        const int axis = AxisLetters(settings_->program).index(SettingTable::columns[column]);
        out = axis >= 0 ? row->value(*settings_, static_cast<unsigned>(axis)) : Decimal{};
        return axis >= 0;
    }
    return false;
}

std::string_view SettingList::key_of(std::int32_t number) noexcept {
    for (const SettingTable::Row& row : SettingTable::rows) {
        if (row.number == number) {
            return row.key;
        }
    }
    const SettingTable::AxisRow* const row = SettingTable::axis_row(number);
    return row != nullptr ? row->key : std::string_view();
}

void SettingList::write(AnswerText& out) const noexcept {
    Decimal value;
    for (const SettingTable::Row& row : SettingTable::rows) {
        write_row(row.number, row.value(*settings_, *sender_), row.decimals, out);
    }
    for (const SettingTable::AxisRow& row : SettingTable::axis_rows) {
        for (std::int32_t column = 0; column < static_cast<std::int32_t>(SettingTable::columns.size()); ++column) {
            if (find(row.number + column, value)) {
                write_row(row.number + column, value, 3, out);
            }
        }
    }
}

} // namespace splinefeed
