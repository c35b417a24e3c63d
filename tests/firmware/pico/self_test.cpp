// SPDX-License-Identifier: MIT
// A firmware for the test of the emulator (emulator_test.mjs). It clocks the chip with 125 MHz, greets, echoes what
// UART0 says, toggles GPIO25 in each SysTick of 200 us, and lets a DMA ring feed PIO0 with words {levels, delay}.
#include <cstdint>
#include <initializer_list>

namespace {

volatile std::uint32_t& reg(std::uint32_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

constexpr std::uint32_t set = 0x2000; // aliases of a register (datasheet 2.1.2)
constexpr std::uint32_t clear = 0x3000;
constexpr std::uint32_t resets = 0x4000c000;
constexpr std::uint32_t clocks = 0x40008000;
constexpr std::uint32_t io_bank0 = 0x40014000;
constexpr std::uint32_t pads_bank0 = 0x4001c000;
constexpr std::uint32_t xosc = 0x40024000;
constexpr std::uint32_t pll_sys = 0x40028000;
constexpr std::uint32_t uart0 = 0x40034000;
constexpr std::uint32_t watchdog = 0x40058000;
constexpr std::uint32_t dma = 0x50000000;
constexpr std::uint32_t pio0 = 0x50200000;
constexpr std::uint32_t sio = 0xd0000000;
constexpr std::uint32_t systick = 0xe000e010;

// 64 words, which the DMA reads around and around: 32 times {levels of GPIO0 to 3, cycles to wait}.
[[gnu::aligned(256)]] std::uint32_t ring[64];
[[gnu::section(".noinit")]] std::uint32_t kept;

void start_clocks() {
    reg(xosc + 0x0c) = 47;           // STARTUP: 1 ms of 12 MHz / 256
    reg(xosc) = 0xfab << 12 | 0xaa0; // CTRL: enabled, 1 to 15 MHz
    while (!(reg(xosc + 4) >> 31)) { // STATUS: STABLE
    }
    reg(resets + clear) = 1 << 12;
    while (!(reg(resets + 8) >> 12 & 1)) {
    }
    reg(pll_sys + 8) = 125;                // FBDIV_INT: 1500 MHz
    reg(pll_sys + 4 + clear) = 1 << 5 | 1; // PWR: VCOPD, PD
    while (!(reg(pll_sys) >> 31)) {        // CS: LOCK
    }
    reg(pll_sys + 0x0c) = 6 << 16 | 2 << 12; // PRIM: 125 MHz
    reg(pll_sys + 4 + clear) = 1 << 3;       // PWR: POSTDIVPD
    reg(clocks + 0x30) = 2;                  // CLK_REF_CTRL: XOSC
    reg(clocks + 0x3c + set) = 1;            // CLK_SYS_CTRL: the auxiliary source, PLL_SYS
    reg(clocks + 0x48) = 1 << 11;            // CLK_PERI_CTRL: enabled, clk_sys
}

void start_uart() {
    reg(uart0 + 0x24) = 67;
    reg(uart0 + 0x28) = 52;
    reg(uart0 + 0x2c) = 0x70;
    reg(uart0 + 0x30) = 0x301;
    reg(io_bank0 + 4) = 2;
    reg(io_bank0 + 12) = 2;
}

void start_edges() {
    for (std::uint32_t i = 0; i < 32; ++i) {
        ring[2 * i] = (i & 1) << 2 | (i >> 1 & 1) << 3;
        ring[2 * i + 1] = i == 31 ? 12'345 : i * i; // from the shortest loop on
    }
    for (const std::uint32_t pin : {2U, 3U}) {
        reg(io_bank0 + 8 * pin + 4) = 6; // PIO0
    }
    const std::uint32_t program[] = {
        0x6000, 0x6020, 0x0042,         // SM0: out pins, 32; out x, 32; jmp x-- 2
        0xf401, 0xe900, 0x0005,         // SM1: set pins, 1 [20]; set pins, 0 [9]; jmp 5
        0x6201,                         // SM2: out pins, 1 [2]
        0x200a, 0xe001, 0x208a, 0xe000, // SM3: wait 0 gpio 10; set pins, 1; wait 1 gpio 10; set pins, 0
    };
    for (std::uint32_t i = 0; i < sizeof(program) / sizeof(program[0]); ++i) {
        reg(pio0 + 0x48 + 4 * i) = program[i];
    }
    reg(pio0 + 0xcc) = 2 << 12;                     // SM0_EXECCTRL: wraps from 2 to 0
    reg(pio0 + 0xd0) = 1 << 30 | 1 << 17 | 1 << 19; // SM0_SHIFTCTRL: FJOIN_TX, AUTOPULL at 32, to the right
    reg(pio0 + 0xdc) = 2 << 26 | 2 << 5;            // SM0_PINCTRL: SET of GPIO2 and 3
    reg(pio0 + 0xd8) = 0xe083;                      // set pindirs, 3
    reg(pio0 + 0xdc) = 4 << 20;                     // OUT of GPIO0 to 3
    for (const std::uint32_t pin : {4U, 6U, 7U}) {
        reg(io_bank0 + 8 * pin + 4) = 6;
    }
    reg(pio0 + 0xfc) = 6 << 12 | 6 << 7;             // SM2_EXECCTRL: wraps at 6
    reg(pio0 + 0x100) = 1 << 25 | 1 << 17 | 1 << 19; // SM2_SHIFTCTRL: AUTOPULL at 1
    reg(pio0 + 0x114) = 10 << 12 | 7 << 7;           // SM3_EXECCTRL: wraps from 10 to 7
    struct Machine {
        std::uint32_t registers; // where they begin
        std::uint32_t pin;
        std::uint32_t begin;
    };
    for (const Machine& machine :
         {Machine{pio0 + 0xe0, 4, 3}, Machine{pio0 + 0xf8, 6, 6}, Machine{pio0 + 0x110, 7, 7}}) {
        reg(machine.registers + 0x14) =
            1 << 26 | machine.pin << 5 | 1 << 20 | machine.pin; // PINCTRL: SET and OUT of a pin
        reg(machine.registers + 0x10) = 0xe081;                 // set pindirs, 1
        reg(machine.registers + 0x10) = machine.begin;          // jmp
    }
    reg(dma) = reinterpret_cast<std::uint32_t>(ring);
    reg(dma + 4) = pio0 + 0x10; // TXF0
    reg(dma + 8) = 0xffffffff;
    reg(dma + 12) = 0 << 15 | 8 << 6 | 1 << 4 | 2 << 2 | 1; // CTRL_TRIG: DREQ_PIO0_TX0, ring of 256 bytes, words
    reg(pio0) = 15;
}

void say(const char* text) {
    for (; *text != 0; ++text) {
        while (reg(uart0 + 0x18) >> 5 & 1) {
        }
        reg(uart0) = static_cast<std::uint8_t>(*text);
    }
}

void on_tick() {
    reg(sio + 0x1c) = 1 << 25;
}

void on_fault() {
    for (;;) {
    }
}

} // namespace

int main() {
    start_clocks();
    reg(resets + clear) = 1 << 22 | 1 << 10 | 1 << 8 | 1 << 5 | 1 << 2; // UART0, PIO0, PADS_BANK0, IO_BANK0, DMA
    while (~reg(resets + 8) & (1 << 22 | 1 << 10 | 1 << 8 | 1 << 5 | 1 << 2)) {
    }
    start_uart();
    say(reg(watchdog + 8) == 1 && kept == 0x12345678 ? "again\n" : "hello\n");
    kept = 0x12345678;
    reg(io_bank0 + 8 * 25 + 4) = 5; // SIO
    reg(sio + 0x24) = 1 << 25;
    reg(pads_bank0 + 4 + 4 * 10) = 0x4a; // GPIO10: pull-up
    reg(io_bank0 + 8 * 9 + 4) = 5;
    reg(sio + 0x24) = 1 << 9;
    start_edges();
    reg(systick + 4) = 24'999;
    reg(systick + 8) = 0;
    reg(systick) = 7;
    for (std::uint32_t wakes = 0;; ++wakes) {
        __asm__ volatile("wfi");
        reg(pio0 + 0x18) = wakes & 1; // TXF2, which is empty in between
        if (!(reg(uart0 + 0x18) >> 4 & 1)) {
            const auto byte = static_cast<char>(reg(uart0));
            const char text[] = {byte, 0};
            say(text);
            if (byte == 'w') {
                reg(watchdog + 0x2c) = 1 << 9 | 12; // TICK: enabled, 12 cycles of the crystal
                reg(0x40010008) = 0x1fffc;          // PSM WDSEL: all but the oscillators
                reg(watchdog + 4) = 2 * 1000;       // LOAD: 1 ms (RP2040-E1)
                reg(watchdog + set) = 1 << 30;
            }
        }
        reg(sio + (reg(sio + 4) >> 10 & 1 ? 0x14U : 0x18U)) = 1 << 9; // GPIO9 shows GPIO10
    }
}

namespace {

extern "C" std::uint32_t stack_top[];

struct Vectors {
    std::uint32_t* stack;
    void (*reset)();
    void (*of[14])();
};

[[gnu::used, gnu::section(".vectors")]] const Vectors vectors = {stack_top,
                                                                 [] { main(); },
                                                                 {on_fault, on_fault, on_fault, on_fault, on_fault,
                                                                  on_fault, on_fault, on_fault, on_fault, on_fault,
                                                                  on_fault, on_fault, on_fault, on_tick}};

} // namespace
