// SPDX-License-Identifier: MIT
// The bus: RAM and flash by the shortest way, and what a Pico would fault at, or answer with nothing: addresses that are not aligned, and peripherals in reset.
import { BasePeripheral, FirmwareError } from "./emulator.mjs";

const RAM = 0x20000000;
const QSPI = 1 << 6 | 1 << 9; // IO_QSPI, PADS_QSPI: what the boot ROM takes out of reset
const ALL = 0x1ffffff;
/** {the peripheral's key in rp2040js: its bit in RESETS (2.14.2)} */
const RESET_BITS = { 0x4004c: 0, 0x40030: 1, 0x50000: 2, 0x40044: 3, 0x40048: 4, 0x40014: 5, 0x40018: 6, 0x4001c: 8, 0x40020: 9, 0x50200: 10, 0x50300: 11, 0x40028: 12,
                     0x4002c: 13, 0x40050: 14, 0x4005c: 15, 0x4003c: 16, 0x40040: 17, 0x40004: 18, 0x40000: 19, 0x4006c: 20, 0x40054: 21, 0x40034: 22, 0x40038: 23, 0x50110: 24 };

class Resets extends BasePeripheral {
    constructor(chip) {
        super(chip, "RESETS");
        this.registers = [ALL & ~QSPI, 0];
    }
    readUint32(offset) {
        return offset === 8 ? ~this.registers[0] & ALL : this.registers[offset / 4] ?? super.readUint32(offset);
    }
    writeUint32(offset, value) {
        if (offset > 4) {
            super.writeUint32(offset, value);
        } else {
            this.registers[offset / 4] = value & ALL;
        }
    }
}

function guard(peripheral, bit, resets) {
    for (const access of ["readUint32", "writeUint32Atomic"]) {
        const go = peripheral[access].bind(peripheral);
        peripheral[access] = (offset, value, kind) => {
            if (resets.registers[0] >>> bit & 1) {
                throw new FirmwareError(`${peripheral.name} is used while RESETS holds it (bit ${bit})`);
            }
            return go(offset, value, kind);
        };
    }
}

const unaligned = (address) => new FirmwareError(`address 0x${(address >>> 0).toString(16)} is not aligned`);

export function mapMemory(chip, ram, xip) {
    const resets = chip.peripherals[0x4000c] = new Resets(chip);
    for (const [key, bit] of Object.entries(RESET_BITS)) {
        guard(chip.peripherals[key], bit, resets);
    }
    const bytes = ram, halfwords = new Uint16Array(ram.buffer), words = new Uint32Array(ram.buffer), size = ram.length;
    const far = Object.fromEntries(["readUint8", "readUint16", "readUint32", "writeUint8", "writeUint16", "writeUint32"].map((name) => [name, chip[name].bind(chip)]));
    const reads = (name, mask, shift, array, flash) => (address) => {
        if (address & mask) {
            throw unaligned(address);
        }
        if (address >>> 26 === 4) {
            return flash(address);
        }
        const at = (address >>> 0) - RAM;
        return at >= 0 && at < size ? array[at >>> shift] : far[name](address);
    };
    const writes = (name, mask, shift, array) => (address, value) => {
        if (address & mask) {
            throw unaligned(address);
        }
        if (address >>> 26 === 4) {
            throw new FirmwareError(`0x${(address >>> 0).toString(16)}, an address of the flash, is written`);
        }
        const at = (address >>> 0) - RAM;
        if (at >= 0 && at < size) {
            array[at >>> shift] = value;
        } else {
            far[name](address, value);
        }
    };
    chip.readUint8 = reads("readUint8", 0, 0, bytes, (address) => xip.read8(address));
    chip.readUint16 = reads("readUint16", 1, 1, halfwords, (address) => xip.read16(address));
    chip.readUint32 = reads("readUint32", 3, 2, words, (address) => xip.read32(address));
    chip.writeUint8 = writes("writeUint8", 0, 0, bytes);
    chip.writeUint16 = writes("writeUint16", 1, 1, halfwords);
    chip.writeUint32 = writes("writeUint32", 3, 2, words);
}
