#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Each Thumb instruction on registers does what the manual says (Armv6-M Architecture Reference Manual, A6.7), computed here with BigInt; with the cycles of the
// Cortex-M0+. Values are at the edges of the ranges and random.
import assert from "node:assert/strict";
import { FirmwareError, Pico, crc32 } from "./rp2040.mjs";
import { random } from "./emulator.mjs";

const pico = new Pico();
new DataView(pico.flash.bytes.buffer).setUint32(252, crc32(pico.flash.bytes.subarray(0, 252)), true);
pico.powerUp();
const { core, clock } = pico.chip, at = 0x20001000;
const next = random(58);
const EDGES = [0, 1, 2, 31, 32, 33, 63, 255, 256, 0x7ffffffe, 0x7fffffff, 0x80000000, 0x80000001, 0xfffffffe, 0xffffffff];
const value = () => (next() & 1 ? EDGES[next() % EDGES.length] : next());
const u = (big) => Number(BigInt.asUintN(32, big));
const s = (number) => BigInt.asIntN(32, BigInt(number));

/** a + b + carry with its flags; a - b is a + ~b + 1 */
function add(a, b, carry) {
    const wide = BigInt(a) + BigInt(b) + BigInt(carry), signed = s(a) + s(b) + BigInt(carry), result = u(wide);
    return { result, c: wide >> 32n ? 1 : 0, v: s(result) === signed ? 0 : 1 };
}
const subtract = (a, b, carry = 1) => add(a, ~b >>> 0, carry);
/** The last bit that goes out is C; none goes out by 0. */
function shift(kind, a, by, { c }) {
    if (by === 0) {
        return { result: a, c };
    }
    const bits = BigInt(by);
    switch (kind) {
        case "lsl": return { result: u(BigInt(a) << bits), c: Number(BigInt(a) << bits >> 32n & 1n) };
        case "lsr": return { result: u(BigInt(a) >> bits), c: Number(BigInt(a) >> bits - 1n & 1n) };
        case "asr": return { result: u(s(a) >> bits), c: Number(s(a) >> bits - 1n & 1n) };
        default: {
            const turned = bits & 31n, result = u(BigInt(a) >> turned | BigInt(a) << 32n - turned);
            return { result, c: result >>> 31 };
        }
    }
}

/** Data processing of two low registers, by the number in its opcode: what becomes of a (Rdn) and b (Rm); no result: only flags. */
const TWO = [
    (a, b) => ({ result: (a & b) >>> 0 }), (a, b) => ({ result: (a ^ b) >>> 0 }), (a, b, f) => shift("lsl", a, b & 255, f), (a, b, f) => shift("lsr", a, b & 255, f),
    (a, b, f) => shift("asr", a, b & 255, f), (a, b, f) => add(a, b, f.c), (a, b, f) => subtract(a, b, f.c), (a, b, f) => shift("ror", a, b & 255, f),
    (a, b) => ({ shown: (a & b) >>> 0 }), (a, b) => subtract(0, b), (a, b) => ({ ...subtract(a, b), only: true }), (a, b) => ({ ...add(a, b, 0), only: true }),
    (a, b) => ({ result: (a | b) >>> 0 }), (a, b) => ({ result: u(BigInt(a) * BigInt(b)) }), (a, b) => ({ result: (a & ~b) >>> 0 }), (a, b) => ({ result: ~b >>> 0 })];

/** [opcode, what becomes of r0 and r1, {result: of r0}] */
function instruction() {
    const kind = next() % 8, five = next() & 31, eight = next() & 255;
    switch (kind) {
        case 0: return [five << 6 | 1 << 3, (a, b, f) => shift("lsl", b, five, f)];
        case 1: return [1 << 11 | five << 6 | 1 << 3, (a, b, f) => shift("lsr", b, five || 32, f)];
        case 2: return [2 << 11 | five << 6 | 1 << 3, (a, b, f) => shift("asr", b, five || 32, f)];
        case 3: return five & 1 ? [0x1800 | 1 << 6, (a, b) => add(a, b, 0)] : [0x1a00 | 1 << 6, (a, b) => subtract(a, b)];
        case 4: return five & 1 ? [0x3000 | eight, (a) => add(a, eight, 0)] : [0x3800 | eight, (a) => subtract(a, eight)];
        case 5: return five & 1 ? [0x2000 | eight, () => ({ result: eight })] : [0x2800 | eight, (a) => ({ ...subtract(a, eight), only: true })];
        default: return [0x4000 | (five & 15) << 6 | 1 << 3, TWO[five & 15]];
    }
}

