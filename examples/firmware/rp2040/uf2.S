// SPDX-License-Identifier: MIT
// A binary in blocks of the format UF2, which the boot ROM takes as a file on its drive: github.com/microsoft/uf2. The build assembles this
// with IMAGE, the binary of the flash from 0x10000000 on; the section .uf2 is the file.

.section .image
image:
.incbin IMAGE
image_end:

.section .uf2
.set blocks, (image_end - image + 255) / 256
.set number, 0
.rept blocks
    .word 0x0a324655, 0x9e5d5157  // magic
    .word 0x2000                  // flags: a family is stated
    .word 0x10000000 + 256 * number
    .word 256                     // bytes of it
    .word number, blocks
    .word 0xe48bff56              // family: RP2040
    .if number + 1 < blocks
        .incbin IMAGE, 256 * number, 256
    .else
        .incbin IMAGE, 256 * number // what is left
    .endif
    .org 512 * number + 508, 0
    .word 0x0ab16f30              // magic
    .set number, number + 1
.endr
