// SPDX-License-Identifier: MIT
// OutputParts: what events of programs act on or wait for in a run on a real target.
#pragma once

#include "splinefeed/s0_program/program_event.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace splinefeed::host {

/// The spindle. All functions return at once and may be called by any thread. Once it has trouble, or end() was called,
/// the spindle is told to stop until it confirms, and takes no order any more.
class RunSpindle {
public:
    RunSpindle() = default;
    RunSpindle(const RunSpindle&) = delete;
    RunSpindle& operator=(const RunSpindle&) = delete;
    virtual ~RunSpindle() = default;

    /// @param direction  1 clockwise, -1 counterclockwise, 0 not at all
    virtual void order(int direction, double rpm) = 0;
    /// Called each millisecond, by the thread that orders.
    virtual void update() {}
    /// Stops it for good.
    virtual void end() = 0;
    /// Whether the last order is carried out: it has its speed, or has taken the order to stop. Never after end().
    [[nodiscard]] virtual bool reached() const = 0;
    /// Whether it is known to stand: it was never told to turn, or has confirmed its standstill.
    [[nodiscard]] virtual bool stands() const = 0;
    /// Why it is not as ordered; empty: it is, or may still become so.
    [[nodiscard]] virtual std::string trouble() const = 0;
    /// How long it may take to come to a standstill. [s]
    [[nodiscard]] virtual double stop_timeout_s() const = 0;
};

/// Coolant and digital outputs. All functions return at once and may be called by any thread.
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

/// A level of an input.
struct InputReading {
    bool active = false;
    std::uint64_t asked_us = 0; ///< on the host's clock: the level is not older
};

/// Digital inputs. For one thread, but trouble(). All functions return at once.
class RunInputs {
public:
    RunInputs() = default;
    RunInputs(const RunInputs&) = delete;
    RunInputs& operator=(const RunInputs&) = delete;
    virtual ~RunInputs() = default;

    /// From now on this input is read; false: it is one of another kind.
    [[nodiscard]] virtual bool watch(std::int32_t number) = 0;
    /// Nothing is read any more.
    virtual void unwatch() = 0;
    /// A reading since watch() that was not taken yet.
    [[nodiscard]] virtual std::optional<InputReading> take() = 0;
    /// Why they cannot be read; empty: they can. May be called by any thread.
    [[nodiscard]] virtual std::string trouble() const = 0;
};

/// What of them one kind of line or wire has; null: nothing.
struct OutputParts {
    std::unique_ptr<RunSpindle> spindle{};
    std::shared_ptr<RunSwitches> switches{};
    std::shared_ptr<RunInputs> inputs{};
};

} // namespace splinefeed::host