let count = 0;
for (; count < 40_000; ++count) {
    const [opcode, meaning] = instruction(), a = value(), b = value(), f = { c: next() & 1, v: next() & 1 };
    pico.chip.writeUint16(at, opcode);
    core.registers[0] = a;
    core.registers[1] = b;
    core.PC = at;
    Object.assign(core, { N: false, Z: false, C: f.c === 1, V: f.v === 1, interruptsUpdated: false });
    const from = clock.nanosCounter;
    pico.execute(from + 8);
    const { result, shown = result, only = false, c = f.c, v = f.v } = meaning(a, b, f);
    const is = [core.registers[0], core.registers[1], core.N, core.Z, core.C, core.V, core.PC, clock.nanosCounter - from];
    assert.deepEqual(is, [only || result === undefined ? a : result, b, shown >>> 31 === 1, shown === 0, c === 1, v === 1, at + 2, 8],
                     `case ${count}: 0x${opcode.toString(16)} of 0x${a.toString(16)}, 0x${b.toString(16)}, C ${f.c}, V ${f.v}`);
}

/** Runs halfwords from RAM until they come to their end; gives the cycles. */
function run(...opcodes) {
    opcodes.forEach((opcode, i) => pico.chip.writeUint16(at + 2 * i, opcode));
    Object.assign(core, { PC: at, interruptsUpdated: false });
    const from = clock.nanosCounter;
    while (core.PC !== at + 2 * opcodes.length) {
        assert(clock.nanosCounter - from < 8000, "it does not come to its end");
        pico.execute(clock.nanosCounter + 8);
    }
    return (clock.nanosCounter - from) / 8;
}
core.SP = 0x20002000;
core.registers.set([0x11223344, 0x80, 0x20003000, 3]);
assert.equal(run(0xb503, 0xbc30), 4 + 3); // push {r0, r1, lr}; pop {r4, r5}
assert.deepEqual([core.registers[4], core.registers[5], core.SP], [0x11223344, 0x80, 0x20002000 - 4]);
assert.equal(run(0x6010, 0x8056, 0x70d1, 0x6815, 0x56d4), 10); // str, strh, strb, ldr, ldrsb
assert.equal(pico.chip.readUint32(0x20003000) >>> 16 & 0xff, core.registers[6] & 0xff);
assert.equal(core.registers[4] >>> 0, 0xffffff80);
core.registers[2] = 0x20003000;
assert.equal(run(0xc203, 0x3a08, 0xca18), 3 + 1 + 3); // stmia r2!, {r0, r1}; subs; ldmia r2!, {r3, r4}
assert.deepEqual([core.registers[3], core.registers[4], core.registers[2]], [0x11223344, 0x80, 0x20003008]);
assert.equal(run(0x2005, 0x3801, 0xd1fd), 1 + 5 * 1 + 4 * 2 + 1); // movs r0, #5; subs; bne: taken costs 2
assert.equal(run(0xf000, 0xf801, 0x46c0, 0x4674), 3 + 1); // bl over a nop; mov r4, lr
assert.equal(core.registers[4], at + 4 | 1);
assert.equal(run(0xf3bf, 0x8f5f, 0x46c0), 3 + 1); // dmb; nop

const signed = (number) => number | 0;
/** By their numbers in the opcode, behind CMP a, b. */
const CONDITIONS = [
    (a, b) => a === b, (a, b) => a !== b, (a, b) => a >= b, (a, b) => a < b, (a, b) => signed(a - b) < 0, (a, b) => signed(a - b) >= 0,
    (a, b) => subtract(a, b).v === 1, (a, b) => subtract(a, b).v === 0, (a, b) => a > b, (a, b) => a <= b,
    (a, b) => signed(a) >= signed(b), (a, b) => signed(a) < signed(b), (a, b) => signed(a) > signed(b), (a, b) => signed(a) <= signed(b)];
for (let i = 0; i < 5000; ++i) {
    const condition = i % CONDITIONS.length, a = value(), b = next() & 3 ? value() : a;
    core.registers.set([a, b]);
    run(0x2200, 0x4288, 0xd000 | condition << 8, 0x2201, 0x46c0); // movs r2, #0; cmp r0, r1; b over movs r2, #1
    assert.equal(core.registers[2] === 0, CONDITIONS[condition](a, b), `condition ${condition} of ${a}, ${b}`);
}

