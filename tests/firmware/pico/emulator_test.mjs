#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// The emulated Pico keeps time as the chip does, with self_test.cpp in it: emulator_test.mjs ELF UF2. What edges and bytes must be is computed here.
import assert from "node:assert/strict";
import { FirmwareError, Pico } from "./rp2040.mjs";

const [elf, uf2] = process.argv.slice(2);
const MS = 1e6;
const BYTE_NS = 1e10 / 115200;

function started(options = {}) {
    const pico = new Pico(options);
    pico.load(elf);
    pico.powerUp();
    return pico;
}

const CONTACTS = [2 * MS + 3, 2.5 * MS + 77, 7 * MS, 7 * MS + 8 * 41];

/** Word i of its ring has levels of GPIO2 and 3, and takes OUT, OUT and so many JMP. */
function edgesAreThoseOfTheRing() {
    const seen = [true, false].map((skips) => {
        const pico = started({ skips });
        CONTACTS.forEach((ns, i) => pico.at(ns, () => pico.contact(10, i % 2 ? null : 0)));
        pico.run(10 * MS);
        return pico.takeEdges();
    });
    assert.deepEqual(seen[0], seen[1], "cycles that are passed in one go change edges");
    const pulse = seen[0].filter(({ pin }) => pin === 4).slice(-2);
    assert.deepEqual([pulse[0].level, pulse[1].level, pulse[1].ns - pulse[0].ns], [1, 0, 8 * 21], "SET with a delay of 20");
    const followed = seen[0].filter(({ pin, ns }) => pin === 7 && ns > 2 * MS);
    assert.deepEqual(followed.map(({ level }) => level), [1, 0, 1, 0]);
    // WAIT ends with the contact (a chip's synchroniser takes two cycles more), SET is in the next cycle.
    followed.forEach(({ ns }, i) => assert.equal(ns, 8 * (Math.floor(CONTACTS[i] / 8) + 1), `a pin that WAIT waits for, ${CONTACTS[i]}`));
    assert(seen[0].filter(({ pin }) => pin === 6).length > 40, "OUT of a FIFO that was empty");
    const edges = seen[0].filter(({ pin, level }) => pin === 2 || pin === 3 && level !== null);
    const first = edges.findIndex(({ pin, level }) => pin === 2 && level === 1);
    let ns = edges[first].ns;
    const planned = [];
    for (let i = 1, levels = 0; planned.length < edges.length - first; i = (i + 1) % 32) {
        const next = i & 3;
        for (const bit of [0, 1]) {
            if ((levels ^ next) >> bit & 1) {
                planned.push({ ns, pin: 2 + bit, level: next >> bit & 1 });
            }
        }
        levels = next;
        ns += 8 * (3 + (i === 31 ? 12345 : i * i));
    }
    planned.length = edges.length - first;
    assert(planned.length > 2000);
    assert.deepEqual(edges.slice(first), planned);
    return `${planned.length} edges of a DMA ring in PIO0, each at its cycle, with and without skipping`;
}

function ticksAre200us() {
    const pico = started();
    pico.run(30 * MS);
    assert.equal(pico.chip.clkSys, 125e6);
    const ticks = pico.takeEdges().filter(({ pin }) => pin === 25).map(({ ns }) => ns).slice(5); // the first ones wait for the cache
    assert(ticks.length > 140);
    // An instruction is whole before the interrupt, so some cycles later or earlier.
    ticks.forEach((ns, i) => assert(Math.abs(ns - ticks[0] - i * 200e3) <= 64, `tick ${i} at ${ns}`));
    return `${ticks.length} ticks of 200 us`;
}

function bytesTakeTheirTime() {
    const pico = started(), heard = [];
    while (heard.length < 6) {
        pico.run(pico.ns + 1000);
        assert(pico.ns < 5 * MS, "it does not greet");
        heard.push(...Array.from(pico.takeSaid(), () => pico.ns));
    }
    heard.forEach((ns, i) => assert(Math.abs(ns - heard[0] - i * BYTE_NS) < 2000, `byte ${i} of the greeting comes at ${ns}`));
    pico.run(5 * MS);
    pico.send("ab");
    pico.run(pico.ns + BYTE_NS - 1000);
    assert.equal(pico.uart.received.length, 0, "a byte has come before its time");
    pico.run(pico.ns + 2000);
    assert.equal(pico.uart.received.length, 1);
    const from = pico.ns;
    while (pico.said === "") {
        pico.run(pico.ns + 1000);
        assert(pico.ns < from + 200e3 + BYTE_NS + 20e3, "its echo comes late");
    }
    assert(pico.ns > from + BYTE_NS, "its echo comes before its time");
    pico.run(pico.ns + MS);
    assert.equal(pico.takeSaid(), "ab");
    pico.send("x".repeat(20));
    pico.run(pico.ns + 10 * MS);
    assert.deepEqual([pico.takeSaid(), pico.uart.overruns], ["x".repeat(20), 0]);
    pico.send("y".repeat(100)); // it takes one in 200 us, of which two come
    pico.run(pico.ns + 30 * MS);
    assert.equal(pico.takeSaid().length + pico.uart.overruns, 100);
    assert(pico.uart.overruns > 20);
    return "UART0 has 115200 baud, and loses what a full FIFO gets";
}

