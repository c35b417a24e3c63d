// SPDX-License-Identifier: MIT
// Says a number in decimal.
#pragma once

#include "platform.hpp"

#include <cstdint>

[[gnu::noinline]] inline void write_number(std::uint32_t value) {
    char text[11] = {};
    char* digit = text + sizeof text - 1;
    do {
        *--digit = static_cast<char>('0' + value % 10);
        value /= 10;
    } while (value != 0);
    write_text(digit);
}
