// SPDX-License-Identifier: MIT
// Reset: prepares RAM and the floating point unit and calls main; every exception ends the program.
#include "platform.hpp"
#include "semihosting.hpp"
#include "write_number.hpp"

#include <cstdint>

int main();

extern "C" {

// Places that the linker script names.
extern std::uint32_t stack_bottom[];
extern std::uint32_t stack_top[];
extern std::uint32_t data_start[];
extern std::uint32_t data_end[];
extern const std::uint32_t data_image[];
extern std::uint32_t bss_start[];
extern std::uint32_t bss_end[];

} // extern "C"

namespace {

constexpr std::uint32_t paint = 0xa5a5a5a5;

// How deep the stack has been: everything above the lowest word that is no longer painted.
void report_stack() {
    const std::uint32_t* deepest = stack_bottom;
    while (deepest < stack_top && *deepest == paint) {
        ++deepest;
    }
    write_text("stack used ");
    write_number(static_cast<std::uint32_t>(stack_top - deepest) * 4);
    write_text(" of ");
    write_number(static_cast<std::uint32_t>(stack_top - stack_bottom) * 4);
    write_text(" bytes\n");
}

[[noreturn]] void on_fault() {
    write_text("fault\n");
    exit_program(3);
}

[[gnu::noinline]] void prepare_memory() {
    for (std::uint32_t* word = data_start; word != data_end; ++word) {
        *word = data_image[word - data_start];
    }
    for (std::uint32_t* word = bss_start; word != bss_end; ++word) {
        *word = 0;
    }
    std::uint32_t* const in_use = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 32;
    for (std::uint32_t* word = stack_bottom; word < in_use; ++word) {
        *word = paint;
    }
}

[[noreturn]] void on_reset() {
#ifdef __ARM_FP
    *reinterpret_cast<volatile std::uint32_t*>(0xe000ed88) |= 0xfU << 20; // CPACR: access to the coprocessors 10, 11
    __asm__ volatile("dsb\n isb" ::: "memory");
#endif
    prepare_memory();
    const int status = main();
    report_stack();
    exit_program(status);
}

struct VectorTable {
    std::uint32_t* stack;
    void (*reset)();
    void (*exceptions[14])();
};

[[gnu::used, gnu::section(".vectors")]] const VectorTable vector_table = {
    stack_top,
    on_reset,
    {on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault, on_fault,
     on_fault, on_fault, on_fault},
};

} // namespace
