// SPDX-License-Identifier: MIT
// UART0 in the chip's time: a PL011 (datasheet 4.2) with its FIFOs, and a line of 115200 baud, 8N1. rp2040js sends a byte at once.
import { BasePeripheral, FirmwareError, IRQ } from "./emulator.mjs";

const BAUD = 115200;
const DR = 0x00, RSR = 0x04, FR = 0x18, IBRD = 0x24, FBRD = 0x28, LCR_H = 0x2c, CR = 0x30, IFLS = 0x34, IMSC = 0x38, RIS = 0x3c, MIS = 0x40, ICR = 0x44;
const FR_BUSY = 1 << 3, FR_RXFE = 1 << 4, FR_TXFF = 1 << 5, FR_RXFF = 1 << 6, FR_TXFE = 1 << 7;
const RX = 1 << 4, TX = 1 << 5, RT = 1 << 6, OE = 1 << 10; // interrupts
const LCR_H_FEN = 1 << 4, CR_UARTEN = 1, CR_TXE = 1 << 8, CR_RXE = 1 << 9;
const WORDS_8N1 = 0x60;
const LEVELS = [4, 8, 16, 24, 28]; // of IFLS, in a FIFO of 32
const FUNCTION_UART = 2;

export class Uart extends BasePeripheral {
    /** @param line where bytes come from, `line.next()` or undefined, and go to, `line.say(byte)` */
    constructor(chip, line) {
        super(chip, "UART0");
        Object.assign(this, { chip, line, overruns: 0, sending: null, sent: [], received: [], raw: 0 });
        this.registers = { [IBRD]: 0, [FBRD]: 0, [LCR_H]: 0, [CR]: CR_TXE | CR_RXE, [IFLS]: 0x12, [IMSC]: 0 };
        this.sentAlarm = chip.clock.createAlarm(() => this.#byteSent());
        this.receivedAlarm = chip.clock.createAlarm(() => this.#byteReceived());
        this.timeoutAlarm = chip.clock.createAlarm(() => this.#raise(this.received.length > 0 ? RT : 0));
        this.receiving = undefined;
    }

    clkPeriChanged() {}

    get depth() {
        return this.registers[LCR_H] & LCR_H_FEN ? 32 : 1;
    }

    /** Of a byte with its start and stop bit; the firmware's own rate must be that of the line within 2 %. */
    byteNs() {
        const { chip, registers } = this;
        const baud = chip.clkPeri / (16 * (registers[IBRD] + registers[FBRD] / 64));
        if (!(Math.abs(baud / BAUD - 1) < 0.02)) {
            throw new FirmwareError(`UART0 has ${baud} baud, the line ${BAUD}: clk_peri is ${chip.clkPeri} Hz, UARTIBRD ${registers[IBRD]}, UARTFBRD ${registers[FBRD]}`);
        }
        if ((registers[LCR_H] & ~LCR_H_FEN) !== WORDS_8N1) {
            throw new FirmwareError(`UART0: UARTLCR_H is 0x${registers[LCR_H].toString(16)}, the line has 8 bits, no parity, one stop bit`);
        }
        return 1e10 / baud;
    }

    /** There is something to receive. */
    wake() {
        if (this.receiving === undefined) {
            this.receiving = this.line.next();
            if (this.receiving !== undefined) {
                this.receivedAlarm.schedule(1e10 / BAUD);
            }
        }
    }

    #byteReceived() {
        const { chip, received } = this, byte = this.receiving;
        this.receiving = undefined;
        const pin = chip.gpio[1];
        if ((this.registers[CR] & (CR_UARTEN | CR_RXE)) === (CR_UARTEN | CR_RXE) && pin.functionSelect === FUNCTION_UART && pin.inputEnable) {
            this.byteNs();
            if (received.length >= this.depth) {
                ++this.overruns;
                this.#raise(OE);
            } else {
                received.push(byte);
                this.#raise(received.length >= LEVELS[(this.registers[IFLS] >> 3) & 7] || this.depth === 1 ? RX : 0);
            }
            this.timeoutAlarm.schedule(32e9 / BAUD);
        }
        this.wake();
    }

    #byteSent() {
        const byte = this.sending;
        this.sending = null;
        if (this.chip.gpio[0].functionSelect === FUNCTION_UART) {
            this.line.say(byte);
        }
        this.#send();
    }

    #send() {
        if (this.sending === null && this.sent.length > 0) {
            this.sending = this.sent.shift();
            this.sentAlarm.schedule(this.byteNs());
            this.#raise(this.sent.length <= 32 - LEVELS[4 - Math.min(4, this.registers[IFLS] & 7)] ? TX : 0);
        }
    }

    #raise(bits) {
        this.raw |= bits;
        this.chip.setInterrupt(IRQ.UART0, (this.raw & this.registers[IMSC]) !== 0);
    }

    readUint32(offset) {
        switch (offset) {
            case DR: {
                const byte = this.received.shift() ?? 0;
                this.raw &= ~((this.received.length < LEVELS[(this.registers[IFLS] >> 3) & 7] ? RX : 0) | (this.received.length === 0 ? RT : 0));
                this.#raise(0);
                return byte;
            }
            case RSR:
                return this.raw & OE ? 8 : 0;
            case FR:
                return (this.sending !== null ? FR_BUSY : 0) | (this.received.length === 0 ? FR_RXFE : 0) | (this.received.length >= this.depth ? FR_RXFF : 0) |
                       (this.sent.length >= this.depth ? FR_TXFF : 0) | (this.sent.length === 0 ? FR_TXFE : 0);
            case RIS:
                return this.raw;
            case MIS:
                return this.raw & this.registers[IMSC];
            default:
                return this.registers[offset] ?? super.readUint32(offset);
        }
    }

    writeUint32(offset, value) {
        switch (offset) {
            case DR:
                if (this.sent.length >= this.depth) {
                    throw new FirmwareError("UART0: a byte is written to a full FIFO");
                }
                if ((this.registers[CR] & (CR_UARTEN | CR_TXE)) !== (CR_UARTEN | CR_TXE)) {
                    throw new FirmwareError("UART0: a byte is written, but UARTCR does not enable it");
                }
                this.sent.push(value & 0xff);
                this.raw &= ~TX;
                this.#raise(0);
                this.#send();
                return;
            case RSR:
                return;
            case ICR:
                this.raw &= ~this.rawWriteValue;
                this.#raise(0);
                return;
            default:
                if (!(offset in this.registers)) {
                    super.writeUint32(offset, value);
                    return;
                }
                this.registers[offset] = value;
                this.#raise(0);
        }
    }
}
