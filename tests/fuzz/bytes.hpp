// SPDX-License-Identifier: MIT
// Bytes: what a fuzzer made, taken apart.
#pragma once

#include <cstddef>
#include <cstdint>

namespace splinefeed_test {

/// The input, byte by byte; zeros behind its end.
struct Bytes {
    const std::uint8_t* data;
    std::size_t left;

    std::uint8_t take() {
        if (left == 0) {
            return 0;
        }
        --left;
        return *data++;
    }
    std::uint16_t take16() {
        const unsigned high = take();
        return static_cast<std::uint16_t>(high << 8U | take());
    }
};

} // namespace splinefeed_test
