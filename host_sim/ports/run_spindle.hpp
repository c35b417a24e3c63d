// SPDX-License-Identifier: MIT
// RunSpindle: the spindle of a run on a real target.
#pragma once

#include <string>

namespace splinefeed::host {

/// All functions return at once and may be called by any thread. Once it has trouble, or end() was called, the spindle
/// is told to stop until it confirms, and takes no order any more.
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

} // namespace splinefeed::host
