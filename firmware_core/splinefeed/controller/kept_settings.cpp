// SPDX-License-Identifier: MIT
#include "splinefeed/controller/kept_settings.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/controller/setting_change.hpp"

#include <array>

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

namespace {

// Keys of the log. Below them a setting's is its number.
constexpr std::uint16_t first_offset = 0x1000;
constexpr std::uint16_t first_line = 0x2000;

constexpr std::size_t number_size = 8;

// Behind the systems. In a struct: its names stay in it where sources are compiled as one.
struct OffsetPlace {
    enum : std::uint8_t { g28 = work_systems, g30, g92, tool, count };
};
constexpr std::size_t offset_count = OffsetPlace::count;

// Offsets in the log: of each axis, and one number more.
struct OffsetRow {
    PerAxis<Decimal>* axes;
    Decimal more{}; // rotation, whether G92 applies, the tool's number
};
using OffsetRows = std::array<OffsetRow, offset_count>;
constexpr std::size_t longest_offset = (all_axes + 1U) * number_size;

// As it takes most of a sector, with 8 bytes a head: settings, offsets and lines.
constexpr std::size_t most_bytes =
    SettingLog::sector_head + most_kept_settings * (SettingLog::record_head + number_size) +
    offset_count * (SettingLog::record_head + longest_offset) +
    SettingKeeper::startup_lines * (SettingLog::record_head + SettingKeeper::longest_line);
static_assert(longest_offset <= SettingLog::longest && SettingKeeper::longest_line <= SettingLog::longest);
static_assert(most_bytes < KeptSettings::least_sector * 3 / 4, "a quarter of the sector is free behind a renewal");

OffsetRows rows_of(WorkOffsets& offsets) noexcept {
    OffsetRows out{};
    for (unsigned k = 0; k < work_systems; ++k) {
        out[k] = {&offsets.systems[k].origin, offsets.systems[k].rotation_deg};
    }
    out[OffsetPlace::g28].axes = &offsets.g28;
    out[OffsetPlace::g30].axes = &offsets.g30;
    out[OffsetPlace::g92] = {&offsets.g92, Decimal::from_integer(offsets.g92_applies ? 1 : 0)};
    out[OffsetPlace::tool] = {&offsets.tool, Decimal{offsets.tool_number}};
    return out;
}

void write(Decimal value, std::uint8_t* out) noexcept {
    for (unsigned i = 0; i < number_size; ++i) {
        out[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value.raw) >> 8 * i);
    }
}

Decimal read(std::span<const std::uint8_t> bytes) noexcept {
    std::uint64_t raw = 0;
    for (unsigned i = 0; i < number_size; ++i) {
        raw |= static_cast<std::uint64_t>(bytes[i]) << 8 * i;
    }
    return {static_cast<std::int64_t>(raw)};
}

bool has(KeptKind what, KeptKind kind) noexcept {
    return (static_cast<unsigned>(what) & static_cast<unsigned>(kind)) != 0;
}

void say(std::string_view sentence, AnswerText& out) noexcept {
    out.put("[MSG:").put(sentence).put(']').end_line();
}

// Numbers that do not fit together; empty: they do.
std::string_view problem_of(const ControllerSettings& settings) noexcept {
    return settings.min_rpm > settings.max_rpm ? "$31, the lowest speed of the spindle, is at most $30"sv : ""sv;
}

} // namespace

KeptSettings::KeptSettings(LogFlash& flash, const ControllerSettings& usual, SettingUser& user) noexcept
    : usual_(&usual), user_(&user), log_(flash), settings_(usual) {
    SPLINEFEED_ASSERT(flash.bytes(0).size() >= least_sector);
    for (std::size_t i = 0; i < most_kept_settings; ++i) {
        const std::int32_t number = kept_setting(i);
        const std::span<const std::uint8_t> value = log_.find(static_cast<std::uint16_t>(number));
        if (value.size() != number_size) {
            continue;
        }
        const ControllerSettings before = settings_;
        if (change_setting(number, read(value), settings_, sender_) != SettingFault::none) {
            settings_ = before;
        }
    }
}

std::string_view KeptSettings::adopt() noexcept {
    const std::string_view problem = problem_of(settings_);
    return problem.empty() ? user_->adopt(settings_) : problem;
}

std::string_view KeptSettings::begin() noexcept {
    const std::string_view problem = adopt();
    if (!problem.empty()) {
        settings_ = *usual_;
        [[maybe_unused]] const std::string_view none = adopt();
        SPLINEFEED_ASSERT(none.empty());
    }
    return problem;
}

bool KeptSettings::keep(std::span<const LogEntry> entries, AnswerText& why) noexcept {
    const bool kept = log_.keep(entries);
    if (!kept) {
        say("The flash does not take it, and all stays as it was; a worn one is to be replaced"sv, why);
    }
    return kept;
}

