// SPDX-License-Identifier: MIT
// A Raspberry Pi Pico in rp2040js, whose processor, clock, DMA and PIO have one time: cycles of 8 ns. Nothing happens but in run().
//
//     const pico = new Pico({ seed: 7 });                 // skips: false steps each cycle of the PIO
//     pico.load("firmware_rp2040.elf");                   // .elf, .uf2 or .bin, into the flash
//     pico.powerUp();                                     // RAM has noise of the seed; then what the boot ROM does
//     pico.run(pico.ns + 5e6);                            // 5 ms; throws FirmwareError for what no Pico would have done
//     pico.takeEdges();                                   // [{ ns, pin, level }] of outputs since the last call; level null: no output any more
//     pico.send("G0 X1\n"); pico.takeSaid();              // UART0 in the chip's time, at 115200 baud; text as latin1
//     pico.contact(10, 0);                                // an input: 0, 1, or null for open, where its pad's pull decides
//     pico.at(ns, () => pico.contact(10, 1));             // at an instant
//     pico.reset();                                       // the RUN pin: as powerUp(), but the RAM stays; resets counts all of them
//     pico.powerOff();                                    // run() ends, and does nothing until powerUp()
//     pico.onEdge = (edge) => pico.stop();                // called at each edge; stop() ends run() there
//     pico.flash.cutAfter(n);                             // n bytes or sectors are written, the next one is cut: run() ends, powered is false
//     pico.flash.bytes                                    // stays over everything; writeFileSync() saves it
//     pico.usb.attach(); pico.usb.send("?"); pico.usb.said // a host behind a cable: usb_cable.mjs
//
// Reads of the flash take the time of the cache and of serial reads: code that is not in the cache runs at a hundredth of the speed.
// chip is rp2040js's RP2040 since the last reset, chip.clkSys what the firmware has made of its clocks: until then 6.5 MHz, with cycles of 8 ns.
import { FirmwareError, RP2040, SimulationClock, random } from "./emulator.mjs";
import { partsOf } from "./image.mjs";
import { mapMemory } from "./memory_map.mjs";
import { PioCycles } from "./pio.mjs";
import { processor } from "./processor.mjs";
import { SysTick } from "./systick.mjs";
import { Uart } from "./uart.mjs";
import { UsbCable } from "./usb_cable.mjs";
import { W25q } from "./w25q.mjs";
import { Xip } from "./xip.mjs";

export { FirmwareError };

export const CYCLE_NS = 8;
const RAM = 0x20000000, BOOT2 = 0x20041f00, BOOT2_SIZE = 256;
const UART0 = 0x40034, WATCHDOG = 0x40058, PSM = 0x40010, PADS_BANK0 = 0x4001c;
const PAD_AT_RESET = 0x56; // 2.19.6.3: input enabled, Schmitt trigger, pull-down, 4 mA
const PAD_PUE = 8, PAD_PDE = 4;
const EXCEPTION_CYCLES = 15; // to enter, and as many to return
const DMA_CHAN_ABORT = 0x444;
const REF_MHZ = 12, WATCHDOG_CTRL = 0, WATCHDOG_TICK = 0x2c, WATCHDOG_ENABLE = 1 << 30, PSM_PROC0 = 1 << 15;
const HARMLESS = /clkDivRestart not implemented/; // there is no divider but 1

/** Datasheet 2.8.1.3.1: polynomial 0x04c11db7 from the highest bit on, begun with ones, nothing reflected. */
export function crc32(bytes) {
    let crc = 0xffffffff;
    for (const byte of bytes) {
        crc ^= byte << 24;
        for (let bit = 0; bit < 8; ++bit) {
            crc = (crc << 1) ^ (crc & 0x80000000 ? 0x04c11db7 : 0);
        }
    }
    return crc >>> 0;
}

export class Pico {
    constructor({ seed = 1, skips = true } = {}) {
        Object.assign(this, { skips, resets: 0, origin: 0, onEdge: null, edges: [], stopped: false, powered: false, resetAsked: false });
        this.random = random(seed);
        this.flash = new W25q(this.random, () => this.powerOff());
        this.ram = new Uint8Array(264 << 10);
        this.contacts = new Array(30).fill(null);
        this.levels = new Array(30).fill(null); // of outputs
        this.later = []; // [ns, action], in order
        this.heard = [];
        this.said = "";
        this.chip = null;
        this.usb = new UsbCable();
        this.waits = { cycles: 0 }; // of the processor, beside what its instructions take
    }

    get ns() {
        return this.origin + (this.chip?.clock.nanos ?? 0);
    }

    load(path) {
        for (const { offset, bytes } of partsOf(path)) {
            this.flash.bytes.set(bytes, offset);
        }
    }

