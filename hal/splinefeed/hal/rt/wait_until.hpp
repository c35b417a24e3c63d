// SPDX-License-Identifier: MIT
// wait_until: the one loop that waits for a condition. It has a bound, and a sentence for when the bound is over.
#pragma once

#include "splinefeed/hal/rt/clock.hpp"

#include <cstdint>

namespace splinefeed::hal {

/// Returns null once the condition holds, and `sentence` once it has not held for bound_us. The condition is asked
/// first, and then each interval_us.
/// @param sentence  why waiting ended, for the user: "it does not report that it is enabled"
template <class Condition>
[[nodiscard]] const char* wait_until(Clock& clock, Condition&& condition, std::uint64_t bound_us, const char* sentence,
                                     std::uint64_t interval_us = 1000) {
    const std::uint64_t until_us = clock.now_us() + bound_us;
    while (!condition()) {
        if (clock.now_us() >= until_us) {
            return sentence;
        }
        clock.sleep_us(interval_us);
    }
    return nullptr;
}

} // namespace splinefeed::hal
