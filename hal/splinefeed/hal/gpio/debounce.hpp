// SPDX-License-Identifier: MIT
// Debounce: the debounced level of one switch, and the instant of its last change. Integers only, no I/O, no
// allocation.
#pragma once

#include "splinefeed/base/units.hpp"
#include <cstdint>

namespace splinefeed::hal::gpio {

/// For one input. A level is accepted when it has lasted for the debounce time; with 0 at once. A time stamp that is
/// earlier than its predecessor is replaced by it.
class Debounce {
public:
    static constexpr std::uint64_t never = UINT64_MAX;

    /// @param level  initial level
    /// @param debounce_us  debounce time; 0: every edge is accepted
    constexpr Debounce(bool level, std::uint32_t debounce_us) noexcept
        : debounce_ns_(std::uint64_t{debounce_us} * ns_per_us), accepted_(level), raw_(level) {}

    /// Adds an edge to `level`. An edge to the present level means that an edge in between was lost; the debounce time
    /// then starts again. Returns true if the accepted level has changed by then, also if it changed to the level
    /// before this edge. Check it after every edge, or a short press goes unnoticed.
    constexpr bool edge(std::uint64_t time_ns, bool level) noexcept {
        const std::uint64_t now = time_ns > raw_since_ns_ ? time_ns : raw_since_ns_;
        const bool changed = settle(now);
        const bool was_quiet = raw_ == accepted_ && (!bouncing_ || now - raw_since_ns_ >= debounce_ns_);
        if (level != accepted_ && was_quiet) {
            first_ns_ = now;
            bouncing_ = true;
        }
        raw_ = level;
        raw_since_ns_ = now;
        return settle(now) || changed;
    }

    /// Adds a level that was read. If it differs from the last edge, an edge was lost. Returns as edge().
    constexpr bool sample(std::uint64_t now_ns, bool level) noexcept {
        return level != raw_ ? edge(now_ns, level) : settle(now_ns);
    }

    /// The accepted level at that instant.
    constexpr bool settled(std::uint64_t now_ns) noexcept {
        settle(now_ns);
        return accepted_;
    }

    /// Instant of the first edge to the accepted level, when the switch really changed: before the bounces and the
    /// debounce time. 0: no change since the start.
    [[nodiscard]] constexpr std::uint64_t since_ns() const noexcept { return accepted_since_ns_; }

    /// When the result of settled() will change unless another edge comes; `never` if no change is pending.
    [[nodiscard]] constexpr std::uint64_t due_ns() const noexcept {
        return raw_ == accepted_ ? never : raw_since_ns_ + debounce_ns_;
    }

private:
    constexpr bool settle(std::uint64_t now_ns) noexcept {
        if (raw_ == accepted_ || now_ns < raw_since_ns_ || now_ns - raw_since_ns_ < debounce_ns_) {
            return false;
        }
        accepted_ = raw_;
        accepted_since_ns_ = first_ns_;
        bouncing_ = false;
        return true;
    }

    std::uint64_t debounce_ns_;
    std::uint64_t raw_since_ns_ = 0;
    std::uint64_t first_ns_ = 0; ///< first edge of the present bounces
    std::uint64_t accepted_since_ns_ = 0;
    bool accepted_;
    bool raw_;
    bool bouncing_ = false; ///< the other level was reported since the last change or quiet period
};

} // namespace splinefeed::hal::gpio
