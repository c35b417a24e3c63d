// SPDX-License-Identifier: MIT
// ProgramOrders: passes what a program orders to the outputs and inputs when the machine itself has come to its place.
#pragma once

#include "host_sim/program/program_action.hpp"

namespace splinefeed::host {

/// For the planner's thread.
class ProgramOrders {
public:
    /// The outputs get the order when everything that was submitted before is executed, in order.
    /// @param standing  the machine stands there: it has done so for a moment then
    virtual void order(const ProgramAction& action, bool standing) = 0;
    /// Whether all orders are carried out: the spindle has its speed, the input has answered.
    [[nodiscard]] virtual bool carried_out() const = 0;
    /// The answer of the last M66: 0 or 1, -1 after its time-out. @pre it was ordered, and carried_out()
    [[nodiscard]] virtual int input() const = 0;
    /// Whether the spindle is known to stand.
    [[nodiscard]] virtual bool spindle_stands() const = 0;

protected:
    ProgramOrders() = default;
    ProgramOrders(const ProgramOrders&) = default;
    ProgramOrders& operator=(const ProgramOrders&) = default;
    ~ProgramOrders() = default;
};

} // namespace splinefeed::host
