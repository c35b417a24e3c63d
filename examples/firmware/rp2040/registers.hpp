// SPDX-License-Identifier: MIT
// Registers of the RP2040, by the names of the "RP2040 Datasheet".
#pragma once

#include <cstdint>

namespace rp2040 {

inline volatile std::uint32_t& reg(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}
// 2.1.2: writes to these aliases set or clear the bits of the value.
inline volatile std::uint32_t& set_bits(std::uintptr_t address) {
    return reg(address + 0x2000);
}
inline volatile std::uint32_t& clear_bits(std::uintptr_t address) {
    return reg(address + 0x3000);
}

constexpr std::uintptr_t CLOCKS_CLK_REF_CTRL = 0x40008030;
constexpr std::uintptr_t CLOCKS_CLK_REF_SELECTED = 0x40008038;
constexpr std::uintptr_t CLOCKS_CLK_SYS_CTRL = 0x4000803c;
constexpr std::uintptr_t CLOCKS_CLK_SYS_SELECTED = 0x40008044;
constexpr std::uintptr_t CLOCKS_CLK_PERI_CTRL = 0x40008048;
constexpr std::uintptr_t CLOCKS_CLK_USB_CTRL = 0x40008054;
constexpr std::uintptr_t CLOCKS_CLK_USB_DIV = 0x40008058;
constexpr std::uintptr_t RESETS_RESET = 0x4000c000;
constexpr std::uintptr_t RESETS_RESET_DONE = 0x4000c008;
constexpr std::uintptr_t PSM_WDSEL = 0x40010008;
constexpr std::uintptr_t IO_BANK0_GPIO0_CTRL = 0x40014004; // and every 8 bytes
constexpr std::uintptr_t PADS_BANK0_GPIO0 = 0x4001c004;    // and every 4 bytes
constexpr std::uintptr_t XOSC_CTRL = 0x40024000;
constexpr std::uintptr_t XOSC_STATUS = 0x40024004;
constexpr std::uintptr_t XOSC_STARTUP = 0x4002400c;
constexpr std::uintptr_t PLL_SYS = 0x40028000;
constexpr std::uintptr_t PLL_USB = 0x4002c000;
constexpr std::uintptr_t PLL_CS = 0x0;
constexpr std::uintptr_t PLL_PWR = 0x4;
constexpr std::uintptr_t PLL_FBDIV_INT = 0x8;
constexpr std::uintptr_t PLL_PRIM = 0xc;
constexpr std::uintptr_t UART0_UARTDR = 0x40034000;
constexpr std::uintptr_t UART0_UARTFR = 0x40034018;
constexpr std::uintptr_t UART0_UARTIBRD = 0x40034024;
constexpr std::uintptr_t UART0_UARTFBRD = 0x40034028;
constexpr std::uintptr_t UART0_UARTLCR_H = 0x4003402c;
constexpr std::uintptr_t UART0_UARTCR = 0x40034030;
constexpr std::uintptr_t WATCHDOG_CTRL = 0x40058000;
constexpr std::uintptr_t WATCHDOG_LOAD = 0x40058004;
constexpr std::uintptr_t WATCHDOG_REASON = 0x40058008;
constexpr std::uintptr_t WATCHDOG_TICK = 0x4005802c;

constexpr std::uintptr_t DMA_READ_ADDR = 0x00;
constexpr std::uintptr_t DMA_WRITE_ADDR = 0x04;
constexpr std::uintptr_t DMA_TRANS_COUNT = 0x08;
constexpr std::uintptr_t DMA_AL1_CTRL = 0x10;
constexpr std::uintptr_t DMA_MULTI_CHAN_TRIGGER = 0x50000430;
constexpr std::uintptr_t DMA_CHAN_ABORT = 0x50000444;
constexpr std::uintptr_t dma(std::uint32_t channel, std::uintptr_t offset) {
    return 0x50000000 + 0x40 * channel + offset;
}

constexpr std::uintptr_t PIO0_CTRL = 0x50200000;
constexpr std::uintptr_t PIO0_FLEVEL = 0x5020000c;
constexpr std::uintptr_t PIO0_TXF0 = 0x50200010;
constexpr std::uintptr_t PIO0_DBG_PADOUT = 0x5020003c;
constexpr std::uintptr_t PIO0_INSTR_MEM0 = 0x50200048;
constexpr std::uintptr_t PIO0_SM0_CLKDIV = 0x502000c8;
constexpr std::uintptr_t PIO0_SM0_EXECCTRL = 0x502000cc;
constexpr std::uintptr_t PIO0_SM0_SHIFTCTRL = 0x502000d0;
constexpr std::uintptr_t PIO0_SM0_INSTR = 0x502000d8;
constexpr std::uintptr_t PIO0_SM0_PINCTRL = 0x502000dc;

constexpr std::uintptr_t SIO_GPIO_IN = 0xd0000004;
constexpr std::uintptr_t SIO_GPIO_OUT_SET = 0xd0000014;
constexpr std::uintptr_t SIO_GPIO_OUT_CLR = 0xd0000018;
constexpr std::uintptr_t SIO_GPIO_OE_SET = 0xd0000024;

constexpr std::uintptr_t SYST_CSR = 0xe000e010;
constexpr std::uintptr_t SYST_RVR = 0xe000e014;
constexpr std::uintptr_t SYST_CVR = 0xe000e018;

} // namespace rp2040
