// SPDX-License-Identifier: MIT
#include "splinefeed/controller/setting_list.hpp"

#include "splinefeed/controller/setting_rows.hpp"
#include "splinefeed/s0_program/words/axis_letters.hpp"

namespace splinefeed {

namespace {

using detail::SettingKind;

// The columns that are shown: what sets a number is not linked where nothing does.
struct ShownRow {
    std::int32_t number = 0;
    int decimals = 0;
    std::string_view key;
    detail::SettingRow::Show show = nullptr;
    SettingKind kind = SettingKind::single;
};
constexpr auto shown_rows = [] {
    std::array<ShownRow, std::size(detail::setting_rows)> out{};
    for (std::size_t i = 0; const detail::SettingRow& row : detail::setting_rows) {
        out[i++] = {row.number, row.range.is_whole ? 0 : 3, row.key, row.show, row.kind};
    }
    return out;
}();

} // namespace

int SettingList::axis_of(const ProgramSettings& program, std::int32_t place) noexcept {
    return AxisLetters(program).index(detail::setting_axes[static_cast<std::size_t>(place)]);
}

bool SettingList::find(std::int32_t number, Decimal& out) const noexcept {
    const ShownRow* const row = detail::find_row(shown_rows, number);
    if (row == nullptr || (row->kind == SettingKind::kept_axis && !kept_)) {
        return false;
    }
    const int axis = row->kind < SettingKind::axis ? 0 : axis_of(settings_->program, number - row->number);
    out = axis >= 0 ? row->show(*settings_, *sender_, static_cast<unsigned>(axis)) : Decimal{};
    return axis >= 0;
}

std::string_view SettingList::key_of(std::int32_t number) noexcept {
    const ShownRow* const row = detail::find_row(shown_rows, number);
    return row != nullptr ? row->key : std::string_view();
}

void SettingList::write(AnswerText& out) const noexcept {
    Decimal value;
    for (const ShownRow& row : shown_rows) {
        const std::int32_t end = row.number + detail::count_of(row.kind);
        for (std::int32_t number = row.number; number < end; ++number) {
            if (find(number, value)) {
                out.put('$').integer(number).put('=').decimal(value, row.decimals).end_line();
            }
        }
    }
}

} // namespace splinefeed
