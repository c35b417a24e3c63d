// SPDX-License-Identifier: MIT
// OutputPart: what events of programs act on or wait for of one kind on one kind of wire.
#pragma once

#include "host_sim/program/program_action.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

/// A level of an input.
struct InputReading {
    bool active = false;
    std::uint64_t asked_us = 0; ///< on the host's clock: the level is not older
};

/// A spindle; coolant and digital outputs; digital inputs. All functions return at once, and but for act(), update()
/// and take(), which one thread calls, they may be called by any thread. Once it has trouble, or end() was called,
/// nothing is turned on any more, and what was on is told to stop until it confirms.
class OutputPart {
public:
    /// Of a spindle.
    struct Progress {
        bool carried_out = true;     ///< it has its speed, or has taken the order to stop. Never after end()
        bool stands = true;          ///< it is known to: it was never told to turn, or has confirmed its standstill
        double stop_timeout_s = 0.0; ///< how long it may take to come to a standstill
        double coasts_s = 0.0;       ///< behind its end, where nobody can ask it whether it stands
    };

    OutputPart() = default;
    OutputPart(const OutputPart&) = delete;
    OutputPart& operator=(const OutputPart&) = delete;
    virtual ~OutputPart() = default;

    /// Carries out what is its own of an event, and leaves the rest to others. M66 begins the reading of an input; of a
    /// number that it does not have, it ends that.
    virtual void act(const ProgramAction& action) = 0;
    /// Called each millisecond.
    virtual void update() {}
    /// The spindle stops, coolant is off, outputs are as they are safe, for good.
    virtual void end() noexcept {}
    [[nodiscard]] virtual Progress progress() const { return {}; }
    /// A reading of the input since act() that was not taken yet.
    [[nodiscard]] virtual std::optional<InputReading> take() { return std::nullopt; }
    /// Why it is not as ordered; empty: it is, or may still become so.
    [[nodiscard]] virtual std::string trouble() const = 0;
    /// The first output that has not confirmed its last level yet; empty: all have.
    [[nodiscard]] virtual std::string unconfirmed() const { return {}; }
};

using OutputParts = std::vector<std::shared_ptr<OutputPart>>;

} // namespace splinefeed::host
