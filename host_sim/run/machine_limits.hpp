// SPDX-License-Identifier: MIT
// machine_limits: the limits of a machine file in the form that plans use.
#pragma once

#include "host_sim/config/machine_description.hpp"

namespace splinefeed::host {

/// Throws InputError if the numbers of the file do not go together; it names the axis and the key that is to blame.
template <Scalar S>
[[nodiscard]] MotionLimits<S> machine_limits(const MachineDescription& machine);

} // namespace splinefeed::host
