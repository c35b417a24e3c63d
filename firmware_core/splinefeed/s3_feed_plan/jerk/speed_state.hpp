// SPDX-License-Identifier: MIT
// SpeedState: a motion along the path at one place.
#pragma once

namespace splinefeed {

/// b = v^2 and its slope db/ds, which is twice the acceleration along the path.
struct SpeedState {
    double b;     ///< [mm^2/s^2]
    double slope; ///< [mm/s^2]
};

} // namespace splinefeed