bool KeptSettings::set(std::int32_t number, Decimal value, AnswerText& why) noexcept {
    const ControllerSettings before = settings_;
    const SenderSettings sender = sender_;
    std::array<std::uint8_t, number_size> bytes{};
    write(value, bytes.data());
    const LogEntry entry{static_cast<std::uint16_t>(number), bytes};
    const SettingFault fault = change_setting(number, value, settings_, sender_);
    const std::string_view problem = fault == SettingFault::none ? adopt() : ""sv;
    if (fault != SettingFault::none) {
        explain(fault, number, why);
    } else if (!problem.empty()) {
        say(problem, why);
    } else if (keep({&entry, 1}, why)) {
        return true;
    }
    settings_ = before;
    sender_ = sender;
    if (fault == SettingFault::none && problem.empty()) {
        static_cast<void>(adopt());
    }
    return false;
}

bool KeptSettings::forget(KeptKind what, AnswerText& why) noexcept {
    std::array<LogEntry, most_kept_settings + offset_count + startup_lines> entries{};
    std::size_t count = 0;
    for (std::size_t i = 0; has(what, KeptKind::settings) && i < most_kept_settings; ++i) {
        entries[count++].key = static_cast<std::uint16_t>(kept_setting(i));
    }
    for (unsigned i = 0; has(what, KeptKind::offsets) && i < offset_count; ++i) {
        entries[count++].key = static_cast<std::uint16_t>(first_offset + i);
    }
    for (unsigned i = 0; has(what, KeptKind::startup_lines) && i < startup_lines; ++i) {
        entries[count++].key = static_cast<std::uint16_t>(first_line + i);
    }
    if (!keep(std::span(entries).first(count), why)) {
        return false;
    }
    if (has(what, KeptKind::settings)) {
        settings_ = *usual_;
        sender_ = {};
        static_cast<void>(adopt());
    }
    return true;
}

bool KeptSettings::keep(const WorkOffsets& offsets, AnswerText& why) noexcept {
    WorkOffsets copy = offsets;
    const OffsetRows rows = rows_of(copy);
    std::array<std::array<std::uint8_t, longest_offset>, offset_count> bytes{};
    std::array<LogEntry, offset_count> entries{};
    const auto axes = static_cast<unsigned>(settings_.program.axes);
    for (unsigned i = 0; i < offset_count; ++i) {
        bool some = rows[i].more.raw != 0;
        for (const unsigned k : indices(axes)) {
            write((*rows[i].axes)[k], &bytes[i][number_size * k]);
            some = some || (*rows[i].axes)[k].raw != 0;
        }
        write(rows[i].more, &bytes[i][number_size * axes]);
        entries[i].key = static_cast<std::uint16_t>(first_offset + i);
        entries[i].value = std::span(bytes[i]).first(some ? number_size * (axes + 1U) : 0U);
    }
    return keep(entries, why);
}

WorkOffsets KeptSettings::offsets() const noexcept {
    WorkOffsets out;
    const auto axes = static_cast<unsigned>(settings_.program.axes);
    OffsetRows rows = rows_of(out);
    for (unsigned i = 0; i < offset_count; ++i) {
        const std::span<const std::uint8_t> value = log_.find(static_cast<std::uint16_t>(first_offset + i));
        if (value.size() != number_size * (axes + 1U)) { // of a machine with other axes
            continue;
        }
        for (const unsigned k : indices(axes)) {
            const Decimal place = read(value.subspan(number_size * k));
            (*rows[i].axes)[k] = is_position(place) ? place : Decimal{};
        }
        rows[i].more = read(value.subspan(number_size * axes));
    }
    for (unsigned k = 0; k < work_systems; ++k) {
        out.systems[k].rotation_deg = rows[k].more;
    }
    out.g92_applies = rows[OffsetPlace::g92].more.raw != 0;
    out.tool_number = static_cast<std::int32_t>(rows[OffsetPlace::tool].more.raw);
    return out;
}

bool KeptSettings::keep(unsigned line, std::string_view text, AnswerText& why) noexcept {
    std::array<std::uint8_t, longest_line> bytes{};
    for (std::size_t i = 0; i < text.size(); ++i) {
        bytes[i] = static_cast<std::uint8_t>(text[i]);
    }
    const LogEntry entry{static_cast<std::uint16_t>(first_line + line), std::span(bytes).first(text.size())};
    return keep({&entry, 1}, why);
}

std::string_view KeptSettings::startup_line(unsigned line) const noexcept {
    const std::span<const std::uint8_t> bytes = log_.find(static_cast<std::uint16_t>(first_line + line));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace splinefeed
