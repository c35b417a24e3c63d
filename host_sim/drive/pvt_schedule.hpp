// SPDX-License-Identifier: MIT
// PvtSchedule: the events of a drive that wait for an instant: a start or resume, a hold, and the watchdog.
#pragma once

#include <cstdint>
#include <optional>

namespace splinefeed::host {

/// Times in microseconds since the drive was made. An event that is due is taken once.
class PvtSchedule {
public:
    /// A start or a resume: at most one of them waits. A new one replaces it.
    void start_at(std::uint64_t time_us) noexcept { start_us_ = time_us; }
    void hold_at(std::uint64_t time_us) noexcept { hold_us_ = time_us; }
    void call_off_start() noexcept { start_us_.reset(); }
    void call_off_hold() noexcept { hold_us_.reset(); }
    /// A valid exchange: restarts the watchdog.
    void feed(std::uint64_t now_us) noexcept { fed_us_ = now_us; }

    [[nodiscard]] bool start_waits() const noexcept { return start_us_.has_value(); }
    [[nodiscard]] bool take_start(std::uint64_t now_us) noexcept { return take(start_us_, now_us); }
    [[nodiscard]] bool take_hold(std::uint64_t now_us) noexcept { return take(hold_us_, now_us); }
    /// Whether nothing came in for longer than the watchdog time. 0: there is no watchdog.
    [[nodiscard]] bool starves(std::uint64_t now_us, std::uint16_t watchdog_ms) const noexcept;
    /// The first instant after now at which an event is due, at most the limit.
    [[nodiscard]] std::uint64_t next_us(std::uint64_t now_us, std::uint16_t watchdog_ms,
                                        std::uint64_t limit_us) const noexcept;

private:
    [[nodiscard]] static bool take(std::optional<std::uint64_t>& event_us, std::uint64_t now_us) noexcept;

    std::optional<std::uint64_t> start_us_;
    std::optional<std::uint64_t> hold_us_;
    std::uint64_t fed_us_ = 0;
};

} // namespace splinefeed::host
