// SPDX-License-Identifier: MIT
// CrashGuard: what a program that crashes leaves its output lines at.
#pragma once

#include "splinefeed/hal/gpio/output_lines.hpp"

#include <span>

namespace splinefeed::hal::gpio {

/// While one lives, signals that end the program for a fault of its own (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT,
/// SIGQUIT, SIGXCPU, SIGSYS) make the lines safe first. One at a time. What SIGKILL leaves is the chip's own business.
class CrashGuard {
public:
    static constexpr std::size_t most_chips = 16;

    /// @param chips  at most 16; they outlive it
    explicit CrashGuard(std::span<OutputLines* const> chips) noexcept;
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;
    ~CrashGuard();
};

} // namespace splinefeed::hal::gpio
