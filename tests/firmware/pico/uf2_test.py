#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A UF2 file holds what its ELF loads, byte by byte, as the boot ROM of an RP2040 takes it: uf2_test.py ELF UF2. The format: github.com/microsoft/uf2."""
import struct
import sys

FLASH, FLASH_SIZE = 0x10000000, 2 << 20
FAMILY_PRESENT, RP2040 = 0x2000, 0xe48bff56


def check(right, what):
    if not right:
        sys.exit(f"{sys.argv[2]}: {what}")


def of_elf(path):
    """{address: byte} of the segments, by their physical addresses."""
    with open(path, "rb") as file:
        data = file.read()
    check(data[:6] == b"\x7fELF\x01\x01", "the ELF is not one of 32 bits, little endian")
    table, = struct.unpack_from("<I", data, 28)
    size, count = struct.unpack_from("<HH", data, 42)
    memory = {}
    for at in range(table, table + size * count, size):
        kind, offset, _, address, length = struct.unpack_from("<5I", data, at)
        if kind == 1:
            memory.update(zip(range(address, address + length), data[offset:offset + length]))
    return memory


def of_uf2(path):
    with open(path, "rb") as file:
        data = file.read()
    check(len(data) > 0 and len(data) % 512 == 0, f"{len(data)} bytes are no blocks of 512")
    memory, blocks = {}, len(data) // 512
    for number in range(blocks):
        block = data[512 * number:512 * (number + 1)]
        magic, magic_2, flags, address, size, said_number, said_blocks, family = struct.unpack_from("<8I", block)
        check((magic, magic_2, *struct.unpack_from("<I", block, 508)) == (0x0a324655, 0x9e5d5157, 0x0ab16f30), f"block {number}: its magic numbers are wrong")
        check((flags, family) == (FAMILY_PRESENT, RP2040), f"block {number}: flags {flags:#x}, family {family:#x}")
        check((said_number, said_blocks) == (number, blocks), f"block {number} of {blocks} says {said_number} of {said_blocks}")
        check(size == 256 and address % 256 == 0, f"block {number}: the boot ROM takes pages of 256 bytes, not {size} at {address:#x}")
        check(FLASH <= address <= FLASH + FLASH_SIZE - 256, f"block {number}: {address:#x} is not in the flash")
        check(not any(block[32 + 256:508]), f"block {number}: something is behind its page")
        for at, byte in enumerate(block[32:32 + 256]):
            check(address + at not in memory, f"{address + at:#x} is there twice")
            memory[address + at] = byte
    return memory


def main():
    elf, uf2 = of_elf(sys.argv[1]), of_uf2(sys.argv[2])
    check(len(elf) > 256 and min(elf) == FLASH, "the ELF does not begin at the flash")
    wrong = [at for at, byte in elf.items() if uf2.get(at) != byte]
    check(not wrong, f"{len(wrong)} bytes are not those of the ELF, the first at {wrong[:1]}")
    more = [at for at, byte in uf2.items() if byte and at not in elf]
    check(not more, f"{len(more)} bytes are in no segment of the ELF")
    check(len(uf2) - len(elf) < 512, f"{len(uf2)} bytes for {len(elf)}")
    print(f"{sys.argv[2]}: {len(uf2) // 256} blocks, the {len(elf)} bytes of its ELF")


if __name__ == "__main__":
    main()
