// SPDX-License-Identifier: MIT
// Reset of a Cortex-M: prepares RAM and the floating point unit and calls main. The vectors: Armv6-M and Armv7-M
// Architecture Reference Manuals, "The vector table".
#include "startup.hpp"

#include "board.hpp"

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

[[gnu::section(".noinit")]] std::uint32_t boots; // neither zeroed nor loaded

/// Some bits of a RAM come up at random.
[[nodiscard]] std::uint32_t noise(const std::uint32_t* end) {
    std::uint32_t mixed = 0;
    for (const std::uint32_t* word = stack_bottom; word < end; ++word) {
        mixed = (mixed << 5 | mixed >> 27) ^ *word;
    }
    return mixed;
}

[[gnu::noinline]] void prepare_memory() {
    for (std::uint32_t* word = data_start; word != data_end; ++word) {
        *word = data_image[word - data_start];
    }
    for (std::uint32_t* word = bss_start; word != bss_end; ++word) {
        *word = 0;
    }
    std::uint32_t* const in_use = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 32;
    boots += 1 + 2 * noise(in_use); // over a reset the stack holds much the same: the count then makes the difference
    for (std::uint32_t* word = stack_bottom; word < in_use; ++word) {
        *word = paint;
    }
}

/// No step is made any more, and the watchdog resets.
[[noreturn]] void on_fault() {
    board::enable_drives(false);
    for (;;) {
    }
}

[[noreturn]] void on_reset() {
#ifdef __ARM_FP
    *reinterpret_cast<volatile std::uint32_t*>(0xe000ed88) |= 0xfU << 20; // CPACR: access to the coprocessors 10, 11
    __asm__ volatile("dsb\n isb" ::: "memory");
#endif
    prepare_memory();
    main();
    on_fault();
}

struct VectorTable {
    std::uint32_t* stack;
    void (*reset)();
    void (*vectors[14 + board::interrupts])();
};

constexpr VectorTable make_vectors() {
    VectorTable table{stack_top, on_reset, {}};
    for (auto& vector : table.vectors) {
        vector = on_fault;
    }
    table.vectors[static_cast<unsigned>(14 + board::timer_interrupt)] = firmware::on_tick;
    return table;
}

[[gnu::used, gnu::section(".vectors")]] constexpr VectorTable vector_table = make_vectors();

} // namespace

namespace firmware {

std::uint32_t stack_used() noexcept {
    const std::uint32_t* deepest = stack_bottom;
    while (deepest < stack_top && *deepest == paint) {
        ++deepest;
    }
    return static_cast<std::uint32_t>(stack_top - deepest) * 4;
}

std::uint32_t boot_number() noexcept {
    return boots;
}

std::uint32_t stack_size() noexcept {
    return static_cast<std::uint32_t>(stack_top - stack_bottom) * 4;
}

} // namespace firmware
