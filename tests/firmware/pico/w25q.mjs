// SPDX-License-Identifier: MIT
// A W25Q16JV, the flash of the Pico: what comes in between its select lines, the times that erasing and programming take, and a power cut in either.
import { FirmwareError } from "./emulator.mjs";

const SIZE = 2 << 20, PAGE = 256, SECTOR = 4096;
const WRITE_ENABLE = 0x06, WRITE_DISABLE = 0x04, READ_STATUS = 0x05, PAGE_PROGRAM = 0x02, SECTOR_ERASE = 0x20, READ = 0x03, JEDEC_ID = 0x9f;
const BUSY = 1, WEL = 2;
const ID = [0xef, 0x40, 0x15];
const LENGTHS = { [WRITE_ENABLE]: [1, 1], [WRITE_DISABLE]: [1, 1], [READ_STATUS]: [1, Infinity], [PAGE_PROGRAM]: [5, Infinity], [SECTOR_ERASE]: [4, 4],
                  [READ]: [4, Infinity], [JEDEC_ID]: [1, Infinity] };

export class W25q {
    /** Typical times of its datasheet; the longest are 3 ms and 400 ms. @param lost is called when the power is cut */
    constructor(random, lost) {
        Object.assign(this, { random, lost, programNs: 400e3, eraseNs: 45e6, steps: 0, cut: Infinity, busyUntil: 0, enabled: false, command: null,
                              changed: () => {} });
        this.bytes = new Uint8Array(SIZE).fill(0xff);
    }

    /** A step is a byte that is programmed, or a sector that is erased. So many are whole from now on; in the next one the power is cut. */
    cutAfter(steps) {
        this.cut = this.steps + steps;
    }

    /** It has power again. */
    start() {
        Object.assign(this, { cut: Infinity, busyUntil: 0, enabled: false, command: null });
    }

    select() {
        this.command = [];
    }

    /** A byte goes in, another one comes out. */
    exchange(byte, ns) {
        const { command, bytes } = this, at = command.length;
        command.push(byte);
        const [code] = command;
        const busy = this.busyUntil > ns && code !== READ_STATUS;
        if (busy || !(code in LENGTHS)) {
            this.command = [];
            throw new FirmwareError(`flash: command 0x${code.toString(16)} ${busy ? "while it is busy" : "is not modelled"}`);
        }
        if (at === 0) {
            return 0xff;
        }
        switch (code) {
            case READ_STATUS:
                return (this.busyUntil > ns ? BUSY : 0) | (this.enabled ? WEL : 0);
            case JEDEC_ID:
                return ID[(at - 1) % 3];
            case READ:
                return at < 4 ? 0xff : bytes[(this.#address() + at - 4) % SIZE];
            default:
                return 0xff;
        }
    }

    deselect(ns) {
        const { command } = this;
        this.command = null;
        if (command === null || command.length === 0) {
            return;
        }
        const [code] = command, [least, most] = LENGTHS[code];
        if (command.length < least || command.length > most) {
            throw new FirmwareError(`flash: command 0x${code.toString(16)} with ${command.length} bytes`);
        }
        if (code === WRITE_ENABLE || code === WRITE_DISABLE) {
            this.enabled = code === WRITE_ENABLE;
        } else if (this.enabled && (code === PAGE_PROGRAM || code === SECTOR_ERASE)) {
            this.enabled = false;
            this.busyUntil = ns + (code === PAGE_PROGRAM ? this.programNs : this.eraseNs);
            const address = this.#address(command) % SIZE;
            if (code === PAGE_PROGRAM) {
                this.#program(address, command.slice(4));
            } else {
                this.#erase(address - address % SECTOR);
            }
        }
    }

    #address(command = this.command) {
        return command[1] << 16 | command[2] << 8 | command[3];
    }

    #program(address, data) {
        const page = address - address % PAGE, latch = new Map();
        data.forEach((byte, i) => latch.set((address + i) % PAGE, byte)); // behind the end of the page comes its begin
        this.changed(page, PAGE);
        for (const [at, byte] of latch) {
            if (this.#cuts()) {
                this.bytes[page + at] &= byte | this.random();
                this.lost();
                return;
            }
            this.bytes[page + at] &= byte;
        }
    }

    #erase(sector) {
        this.changed(sector, SECTOR);
        const cells = this.bytes.subarray(sector, sector + SECTOR);
        if (this.#cuts()) {
            this.#eraseInPart(cells);
            this.lost();
        } else {
            cells.fill(0xff);
        }
    }

    /** Of an erase that was cut the datasheet says nothing: all may be as before, some bits erased, all but a few, or anything. */
    #eraseInPart(cells) {
        const state = this.random() % 4;
        for (let i = 0; i < cells.length; ++i) {
            const noise = this.random();
            cells[i] = [cells[i], cells[i] | noise, 0xff & ~(noise & noise >> 8 & noise >> 16), noise][state];
        }
    }

    #cuts() {
        if (this.steps >= this.cut) {
            return true;
        }
        ++this.steps;
        return false;
    }
}
