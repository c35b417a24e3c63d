// SPDX-License-Identifier: MIT
// InputSource: interface to the input lines of a chip. Tests replace it.
#pragma once

#include "splinefeed/hal/gpio/pin_request.hpp"

#include <optional>
#include <span>

namespace splinefeed::hal::gpio {

/// For one thread.
class InputSource {
public:
    InputSource() = default;
    InputSource(const InputSource&) = delete;
    InputSource& operator=(const InputSource&) = delete;
    virtual ~InputSource() = default;

    /// Bit i: line i is high. Empty on failure, with errno.
    [[nodiscard]] virtual std::optional<std::uint64_t> levels() noexcept = 0;
    /// Waits for edges and stores them. Returns their number; 0: time-out; -1: failure, with errno.
    [[nodiscard]] virtual int wait(std::span<InputEvent> out, std::uint32_t timeout_us) noexcept = 0;
};

} // namespace splinefeed::hal::gpio
