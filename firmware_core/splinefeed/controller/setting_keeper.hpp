// SPDX-License-Identifier: MIT
// SettingKeeper: what a controller asks of a machine that keeps what its senders set.
#pragma once

#include "splinefeed/controller/setting_list.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

namespace splinefeed {

/// What $RST forgets, by bits.
enum class KeptKind : std::uint8_t { settings = 1, offsets = 2, startup_lines = 4, all = 7 };

/// It is called while the machine stands. What returns false has changed nothing, and has written to `why` what would
/// be right: a line.
class SettingKeeper {
public:
    static constexpr unsigned startup_lines = 2;
    static constexpr std::size_t longest_line = 80;

    /// $n=value: takes the number over, and keeps it.
    virtual bool set(std::int32_t number, Decimal value, AnswerText& why) noexcept = 0;
    virtual bool forget(KeptKind what, AnswerText& why) noexcept = 0;
    [[nodiscard]] virtual SenderSettings sender() const noexcept = 0;
    /// All of them but which system is active.
    virtual bool keep(const WorkOffsets& offsets, AnswerText& why) noexcept = 0;
    [[nodiscard]] virtual WorkOffsets offsets() const noexcept = 0;
    /// @pre line < startup_lines; the text has at most longest_line characters, and empty forgets the line
    virtual bool keep(unsigned line, std::string_view text, AnswerText& why) noexcept = 0;
    /// Until something is kept.
    [[nodiscard]] virtual std::string_view startup_line(unsigned line) const noexcept = 0;

protected:
    SettingKeeper() = default;
    SettingKeeper(const SettingKeeper&) = default;
    SettingKeeper& operator=(const SettingKeeper&) = default;
    ~SettingKeeper() = default;
};

} // namespace splinefeed
