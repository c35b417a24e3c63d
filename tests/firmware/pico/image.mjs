// SPDX-License-Identifier: MIT
// What an image puts into flash: [{ offset, bytes }] of an ELF's segments, of a UF2's blocks, or of a plain binary.
import { readFileSync } from "node:fs";

const FLASH = 0x10000000, FLASH_SIZE = 2 << 20;
const PT_LOAD = 1, UF2_MAGIC = 0x0a324655;

function ofElf(view, file) {
    const parts = [];
    const table = view.getUint32(28, true), size = view.getUint16(42, true), count = view.getUint16(44, true);
    for (let at = table; at < table + size * count; at += size) {
        const [type, offset, , address, length] = [0, 4, 8, 12, 16].map((field) => view.getUint32(at + field, true));
        if (type === PT_LOAD && length > 0) {
            parts.push({ offset: address - FLASH, bytes: file.subarray(offset, offset + length) });
        }
    }
    return parts;
}

function ofUf2(view, file) {
    const parts = [];
    for (let at = 0; at < file.length; at += 512) {
        const address = view.getUint32(at + 12, true), length = view.getUint32(at + 16, true);
        parts.push({ offset: address - FLASH, bytes: file.subarray(at + 32, at + 32 + length) });
    }
    return parts;
}

export function partsOf(path) {
    const file = readFileSync(path);
    const view = new DataView(file.buffer, file.byteOffset, file.length);
    const parts = file.subarray(0, 4).equals(Buffer.from("\x7fELF", "latin1")) ? ofElf(view, file)
                : view.getUint32(0, true) === UF2_MAGIC ? ofUf2(view, file) : [{ offset: 0, bytes: file }];
    for (const { offset, bytes } of parts) {
        if (offset < 0 || offset + bytes.length > FLASH_SIZE) {
            throw new Error(`${path}: 0x${(offset + FLASH).toString(16)} is outside of the flash`);
        }
    }
    return parts;
}
