// SPDX-License-Identifier: MIT
// nRF51822 on the BBC micro:bit, version 1; QEMU: -M microbit. A Cortex-M0 with 256 KB of flash and 16 KB of RAM, at
// 16 MHz: slow, but it moves. Registers: Nordic's "nRF51 Series Reference Manual", version 3, chapters CLOCK, POWER,
// GPIO, TIMER, UART, WDT. Pins: the schematic of the micro:bit.
//
//   P0.01 P0.02 P0.03   step x, y, z: rings 2, 1, 0          P0.17   emergency stop: button A, low when pressed
//   P0.21 P0.22 P0.23   direction, high: up: pins 15 14 13   P0.26   limit switch: button B, low when pressed
//   P0.20               enable, high: on: pin 12             P0.24 P0.25   UART of the USB adapter: 38400 baud, 8N1
//
// The buttons are there to try it out. An emergency stop of a machine is a contact that opens, so that a broken wire
// stops, too: then `pressed_level` of it is 1.
#pragma once

#include "serial.hpp"
#include "step_generator.hpp"

#include <cstddef>
#include <cstdint>

namespace board {

constexpr const char* name = "nrf51";
using Real = float;
constexpr unsigned tick_us = 200;
constexpr unsigned ticks_an_interrupt = 1;
constexpr unsigned pulse_us = tick_us;
constexpr unsigned segment_us = 8000;
constexpr unsigned steps_per_s = 2000;
constexpr std::size_t window = 10;
constexpr std::size_t parts = 28;
constexpr unsigned interrupts = 32;
constexpr int timer_interrupt = 8; // TIMER0

using Lines = firmware::PinLines<3>;
inline Lines lines() {
    return {};
}

constexpr std::uint32_t clock_hz = 16'000'000;
constexpr std::uint32_t estop_pressed_level = 0;
constexpr std::uint32_t limit_pressed_level = 0;

inline volatile std::uint32_t& reg(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

constexpr std::uintptr_t HFCLKSTART = 0x40000000;
constexpr std::uintptr_t HFCLKSTARTED = 0x40000100;
constexpr std::uintptr_t RESETREAS = 0x40000400;

constexpr std::uintptr_t UART = 0x40002000;
constexpr std::uintptr_t STARTRX = UART + 0x000;
constexpr std::uintptr_t STARTTX = UART + 0x008;
constexpr std::uintptr_t RXDRDY = UART + 0x108;
constexpr std::uintptr_t TXDRDY = UART + 0x11c;
constexpr std::uintptr_t UART_ERROR = UART + 0x124;
constexpr std::uintptr_t ERRORSRC = UART + 0x480;
constexpr std::uintptr_t UART_ENABLE = UART + 0x500;
constexpr std::uintptr_t PSELTXD = UART + 0x50c;
constexpr std::uintptr_t PSELRXD = UART + 0x514;
constexpr std::uintptr_t RXD = UART + 0x518;
constexpr std::uintptr_t TXD = UART + 0x51c;
constexpr std::uintptr_t BAUDRATE = UART + 0x524;

constexpr std::uintptr_t TIMER0 = 0x40008000;
constexpr std::uintptr_t TIMER_START = TIMER0 + 0x000;
constexpr std::uintptr_t COMPARE0 = TIMER0 + 0x140;
constexpr std::uintptr_t SHORTS = TIMER0 + 0x200;
constexpr std::uintptr_t INTENSET = TIMER0 + 0x304;
constexpr std::uintptr_t BITMODE = TIMER0 + 0x508;
constexpr std::uintptr_t PRESCALER = TIMER0 + 0x510;
constexpr std::uintptr_t CC0 = TIMER0 + 0x540;

constexpr std::uintptr_t WDT_START = 0x40010000;
constexpr std::uintptr_t WDT_CRV = 0x40010504;
constexpr std::uintptr_t WDT_RR0 = 0x40010600;

constexpr std::uintptr_t GPIO_OUT = 0x50000504;
constexpr std::uintptr_t GPIO_OUTSET = 0x50000508;
constexpr std::uintptr_t GPIO_OUTCLR = 0x5000050c;
constexpr std::uintptr_t GPIO_IN = 0x50000510;
constexpr std::uintptr_t GPIO_DIRSET = 0x50000518;
constexpr std::uintptr_t PIN_CNF = 0x50000700;

constexpr std::uintptr_t NVIC_ISER = 0xe000e100;

constexpr unsigned step_shift = 1;
constexpr unsigned direction_shift = 21;
constexpr std::uint32_t line_pins = 7U << step_shift | 7U << direction_shift;
constexpr std::uint32_t enable_pin = 1U << 20;
constexpr unsigned estop_pin = 17;
constexpr unsigned limit_pin = 26;

inline bool sending = false; // a byte was written: TXDRDY comes when it has gone

inline void start() {
    reg(HFCLKSTART) = 1;
    while (reg(HFCLKSTARTED) == 0) { // until the crystal runs: the UART needs it
    }
    reg(GPIO_OUTCLR) = line_pins | enable_pin;
    reg(GPIO_DIRSET) = line_pins | enable_pin | 1U << 24;
    reg(PIN_CNF + 4 * estop_pin) = 3U << 2; // input, pull-up
    reg(PIN_CNF + 4 * limit_pin) = 3U << 2;
    reg(PSELTXD) = 24;
    reg(PSELRXD) = 25;
    reg(BAUDRATE) = 0x009d5000; // 38400
    reg(UART_ENABLE) = 4;
    reg(STARTTX) = 1;
    reg(STARTRX) = 1;
}

inline void start_timer() {
    reg(BITMODE) = 3; // 32 bits
    reg(PRESCALER) = 0;
    reg(CC0) = clock_hz / 1'000'000 * tick_us;
    reg(SHORTS) = 1; // the comparison clears the counter
    reg(INTENSET) = 1U << 16;
    reg(NVIC_ISER) = 1U << timer_interrupt;
    reg(TIMER_START) = 1;
}
inline void acknowledge_tick() {
    reg(COMPARE0) = 0;
}

inline void start_watchdog() {
    reg(WDT_CRV) = 32768 / 2 - 1; // half a second
    reg(WDT_START) = 1;
}
inline void feed_watchdog() {
    reg(WDT_RR0) = 0x6e524635;
}
inline bool watchdog_bit() {
    const std::uint32_t reason = reg(RESETREAS);
    reg(RESETREAS) = reason;
    return (reason & 2) != 0;
}

/// Read and written in the interrupt: nothing comes between. The main loop sets the enable line by OUTSET.
inline void write_lines(firmware::Pins lines) {
    reg(GPIO_OUT) = (reg(GPIO_OUT) & ~line_pins) | lines.step << step_shift | lines.up << direction_shift;
}
template <class Tick>
inline void run_ticks(Tick&& tick) {
    tick([](firmware::Pins lines) { write_lines(lines); });
}
inline void enable_drives(bool on) {
    reg(on ? GPIO_OUTSET : GPIO_OUTCLR) = enable_pin;
}
inline firmware::Inputs read_inputs() {
    const std::uint32_t levels = reg(GPIO_IN);
    return {(levels >> estop_pin & 1U) == estop_pressed_level, (levels >> limit_pin & 1U) == limit_pressed_level};
}

inline std::uint32_t line_session() {
    return 0;
}
inline int read_byte() {
    if (reg(UART_ERROR) != 0) {
        reg(UART_ERROR) = 0;
        reg(ERRORSRC) = reg(ERRORSRC); // overrun, parity, framing, break
        return firmware::Serial::lost;
    }
    if (reg(RXDRDY) == 0) {
        return firmware::Serial::nothing;
    }
    reg(RXDRDY) = 0; // before the byte is taken: it may be set again at once
    return static_cast<int>(reg(RXD) & 0xffU);
}
inline bool write_byte(std::uint8_t byte) {
    if (sending && reg(TXDRDY) == 0) {
        return false;
    }
    reg(TXDRDY) = 0;
    sending = true;
    reg(TXD) = byte;
    return true;
}

} // namespace board
