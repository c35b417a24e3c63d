// SPDX-License-Identifier: MIT
#include "semihosting.hpp"

#include "platform.hpp"

#include <cstdint>

namespace {

constexpr std::uintptr_t write_string = 0x04;
constexpr std::uintptr_t exit_extended = 0x20;
constexpr std::uintptr_t application_exit = 0x20026;

void call_host(std::uintptr_t operation, const void* argument) {
    register std::uintptr_t r0 __asm__("r0") = operation;
    register const void* r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

} // namespace

void write_text(const char* text) {
    call_host(write_string, text);
}

void exit_program(int status) {
    const std::uintptr_t block[] = {application_exit, static_cast<std::uintptr_t>(status)};
    call_host(exit_extended, block);
    for (;;) {
    }
}
