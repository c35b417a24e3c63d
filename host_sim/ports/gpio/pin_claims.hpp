// SPDX-License-Identifier: MIT
// PinClaims: lines of a GPIO chip that this program alone uses.
#pragma once

#include "host_sim/base/resource_claim.hpp"

#include "splinefeed/hal/gpio/pin_map.hpp"

#include <list>

namespace splinefeed::host {

/// The kernel refuses a line that somebody has, and knows no process: this one is named here. A line that another
/// program names in another way is left to the kernel.
class PinClaims {
public:
    /// Throws hal::gpio::GpioError, which names the program that has one of them.
    explicit PinClaims(const hal::gpio::ChipPins& chip);

private:
    void add(const std::string& chip, const hal::gpio::PinName& line);

    std::list<ResourceClaim> claims_;
};

} // namespace splinefeed::host