function inputsAreSeen() {
    const pico = started();
    pico.run(3 * MS);
    const shown = () => pico.takeEdges().filter(({ pin }) => pin === 9).map(({ level }) => level);
    assert.deepEqual(shown(), [0, 1]); // its pull-up, once it is set
    pico.at(3.5 * MS, () => pico.contact(10, 0));
    pico.run(4 * MS);
    const [{ ns, level }] = pico.takeEdges().filter(({ pin }) => pin === 9);
    assert(level === 0 && ns >= 3.5 * MS && ns < 3.5 * MS + 250e3, `seen at ${ns}`);
    pico.contact(10, null);
    pico.run(5 * MS);
    assert.deepEqual(shown(), [1]);
    return "an input at its instant, and a pull-up";
}

function resetsKeepTheRam() {
    const pico = started({ seed: 3 });
    const noise = Buffer.from(pico.ram.subarray(0x30000, 0x30100));
    assert(new Set(noise).size > 100);
    assert.deepEqual(Buffer.from(started({ seed: 3 }).ram.subarray(0x30000, 0x30100)), noise);
    assert.notDeepEqual(Buffer.from(started({ seed: 4 }).ram.subarray(0x30000, 0x30100)), noise);
    pico.run(3 * MS);
    pico.send("w");
    pico.run(8 * MS);
    assert.deepEqual([pico.takeSaid(), pico.resets], ["hello\nwagain\n", 2]);
    pico.takeEdges();
    const { ns } = pico;
    pico.reset();
    assert.deepEqual(pico.takeEdges().filter((edge) => edge.ns === ns && edge.level === null).map(({ pin }) => pin), [2, 3, 4, 6, 7, 9, 25], "a reset ends outputs");
    // No watchdog: RAM is kept, its reason is not
    pico.run(pico.ns + 3 * MS);
    assert.equal(pico.takeSaid(), "hello\n");
    return "a watchdog's reset keeps the RAM, and says why";
}

function bootRomChecks() {
    const whole = new Pico();
    whole.load(uf2);
    const { bytes } = started().flash;
    assert.deepEqual(whole.flash.bytes.subarray(0, 0x400), bytes.subarray(0, 0x400));
    for (const at of [0, 20, 251, 252, 255]) {
        const pico = new Pico();
        pico.load(elf);
        pico.flash.bytes[at] ^= 1;
        assert.throws(() => pico.powerUp(), /boot2: its CRC32/);
    }
    return "the boot ROM refuses a second stage with another CRC";
}

/** A driver of the flash in place of the processor, which waits. */
class Driver {
    constructor(options) {
        this.pico = started(options);
        this.pico.run(2 * MS); // until boot2 is over
        Object.assign(this.pico.chip.core, { waiting: true, enabledInterrupts: 0 });
        this.write(0xe000e010, 0);
        this.command();
    }
    write(address, value) {
        this.pico.chip.writeUint32(address, value);
    }
    read(address) {
        return this.pico.chip.readUint32(address);
    }
    wait(ns) {
        this.pico.chip.core.pendingSystick = false;
        this.pico.run(this.pico.ns + ns);
    }
    #set(...writes) {
        this.write(0x18000008, 0);
        writes.forEach(([offset, value]) => this.write(0x18000000 + offset, value));
        this.write(0x18000008, 1);
    }
    command() {
        this.#set([0x14, 4], [0, 7 << 16]);
    }
    mapped() {
        this.write(0x4001800c, 0);
        this.#set([0, 31 << 16 | 3 << 8], [4, 0], [0xf4, 3 << 24 | 6 << 2 | 2 << 8]);
    }
    exchange(...bytes) {
        this.write(0x4001800c, 2 << 8);
        const answer = bytes.map((byte) => {
            this.write(0x18000060, byte);
            while (!(this.read(0x18000028) & 8)) {
                this.wait(64);
            }
            return this.read(0x18000060);
        });
        this.write(0x4001800c, 3 << 8);
        return answer;
    }
    ready() {
        const from = this.pico.ns;
        while (this.pico.powered && this.exchange(5, 0)[1] & 1) {
            this.wait(100e3);
        }
        return this.pico.ns - from;
    }
    #begin(code, address, ...data) {
        this.exchange(6);
        this.exchange(code, address >> 16, address >> 8 & 255, address & 255, ...data);
    }
    erase(address) {
        this.#begin(0x20, address);
    }
    program(address, data) {
        this.#begin(0x02, address, ...data);
    }
}