    powerUp() {
        const words = new Uint32Array(this.ram.buffer);
        for (let i = 0; i < words.length; ++i) {
            words[i] = this.random();
        }
        this.powered = true;
        this.flash.start();
        this.#boot(null);
    }

    powerOff() {
        this.powered = false;
        this.stopped = true;
    }

    reset() {
        this.#boot(null);
    }

    send(text) {
        this.heard.push(...Buffer.from(text, "latin1"));
        this.uart.wake();
    }

    takeSaid() {
        const said = this.said;
        this.said = "";
        return said;
    }

    takeEdges() {
        const edges = this.edges;
        this.edges = [];
        return edges;
    }

    contact(pin, level) {
        this.contacts[pin] = level;
        this.#settle(pin);
    }

    at(ns, action) {
        const behind = this.later.findIndex(([other]) => other > ns);
        this.later.splice(behind < 0 ? this.later.length : behind, 0, [ns, action]);
    }

    stop() {
        this.stopped = true;
    }

    /** Until that instant, or stop(): the instruction at it is over. */
    run(untilNs) {
        this.stopped = !this.powered;
        try {
            while (this.ns < untilNs && !this.stopped) {
                this.#runChip(Math.min(untilNs, this.later[0]?.[0] ?? Infinity) - this.origin);
                while (this.later.length > 0 && this.later[0][0] <= this.ns && !this.stopped) {
                    this.later.shift()[1]();
                }
                if (this.resetAsked && this.powered) {
                    this.#boot(this.chip.peripherals[WATCHDOG]);
                }
            }
        } catch (problem) {
            if (problem instanceof FirmwareError) {
                problem.message = `at ${this.ns} ns, PC 0x${this.chip.core.PC.toString(16)}: ${problem.message}`;
            }
            throw problem;
        }
    }

