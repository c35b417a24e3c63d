// SPDX-License-Identifier: MIT
// limit_kind: the limits that can bind a motion, and their names in reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace splinefeed::host {

enum class LimitKind : std::uint8_t {
    none,
    feed,
    machine_feed,
    velocity,
    acceleration,
    jerk,
    centripetal,
    chord,
    override_feed, ///< the feed as the operator changed it
    hold,          ///< the operator brakes the machine, or keeps it at rest
    dwell,         ///< the program keeps it at rest
};

/// A limit; `axis` is meaningful for velocity, acceleration and jerk.
struct BindingLimit {
    LimitKind kind = LimitKind::none;
    std::uint8_t axis = 0;

    /// One byte that tells all limits apart; 0: none.
    [[nodiscard]] constexpr std::uint8_t code() const noexcept {
        return static_cast<std::uint8_t>(static_cast<unsigned>(kind) << 3U | axis);
    }
    [[nodiscard]] static constexpr BindingLimit of(std::uint8_t code) noexcept {
        return {static_cast<LimitKind>(code >> 3U), static_cast<std::uint8_t>(code & 7U)};
    }
    friend constexpr bool operator==(const BindingLimit&, const BindingLimit&) = default;
};

/// Codes of all limits are below it.
inline constexpr std::size_t limit_codes = (static_cast<std::size_t>(LimitKind::dwell) + 1) << 3U;

/// "acceleration of x", "programmed feed". @param axes  names
[[nodiscard]] std::string limit_name(BindingLimit limit, std::span<const std::string> axes);

} // namespace splinefeed::host
