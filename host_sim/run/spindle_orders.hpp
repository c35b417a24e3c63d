// SPDX-License-Identifier: MIT
// SpindleOrders: passes the orders of a program to the spindle when the machine itself has come to their place.
#pragma once

#include "host_sim/program/program_action.hpp"

namespace splinefeed::host {

/// For the planner's thread.
class SpindleOrders {
public:
    /// The spindle gets the order when everything that was submitted before is executed. @pre spindle_reached()
    virtual void order_spindle(const SpindleTurn& turn) = 0;
    /// Whether the last order is carried out.
    [[nodiscard]] virtual bool spindle_reached() const = 0;

protected:
    SpindleOrders() = default;
    SpindleOrders(const SpindleOrders&) = default;
    SpindleOrders& operator=(const SpindleOrders&) = default;
    ~SpindleOrders() = default;
};

} // namespace splinefeed::host
