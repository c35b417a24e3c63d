// SPDX-License-Identifier: MIT
// STM32F405 with a crystal of 25 MHz, such as the Netduino Plus 2; QEMU: -M netduinoplus2. A Cortex-M4 with a floating
// point unit, 1 MB of flash and 128 KB of RAM, here at 168 MHz. Registers: ST's reference manual RM0090, chapters
// Embedded Flash, RCC, GPIO, USART, IWDG; the processor's SysTick: Armv7-M Architecture Reference Manual.
//
//   PC0 PC1 PC2   step x, y, z           PB0   emergency stop: a contact to ground that opens
//   PC4 PC5 PC6   direction, high: up    PB1   limit switches, in series: contacts to ground that open
//   PC7           enable, high: on       PA9 PA10   USART1: 115200 baud, 8N1
#pragma once

#include "serial.hpp"
#include "step_generator.hpp"

#include <cstddef>
#include <cstdint>

namespace board {

constexpr const char* name = "stm32f405";
using Real = float;
constexpr unsigned tick_us = 50;
constexpr unsigned ticks_an_interrupt = 1;
constexpr unsigned pulse_us = tick_us;
constexpr unsigned segment_us = 1000;
constexpr unsigned steps_per_s = 8000;
constexpr std::size_t window = 64;
constexpr bool curves_through_points = true;
constexpr std::size_t parameters = 200;
constexpr std::size_t parts = 128;
constexpr unsigned interrupts = 82;
constexpr int timer_interrupt = -1; // SysTick, the vector before those of the chip

using Lines = firmware::PinLines<3>;
inline Lines lines() {
    return {};
}

constexpr std::uint32_t clock_hz = 168'000'000;
constexpr std::uint32_t crystal_mhz = 25;
constexpr std::uint32_t apb2_hz = clock_hz / 2;

inline volatile std::uint32_t& reg(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

constexpr std::uintptr_t RCC_CR = 0x40023800;
constexpr std::uintptr_t RCC_PLLCFGR = 0x40023804;
constexpr std::uintptr_t RCC_CFGR = 0x40023808;
constexpr std::uintptr_t RCC_AHB1ENR = 0x40023830;
constexpr std::uintptr_t RCC_APB2ENR = 0x40023844;
constexpr std::uintptr_t RCC_CSR = 0x40023874;
constexpr std::uintptr_t FLASH_ACR = 0x40023c00;

constexpr std::uintptr_t GPIOA = 0x40020000;
constexpr std::uintptr_t GPIOB = 0x40020400;
constexpr std::uintptr_t GPIOC = 0x40020800;
constexpr std::uintptr_t MODER = 0x00;
constexpr std::uintptr_t PUPDR = 0x0c;
constexpr std::uintptr_t IDR = 0x10;
constexpr std::uintptr_t BSRR = 0x18;
constexpr std::uintptr_t AFRH = 0x24;

constexpr std::uintptr_t USART1_SR = 0x40011000;
constexpr std::uintptr_t USART1_DR = 0x40011004;
constexpr std::uintptr_t USART1_BRR = 0x40011008;
constexpr std::uintptr_t USART1_CR1 = 0x4001100c;

constexpr std::uintptr_t IWDG_KR = 0x40003000;
constexpr std::uintptr_t IWDG_PR = 0x40003004;
constexpr std::uintptr_t IWDG_RLR = 0x40003008;

constexpr std::uintptr_t SYST_CSR = 0xe000e010;
constexpr std::uintptr_t SYST_RVR = 0xe000e014;
constexpr std::uintptr_t SYST_CVR = 0xe000e018;

/// The crystal / 25 * 336 / 2, by RM0090's "PLL configuration"; APB1 a quarter, APB2 a half of it.
inline void start_clock() {
    if (reg(RCC_CR) == 0) {
        return; // QEMU: there is no RCC, and the processor has its 168 MHz; on the chip HSION is set
    }
    reg(FLASH_ACR) = 7U << 8 | 5; // caches and prefetch on, five wait states
    reg(RCC_CR) = reg(RCC_CR) | 1U << 16;
    while ((reg(RCC_CR) & 1U << 17) == 0) { // until the crystal runs
    }
    reg(RCC_PLLCFGR) = crystal_mhz | 336U << 6 | 0U << 16 | 1U << 22 | 7U << 24;
    reg(RCC_CR) = reg(RCC_CR) | 1U << 24;
    while ((reg(RCC_CR) & 1U << 25) == 0) { // until the PLL has locked
    }
    reg(RCC_CFGR) = 5U << 10 | 4U << 13 | 2;
    while ((reg(RCC_CFGR) & 3U << 2) != 2U << 2) { // until the processor runs from it
    }
}

/// `value` in the two bits that each pin of a port has.
constexpr std::uint32_t two_bits(std::uint32_t pins, std::uint32_t value) {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < 16; ++i) {
        bits |= (pins >> i & 1U) * value << (2 * i);
    }
    return bits;
}

constexpr std::uint32_t step_pins = 0x07;
constexpr std::uint32_t direction_pins = 0x70;
constexpr std::uint32_t enable_pin = 0x80;
constexpr std::uint32_t estop_pin = 1;
constexpr std::uint32_t limit_pin = 2;

inline void start() {
    start_clock();
    reg(RCC_AHB1ENR) = reg(RCC_AHB1ENR) | 7;       // ports A, B, C
    reg(RCC_APB2ENR) = reg(RCC_APB2ENR) | 1U << 4; // USART1
    __asm__ volatile("dsb");                       // two clocks until they can be used

    constexpr std::uint32_t outputs = step_pins | direction_pins | enable_pin;
    reg(GPIOC + BSRR) = outputs << 16;
    reg(GPIOC + MODER) = two_bits(outputs, 1);
    reg(GPIOB + PUPDR) = two_bits(estop_pin | limit_pin, 1);
    constexpr std::uint32_t serial_pins = 1U << 9 | 1U << 10;
    reg(GPIOA + AFRH) = 7U << 4 | 7U << 8;
    reg(GPIOA + MODER) = (reg(GPIOA + MODER) & ~two_bits(serial_pins, 3)) | two_bits(serial_pins, 2);

    reg(USART1_BRR) = (apb2_hz + 115200 / 2) / 115200;
    reg(USART1_CR1) = 1U << 13 | 1U << 3 | 1U << 2; // on, transmit, receive
}

inline void start_timer() {
    reg(SYST_RVR) = clock_hz / 1'000'000 * tick_us - 1;
    reg(SYST_CVR) = 0;
    reg(SYST_CSR) = 7; // from the processor's clock, interrupt, on
}
inline void acknowledge_tick() {}

/// 32 kHz / 16, a thousand counts.
inline void start_watchdog() {
    reg(IWDG_KR) = 0xcccc;
    reg(IWDG_KR) = 0x5555;
    reg(IWDG_PR) = 2;
    reg(IWDG_RLR) = 1000;
    reg(IWDG_KR) = 0xaaaa;
}
inline void feed_watchdog() {
    reg(IWDG_KR) = 0xaaaa;
}
inline bool watchdog_bit() {
    const bool bit = (reg(RCC_CSR) & 1U << 29) != 0;
    reg(RCC_CSR) = reg(RCC_CSR) | 1U << 24;
    return bit;
}

/// All at once: a direction changes a tick before a pulse begins.
inline void write_lines(firmware::Pins lines) {
    const std::uint32_t high = lines.up << 4 | lines.step;
    reg(GPIOC + BSRR) = high | ((step_pins | direction_pins) & ~high) << 16;
}
template <class Tick>
inline void run_ticks(Tick&& tick) {
    tick([](firmware::Pins lines) { write_lines(lines); });
}
inline void enable_drives(bool on) {
    reg(GPIOC + BSRR) = on ? enable_pin : enable_pin << 16;
}
inline firmware::Inputs read_inputs() {
    const std::uint32_t open = reg(GPIOB + IDR);
    return {(open & estop_pin) != 0, (open & limit_pin) != 0};
}

inline std::uint32_t line_session() {
    return 0;
}
inline int read_byte() {
    const std::uint32_t status = reg(USART1_SR);
    if ((status & 1U << 5) == 0) {
        return firmware::Serial::nothing;
    }
    const auto byte = static_cast<int>(reg(USART1_DR) & 0xffU);  // this also clears the errors
    return (status & 0xeU) != 0 ? firmware::Serial::lost : byte; // overrun, noise, framing
}
inline bool write_byte(std::uint8_t byte) {
    const bool room = (reg(USART1_SR) & 1U << 7) != 0;
    if (room) {
        reg(USART1_DR) = byte;
    }
    return room;
}

} // namespace board
