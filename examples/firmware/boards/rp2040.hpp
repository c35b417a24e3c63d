// SPDX-License-Identifier: MIT
// RP2040 on a Raspberry Pi Pico: two Cortex-M0+, of which this uses one, at 125 MHz, with 264 KB of RAM, from which it
// runs, and 2 MB of flash. PIO makes the edges, exact to a cycle of 8 ns. Registers: "RP2040 Datasheet"; SysTick:
// Armv6-M Architecture Reference Manual.
//
//   GPIO2 3 4   step x, y, z           GPIO10         emergency stop: a contact to ground that opens
//   GPIO5 6 7   direction, high: up    GPIO11 12 13   limit switches: contacts to ground that open
//   GPIO8       enable, high: on       GPIO0 1        UART0: 115200 baud, 8N1; heard while no sender has opened USB
#pragma once

#include "rp2040/registers.hpp"
#include "rp2040/usb_serial.hpp"
#include "rp2040/word_port.hpp"
#include "serial.hpp"
#include "step_generator.hpp"
#include "word_lines.hpp"

#include "splinefeed/base/slot.hpp"
#include "splinefeed/number/fixed.hpp"

#include <cstddef>
#include <cstdint>

namespace board {

constexpr const char* name = "rp2040";
using Real = splinefeed::Fixed;
constexpr unsigned tick_us = 40; // of the motion; five of them in an interrupt
constexpr unsigned ticks_an_interrupt = 5;
constexpr unsigned pulse_us = 2;
constexpr unsigned segment_us = 1000;
constexpr unsigned steps_per_s = 100000;
constexpr std::size_t window = 64;
constexpr bool curves_through_points = true;
constexpr std::size_t parameters = 200;
constexpr std::size_t parts = 250;
constexpr unsigned interrupts = 32;
constexpr int timer_interrupt = -1; // SysTick, the vector before those of the chip

constexpr std::uint32_t clock_mhz = 125;
constexpr std::uint32_t crystal_mhz = 12;

struct AxisPins {
    unsigned step;
    unsigned direction;
};
constexpr AxisPins axis_pins[] = {{2, 5}, {3, 6}, {4, 7}};
constexpr std::uint32_t enable_pin = 1U << 8;
constexpr std::uint32_t estop_pin = 1U << 10;
constexpr std::uint32_t limit_pins = 7U << 11;

/// Pulses of 2 us, 5 us before and after a change of direction. Behind the first levels of a motion two more batches of
/// ticks can be made.
using Lines = firmware::WordLines<3, firmware::WordSettings{
                                         .timing = *splinefeed::StepTiming::make(
                                             {.tick_us = tick_us, .interpolated = true, .step_length_us = pulse_us}),
                                         .cycles_per_us = clock_mhz,
                                         .lead_ticks = 2 * ticks_an_interrupt,
                                         .late_ticks = 2 * ticks_an_interrupt}>;

// A word ends where one of a step's two edges is, or that of a direction; a tick's, and a motion's first one.
static_assert(ticks_an_interrupt * (3 * (2 * Lines::counts_in_ticks[0] + 1) + 1) + 1 <= rp2040::WordPort::most_words);

inline Lines lines() {
    splinefeed::PerAxis<splinefeed::LineMasks> masks{};
    for (unsigned k = 0; k < 3; ++k) {
        masks[k] = {.step = 1U << axis_pins[k].step, .direction = 1U << axis_pins[k].direction};
    }
    return Lines(masks);
}

inline rp2040::WordPort word_port{};
inline splinefeed::Slot<rp2040::UsbRegisters> usb_registers;
inline splinefeed::Slot<rp2040::UsbSerial> usb;

/// Datasheet 2.18: the crystal / REFDIV 1 * feedback / the two dividers.
inline void start_pll(std::uintptr_t pll, std::uint32_t feedback, std::uint32_t divider_1, std::uint32_t divider_2) {
    using namespace rp2040;
    constexpr std::uint32_t power = 1U << 0;
    constexpr std::uint32_t post_dividers = 1U << 3;
    constexpr std::uint32_t oscillator = 1U << 5;
    reg(pll + PLL_CS) = 1;
    reg(pll + PLL_FBDIV_INT) = feedback;
    clear_bits(pll + PLL_PWR) = power | oscillator;
    while ((reg(pll + PLL_CS) & 1U << 31) == 0) { // until it has locked
    }
    reg(pll + PLL_PRIM) = divider_1 << 16 | divider_2 << 12;
    clear_bits(pll + PLL_PWR) = post_dividers;
}

inline void leave_reset(std::uint32_t blocks) {
    rp2040::clear_bits(rp2040::RESETS_RESET) = blocks;
    while ((rp2040::reg(rp2040::RESETS_RESET_DONE) & blocks) != blocks) {
    }
}

inline void start_clocks() {
    using namespace rp2040;
    reg(XOSC_CTRL) = 0xaa0;
    reg(XOSC_STARTUP) = (crystal_mhz * 1000 + 128) / 256; // 1 ms
    set_bits(XOSC_CTRL) = 0xfabU << 12;
    while ((reg(XOSC_STATUS) & 1U << 31) == 0) { // until it is stable
    }
    reg(CLOCKS_CLK_REF_CTRL) = 2; // the crystal
    while ((reg(CLOCKS_CLK_REF_SELECTED) & 1U << 2) == 0) {
    }
    clear_bits(CLOCKS_CLK_SYS_CTRL) = 1; // from there, while the PLL starts
    while ((reg(CLOCKS_CLK_SYS_SELECTED) & 1U) == 0) {
    }
    constexpr std::uint32_t pll_sys = 1U << 12;
    constexpr std::uint32_t pll_usb = 1U << 13;
    leave_reset(pll_sys | pll_usb);
    start_pll(PLL_SYS, 125, 6, 2); // 12 * 125 / 12
    start_pll(PLL_USB, 100, 5, 5); // 12 * 100 / 25 = 48 MHz
    reg(CLOCKS_CLK_SYS_CTRL) = 0U << 5;
    set_bits(CLOCKS_CLK_SYS_CTRL) = 1; // the PLL
    while ((reg(CLOCKS_CLK_SYS_SELECTED) & 2U) == 0) {
    }
    reg(CLOCKS_CLK_PERI_CTRL) = 1U << 11;
    reg(CLOCKS_CLK_USB_CTRL) = 1U << 11;
}

inline void use_pins(std::uint32_t pins, std::uint32_t function, std::uint32_t pad) {
    for (unsigned pin = 0; pin < 30; ++pin) {
        if ((pins >> pin & 1U) != 0) {
            rp2040::reg(rp2040::PADS_BANK0_GPIO0 + 4 * pin) = pad;
            rp2040::reg(rp2040::IO_BANK0_GPIO0_CTRL + 8 * pin) = function;
        }
    }
}

inline void start() {
    using namespace rp2040;
    start_clocks();
    constexpr std::uint32_t blocks = 1U << 22 | 1U << 10 | 1U << 8 | 1U << 5 | 1U << 2; // UART0, PIO0, pads, pins, DMA
    leave_reset(blocks);

    constexpr std::uint32_t pad = 1U << 6 | 1U << 4 | 1U << 1; // input, 4 mA, Schmitt trigger
    constexpr std::uint32_t pull_up = 1U << 3;
    constexpr std::uint32_t of_uart = 2;
    constexpr std::uint32_t of_sio = 5;
    constexpr std::uint32_t of_pio0 = 6;
    reg(SIO_GPIO_OUT_CLR) = enable_pin;
    reg(SIO_GPIO_OE_SET) = enable_pin;
    use_pins(enable_pin, of_sio, pad);
    use_pins(estop_pin | limit_pins, of_sio, pad | pull_up);
    use_pins(1, of_uart, pad);
    use_pins(2, of_uart, pad | pull_up);
    std::uint32_t step_lines = 0;
    for (const AxisPins& axis : axis_pins) {
        step_lines |= 1U << axis.step | 1U << axis.direction;
    }
    word_port.start(step_lines, lines().levels());
    use_pins(step_lines, of_pio0, pad);

    // 125 MHz / 16 / 115200, in 64ths
    constexpr std::uint32_t divider = (clock_mhz * 1'000'000 * 4 + 115200 / 2) / 115200;
    reg(UART0_UARTIBRD) = divider / 64;
    reg(UART0_UARTFBRD) = divider % 64;
    reg(UART0_UARTLCR_H) = 3U << 5 | 1U << 4;  // 8 bits, with FIFOs
    reg(UART0_UARTCR) = 1U << 9 | 1U << 8 | 1; // receive, transmit, on
    usb.build(usb_registers.build()).start();
}

inline void start_timer() {
    using namespace rp2040;
    reg(SYST_RVR) = clock_mhz * tick_us * ticks_an_interrupt - 1;
    reg(SYST_CVR) = 0;
    reg(SYST_CSR) = 7; // from the processor's clock, interrupt, on
}
inline void acknowledge_tick() {
    usb->poll();
}

/// Half a second of 1 MHz. The counter goes by two a tick: RP2040-E1.
inline void start_watchdog() {
    using namespace rp2040;
    constexpr std::uint32_t all_but_oscillators = 0x1fffc;
    reg(PSM_WDSEL) = all_but_oscillators;
    reg(WATCHDOG_TICK) = 1U << 9 | crystal_mhz;
    reg(WATCHDOG_LOAD) = 2 * 500'000;
    set_bits(WATCHDOG_CTRL) = 1U << 30;
}
inline void feed_watchdog() {
    rp2040::reg(rp2040::WATCHDOG_LOAD) = 2 * 500'000;
}
/// The reason stays until the power goes, and for resets by software: it is the timer's if bit 0 is set.
inline bool watchdog_bit() {
    return (rp2040::reg(rp2040::WATCHDOG_REASON) & 1U) != 0;
}

/// The ticks of an interrupt: tick(write) for each.
template <class Tick>
inline void run_ticks(Tick&& tick) {
    if (word_port.has_room()) {
        for (unsigned i = 0; i < ticks_an_interrupt; ++i) {
            tick(word_port);
        }
        word_port.send();
    }
}
inline void enable_drives(bool on) {
    rp2040::reg(on ? rp2040::SIO_GPIO_OUT_SET : rp2040::SIO_GPIO_OUT_CLR) = enable_pin;
}
inline firmware::Inputs read_inputs() {
    const std::uint32_t open = rp2040::reg(rp2040::SIO_GPIO_IN);
    return {(open & estop_pin) != 0, (open & limit_pins) != 0};
}

/// Another number for each sender; 0 is the UART's.
inline std::uint32_t line_session() {
    return usb->is_open() ? usb->sessions() : 0;
}
inline int read_uart() {
    constexpr std::uint32_t empty = 1U << 4;
    if ((rp2040::reg(rp2040::UART0_UARTFR) & empty) != 0) {
        return firmware::Serial::nothing;
    }
    const std::uint32_t data = rp2040::reg(rp2040::UART0_UARTDR);
    return (data & 0xf00U) != 0 ? firmware::Serial::lost
                                : static_cast<int>(data & 0xffU); // overrun, break, parity, frame
}
inline int read_byte() {
    const int of_uart = read_uart();
    if (!usb->is_open()) {
        return of_uart;
    }
    const int byte = usb->read_byte();
    return byte >= 0 ? byte : firmware::Serial::nothing;
}
inline bool write_byte(std::uint8_t byte) {
    if (usb->is_open()) {
        return usb->write_byte(byte);
    }
    constexpr std::uint32_t full = 1U << 5;
    const bool room = (rp2040::reg(rp2040::UART0_UARTFR) & full) == 0;
    if (room) {
        rp2040::reg(rp2040::UART0_UARTDR) = byte;
    }
    return room;
}

} // namespace board
