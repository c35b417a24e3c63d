// SPDX-License-Identifier: MIT
// RunSwitches: coolant and digital outputs of a run on a real target.
#pragma once

#include "splinefeed/s0_program/program_event.hpp"

#include <string>

namespace splinefeed::host {

/// All functions return at once and may be called by any thread.
class RunSwitches {
public:
    RunSwitches() = default;
    RunSwitches(const RunSwitches&) = delete;
    RunSwitches& operator=(const RunSwitches&) = delete;
    virtual ~RunSwitches() = default;

    /// Carries out M7 to M9 and M62 to M65. Nothing after end(), or once there is trouble.
    /// @param number  of the output
    virtual void act(EventKind kind, std::int32_t number) = 0;
    /// Coolant off, and outputs as they are safe, for good.
    virtual void end() noexcept = 0;
    /// Why they are not as they should be; empty: they are.
    [[nodiscard]] virtual std::string trouble() const = 0;
    /// The first one that has not confirmed its last level yet; empty: all have.
    [[nodiscard]] virtual std::string unconfirmed() const { return {}; }

    /// Whether an event is one for switches.
    [[nodiscard]] static bool is_of(EventKind kind) noexcept {
        switch (kind) {
        case EventKind::mist_on:
        case EventKind::flood_on:
        case EventKind::coolant_off:
        case EventKind::output_on_with_motion:
        case EventKind::output_off_with_motion:
        case EventKind::output_on:
        case EventKind::output_off: return true;
        default: return false;
        }
    }
};

} // namespace splinefeed::host
