// SPDX-License-Identifier: MIT
// FNV-1a, 64 bits, over the bytes of integers in little-endian order, whatever the machine's order is.
#pragma once

#include <cstdint>

class IntegerHash {
public:
    void add(std::uint64_t value) {
        for (int i = 0; i < 8; ++i) {
            state_ = (state_ ^ (value & 0xffU)) * 0x100000001b3U;
            value >>= 8;
        }
    }
    [[nodiscard]] std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xcbf29ce484222325U;
};
