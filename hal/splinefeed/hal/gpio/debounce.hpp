// SPDX-License-Identifier: MIT
// Debounce: which level of a bouncing switch counts, and since when. Integers, no I/O, no allocation.
#pragma once

#include <cstdint>

namespace splinefeed::hal::gpio {

/// For one input. A level counts when it has lasted for the time of debouncing; with 0 at once. Time stamps do not go
/// back; one that does is taken as the latest before.
class Debounce {
public:
    static constexpr std::uint64_t never = UINT64_MAX;

    /// @param level  what counts at first
    /// @param debounce_us  0: every edge counts
    constexpr Debounce(bool level, std::uint32_t debounce_us) noexcept
        : debounce_ns_(std::uint64_t{debounce_us} * ns_per_us), accepted_(level), raw_(level) {}

    /// An edge to that level. One to the level that already is means that edges in between got lost: the switch moved,
    /// and the time starts anew. Returns whether what counts has changed by then, be it to the level before this edge:
    /// ask after every edge, or a short press is not noticed.
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

    /// A level that was read, not told by an edge: where it is another one, an edge got lost. Returns as edge() does.
    constexpr bool sample(std::uint64_t now_ns, bool level) noexcept {
        return level != raw_ ? edge(now_ns, level) : settle(now_ns);
    }

    /// The level that counts.
    constexpr bool settled(std::uint64_t now_ns) noexcept {
        settle(now_ns);
        return accepted_;
    }

    /// The first edge to the level that counts: when the switch really closed, the time of debouncing and the bounces
    /// before settled() told. 0: it has counted from the start.
    [[nodiscard]] constexpr std::uint64_t since_ns() const noexcept { return accepted_since_ns_; }

    /// When settled() will tell something else unless another edge comes; never, where nothing is under way.
    [[nodiscard]] constexpr std::uint64_t due_ns() const noexcept {
        return raw_ == accepted_ ? never : raw_since_ns_ + debounce_ns_;
    }

private:
    static constexpr std::uint64_t ns_per_us = 1000;

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
    std::uint64_t first_ns_ = 0; ///< of the bounces that are under way
    std::uint64_t accepted_since_ns_ = 0;
    bool accepted_;
    bool raw_;
    bool bouncing_ = false; ///< the other level was seen since the last change, or since it was quiet again
};

} // namespace splinefeed::hal::gpio
