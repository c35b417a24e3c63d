// SPDX-License-Identifier: MIT
// A firmware for usb_test.mjs: sends back each byte that comes by USB, as its tick of 200 us does. GPIO2 is high while
// the port is open; GPIO3 changes when it is opened.
#include "rp2040/usb_serial.hpp"

#include "splinefeed/base/slot.hpp"

namespace {

volatile std::uint32_t& reg(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}
constexpr std::uintptr_t IO_BANK0 = 0x40014000;
constexpr std::uintptr_t TIMERAWL = 0x40054028;
constexpr std::uintptr_t GPIO_OUT = 0xd0000010;
constexpr std::uintptr_t GPIO_OE_SET = 0xd0000024;

splinefeed::Slot<rp2040::UsbRegisters> registers;
splinefeed::Slot<rp2040::UsbSerial> usb;

void tick(int& kept) {
    usb->poll();
    reg(GPIO_OUT) = (usb->is_open() ? 1U : 0U) << 2 | (usb->sessions() & 1U) << 3;
    for (int i = 0; i < 128; ++i) {
        kept = kept < 0 ? usb->read_byte() : kept;
        if (kept < 0 || !usb->write_byte(static_cast<std::uint8_t>(kept))) {
            break;
        }
        kept = -1;
    }
}

void on_fault() {
    for (;;) {
    }
}

} // namespace

int main() {
    constexpr std::uint32_t blocks = 1U << 5 | 1U << 8 | 1U << 21; // IO_BANK0, PADS_BANK0, TIMER
    reg(rp2040::RESETS_CLR) = blocks;
    while (~reg(rp2040::RESET_DONE) & blocks) {
    }
    reg(IO_BANK0 + 8 * 2 + 4) = 5; // SIO
    reg(IO_BANK0 + 8 * 3 + 4) = 5;
    reg(GPIO_OUT) = 0;
    reg(GPIO_OE_SET) = 3U << 2;
    usb.build(registers.build()).start();
    int kept = -1;
    for (std::uint32_t next = reg(TIMERAWL);; next += 200) {
        while (static_cast<std::int32_t>(reg(TIMERAWL) - next) < 0) {
        }
        tick(kept);
    }
}

namespace {

extern "C" std::uint32_t stack_top[];

struct Vectors {
    std::uint32_t* stack;
    void (*of[15])();
};

[[gnu::used, gnu::section(".vectors")]] const Vectors vectors = {stack_top, {[] { main(); }, on_fault, on_fault}};

} // namespace
