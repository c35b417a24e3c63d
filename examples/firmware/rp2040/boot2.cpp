// SPDX-License-Identifier: MIT
// The second stage of the RP2040's boot (datasheet 2.8.1): 256 bytes at the begin of the flash, which the boot ROM
// copies to the end of the RAM, checks and calls. It lets the flash be read at its addresses, by the serial read 03h
// that every flash has, and starts what lies behind it.
#include <bit>
#include <cstdint>

namespace {

constexpr std::uint32_t vectors = 0x10000100;

struct Write {
    std::uint32_t address; ///< 0 ends the table
    std::uint32_t value;
};

struct Boot2 {
    std::uint16_t code[10];
    Write writes[8];
    std::uint32_t unused[42];
    std::uint32_t crc;
};

struct Bytes {
    std::uint8_t of[252];
    std::uint8_t crc[4];
};

static_assert(sizeof(Boot2) == 256 && sizeof(Bytes) == sizeof(Boot2));

constexpr Boot2 without_crc = {
    {
        0xa004,         // 00  adr   r0, writes
        0xc806,         // 02  ldmia r0!, {r1, r2}
        0x2900,         // 04  cmp   r1, #0
        0xd001,         // 06  beq   0c
        0x600a,         // 08  str   r2, [r1]
        0xe7fa,         // 0a  b     02
        0xca03,         // 0c  ldmia r2!, {r0, r1}: the stack and the reset handler
        0xf380, 0x8808, // 0e  msr   msp, r0
        0x4708,         // 12  bx    r1
    },
    {
        {0x18000008, 0},                   // SSIENR: its settings are written while it is off
        {0x18000014, 4},                   // BAUDR: 31.25 MHz of 125 MHz, for 03h the slowest flashes take 33 MHz
        {0x18000000, 31U << 16 | 3U << 8}, // CTRLR0: DFS_32 32 bits, TMOD "EEPROM read", SPI_FRF one line
        {0x18000004, 0},                   // CTRLR1: NDF one word
        {0x180000f4, 3U << 24 | 2 << 8 | 6 << 2}, // SPI_CTRLR0: XIP_CMD 03h, INST_L 8 bits, ADDR_L 24 bits
        {0x18000008, 1},                          // SSIENR
        {0xe000ed08, vectors},                    // VTOR
        {0, vectors},
    },
    {},
    0,
};

/// Datasheet 2.8.1.3.1: polynomial 0x04c11db7 from the highest bit on, begun with ones, nothing reflected.
constexpr Boot2 with_crc(Boot2 stage) {
    std::uint32_t crc = 0xffffffff;
    for (const std::uint8_t byte : std::bit_cast<Bytes>(stage).of) {
        crc ^= static_cast<std::uint32_t>(byte) << 24;
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc << 1 ^ (crc >> 31) * 0x04c11db7;
        }
    }
    stage.crc = crc;
    return stage;
}

[[gnu::used, gnu::section(".boot2")]] constexpr Boot2 boot2 = with_crc(without_crc);

} // namespace
