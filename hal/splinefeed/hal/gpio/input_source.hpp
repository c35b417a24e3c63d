// SPDX-License-Identifier: MIT
// InputSource: where the edges of a chip's input lines come from.
#pragma once

#include "splinefeed/hal/gpio/line_request.hpp"

#include <optional>
#include <span>

namespace splinefeed::hal::gpio {

/// Used by one thread. As InputLines, which says more.
class InputSource {
public:
    InputSource() = default;
    InputSource(const InputSource&) = delete;
    InputSource& operator=(const InputSource&) = delete;
    virtual ~InputSource() = default;

    /// Bit i: line i is high. Empty: errno says why.
    [[nodiscard]] virtual std::optional<std::uint64_t> levels() noexcept = 0;
    /// Stores edges that came; 0: none in time; -1: errno says why.
    [[nodiscard]] virtual int wait(std::span<InputEvent> out, std::uint32_t timeout_us) noexcept = 0;
};

} // namespace splinefeed::hal::gpio
