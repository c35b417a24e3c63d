// SPDX-License-Identifier: MIT
// The boards' SysTick goes on 25 times a microsecond, and with -icount shift=10 every instruction takes 1.024 us, in
// the emulator's time: 25.6 of its counts. The counter has 24 bits and counts down.
#include "instructions.hpp"

namespace {

struct SysTick {
    volatile std::uint32_t control;
    volatile std::uint32_t reload;
    volatile std::uint32_t value;
};

SysTick& sys_tick() {
    return *reinterpret_cast<SysTick*>(0xe000e010);
}

std::uint32_t last;
std::uint32_t counts; // modulo 2^32

} // namespace

void start_counting() {
    sys_tick().reload = 0xffffff;
    sys_tick().value = 0;
    sys_tick().control = 5; // on, from the processor's clock
    last = sys_tick().value;
}

std::uint32_t instructions_now() {
    const std::uint32_t value = sys_tick().value;
    counts += (last - value) & 0xffffffU;
    last = value;
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(counts) * 10 + 128) >> 8);
}
