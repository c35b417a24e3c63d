// SPDX-License-Identifier: MIT
// PlannedCell: a cell in the window of a plan, with its speeds.
#pragma once

#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"

namespace splinefeed {

/// A cell with its speeds. `entry_sq` and `exit_sq` are v^2 at its ends; they are valid once it is the front of the
/// plan.
template <Scalar S>
struct PlannedCell {
    Cell<S> cell{};
    S entry_sq{};
    S exit_sq{};
    CapLine<S> cap{};     ///< what the machine allows, whatever the programmed feed
    PeakSpeeds<S> peak{}; ///< the fastest entry, whatever comes after the cell
};

} // namespace splinefeed