function flashIsAsItsDatasheetSays() {
    const d = new Driver(), { bytes } = d.pico.flash, at = 0x1ff000;
    assert.deepEqual(d.exchange(0x9f, 0, 0, 0).slice(1), [0xef, 0x40, 0x15]);
    const from = d.pico.ns;
    d.exchange(5, 0);
    assert(Math.abs(d.pico.ns - from - 2 * 8 * 4 * 8) <= 128, "a byte has 8 clocks of 32 ns");
    d.program(at + 0xfe, [1, 2, 3]); // behind the page comes its begin
    const programmed = d.ready();
    assert(programmed > 0.3 * MS && programmed < 3 * MS, `a page takes ${programmed} ns`);
    assert.deepEqual([bytes[at + 0xfe], bytes[at + 0xff], bytes[at], bytes[at + 0x100]], [1, 2, 3, 0xff]);
    d.program(at, [0xf1]);
    d.ready();
    assert.equal(bytes[at], 3 & 0xf1, "programming only clears bits");
    d.exchange(0x20, 0x1f, 0xf0, 0);
    d.ready();
    assert.equal(bytes[at], 1, "it erases without being enabled");
    assert.deepEqual(d.exchange(3, 0x1f, 0xf0, 0xfe, 0, 0, 0).slice(4), [1, 2, 0xff]);
    d.erase(at + 77);
    assert.throws(() => d.exchange(3, 0, 0, 0, 0), /while it is busy/);
    d.write(0x4001800c, 3 << 8);
    const erased = d.ready();
    assert(erased > 40 * MS && erased < 400 * MS, `a sector takes ${erased} ns`);
    assert(bytes.subarray(at, at + 4096).every((byte) => byte === 0xff));
    assert.equal(bytes[at - 1], 0xff);
    return "the flash: commands, pages, sectors, times";
}

function flashMistakesAreTold() {
    const d = new Driver();
    assert.throws(() => d.read(0x10000100), /the SSI is not set/);
    d.mapped();
    assert.equal(d.read(0x10000100), new DataView(d.pico.flash.bytes.buffer).getUint32(0x100, true));
    d.write(0x4001800c, 3 << 8);
    assert.throws(() => d.read(0x10000104), /forced by OUTOVER/);
    assert.throws(() => d.write(0x18000000, 0), /while SSIENR is 1/);
    d.mapped();
    d.read(0x101ff000);
    d.command();
    d.program(0x1ff000, [0]);
    d.mapped();
    assert.throws(() => d.read(0x101ff000), /it is busy/);
    d.wait(MS);
    assert.throws(() => d.read(0x101ff000), /from before a change/);
    d.write(0x14000004, 1);
    assert.equal(d.read(0x101ff000) & 0xff, 0);
    assert.throws(() => d.write(0x10000000, 0), FirmwareError);
    assert.throws(() => d.read(0x40054028), /RESETS holds it/);
    assert.throws(() => d.read(0x20000002), /not aligned/);
    return "mistakes at the flash, and peripherals in reset, are told";
}

/** A cut leaves what was written before it, and of what it interrupts any state; the next start has all of it. */
function powerIsCut() {
    const data = Array.from({ length: 16 }, (_, i) => 0x11 * i), at = 0x1fe000, states = new Set();
    for (let steps = 0; steps <= 17; ++steps) {
        const d = new Driver({ seed: 100 + steps });
        d.pico.flash.bytes.fill(0x5a, at, at + 4096);
        d.pico.flash.cutAfter(steps);
        d.erase(at);
        if (steps > 0) {
            d.ready();
            d.program(at, data);
        }
        const { bytes, steps: made } = d.pico.flash;
        assert.equal(d.pico.powered, steps === 17);
        assert.equal(made, Math.min(steps, 17));
        if (steps === 0) {
            continue;
        }
        assert.deepEqual([...bytes.subarray(at, at + steps - 1)], data.slice(0, steps - 1));
        if (steps < 17) {
            assert.equal(bytes[at + steps - 1] & data[steps - 1], data[steps - 1]);
            assert(bytes.subarray(at + steps, at + 4096).every((byte) => byte === 0xff));
            const { ns } = d.pico;
            d.pico.run(ns + MS);
            assert.equal(d.pico.ns, ns, "it runs without power");
            d.pico.powerUp();
            d.pico.run(ns + 5 * MS);
            assert.equal(d.pico.takeSaid().slice(-6), "hello\n");
            assert.deepEqual([...bytes.subarray(at, at + steps - 1)], data.slice(0, steps - 1));
        }
    }
    for (let seed = 0; seed < 16; ++seed) {
        const d = new Driver({ seed });
        d.pico.flash.bytes.fill(0x5a, at, at + 4096);
        d.pico.flash.cutAfter(0);
        d.erase(at);
        const left = d.pico.flash.bytes.subarray(at, at + 4096);
        assert(!d.pico.powered && !left.every((byte) => byte === 0xff));
        states.add(left.every((byte) => byte === 0x5a) ? "as before" : left.every((byte) => (byte & 0x5a) === 0x5a) ? "some bits" : new Set(left).size > 100 ? "anything" : "nearly");
    }
    assert(states.has("as before") && states.has("some bits") && states.size > 2, [...states].join());
    return `power cuts in 17 bytes and sectors, and an erase that leaves ${[...states].join(", ")}`;
}

for (const test of [edgesAreThoseOfTheRing, ticksAre200us, bytesTakeTheirTime, inputsAreSeen, resetsKeepTheRam, bootRomChecks, flashIsAsItsDatasheetSays, flashMistakesAreTold, powerIsCut]) {
    console.log(test());
}
