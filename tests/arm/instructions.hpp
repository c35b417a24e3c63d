// SPDX-License-Identifier: MIT
// What a piece of the program costs, in instructions; on the host always 0.
#pragma once

#include <cstdint>

void start_counting();
/// Instructions since start_counting(), modulo 2^24 / 25. In QEMU only, with -icount shift=10.
std::uint32_t instructions_now();