/** [opcode of r0, [r1 + ...] or SP, bytes, whether it loads, signed, offset] */
function access() {
    const five = next() & 31, eight = next() & 63;
    switch (next() % 4) {
        case 0: return [0x6000 | five << 6 | 8, 4, false, false, 4 * five];
        case 1: return [0x9000 | eight, 4, false, false, 4 * eight];
        case 2: return next() & 1 ? [0x7000 | five << 6 | 8, 1, false, false, five] : [0x8000 | five << 6 | 8, 2, false, false, 2 * five];
        default: {
            const which = next() & 7, bytes = [4, 2, 1, 1, 4, 2, 1, 2][which];
            core.registers[2] = eight - eight % bytes;
            return [0x5000 | which << 9 | 2 << 6 | 8, bytes, which > 2, which === 3 || which === 7, core.registers[2]];
        }
    }
}
const area = new DataView(pico.ram.buffer, 0x3000, 512);
for (let i = 0; i < 8000; ++i) {
    let [opcode, bytes, loads, extends_sign, offset] = access();
    if (opcode >= 0x6000 && next() & 1) {
        opcode |= 0x800;
        loads = true;
    }
    const stored = value(), at_bit = 8 * bytes;
    area.setUint32(offset - offset % 4, next(), true);
    const model = new DataView(pico.ram.slice(0x3000, 0x3200).buffer);
    core.registers.set([stored, 0x20003000]);
    core.SP = 0x20003000;
    const read = model[`get${extends_sign ? "Int" : "Uint"}${at_bit}`](offset, true) >>> 0;
    if (!loads) {
        model[`setUint${at_bit}`](offset, stored, true);
    }
    assert.equal(run(opcode), 2);
    assert.equal(core.registers[0], loads ? read : stored, `0x${opcode.toString(16)}`);
    assert.deepEqual(pico.ram.slice(0x3000, 0x3200), new Uint8Array(model.buffer), `0x${opcode.toString(16)}`);
}

for (const extended of [0x12348765, 0xfedc7f80]) {
    core.registers[1] = extended;
    run(0xb208, 0xb24a, 0xb28b, 0xb2cc); // sxth r0; sxtb r2; uxth r3; uxtb r4
    assert.deepEqual([...core.registers.subarray(2, 5)], [extended << 24 >> 24 >>> 0, extended & 0xffff, extended & 0xff]);
    assert.equal(core.registers[0], extended << 16 >> 16 >>> 0);
}
core.registers.set([0xfffffff0, 0x20]);
run(0x4680, 0x4488, 0x4643, 0x4589, 0x46c0); // mov r8, r0; add r8, r1; mov r3, r8; cmp r9, r1
assert.equal(core.registers[3], 0x10);
core.registers.set([5, 5]);
run(0x4680, 0x4588); // mov r8, r0; cmp r8, r1
assert.deepEqual([core.Z, core.C], [true, true]);
run(0x4801, 0xa201, 0xa301, 0xe001, 0x5678, 0x1234, 0x46c0); // ldr r0 and adr r2 of the word that b jumps over; adr r3 behind it
assert.deepEqual([core.registers[0], core.registers[2], core.registers[3]], [0x12345678, at + 8, at + 12]);
core.SP = 0x20002000;
run(0xb082, 0xab01, 0xb001); // sub sp, #8; add r3, sp, #4; add sp, #4
assert.deepEqual([core.registers[3], core.SP], [0x20001ffc, 0x20001ffc]);
core.SP = 0x20002000;
core.LR = at + 5; // behind the next two
assert.equal(run(0xb500, 0xbd00, 0x46c0), 2 + 4 + 1); // push {lr}; pop {pc}
assert.equal(pico.chip.readUint32(0x20001ffc), at + 5);
core.registers.set([0x20003000, 7]);
run(0xc003); // stmia r0!, {r0, r1}
assert.deepEqual([core.registers[0], pico.chip.readUint32(0x20003000), pico.chip.readUint32(0x20003004)], [0x20003008, 0x20003000, 7]);
core.registers[2] = 0x20003001;
assert.throws(() => run(0x6810), FirmwareError); // ldr at an odd address
console.log(`${count} instructions on registers, and those on memory, as the manual has them`);
