// SPDX-License-Identifier: MIT
// PortFailure: why a port cannot begin, or has stopped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace splinefeed::hal {

/// What the program that uses a port can change, so that the next run does not fail for this.
enum class Remedy : std::uint8_t {
    none,
    reset,        ///< prepare() resets the fault, if its settings ask for that
    omit_home,    ///< prepare() does not home, if its settings do not ask for that
    home,         ///< prepare() homes, if its settings ask for that
    clear_switch, ///< a home switch acts where its axis should be off it: more pull-off, or its wire
};

struct PortFailure {
    std::string what;      ///< for the user: what is wrong, and what to check; empty: nothing is wrong
    std::size_t drive = 0; ///< index of the drive; 0 where the port has only one
    Remedy remedy = Remedy::none;

    /// Whether something is wrong.
    [[nodiscard]] explicit operator bool() const noexcept { return !what.empty(); }
};

} // namespace splinefeed::hal
