// SPDX-License-Identifier: MIT
// CrashGuard: sets output lines to their safe levels when the program crashes.
#pragma once

#include "splinefeed/hal/gpio/output_pins.hpp"

#include <array>
#include <span>

namespace splinefeed::hal::gpio {

/// While an object exists, signals that would end the program and that nobody handles or ignores (crashes, SIGQUIT,
/// SIGPIPE, SIGXFSZ, SIGALRM, ...) first set the lines to their safe levels. A handler that the program sets stays.
/// Objects are made and destroyed by one thread. SIGKILL cannot be handled: the chip then decides what the lines do.
class CrashGuard {
public:
    static constexpr std::size_t most_chips = 16; ///< of all objects

    /// @param chips  must outlive the guard
    explicit CrashGuard(std::span<OutputPins* const> chips) noexcept;
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;
    ~CrashGuard();

private:
    std::array<OutputPins*, most_chips> own_{}; // null: not this object's
};

} // namespace splinefeed::hal::gpio
