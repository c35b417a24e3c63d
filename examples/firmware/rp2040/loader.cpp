// SPDX-License-Identifier: MIT
// What the boot's second stage starts: it copies the image into RAM, and starts it there. The flash is read a bit at a
// time, at 31 MHz, and its cache has 16 KB: from there the interrupt would take ten times as long.
#include <cstdint>

extern "C" {

// Places that the linker script names.
extern std::uint32_t stack_top[];
extern std::uint32_t image_start[];
extern std::uint32_t image_end[];
extern const std::uint32_t image_in_flash[];

} // extern "C"

namespace {

[[noreturn, gnu::section(".loader")]] void load() {
    const std::uint32_t* from = image_in_flash;
    for (std::uint32_t* to = image_start; to != image_end; ++to) {
        *to = *from++;
    }
    constexpr std::uintptr_t VTOR = 0xe000ed08;
    *reinterpret_cast<volatile std::uintptr_t*>(VTOR) = reinterpret_cast<std::uintptr_t>(image_start);
    __asm__ volatile("msr msp, %0\n bx %1" : : "r"(image_start[0]), "r"(image_start[1]) : "memory");
    __builtin_unreachable();
}

struct Vectors {
    std::uint32_t* stack;
    void (*reset)();
};
[[gnu::used, gnu::section(".loader.vectors")]] const Vectors vectors{stack_top, load};

} // namespace
