// SPDX-License-Identifier: MIT
// A board of three axes whose clock runs as often as it is read: it runs a sketch until nothing has happened for long,
// and says where its axes are.
#include "Arduino.h"
#include "write_number.hpp"

extern "C" {

// Places that the linker script names.
extern void (*const first_constructor[])();
extern void (*const last_constructor[])();

} // extern "C"

namespace {

constexpr int axes = 3;
int levels[2 + 2 * axes];
std::int32_t counts[axes];
std::uint32_t now_us;
std::uint32_t idle;

} // namespace

void pinMode(int, int) {}

void digitalWrite(int pin, int level) {
    idle = 0;
    // Steps are pins 2 to 4, their directions 5 to 7.
    if (pin < 2 + axes && level == HIGH && levels[pin] == LOW) {
        counts[pin - 2] += levels[pin + axes] == HIGH ? 1 : -1;
    }
    levels[pin] = level;
}

std::uint32_t micros() {
    return now_us++;
}

int main() {
    for (void (*const* constructor)() = first_constructor; constructor != last_constructor; ++constructor) {
        (*constructor)();
    }
    setup();
    for (; idle < 1000; ++idle) {
        loop();
    }
    for (const std::int32_t count : counts) {
        write_text(count < 0 ? " -" : " ");
        write_number(static_cast<std::uint32_t>(count < 0 ? -count : count));
    }
    write_text("\n");
    return 0;
}
