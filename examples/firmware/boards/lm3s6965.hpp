// SPDX-License-Identifier: MIT
// LM3S6965 on TI's evaluation board EKK-LM3S6965; QEMU: -M lm3s6965evb. A Cortex-M3 with 256 KB of flash and 64 KB of
// RAM, here at 50 MHz. Registers: "Stellaris LM3S6965 Microcontroller Data Sheet" (TI, SPMS019), chapters System
// Control, GPIOs, General-Purpose Timers, Watchdog Timer, UARTs. Buttons: EKK-LM3S6965 User's Manual, schematic.
//
//   PD0 PD1 PD2   step x, y, z           PF1   emergency stop: the button Select, low when pressed
//   PD4 PD5 PD6   direction, high: up    PE0   limit switch: the button Up, low when pressed
//   PD7           enable, high: on       PA0 PA1   UART0, which the board's USB adapter carries: 115200 baud, 8N1
//
// The buttons are there to try it out. An emergency stop of a machine is a contact that opens, so that a broken wire
// stops, too: then `estop_pressed_level` is 1, with the same pull-up.
#pragma once

#include "serial.hpp"
#include "step_generator.hpp"

#include "splinefeed/number/fixed.hpp"

#include <cstddef>
#include <cstdint>

namespace board {

constexpr const char* name = "lm3s6965";
using Real = splinefeed::Fixed;
constexpr unsigned tick_us = 50;
constexpr unsigned ticks_an_interrupt = 1;
constexpr unsigned pulse_us = tick_us;
constexpr unsigned segment_us = 1000;
constexpr unsigned steps_per_s = 8000;
constexpr std::size_t window = 20;
constexpr bool curves_through_points = false; // 6 KB of RAM, which it does not have
constexpr std::size_t parameters = 0;         // nor 1 KB for them
constexpr std::size_t parts = 128;
constexpr unsigned interrupts = 44;
constexpr int timer_interrupt = 19; // timer 0A

using Lines = firmware::PinLines<3>;
inline Lines lines() {
    return {};
}

constexpr std::uint32_t clock_hz = 50'000'000;
constexpr std::uint32_t estop_pressed_level = 0;
constexpr std::uint32_t limit_pressed_level = 0;

inline volatile std::uint32_t& reg(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

// System Control
constexpr std::uintptr_t RIS = 0x400fe050;
constexpr std::uintptr_t RESC = 0x400fe05c;
constexpr std::uintptr_t RCC = 0x400fe060;
constexpr std::uintptr_t RCGC0 = 0x400fe100;
constexpr std::uintptr_t RCGC1 = 0x400fe104;
constexpr std::uintptr_t RCGC2 = 0x400fe108;

constexpr std::uintptr_t PORT_A = 0x40004000;
constexpr std::uintptr_t PORT_D = 0x40007000;
constexpr std::uintptr_t PORT_E = 0x40024000;
constexpr std::uintptr_t PORT_F = 0x40025000;
/// GPIODATA: the address says which pins an access is for.
inline volatile std::uint32_t& pins(std::uintptr_t port, std::uint32_t mask) {
    return reg(port + (mask << 2));
}
constexpr std::uintptr_t GPIODIR = 0x400;
constexpr std::uintptr_t GPIOAFSEL = 0x420;
constexpr std::uintptr_t GPIOPUR = 0x510;
constexpr std::uintptr_t GPIODEN = 0x51c;

constexpr std::uintptr_t UART0 = 0x4000c000;
constexpr std::uintptr_t UARTDR = UART0 + 0x000;
constexpr std::uintptr_t UARTFR = UART0 + 0x018;
constexpr std::uintptr_t UARTIBRD = UART0 + 0x024;
constexpr std::uintptr_t UARTFBRD = UART0 + 0x028;
constexpr std::uintptr_t UARTLCRH = UART0 + 0x02c;
constexpr std::uintptr_t UARTCTL = UART0 + 0x030;

constexpr std::uintptr_t TIMER0 = 0x40030000;
constexpr std::uintptr_t GPTMCFG = TIMER0 + 0x000;
constexpr std::uintptr_t GPTMTAMR = TIMER0 + 0x004;
constexpr std::uintptr_t GPTMCTL = TIMER0 + 0x00c;
constexpr std::uintptr_t GPTMIMR = TIMER0 + 0x018;
constexpr std::uintptr_t GPTMICR = TIMER0 + 0x024;
constexpr std::uintptr_t GPTMTAILR = TIMER0 + 0x028;

constexpr std::uintptr_t WDTLOAD = 0x40000000;
constexpr std::uintptr_t WDTCTL = 0x40000008;
constexpr std::uintptr_t WDTICR = 0x4000000c;
constexpr std::uintptr_t WDTLOCK = 0x40000c00;

constexpr std::uintptr_t NVIC_ISER = 0xe000e100;

constexpr std::uint32_t step_pins = 0x07;
constexpr std::uint32_t direction_pins = 0x70;
constexpr std::uint32_t enable_pin = 0x80;

/// 200 MHz / 4, from the crystal of 8 MHz, by the steps of the data sheet's "Initialization and Configuration".
inline void start_clock() {
    std::uint32_t rcc = reg(RCC);
    rcc = (rcc | 1U << 11) & ~(1U << 22); // BYPASS the PLL, no divider
    reg(RCC) = rcc;
    rcc = (rcc & ~(0xfU << 6 | 3U << 4 | 1U << 13 | 1U)) | 0xeU << 6; // XTAL 8 MHz, main oscillator on, PLL on
    reg(RCC) = rcc;
    rcc = (rcc & ~(0xfU << 23)) | 3U << 23 | 1U << 22; // SYSDIV 4
    reg(RCC) = rcc;
    while ((reg(RIS) & 1U << 6) == 0) { // until the PLL has locked
    }
    reg(RCC) = rcc & ~(1U << 11);
}

inline void start() {
    start_clock();
    reg(RCGC0) = reg(RCGC0) | 1U << 3;                          // watchdog
    reg(RCGC1) = reg(RCGC1) | 1U << 16 | 1U;                    // timer 0, UART0
    reg(RCGC2) = reg(RCGC2) | 1U << 5 | 1U << 4 | 1U << 3 | 1U; // ports F, E, D, A
    __asm__ volatile("nop\n nop\n nop");                        // three clocks until they can be used

    constexpr std::uint32_t outputs = step_pins | direction_pins | enable_pin;
    pins(PORT_D, outputs) = 0;
    reg(PORT_D + GPIODIR) = outputs;
    reg(PORT_D + GPIODEN) = outputs;
    reg(PORT_F + GPIOPUR) = 1U << 1;
    reg(PORT_F + GPIODEN) = 1U << 1;
    reg(PORT_E + GPIOPUR) = 1U;
    reg(PORT_E + GPIODEN) = 1U;
    reg(PORT_A + GPIOAFSEL) = 3;
    reg(PORT_A + GPIODEN) = 3;

    constexpr std::uint32_t baud_64ths = (clock_hz * 4 + 115200 / 2) / 115200; // clock / (16 baud), 6 bits of fraction
    reg(UARTIBRD) = baud_64ths >> 6;
    reg(UARTFBRD) = baud_64ths & 0x3f;
    reg(UARTLCRH) = 3U << 5 | 1U << 4; // 8 bits, FIFOs
    reg(UARTCTL) = 3U << 8 | 1U;       // receive, transmit, on
}

inline void start_timer() {
    reg(GPTMCFG) = 0;  // 32 bits
    reg(GPTMTAMR) = 2; // periodic
    reg(GPTMTAILR) = clock_hz / 1'000'000 * tick_us - 1;
    reg(GPTMIMR) = 1;
    reg(NVIC_ISER) = 1U << timer_interrupt;
    reg(GPTMCTL) = 1;
}
inline void acknowledge_tick() {
    reg(GPTMICR) = 1;
}

/// The first time-out, after a quarter of a second, is an interrupt that nothing is enabled for; the second resets.
inline void start_watchdog() {
    reg(WDTLOCK) = 0x1acce551;
    reg(WDTLOAD) = clock_hz / 4;
    reg(WDTCTL) = 3;
}
inline void feed_watchdog() {
    reg(WDTICR) = 1;
}
inline bool watchdog_bit() {
    const bool bit = (reg(RESC) & 1U << 3) != 0;
    reg(RESC) = 0;
    return bit;
}

inline void write_lines(firmware::Pins lines) {
    pins(PORT_D, direction_pins) = lines.up << 4;
    pins(PORT_D, step_pins) = lines.step;
}
template <class Tick>
inline void run_ticks(Tick&& tick) {
    tick([](firmware::Pins lines) { write_lines(lines); });
}
inline void enable_drives(bool on) {
    pins(PORT_D, enable_pin) = on ? enable_pin : 0;
}
inline firmware::Inputs read_inputs() {
    return {pins(PORT_F, 1U << 1) >> 1 == estop_pressed_level, pins(PORT_E, 1U) == limit_pressed_level};
}

inline std::uint32_t line_session() {
    return 0;
}
inline int read_byte() {
    if ((reg(UARTFR) & 1U << 4) != 0) {
        return firmware::Serial::nothing;
    }
    const std::uint32_t data = reg(UARTDR);
    return (data & 0xf00U) != 0 ? firmware::Serial::lost
                                : static_cast<int>(data & 0xffU); // overrun, break, parity, framing
}
inline bool write_byte(std::uint8_t byte) {
    const bool room = (reg(UARTFR) & 1U << 5) == 0;
    if (room) {
        reg(UARTDR) = byte;
    }
    return room;
}

} // namespace board
