// SPDX-License-Identifier: MIT
#include "splinefeed/controller/setting_change.hpp"

#include "splinefeed/controller/setting_rows.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

namespace {

using detail::setting_rows;
using detail::SettingKind;
using detail::SettingRange;
using detail::SettingRow;

constexpr int most_places = 3; // of a number in a sentence

constexpr auto kept_numbers = [] {
    std::array<std::int32_t, most_kept_settings> out{};
    std::size_t count = 0;
    for (const SettingRow& row : setting_rows) {
        for (std::int32_t k = 0; row.kind != SettingKind::fixed && k < detail::count_of(row.kind); ++k) {
            out[count++] = row.number + k;
        }
    }
    return count == out.size() ? out : std::array<std::int32_t, most_kept_settings>{};
}();
static_assert(kept_numbers.back() != 0, "most_kept_settings are as many as the rows have");

bool holds(const SettingRange& range, Decimal value) noexcept {
    return value >= range.least && value <= range.most && (!range.is_whole || value.raw % Decimal::one == 0);
}

void put_number(Decimal value, AnswerText& out) noexcept {
    out.decimal(value, value.raw % Decimal::one == 0 ? 0 : most_places);
}

} // namespace

std::int32_t kept_setting(std::size_t i) noexcept {
    return kept_numbers[i];
}

void limit_path_by_axes(ControllerSettings& settings) noexcept {
    double most[2] = {}; // of linear axes, and of rotary ones
    for (const unsigned k : indices(settings.machine.axes)) {
        const AxisSettings& axis = settings.machine.axis[k];
        double& fastest = most[axis.rotary ? 1 : 0];
        fastest = axis.max_velocity_mm_s > fastest ? axis.max_velocity_mm_s : fastest;
    }
    settings.machine.max_feed_mm_s = most[0] > 0.0 ? most[0] : most[1];
    settings.max_feed_mm_s = detail::of_double(settings.machine.max_feed_mm_s);
}

SettingFault change_setting(std::int32_t number, Decimal value, ControllerSettings& settings,
                            SenderSettings& sender) noexcept {
    const SettingRow* const row = detail::find_row(setting_rows, number);
    const int axis = row == nullptr                  ? -1
                     : row->kind < SettingKind::axis ? 0
                                                     : SettingList::axis_of(settings.program, number - row->number);
    if (axis < 0) {
        return SettingFault::unknown;
    }
    if (row->kind == SettingKind::fixed) {
        return SettingFault::fixed;
    }
    if (!holds(row->range, value)) {
        return SettingFault::out_of_range;
    }
    row->take(settings, sender, static_cast<unsigned>(axis), value);
    if (row->key == "max_velocity_mm_s"sv) {
        limit_path_by_axes(settings);
    }
    // Of a mask or a flag what the machine has no axis or switch for does not read back.
    const bool reads_back = !row->range.is_whole || row->show(settings, sender, 0) == value;
    return reads_back ? SettingFault::none : SettingFault::absent;
}

void explain(SettingFault fault, std::int32_t number, AnswerText& out) noexcept {
    out.put("[MSG:$").integer(number);
    if (fault == SettingFault::out_of_range) {
        const SettingRange& range = detail::find_row(setting_rows, number)->range;
        out.put(range.is_whole ? " is a whole number from "sv : " is a number from "sv);
        put_number(range.least, out);
        out.put(" to ");
        put_number(range.most, out);
    } else {
        out.put(fault == SettingFault::absent  ? ": the machine has nothing for it; it stays as it is"sv
                : fault == SettingFault::fixed ? " is fixed"sv
                                               : " is not known"sv);
    }
    out.put(']').end_line();
}

} // namespace splinefeed
