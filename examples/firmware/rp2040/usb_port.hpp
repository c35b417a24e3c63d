// SPDX-License-Identifier: MIT
// UsbPort: the registers of the RP2040's USB controller and its memory, DPSRAM. Names: RP2040 Datasheet, 2.14 and 4.1.
#pragma once

#include <cstdint>

namespace rp2040 {

constexpr std::uintptr_t RESETS_SET = 0x4000e000; // RESET, by the alias that sets bits
constexpr std::uintptr_t RESETS_CLR = 0x4000f000;
constexpr std::uintptr_t RESET_DONE = 0x4000c008;
constexpr std::uint32_t reset_usbctrl = 1U << 24;
constexpr std::uintptr_t DPSRAM = 0x50100000;       // begins with the SETUP packet
constexpr std::uintptr_t ENDPOINT_CONTROL = DPSRAM; // by pipe: twice the endpoint, and 1 more for what the host sends
constexpr std::uint32_t endpoint_enable = 1U << 31;
constexpr std::uint32_t endpoint_each_buffer = 1U << 29; // is told of in BUFF_STATUS
constexpr std::uintptr_t BUFFER_CONTROL = DPSRAM + 0x80;
constexpr std::uint32_t buffer_full = 1U << 15;
constexpr std::uint32_t buffer_data1 = 1U << 13;
constexpr std::uint32_t buffer_stall = 1U << 11;
constexpr std::uint32_t buffer_available = 1U << 10; // the buffer is the controller's; without it, ours
constexpr std::uint32_t buffer_length = 0x3ff;

constexpr std::uintptr_t USBCTRL = 0x50110000;
constexpr std::uintptr_t ADDR_ENDP = USBCTRL + 0x00;
constexpr std::uintptr_t MAIN_CTRL = USBCTRL + 0x40;
constexpr std::uintptr_t SOF_RD = USBCTRL + 0x48;
constexpr std::uintptr_t SIE_CTRL = USBCTRL + 0x4c;
constexpr std::uint32_t sie_ep0_int_1buf = 1U << 29; // tells of each buffer of endpoint 0
constexpr std::uint32_t sie_pullup_en = 1U << 16;
constexpr std::uintptr_t SIE_STATUS = USBCTRL + 0x50; // a written 1 clears, in BUFF_STATUS, too
constexpr std::uint32_t sie_bus_reset = 1U << 19;
constexpr std::uint32_t sie_setup_rec = 1U << 17;
constexpr std::uint32_t sie_suspended = 1U << 4;
constexpr std::uintptr_t BUFF_STATUS = USBCTRL + 0x58; // by pipe
constexpr std::uintptr_t EP_STALL_ARM = USBCTRL + 0x68;
constexpr std::uintptr_t USB_MUXING = USBCTRL + 0x74;
constexpr std::uintptr_t USB_PWR = USBCTRL + 0x78;

/// Behind it is the chip, or a test.
class UsbPort {
public:
    [[nodiscard]] virtual std::uint32_t read(std::uintptr_t address) const noexcept = 0;
    virtual void write(std::uintptr_t address, std::uint32_t value) noexcept = 0;
    /// Until the controller has seen what was written: its cycle at 48 MHz are three at 125 MHz.
    virtual void settle() noexcept = 0;
};

struct UsbRegisters final : UsbPort {
    using Word = volatile std::uint32_t;
    std::uint32_t read(std::uintptr_t address) const noexcept override { return *reinterpret_cast<Word*>(address); }
    void write(std::uintptr_t address, std::uint32_t to) noexcept override { *reinterpret_cast<Word*>(address) = to; }
    void settle() noexcept override { __asm__ volatile("nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop" ::: "memory"); }
};

} // namespace rp2040
