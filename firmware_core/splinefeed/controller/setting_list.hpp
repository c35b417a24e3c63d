// SPDX-License-Identifier: MIT
// SettingList: the machine's numbers as `$` settings, which senders read.
#pragma once

#include "splinefeed/controller/answer_text.hpp"
#include "splinefeed/controller/controller_settings.hpp"

namespace splinefeed {

/// The two that a sender may set.
struct SenderSettings {
    static constexpr std::int32_t most_mask = 511; ///< bits 3 to 8 ask for what reports have anyway

    /// $10: bit 0 machine position, else that of the program; bit 1 buffers, bit 2 line
    std::int32_t report_mask = 3;
    bool inches = false; ///< $13
};

class SettingList {
public:
    /// Both must outlive it. @param kept  the machine keeps settings, and has all numbers that one can keep
    SettingList(const ControllerSettings& settings, const SenderSettings& sender, bool kept = false) noexcept
        : settings_(&settings), sender_(&sender), kept_(kept) {}

    /// All of them, a line each.
    void write(AnswerText& out) const noexcept;
    /// Whether there is such a number, and its value.
    [[nodiscard]] bool find(std::int32_t number, Decimal& out) const noexcept;
    /// The key of a machine file that states it; empty: none does.
    [[nodiscard]] static std::string_view key_of(std::int32_t number) noexcept;
    /// The axis of the machine that stands there in x, y, z, a, b, c; -1: it has none.
    [[nodiscard]] static int axis_of(const ProgramSettings& program, std::int32_t place) noexcept;

private:
    const ControllerSettings* settings_;
    const SenderSettings* sender_;
    bool kept_;
};

} // namespace splinefeed
