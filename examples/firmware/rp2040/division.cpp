// SPDX-License-Identifier: MIT
// Division of 32 bits by the RP2040's divider (datasheet 2.3.1.5), in 25 cycles instead of libgcc's hundred. It has one
// set of registers, so no interrupt comes between.
extern "C" {

[[gnu::naked, gnu::nothrow]] void __aeabi_uidivmod() { // r0 / r1: quotient in r0, remainder in r1
    __asm__("    mrs   r2, primask\n"
            "    cpsid i\n"
            "    ldr   r3, =0xd0000060\n" // SIO_DIV_UDIVIDEND, and behind it SIO_DIV_UDIVISOR
            "    str   r0, [r3, #0]\n"
            "    str   r1, [r3, #4]\n"
            "    b     1f\n" // eight cycles
            "1:  b     2f\n"
            "2:  b     3f\n"
            "3:  b     4f\n"
            "4:  ldr   r1, [r3, #20]\n" // SIO_DIV_REMAINDER
            "    ldr   r0, [r3, #16]\n" // SIO_DIV_QUOTIENT
            "    msr   primask, r2\n"
            "    bx    lr\n"
            "    .ltorg\n");
}

[[gnu::alias("__aeabi_uidivmod"), gnu::nothrow]] void __aeabi_uidiv();

} // extern "C"
