// SPDX-License-Identifier: MIT
#include "splinefeed/controller/setting_list.hpp"

#include "splinefeed/number/wide.hpp"
#include "splinefeed/s0_program/words/axis_letters.hpp"

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

bool is_limited(const ControllerSettings& settings) noexcept {
    bool all = true;
    for (const unsigned k : indices(settings.program.axes)) {
        all = all && settings.travel[k].limited;
    }
    return all;
}

struct SettingRow {
    using Value = Decimal (*)(const ControllerSettings&, const SenderSettings&);
    constexpr SettingRow(std::int32_t n, int places, std::string_view from, Value of) noexcept
        : number(n), decimals(places), key(from), value(of) {}
    std::int32_t number;
    int decimals;
    std::string_view key;
    Value value;
};
constexpr SettingRow setting_rows[] = {
    SettingRow(0, 0, "step_length_us of [step]", [](auto& c, auto&) { return whole(c.step_us); }),
    SettingRow(1, 0, "drives_at_end", [](auto& c, auto&) { return whole(c.drives_stay_on ? 255 : 25); }),
    SettingRow(2, 0, "invert_step of an axis",
               [](auto& c, auto&) { return bits(c, [&](unsigned k) { return c.wiring[k].invert_step; }); }),
    SettingRow(3, 0, "invert of an axis",
               [](auto& c, auto&) { return bits(c, [&](unsigned k) { return c.wiring[k].invert_direction; }); }),
    SettingRow(4, 0, "active of the line enable", [](auto&, auto&) { return Decimal{}; }),
    SettingRow(5, 0, "active of the limit switches", [](auto&, auto&) { return Decimal{}; }),
    SettingRow(6, 0, "active of the probe", [](auto&, auto&) { return Decimal{}; }),
    SettingRow(10, 0, "", [](auto&, auto& s) { return whole(s.report_mask); }),
    SettingRow(11, 3, "", [](auto&, auto&) { return Decimal{Decimal::one / 100}; }),
    SettingRow(12, 3, "", [](auto&, auto&) { return Decimal{Decimal::one / 500}; }),
    SettingRow(13, 0, "", [](auto&, auto& s) { return whole(s.inches ? 1 : 0); }),
    SettingRow(20, 0, "travel_mm of every axis", [](auto& c, auto&) { return whole(is_limited(c) ? 1 : 0); }),
    SettingRow(21, 0, "the limit switches", [](auto& c, auto&) { return whole(c.has_limits ? 1 : 0); }),
    SettingRow(22, 0, "[home.x]", [](auto& c, auto&) { return whole(c.homes != 0 ? 1 : 0); }),
    SettingRow(23, 0, "towards of [home.x]",
               [](auto& c, auto&) { return bits(c, [&](unsigned k) { return c.wiring[k].homes_low; }); }),
    SettingRow(24, 3, "latch_mm_s of [home.x]", [](auto& c, auto&) { return c.home_latch_mm_min; }),
    SettingRow(25, 3, "seek_mm_s of [home.x]", [](auto& c, auto&) { return c.home_seek_mm_min; }),
    SettingRow(26, 0, "debounce_us", [](auto& c, auto&) { return whole(c.debounce_ms); }),
    SettingRow(27, 3, "pull_off_mm of [home.x]", [](auto& c, auto&) { return c.pull_off_mm; }),
    SettingRow(30, 3, "max_rpm of [spindle]", [](auto& c, auto&) { return c.max_rpm; }),
    SettingRow(31, 3, "min_rpm of [spindle]", [](auto& c, auto&) { return c.min_rpm; }),
    SettingRow(32, 0, "", [](auto&, auto&) { return Decimal{}; }),
};

// One for each axis, from `number` on.
struct AxisSetting {
    using Value = Decimal (*)(const ControllerSettings&, unsigned axis);
    constexpr AxisSetting(std::int32_t n, std::string_view from, Value of) noexcept : number(n), key(from), value(of) {}
    std::int32_t number;
    std::string_view key;
    Value value;
};
constexpr AxisSetting axis_settings[] = {
    AxisSetting(100, "steps_per_mm", [](auto& c, unsigned k) { return of_double(c.machine.axis[k].steps_per_mm); }),
    AxisSetting(110, "max_velocity_mm_s",
                [](auto& c, unsigned k) { return of_double(c.machine.axis[k].max_velocity_mm_s, 60); }),
    AxisSetting(120, "max_acceleration_mm_s2",
                [](auto& c, unsigned k) { return of_double(c.machine.axis[k].max_acceleration_mm_s2); }),
    AxisSetting(130, "travel_mm", [](auto& c, unsigned k) { return c.travel[k].high - c.travel[k].low; }),
};
constexpr std::string_view setting_axes = "xyzabc"; // as the status has them
constexpr auto most_axes = static_cast<std::int32_t>(setting_axes.size());

const SettingRow* setting_row(std::int32_t number) noexcept {
    for (const SettingRow& row : setting_rows) {
        if (row.number == number) {
            return &row;
        }
    }
    return nullptr;
}

const AxisSetting* axis_setting(std::int32_t number) noexcept {
    for (const AxisSetting& row : axis_settings) {
        if (number >= row.number && number < row.number + most_axes) {
            return &row;
        }
    }
    return nullptr;
}

void write_row(std::int32_t number, Decimal value, int decimals, AnswerText& out) noexcept {
    out.put('$').integer(number).put('=').decimal(value, decimals).end_line();
}

} // namespace

bool SettingList::find(std::int32_t number, Decimal& out) const noexcept {
    if (const SettingRow* const row = setting_row(number)) {
        out = row->value(*settings_, *sender_);
        return true;
    }
    const AxisSetting* const row = axis_setting(number);
    if (row == nullptr) {
        return false;
    }
    const int axis =
        AxisLetters(settings_->program).index(setting_axes[static_cast<std::size_t>(number - row->number)]);
    out = axis >= 0 ? row->value(*settings_, static_cast<unsigned>(axis)) : Decimal{};
    return axis >= 0;
}

std::string_view SettingList::key_of(std::int32_t number) noexcept {
    const SettingRow* const row = setting_row(number);
    const AxisSetting* const axis = axis_setting(number);
    return row != nullptr ? row->key : axis != nullptr ? axis->key : std::string_view();
}

void SettingList::write(AnswerText& out) const noexcept {
    Decimal value;
    for (const SettingRow& row : setting_rows) {
        write_row(row.number, row.value(*settings_, *sender_), row.decimals, out);
    }
    for (const AxisSetting& row : axis_settings) {
        for (std::int32_t number = row.number; number < row.number + most_axes; ++number) {
            if (find(number, value)) {
                write_row(number, value, 3, out);
            }
        }
    }
}

} // namespace splinefeed
