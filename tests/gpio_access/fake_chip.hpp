// SPDX-License-Identifier: MIT
//
// A chip without a kernel, in place of pins_v1.cpp or pins_v2.cpp: the linker takes what is defined here first, and
// this is all that those define. Lines 0 to 3 are A to D.
#pragma once

#include "splinefeed/hal/gpio/chip_access.hpp"

#include <functional>

namespace splinefeed_test {

struct FakeChip {
    struct Write {
        std::uint64_t mask;
        std::uint64_t levels;

        friend bool operator==(const Write&, const Write&) = default;
    };

    std::uint64_t requested_levels = 0;
    std::vector<unsigned> offsets;
    std::vector<Write> writes;
    int write_error = 0;           ///< errno of every write; 0: they succeed
    std::function<void()> between; ///< runs once, before the next write reaches the chip
    bool released = false;

    std::vector<splinefeed::hal::gpio::InputEvent> events;
    int wait_error = 0;
    std::uint64_t waited_ns = 0;
};

/// The one that all requests go to.
inline FakeChip fake_chip;

} // namespace splinefeed_test
