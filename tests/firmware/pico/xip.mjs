// SPDX-License-Identifier: MIT
// The way to the flash: the SSI as a driver without a boot ROM uses it (datasheet 4.10), the select line's pad, and reads at the flash's addresses through
// the cache (2.6.3), with the time that they take. rp2040js has none of it. Reads while the SSI is not set for them, while the flash is busy, and of
// what the cache still holds from before a change are errors of the firmware.
import { BasePeripheral, FirmwareError } from "./emulator.mjs";

const CTRLR0 = 0x00, CTRLR1 = 0x04, SSIENR = 0x08, SER = 0x10, BAUDR = 0x14, TXFLR = 0x20, RXFLR = 0x24, SR = 0x28, ICR = 0x48, DR0 = 0x60, SPI_CTRLR0 = 0xf4;
const SR_BUSY = 1, SR_TFNF = 2, SR_TFE = 4, SR_RFNE = 8, SR_RFF = 16;
const FIFO_SIZE = 16;
const FRAMES_OF_8_BITS = 7 << 16; // TMOD 0: each frame goes out and comes in
const READ_03H = { [CTRLR0]: 31 << 16 | 3 << 8, [CTRLR1]: 0, [SPI_CTRLR0]: 3 << 24 | 6 << 2 | 2 << 8 };
const SS_CTRL = 0x0c, OUTOVER_LOW = 2, OUTOVER_HIGH = 3;
const LINE_CLOCKS = 8 + 24 + 64, WORD_CLOCKS = 8 + 24 + 32; // command, address, data
const SETS = 1024;

/** IO_QSPI: a register for each pad; of the select line OUTOVER decides. */
class IoQspi extends BasePeripheral {
    constructor(chip, selected) {
        super(chip, "IO_QSPI");
        this.ctrl = {};
        this.selected = selected;
    }
    readUint32(offset) {
        return this.ctrl[offset] ?? 0;
    }
    writeUint32(offset, value) {
        this.ctrl[offset] = value;
        if (offset === SS_CTRL) {
            this.selected(value >>> 8 & 3);
        }
    }
}

/** XIP_CTRL: CTRL, FLUSH, STAT. */
class XipCtrl extends BasePeripheral {
    constructor(chip, xip) {
        super(chip, "XIP_CTRL");
        Object.assign(this, { xip, ctrl: 1 });
    }
    readUint32(offset) {
        return [this.ctrl, 0, 3][offset / 4] ?? super.readUint32(offset); // FLUSH_READY, FIFO_EMPTY
    }
    writeUint32(offset, value) {
        if (offset === 4) {
            this.xip.flush();
        } else if (offset === 0 && value & 1) {
            this.ctrl = value;
        } else {
            super.writeUint32(offset, value);
        }
    }
}

export class Xip extends BasePeripheral {
    /** @param waits its `cycles` are what reads have to wait */
    constructor(chip, flash, now, waits, cycleNs) {
        super(chip, "SSI");
        Object.assign(this, { flash, now, waits, cycleNs, open: false, outover: 0, line: -1, shifting: [], received: [] });
        this.words = new Uint32Array(flash.bytes.buffer);
        this.halfwords = new Uint16Array(flash.bytes.buffer);
        this.tags = new Int32Array(2 * SETS).fill(-1);
        this.older = new Uint8Array(SETS); // which of the two is replaced next
        this.stale = new Set();
        // As the boot ROM leaves it: commands by frames of 8 bits.
        this.registers = { [CTRLR0]: FRAMES_OF_8_BITS, [CTRLR1]: 0, [SSIENR]: 1, [SER]: 1, [BAUDR]: 6, [SPI_CTRLR0]: 0 };
        Object.assign(chip.peripherals, { 0x18000: this, 0x40018: new IoQspi(chip, (outover) => this.#selected(outover)), 0x14000: new XipCtrl(chip, this) });
        flash.changed = (from, size) => this.#changed(from, size);
    }

    read8(address) {
        this.#pass(address);
        return this.flash.bytes[address & 0x1fffff];
    }

    read16(address) {
        this.#pass(address);
        return this.halfwords[(address & 0x1fffff) >>> 1];
    }

    read32(address) {
        this.#pass(address);
        return this.words[(address & 0x1fffff) >>> 2];
    }

    flush() {
        this.tags.fill(-1);
        this.stale.clear();
        this.line = -1;
    }

    #pass(address) {
        const line = address >>> 3;
        if (line !== this.line) {
            this.#lookUp(address, line);
        }
    }

    #lookUp(address, line) {
        if (!this.open) {
            this.#settled();
            if (!this.open) {
                throw new FirmwareError(`the flash is read at 0x${(address >>> 0).toString(16)}, but ${this.#whyNot()}`);
            }
        }
        if (address >>> 24 !== 0x10) { // past the cache
            this.waits.cycles += WORD_CLOCKS * this.registers[BAUDR];
            return;
        }
        const set = line % SETS, ways = this.tags, at = 2 * set;
        if (ways[at] === line || ways[at + 1] === line) {
            this.older[set] = ways[at] === line ? 1 : 0;
        } else {
            if (this.stale.has(line)) {
                throw new FirmwareError(`the flash is read at 0x${(address >>> 0).toString(16)}, which the cache holds from before a change: XIP_CTRL FLUSH is missing`);
            }
            ways[at + this.older[set]] = line;
            this.older[set] ^= 1;
            this.waits.cycles += LINE_CLOCKS * this.registers[BAUDR];
        }
        this.line = line;
    }

    #whyNot() {
        if (this.flash.busyUntil > this.now()) {
            return "it is busy";
        }
        return this.outover ? `its select line is forced by OUTOVER ${this.outover}` : "the SSI is not set for the read 03h";
    }

