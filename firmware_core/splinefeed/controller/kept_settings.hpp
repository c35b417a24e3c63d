// SPDX-License-Identifier: MIT
// KeptSettings: settings, offsets and start-up lines that last in a flash.
#pragma once

#include "splinefeed/controller/setting_keeper.hpp"
#include "splinefeed/controller/setting_log.hpp"

namespace splinefeed {

/// The machine, as it takes numbers over.
class SettingUser {
public:
    /// Takes the numbers over, or goes on with those before. The machine stands, and the motion begins anew where it
    /// says that it stands. @return  empty: done; else why not, and what would be right
    virtual std::string_view adopt(const ControllerSettings& settings) noexcept = 0;

protected:
    SettingUser() = default;
    SettingUser(const SettingUser&) = default;
    SettingUser& operator=(const SettingUser&) = default;
    ~SettingUser() = default;
};

/// A number that nobody has set is that of the firmware, also of a newer one. What stands in the flash and is not right
/// for this machine is left out. The flash needs sectors of `least_sector` bytes.
class KeptSettings final : public SettingKeeper {
public:
    static constexpr std::size_t least_sector = 4096;

    /// Reads what is kept. All arguments must outlive it.
    /// @param usual  the firmware's numbers
    KeptSettings(LogFlash& flash, const ControllerSettings& usual, SettingUser& user) noexcept;
    /// The user adopts what is kept; where it does not, what is usual. @return  why it did not; empty: it did
    std::string_view begin() noexcept;
    /// Also while the user adopts them; they stay where they are.
    [[nodiscard]] const ControllerSettings& settings() const noexcept { return settings_; }

    bool set(std::int32_t number, Decimal value, AnswerText& why) noexcept override;
    bool forget(KeptKind what, AnswerText& why) noexcept override;
    [[nodiscard]] SenderSettings sender() const noexcept override { return sender_; }
    bool keep(const WorkOffsets& offsets, AnswerText& why) noexcept override;
    [[nodiscard]] WorkOffsets offsets() const noexcept override;
    bool keep(unsigned line, std::string_view text, AnswerText& why) noexcept override;
    [[nodiscard]] std::string_view startup_line(unsigned line) const noexcept override;

private:
    [[nodiscard]] std::string_view adopt() noexcept;
    bool keep(std::span<const LogEntry> entries, AnswerText& why) noexcept;

    const ControllerSettings* usual_;
    SettingUser* user_;
    SettingLog log_;
    ControllerSettings settings_;
    SenderSettings sender_{};
};

} // namespace splinefeed
