// SPDX-License-Identifier: MIT
// What the start-up code offers, and what it calls.
#pragma once

#include <cstdint>

int main();

namespace firmware {

/// The tick's interrupt.
void on_tick();

/// How deep the stack has been since the start, and how deep it may be [bytes].
[[nodiscard]] std::uint32_t stack_used() noexcept;
[[nodiscard]] std::uint32_t stack_size() noexcept;

/// A different number after each start: kept over a reset, and made of what the RAM holds after power-up.
[[nodiscard]] std::uint32_t boot_number() noexcept;

} // namespace firmware