    /** Whether it can be read at its addresses now. */
    #settled() {
        const { registers } = this;
        this.open = this.outover === 0 && this.flash.busyUntil <= this.now() && registers[SSIENR] === 1 && registers[SER] === 1 && registers[BAUDR] >= 2 &&
            Object.entries(READ_03H).every(([offset, value]) => registers[offset] === value);
    }

    #closed() {
        this.open = false;
        this.line = -1;
    }

    /** What the cache holds of it is old. */
    #changed(from, size) {
        for (let line = (0x10000000 + from) >>> 3; line < (0x10000000 + from + size) >>> 3; ++line) {
            const at = this.tags.indexOf(line, 2 * (line % SETS));
            if (at >= 0 && at < 2 * (line % SETS) + 2) {
                this.tags[at] = -1;
                this.stale.add(line);
            }
        }
        this.#closed();
    }

    #selected(outover) {
        this.#shift();
        if (this.shifting.length > 0) {
            throw new FirmwareError("flash: the select line changes while a byte is on its way");
        }
        if (outover === OUTOVER_LOW && this.outover !== OUTOVER_LOW) {
            this.flash.select();
        } else if (outover !== OUTOVER_LOW && this.outover === OUTOVER_LOW) {
            this.flash.deselect(this.now());
        }
        this.outover = outover;
        this.#closed();
    }

    /** Bytes whose time is over are in the other FIFO. */
    #shift() {
        while (this.shifting.length > 0 && this.shifting[0].ns <= this.now()) {
            const { byte, ns } = this.shifting.shift();
            if (this.received.length >= FIFO_SIZE) {
                throw new FirmwareError("SSI: a byte is received by a full FIFO");
            }
            this.received.push(this.flash.exchange(byte, ns));
        }
    }

    readUint32(offset) {
        this.#shift();
        const { shifting, received } = this, waiting = Math.max(0, shifting.length - 1);
        switch (offset) {
            case SR:
                return (shifting.length > 0 ? SR_BUSY : 0) | (waiting < FIFO_SIZE ? SR_TFNF : 0) | (waiting === 0 ? SR_TFE : 0) |
                       (received.length > 0 ? SR_RFNE : 0) | (received.length === FIFO_SIZE ? SR_RFF : 0);
            case TXFLR:
                return waiting;
            case RXFLR:
                return received.length;
            case ICR:
                return 0;
            case DR0:
                if (received.length === 0) {
                    throw new FirmwareError("SSI: DR0 is read, but nothing was received");
                }
                return received.shift();
            default:
                return this.registers[offset] ?? super.readUint32(offset);
        }
    }

    writeUint32(offset, value) {
        this.#shift();
        if (offset === DR0) {
            this.#send(value & 0xff);
            return;
        }
        if (!(offset in this.registers)) {
            super.writeUint32(offset, value);
            return;
        }
        if (this.registers[SSIENR] === 1 && offset !== SSIENR && offset !== SER) {
            throw new FirmwareError(`SSI: register 0x${offset.toString(16)} is written while SSIENR is 1`);
        }
        this.registers[offset] = value >>> 0;
        if (offset === SSIENR) {
            this.shifting = [];
            this.received = [];
        }
        this.#closed();
    }

    #send(byte) {
        const { registers, shifting } = this;
        if (registers[SSIENR] !== 1 || registers[CTRLR0] !== FRAMES_OF_8_BITS || registers[SER] !== 1 || registers[BAUDR] < 2 || this.outover !== OUTOVER_LOW) {
            throw new FirmwareError("SSI: DR0 is written, but it is not set for frames of 8 bits with the select line low (OUTOVER 2)");
        }
        if (shifting.length > FIFO_SIZE) {
            throw new FirmwareError("SSI: DR0 is written to a full FIFO");
        }
        const from = Math.max(this.now(), shifting.at(-1)?.ns ?? 0);
        shifting.push({ byte, ns: from + 8 * registers[BAUDR] * this.cycleNs });
    }
}
