// SPDX-License-Identifier: MIT
// The `$` settings, a row each: what they show, and what sets them. A program links the columns that it uses.
#pragma once

#include "splinefeed/controller/setting_list.hpp"
#include "splinefeed/number/wide.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"

#include <bit>

namespace splinefeed::detail {

struct SettingRange {
    Decimal least{};
    Decimal most{};
    bool is_whole = true; ///< else it has three decimals where it is shown
};

constexpr Decimal whole(std::int64_t value) noexcept {
    return {value * Decimal::one};
}
constexpr SettingRange whole_range(std::int32_t least, std::int32_t most) noexcept {
    return {whole(least), whole(most), true};
}
constexpr SettingRange flag_range = whole_range(0, 1);
constexpr SettingRange mask_range = whole_range(0, 63);
constexpr SettingRange rpm_range{{}, whole(1'000'000), false};
constexpr SettingRange speed_range{{Decimal::one / 100}, whole(600'000), false};

/// Of the key of a machine file; of one that may be left out 0 is none.
constexpr SettingRange range_of(std::string_view key, std::int64_t factor = 1) noexcept {
    for (const auto& row : axis_numbers) {
        if (row.key == key) {
            const auto most = static_cast<std::int64_t>(row.high) * factor;
            const bool may_lack = row.without == WithoutKey::none;
            return {may_lack ? Decimal{} : Decimal{static_cast<std::int64_t>(row.low * 1e9) * factor},
                    whole(most < 100'000'000 ? most : 100'000'000), false}; // no line has more
        }
    }
    return {};
}

// A number of the machine, which is not negative, times `factor`, 100 at most; rounded. By integers: a firmware has no
// arithmetic in double.
constexpr Decimal of_double(double value, std::uint64_t factor = 1) noexcept {
    constexpr int digits = 52;
    constexpr std::uint64_t hidden = std::uint64_t{1} << digits;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int places = digits + 1023 - static_cast<int>(bits >> digits); // value = significand / 2^places
    const std::uint64_t significand = (bits & (hidden - 1)) | hidden;
    constexpr int fewest = 18; // from 2^35 on it is out of range
    const int shift = places > fewest ? places : fewest;
    const Wide scaled = multiply(significand, factor * Decimal::one);
    const Wide raw = shift_right(add(scaled, shift_left({0, 1}, shift - 1)), shift);
    return {raw.high == 0 && raw.low < Decimal::largest_raw ? static_cast<std::int64_t>(raw.low)
                                                            : Decimal::largest_raw};
}

// At rest alone: a chip without doubles takes its time.
constexpr double to_double(Decimal value, double divisor = 1.0) noexcept {
    return static_cast<double>(value.raw) / (static_cast<double>(Decimal::one) * divisor);
}

constexpr std::int32_t to_whole(Decimal value) noexcept {
    return static_cast<std::int32_t>(value.raw / Decimal::one);
}

using Settings = ControllerSettings;

enum class SettingKind : std::uint8_t {
    fixed, ///< nothing sets it
    single,
    axis,      ///< a number for each axis
    kept_axis, ///< likewise; only machines that keep settings have it
};

struct SettingRow {
    using Show = Decimal (*)(const Settings&, const SenderSettings&, unsigned axis);
    using Take = void (*)(Settings&, SenderSettings&, unsigned axis, Decimal);

    std::int32_t number;
    std::string_view key; ///< of a machine file
    SettingRange range;
    Show show;
    Take take;
    SettingKind kind = SettingKind::single;
};

inline constexpr std::string_view setting_axes = "xyzabc"; // as the status has them
inline constexpr auto most_axes = static_cast<std::int32_t>(setting_axes.size());

constexpr std::int32_t count_of(SettingKind kind) noexcept {
    return kind >= SettingKind::axis ? most_axes : 1;
}

/// The row of a number, also of an axis; null: there is none.
template <class Rows>
[[nodiscard]] constexpr auto* find_row(const Rows& rows, std::int32_t number) noexcept {
    for (const auto& row : rows) {
        if (number >= row.number && number < row.number + count_of(row.kind)) {
            return &row;
        }
    }
    return static_cast<decltype(&*std::begin(rows))>(nullptr);
}

// Members that are a Decimal, a whole number or a flag.
template <auto member, class C, class S>
constexpr auto& member_of(C& c, S& s) noexcept {
    if constexpr (requires { c.*member; }) {
        return c.*member;
    } else {
        return s.*member;
    }
}
template <auto member>
constexpr Decimal show_member(const Settings& c, const SenderSettings& s, unsigned /*axis*/) noexcept {
    const auto& value = member_of<member>(c, s);
    if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, Decimal>) {
        return value;
    } else {
        return whole(value);
    }
}
template <auto member>
constexpr void take_member(Settings& c, SenderSettings& s, unsigned /*axis*/, Decimal value) noexcept {
    auto& out = member_of<member>(c, s);
    using T = std::remove_cvref_t<decltype(out)>;
    if constexpr (std::same_as<T, Decimal>) {
        out = value;
    } else {
        out = static_cast<T>(to_whole(value));
    }
}
template <auto member>
constexpr SettingRow member_row(std::int32_t number, std::string_view key, SettingRange range) noexcept {
    return {number, key, range, show_member<member>, take_member<member>};
}

// A bit for each axis.
template <auto member>
constexpr Decimal show_mask(const Settings& c, const SenderSettings& /*s*/, unsigned /*axis*/) noexcept {
    std::int64_t mask = 0;
    for (const unsigned k : indices(c.program.axes)) {
        mask |= c.wiring[k].*member ? std::int64_t{1} << k : 0;
    }
    return whole(mask);
}
template <auto member>
constexpr void take_mask(Settings& c, SenderSettings& /*s*/, unsigned /*axis*/, Decimal value) noexcept {
    for (const unsigned k : indices(c.program.axes)) {
        c.wiring[k].*member = (to_whole(value) >> k & 1) != 0;
    }
}
template <auto member>
constexpr SettingRow mask_row(std::int32_t number, std::string_view key) noexcept {
    return {number, key, mask_range, show_mask<member>, take_mask<member>};
}

/// Of the machine; `factor`: the setting is that times what the key has.
template <auto member, unsigned factor = 1>
constexpr SettingRow axis_row(std::int32_t number, std::string_view key,
                              SettingKind kind = SettingKind::axis) noexcept {
    return {number,
            key,
            range_of(key, factor),
            [](auto& c, auto&, unsigned k) { return of_double(c.machine.axis[k].*member, factor); },
            [](auto& c, auto&, unsigned k, Decimal v) { c.machine.axis[k].*member = to_double(v, factor); },
            kind};
}

template <std::int64_t value>
constexpr Decimal show_fixed(const Settings& /*c*/, const SenderSettings& /*s*/, unsigned /*axis*/) noexcept {
    return {value};
}

constexpr Decimal show_limited(const Settings& c, const SenderSettings& /*s*/, unsigned /*axis*/) noexcept {
    bool all = true;
    for (const unsigned k : indices(c.program.axes)) {
        all = all && c.travel[k].limited;
    }
    return whole(all ? 1 : 0);
}
constexpr void take_limited(Settings& c, SenderSettings& /*s*/, unsigned /*axis*/, Decimal value) noexcept {
    for (AxisTravel& travel : c.travel) {
        travel.limited = value.raw != 0;
    }
}

constexpr Decimal show_length(const Settings& c, const SenderSettings& /*s*/, unsigned k) noexcept {
    return c.travel[k].high - c.travel[k].low;
}
// The end that lies at 0 stays there.
constexpr void take_length(Settings& c, SenderSettings& /*s*/, unsigned k, Decimal length) noexcept {
    AxisTravel& travel = c.travel[k];
    travel.high.raw == 0 ? travel.low = -length : travel.high = travel.low + length;
}

// Of an axis whose travel has an end at 0: it ends there, or it begins there.
constexpr void lay_travel(Settings& c) noexcept {
    for (const unsigned k : indices(c.program.axes)) {
        AxisTravel& travel = c.travel[k];
        const Decimal length = travel.high - travel.low;
        if (travel.low.raw == 0 || travel.high.raw == 0) {
            const bool begins = c.home_is_zero && c.wiring[k].homes_low;
            travel.low = begins ? Decimal{} : -length;
            travel.high = begins ? length : Decimal{};
        }
    }
}
constexpr int home_is_zero_bit = 8; // of $22, as grblHAL has it; bit 0: it homes
constexpr Decimal show_homing(const Settings& c, const SenderSettings& /*s*/, unsigned /*axis*/) noexcept {
    return whole((c.homes != 0 ? 1 : 0) | (c.home_is_zero ? home_is_zero_bit : 0));
}
constexpr void take_homing(Settings& c, SenderSettings& /*s*/, unsigned /*axis*/, Decimal value) noexcept {
    c.homes = (to_whole(value) & 1) != 0 ? c.home_switches : 0;
    if (c.home_is_zero != ((to_whole(value) & home_is_zero_bit) != 0)) {
        c.home_is_zero = !c.home_is_zero;
        lay_travel(c);
    }
}
constexpr void take_homes_low(Settings& c, SenderSettings& s, unsigned axis, Decimal value) noexcept {
    take_mask<&AxisWiring::homes_low>(c, s, axis, value);
    if (c.home_is_zero) {
        lay_travel(c);
    }
}

inline constexpr SettingRow setting_rows[] = {
    member_row<&Settings::step_us>(0, "step_length_us of [step]", whole_range(1, 1000)),
    member_row<&Settings::idle_ms>(1, "drives_at_end", whole_range(0, 255)),
    mask_row<&AxisWiring::invert_step>(2, "invert_step of an axis"),
    mask_row<&AxisWiring::invert_direction>(3, "invert of an axis"),
    member_row<&Settings::invert_enable>(4, "active of the line enable", flag_range),
    member_row<&Settings::invert_limits>(5, "active of the limit switches", flag_range),
    member_row<&Settings::invert_probe>(6, "active of the probe", flag_range),
    member_row<&SenderSettings::report_mask>(10, "", whole_range(0, SenderSettings::most_mask)),
    {11, "", speed_range, show_fixed<Decimal::one / 100>, nullptr, SettingKind::fixed},
    {12, "", speed_range, show_fixed<Decimal::one / 500>, nullptr, SettingKind::fixed},
    member_row<&SenderSettings::inches>(13, "", flag_range),
    {20, "travel_mm of every axis", flag_range, show_limited, take_limited},
    member_row<&Settings::has_limits>(21, "the limit switches", flag_range),
    {22, "[home.x]", whole_range(0, 9), show_homing, take_homing},
    {23, "towards of [home.x]", mask_range, show_mask<&AxisWiring::homes_low>, take_homes_low},
    member_row<&Settings::home_latch_mm_min>(24, "latch_mm_s of [home.x]", speed_range),
    member_row<&Settings::home_seek_mm_min>(25, "seek_mm_s of [home.x]", speed_range),
    member_row<&Settings::debounce_ms>(26, "debounce_us", whole_range(0, 1000)),
    member_row<&Settings::pull_off_mm>(27, "pull_off_mm of [home.x]", {{}, whole(1000), false}),
    member_row<&Settings::max_rpm>(30, "max_rpm of [spindle]", rpm_range),
    member_row<&Settings::min_rpm>(31, "min_rpm of [spindle]", rpm_range),
    {32, "", flag_range, show_fixed<0>, nullptr, SettingKind::fixed},
    axis_row<&AxisSettings::steps_per_mm>(100, "steps_per_mm"),
    axis_row<&AxisSettings::max_velocity_mm_s, 60>(110, "max_velocity_mm_s"),
    axis_row<&AxisSettings::max_acceleration_mm_s2>(120, "max_acceleration_mm_s2"),
    {130, "travel_mm", {{Decimal::one / 1000}, whole(1'000'000), false}, show_length, take_length, SettingKind::axis},
    axis_row<&AxisSettings::max_jerk_mm_s3>(800, "max_jerk_mm_s3", SettingKind::kept_axis), // as grblHAL has it
};

} // namespace splinefeed::detail
