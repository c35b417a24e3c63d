// SPDX-License-Identifier: MIT
// Says a value by name, in 16 digits to the base 16, so that a host and a microcontroller can be compared line by line.
#pragma once

#include "platform.hpp"

#include <cstdint>

[[gnu::noinline]] inline void write_value(const char* name, std::uint64_t value) {
    constexpr char digits[] = "0123456789abcdef";
    char text[] = " 0x0000000000000000\n";
    for (unsigned i = 18; i > 2; --i) {
        text[i] = digits[value & 0xfU];
        value >>= 4;
    }
    write_text(name);
    write_text(text);
}
