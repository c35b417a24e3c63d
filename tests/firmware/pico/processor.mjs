// SPDX-License-Identifier: MIT
// What a Cortex-M0+ does most of the time: Thumb instructions on registers, RAM and flash (Armv6-M Architecture Reference Manual, A6). All else is left
// to rp2040js: registers of peripherals, special registers, exceptions. That is three times as fast as rp2040js alone. It also mends what
// there is wrong: V of ADCS and SBCS beside 0x7fffffff, C of shifts by a register of 0 or above 32, and the cycle of LR in PUSH.
const RAM = 0x20000000;
const ones = (bits) => {
    let count = 0;
    for (; bits; bits &= bits - 1, ++count) {}
    return count;
};

/** @returns run(limit): instructions as long as they begin before that time of chip.clock, until one is left to rp2040js, which is done, too */
export function processor(chip, ram, xip, waits, cycleNs) {
    const { core, clock } = chip, r = core.registers, size = ram.length;
    const halfwords = new Uint16Array(ram.buffer), words = new Uint32Array(ram.buffer);
    const { bytes: flashBytes } = xip.flash, flashHalfwords = xip.halfwords, flashWords = xip.words;

    const transfer = (list, at, loads) => {
        for (let i = 0; list >>> i; ++i) {
            if (list >>> i & 1) {
                if (loads) {
                    r[i] = words[at++];
                } else {
                    words[at++] = r[i];
                }
            }
        }
    };

    const slowly = () => {
        const cycles = core.executeInstruction() + waits.cycles;
        waits.cycles = 0;
        clock.nanosCounter += cycles * cycleNs;
    };

    return (limit) => {
        if (core.interruptsUpdated) {
            slowly();
            return;
        }
        const begin = clock.nanosCounter, cycles = (limit - begin) / cycleNs;
        let spent = 0, pc = r[15] & ~1, nz = core.Z ? 0 : core.N ? -1 : 1, c = core.C ? 1 : 0, v = core.V ? 1 : 0, done = true;

        // Passes the cache: behind it the wait is counted.
        const flash = (address) => {
            if (address >>> 3 !== xip.line) {
                clock.nanosCounter = begin + spent * cycleNs;
                r[15] = pc;
                xip.read8(address);
                spent += waits.cycles;
                waits.cycles = 0;
            }
            return address & 0x1fffff;
        };

        while (spent < cycles) {
            let op;
            const from = (pc - RAM) >>> 0;
            if (from < size) {
                op = halfwords[from >>> 1];
            } else if (pc >>> 26 === 4) {
                op = flashHalfwords[flash(pc) >>> 1];
            } else {
                done = false;
                break;
            }
            const d = op & 7, m = op >>> 3 & 7, high = op >>> 8 & 7;
            let next = pc + 2;
            switch (op >>> 11) {
                case 0: { // LSLS
                    const shift = op >>> 6 & 31, value = r[m];
                    if (shift > 0) {
                        c = value >>> (32 - shift) & 1;
                    }
                    nz = value << shift;
                    r[d] = nz;
                    ++spent;
                    break;
                }
                case 1:
                case 2: { // LSRS, ASRS, 0 is 32
                    const shift = op >>> 6 & 31, value = r[m] | 0;
                    c = value >>> (shift + 31 & 31) & 1;
                    nz = op & 0x1000 ? value >> (shift > 0 ? shift : 31) : shift > 0 ? value >>> shift | 0 : 0;
                    r[d] = nz;
                    ++spent;
                    break;
                }
                case 3: { // ADDS, SUBS
                    const a = r[m], b = op & 0x400 ? op >>> 6 & 7 : r[op >>> 6 & 7];
                    if (op & 0x200) {
                        nz = (a - b) | 0;
                        c = a >= b ? 1 : 0;
                        v = ((a ^ b) & (a ^ nz)) >>> 31;
                    } else {
                        nz = (a + b) | 0;
                        c = a + b > 0xffffffff ? 1 : 0;
                        v = (~(a ^ b) & (a ^ nz)) >>> 31;
                    }
                    r[d] = nz;
                    ++spent;
                    break;
                }
                case 4: // MOVS
                    nz = op & 0xff;
                    r[high] = nz;
                    ++spent;
                    break;
                case 5:
                case 7: { // CMP, SUBS
                    const a = r[high], b = op & 0xff;
                    nz = (a - b) | 0;
                    c = a >= b ? 1 : 0;
                    v = (a & ~nz) >>> 31;
                    if (op >>> 11 === 7) {
                        r[high] = nz;
                    }
                    ++spent;
                    break;
                }
                case 6: { // ADDS
                    const a = r[high], sum = a + (op & 0xff);
                    nz = sum | 0;
                    c = sum > 0xffffffff ? 1 : 0;
                    v = (~a & nz) >>> 31;
                    r[high] = nz;
                    ++spent;
                    break;
                }
                case 8:
                    if ((op & 0x400) === 0) {
                        const a = r[d], b = r[m];
                        switch (op >>> 6 & 15) {
                            case 0: nz = a & b; r[d] = nz; break;
                            case 1: nz = a ^ b; r[d] = nz; break;
                            case 2: { // LSLS
                                const shift = b & 0xff;
                                c = shift === 0 ? c : shift > 32 ? 0 : a >>> (32 - shift & 31) & 1;
                                nz = shift > 31 ? 0 : a << shift;
                                r[d] = nz;
                                break;
                            }
                            case 3: { // LSRS
                                const shift = b & 0xff;
                                c = shift === 0 ? c : shift > 32 ? 0 : a >>> (shift - 1) & 1;
                                nz = shift > 31 ? 0 : a >>> shift | 0;
                                r[d] = nz;
                                break;
                            }
                            case 4: { // ASRS
                                const shift = b & 0xff;
                                c = shift === 0 ? c : a >>> Math.min(shift - 1, 31) & 1;
                                nz = (a | 0) >> Math.min(shift, 31);
                                r[d] = nz;
                                break;
                            }
                            case 5: { // ADCS
                                const sum = a + b + c;
                                nz = sum | 0;
                                c = sum > 0xffffffff ? 1 : 0;
                                v = (~(a ^ b) & (a ^ nz)) >>> 31;
                                r[d] = nz;
                                break;
                            }
                            case 6: { // SBCS
                                const difference = a - b - 1 + c;
                                nz = difference | 0;
                                c = difference >= 0 ? 1 : 0;
                                v = ((a ^ b) & (a ^ nz)) >>> 31;
                                r[d] = nz;
                                break;
                            }
                            case 7: { // RORS
                                const shift = b & 31;
                                nz = a >>> shift | (shift > 0 ? a << (32 - shift) : 0);
                                c = (b & 0xff) === 0 ? c : nz >>> 31;
                                r[d] = nz;
                                break;
                            }
                            case 8: nz = a & b; break;
                            case 9: // RSBS
                                nz = -b | 0;
                                c = b === 0 ? 1 : 0;
                                v = (b & nz) >>> 31;
                                r[d] = nz;
                                break;
                            case 10: // CMP
                                nz = (a - b) | 0;
                                c = a >= b ? 1 : 0;
                                v = ((a ^ b) & (a ^ nz)) >>> 31;
                                break;
                            case 11: // CMN
                                nz = (a + b) | 0;
                                c = a + b > 0xffffffff ? 1 : 0;
                                v = (~(a ^ b) & (a ^ nz)) >>> 31;
                                break;
                            case 12: nz = a | b; r[d] = nz; break;
                            case 13: nz = Math.imul(a, b); r[d] = nz; break;
                            case 14: nz = a & ~b; r[d] = nz; break;
                            default: nz = ~b; r[d] = nz; break;
                        }
                        ++spent;
                    } else { // high registers; with PC left to rp2040js but for BX and BLX
                        const rd = op >>> 4 & 8 | d, rm = op >>> 3 & 15, b = rm === 15 ? pc + 4 : r[rm];
                        const kind = op >>> 8 & 3;
                        if (kind === 3 && b >>> 28 !== 15 && rm !== 15) {
                            if (op & 0x80) {
                                r[14] = next | 1;
                            }
                            next = (b & ~1) >>> 0;
                            spent += 2;
                        } else if (kind === 3 || rd === 15) {
                            done = false;
                        } else {
                            const a = r[rd];
                            if (kind === 1) {
                                nz = (a - b) | 0;
                                c = a >= b ? 1 : 0;
                                v = ((a ^ b) & (a ^ nz)) >>> 31;
                            } else {
                                const value = kind === 0 ? a + b : b;
                                r[rd] = rd === 13 ? value & ~3 : value;
                            }
                            ++spent;
                        }
                    }
                    break;
                case 9:
                case 12:
                case 13:
                case 18:
                case 19: { // STR, LDR of a word: a literal, beside a register, beside SP
                    const by_register = op >>> 12 === 6, to = by_register ? d : high;
                    const address = (by_register ? r[m] + (op >>> 4 & 0x7c) : (op < 0x6000 ? pc + 4 & ~3 : r[13]) + ((op & 0xff) << 2)) >>> 0;
                    const at = (address - RAM) >>> 0;
                    if ((address & 3) === 0 && at < size) {
                        if (op & 0x800) {
                            r[to] = words[at >>> 2];
                        } else {
                            words[at >>> 2] = r[to];
                        }
                        spent += 2;
                    } else if ((address & 3) === 0 && address >>> 26 === 4 && op & 0x800) {
                        r[to] = flashWords[flash(address) >>> 2];
                        spent += 2;
                    } else {
                        done = false;
                    }
                    break;
                }
                case 26:
                case 27: { // B with a condition; 14 and 15 are UDF and SVC
                    const condition = op >>> 8 & 15;
                    if (condition > 13) {
                        done = false;
                        break;
                    }
                    const n = nz < 0 ? 1 : 0;
                    let holds;
                    switch (condition >>> 1) {
                        case 0: holds = nz === 0; break;
                        case 1: holds = c === 1; break;
                        case 2: holds = n === 1; break;
                        case 3: holds = v === 1; break;
                        case 4: holds = c === 1 && nz !== 0; break;
                        case 5: holds = n === v; break;
                        default: holds = nz !== 0 && n === v; break;
                    }
                    if (holds !== ((condition & 1) === 1)) {
                        next = pc + 4 + (op << 24 >> 23);
                        ++spent;
                    }
                    ++spent;
                    break;
                }
                case 28: // B
                    next = pc + 4 + (op << 21 >> 20);
                    spent += 2;
                    break;
                case 30: { // BL, and DMB, DSB, ISB, for which there is nothing to wait
                    const second = from < size ? halfwords[(from >>> 1) + 1] : flashHalfwords[flash(pc + 2) >>> 1];
                    if (op === 0xf3bf && second >>> 8 === 0x8f) {
                        next = pc + 4;
                        spent += 3;
                        break;
                    }
                    if (second >>> 14 !== 3 || !(second & 0x1000)) {
                        done = false;
                        break;
                    }
                    const sign = op >>> 10 & 1, i1 = 1 ^ sign ^ (second >>> 13 & 1), i2 = 1 ^ sign ^ (second >>> 11 & 1);
                    r[14] = pc + 4 | 1;
                    next = pc + 4 + ((sign ? 0xff000000 | 0 : 0) | i1 << 23 | i2 << 22 | (op & 0x3ff) << 12 | (second & 0x7ff) << 1);
                    spent += 3;
                    break;
                }
                default: {
                    const kind = op >>> 11;
                    if (kind < 20) { // other loads and stores
                        const offset = op >>> 6 & 31;
                        let load = (op & 0x800) !== 0, bytes = 2, signed = false, address;
                        if (kind < 12) {
                            const which = op >>> 9 & 7;
                            address = r[m] + r[op >>> 6 & 7];
                            load = which > 2;
                            bytes = which === 0 || which === 4 ? 4 : which === 1 || which === 5 || which === 7 ? 2 : 1;
                            signed = which === 3 || which === 7;
                        } else if (kind < 16) {
                            address = r[m] + offset;
                            bytes = 1;
                        } else {
                            address = r[m] + 2 * offset;
                        }
                        address >>>= 0;
                        const at = (address - RAM) >>> 0;
                        if ((address & (bytes - 1)) !== 0) {
                            done = false;
                        } else if (at < size) {
                            if (load) {
                                const value = bytes === 4 ? words[at >>> 2] : bytes === 2 ? halfwords[at >>> 1] : ram[at];
                                r[d] = !signed ? value : bytes === 2 ? value << 16 >> 16 : value << 24 >> 24;
                            } else if (bytes === 4) {
                                words[at >>> 2] = r[d];
                            } else if (bytes === 2) {
                                halfwords[at >>> 1] = r[d];
                            } else {
                                ram[at] = r[d];
                            }
                            spent += 2;
                        } else if (address >>> 26 === 4 && load) {
                            const in_flash = flash(address);
                            const value = bytes === 4 ? flashWords[in_flash >>> 2] : bytes === 2 ? flashHalfwords[in_flash >>> 1] : flashBytes[in_flash];
                            r[d] = !signed ? value : bytes === 2 ? value << 16 >> 16 : value << 24 >> 24;
                            spent += 2;
                        } else {
                            done = false;
                        }
                    } else if (kind === 20) { // ADR
                        r[high] = (pc + 4 & ~3) + ((op & 0xff) << 2);
                        ++spent;
                    } else if (kind === 21) { // ADD to SP
                        r[high] = r[13] + ((op & 0xff) << 2);
                        ++spent;
                    } else if (op >>> 8 === 0xb0) { // ADD SP, SUB SP
                        r[13] += op & 0x80 ? -((op & 0x7f) << 2) : (op & 0x7f) << 2;
                        ++spent;
                    } else if (op >>> 8 === 0xb2) { // SXTH, SXTB, UXTH, UXTB
                        const value = r[m], extension = op >>> 6 & 3;
                        r[d] = extension === 0 ? value << 16 >> 16 : extension === 1 ? value << 24 >> 24 : extension === 2 ? value & 0xffff : value & 0xff;
                        ++spent;
                    } else if ((op & 0xf600) === 0xb400) { // PUSH, POP
                        const loads = (op & 0x800) !== 0, bytes = 4 * ones(op & 0x1ff), from_sp = (r[13] - (loads ? 0 : bytes) - RAM) >>> 0;
                        const last = (from_sp + bytes >>> 2) - 1;
                        if (from_sp + bytes > size || loads && op & 0x100 && words[last] >>> 28 === 15) { // a return from an exception
                            done = false;
                            break;
                        }
                        transfer(op & 0xff, from_sp >>> 2, loads);
                        if (op & 0x100 && loads) {
                            next = (words[last] & ~1) >>> 0;
                            spent += 2;
                        } else if (op & 0x100) {
                            words[last] = r[14];
                        }
                        r[13] += loads ? bytes : -bytes;
                        spent += 1 + bytes / 4;
                    } else if (kind === 24 || kind === 25) { // STM, LDM
                        const bytes = 4 * ones(op & 0xff), end = r[high] + bytes, at = (r[high] - RAM) >>> 0;
                        if (at + bytes > size || (at & 3) !== 0) {
                            done = false;
                            break;
                        }
                        transfer(op & 0xff, at >>> 2, kind === 25);
                        if (kind === 24 || !(op >>> high & 1)) {
                            r[high] = end;
                        }
                        spent += 1 + bytes / 4;
                    } else {
                        done = false;
                    }
                }
            }
            if (!done) {
                break;
            }
            pc = next >>> 0;
        }
        clock.nanosCounter = begin + spent * cycleNs;
        r[15] = pc;
        core.N = nz < 0;
        core.Z = nz === 0;
        core.C = c === 1;
        core.V = v === 1;
        if (!done && clock.nanosCounter < limit) {
            slowly();
        }
    };
}