    #runChip(until) {
        const { chip, pios: [pio0, pio1] } = this, { core, clock } = chip;
        while (clock.nanosCounter < until && !this.stopped && !this.resetAsked) {
            const event = Math.min(until, clock.nextAlarm?.nanos ?? Infinity, pio0.next * CYCLE_NS, pio1.next * CYCLE_NS);
            if (core.waiting && !(core.pendingInterrupts & core.enabledInterrupts) && !core.pendingSystick && !core.pendingPendSV) {
                this.#advance(event);
            } else {
                core.waiting = false;
                const from = clock.nanosCounter;
                this.execute(event);
                const to = clock.nanosCounter;
                clock.nanosCounter = from;
                this.#advance(to);
            }
        }
    }

    /** Cycles of the PIO and alarms until there, in their order. */
    #advance(to) {
        const { clock } = this.chip;
        for (;;) {
            const at = Math.min(clock.nextAlarm?.nanos ?? Infinity, this.pios[0].next * CYCLE_NS, this.pios[1].next * CYCLE_NS);
            if (at > to || this.resetAsked) {
                break;
            }
            clock.nanosCounter = Math.max(at, clock.nanosCounter);
            for (const pio of this.pios) {
                if (pio.next * CYCLE_NS <= at) {
                    pio.step();
                }
            }
            clock.tick(0);
        }
        clock.nanosCounter = Math.max(to, clock.nanosCounter);
    }

    /** @param watchdog of the chip before, which keeps its reason and scratch registers; null: they are cleared, too */
    #boot(watchdog) {
        this.origin = this.ns;
        const clock = new SimulationClock();
        this.resetAsked = false;
        ++this.resets;
        const chip = this.chip = new RP2040(clock);
        Object.assign(chip, { clkSys: chip.roscFreq, clkPeri: 0 });
        chip.logger = { debug() {}, info() {}, warn: refused, error: refused };
        chip.onBreak = (code) => { throw new FirmwareError(`BKPT or UDF ${code}`); };
        chip.core.setInterrupt = function (irq, value) {
            // A waiting processor is woken by run(); with PRIMASK it goes on without the interrupt, which rp2040js would enter.
            this.pendingInterrupts = value ? this.pendingInterrupts | 1 << irq : this.pendingInterrupts & ~(1 << irq);
            this.interruptsUpdated = true;
        };
        for (const way of ["exceptionEntry", "exceptionReturn"]) {
            const go = chip.core[way].bind(chip.core);
            chip.core[way] = (number) => {
                this.waits.cycles += EXCEPTION_CYCLES;
                go(number);
            };
        }
        this.waits.cycles = 0;
        this.xip = new Xip(chip, this.flash, () => clock.nanos + this.origin, this.waits, CYCLE_NS);
        this.systick = new SysTick(chip, CYCLE_NS);
        this.uart = chip.uart[0] = chip.peripherals[UART0] = new Uart(chip, { next: () => this.heard.shift(), say: (byte) => { this.said += String.fromCharCode(byte); } });
        this.uart.wake();
        this.usb.plugInto(chip);
        this.#followPins();
        this.pios = chip.pio.map((pio) => this.#followPio(pio));
        this.#followWatchdog(watchdog);
        const read = chip.dma.readUint32.bind(chip.dma);
        chip.dma.readUint32 = (offset) => (offset === DMA_CHAN_ABORT ? 0 : read(offset)); // it is over at once
        mapMemory(chip, this.ram, this.xip);
        this.execute = processor(chip, this.ram, this.xip, this.waits, CYCLE_NS);
        this.#bootRom();
    }

    #followPins() {
        const { chip } = this;
        for (const pin of chip.gpio) {
            pin.padValue = PAD_AT_RESET;
            pin.lastValue = pin.value;
            pin.addListener(() => {
                this.#settle(pin.index);
                this.#note(pin);
            });
            this.#note(pin); // a reset ends an output
            this.#settle(pin.index);
        }
        const pads = chip.peripherals[PADS_BANK0], write = pads.writeUint32.bind(pads);
        pads.writeUint32 = (offset, value) => {
            write(offset, value);
            if (offset >= 4 && offset < 4 + 4 * chip.gpio.length) {
                this.#settle((offset - 4) / 4);
            }
        };
    }

    #note(pin) {
        const level = pin.outputEnable ? Number(pin.outputValue) : null;
        if (level !== this.levels[pin.index]) {
            this.levels[pin.index] = level;
            const edge = { ns: this.ns, pin: pin.index, level };
            this.edges.push(edge);
            this.onEdge?.(edge);
        }
    }

    /** The level of a pin: what drives it, its contact, or its pull. */
    #settle(index) {
        const pin = this.chip.gpio[index];
        const pull = pin.padValue & (PAD_PUE | PAD_PDE);
        const level = pin.outputEnable ? pin.outputValue : this.contacts[index] ?? (pull === PAD_PUE || pull === (PAD_PUE | PAD_PDE) && pin.rawInputValue);
        if (Boolean(level) !== pin.rawInputValue) {
            pin.setInputValue(Boolean(level));
            for (const pio of this.pios ?? []) {
                pio.comeTo(Math.floor(this.chip.clock.nanos / CYCLE_NS));
                pio.touched();
            }
        }
    }

    #followPio(pio) {
        const { chip } = this;
        const cycles = new PioCycles(pio, (changed) => {
            for (let pin = 0; changed >>> pin; ++pin) {
                if (changed >>> pin & 1) {
                    chip.gpio[pin].checkForUpdates();
                }
            }
        }, this.skips);
        const read = pio.readUint32.bind(pio), write = pio.writeUint32.bind(pio);
        pio.readUint32 = (offset) => {
            cycles.comeTo(chip.clock.nanos / CYCLE_NS);
            const value = read(offset);
            cycles.touched();
            return value;
        };
        pio.writeUint32 = (offset, value) => {
            cycles.comeTo(chip.clock.nanos / CYCLE_NS);
            write(offset, value);
            cycles.touched();
        };
        return cycles;
    }

    #followWatchdog(before) {
        const watchdog = this.chip.peripherals[WATCHDOG];
        if (before) {
            watchdog.scratchData.set(before.scratchData);
            watchdog.reason = before.reason;
        }
        watchdog.onWatchdogTrigger = () => {
            if (!(this.chip.peripherals[PSM].wdsel & PSM_PROC0)) {
                throw new FirmwareError("the watchdog fires, but PSM WDSEL does not let it reset the processor");
            }
            watchdog.alarm.enable = false; // it would fire at the same instant again and again
            this.resetAsked = true;
        };
        let mhz = 0;
        const write = watchdog.writeUint32.bind(watchdog);
        watchdog.writeUint32 = (offset, value) => {
            if (offset === WATCHDOG_TICK) {
                mhz = value & 0x1ff;
            } else if (offset === WATCHDOG_CTRL && value & WATCHDOG_ENABLE && mhz !== REF_MHZ) {
                throw new FirmwareError(`WATCHDOG TICK has ${mhz} CYCLES, a microsecond has ${REF_MHZ} of the crystal`);
            }
            write(offset, value);
        };
    }

    #bootRom() {
        const { core } = this.chip, boot2 = this.flash.bytes.subarray(0, BOOT2_SIZE);
        const said = new DataView(boot2.buffer).getUint32(BOOT2_SIZE - 4, true), is = crc32(boot2.subarray(0, BOOT2_SIZE - 4));
        if (said !== is) {
            throw new FirmwareError(`boot2: its CRC32 is 0x${is.toString(16)}, its last word says 0x${said.toString(16)}`);
        }
        this.ram.set(boot2, BOOT2 - RAM);
        Object.assign(core, { VTOR: 0, SP: BOOT2, LR: 0, PC: BOOT2 });
    }
}

function refused(name, message) {
    if (!HARMLESS.test(message)) {
        throw new FirmwareError(`${name}: ${message}`);
    }
}
