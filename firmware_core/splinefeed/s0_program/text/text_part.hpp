// SPDX-License-Identifier: MIT
// TextPart: a part of a line by its place in it. It cannot refer to a line that is gone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace splinefeed {

struct TextPart {
    std::uint16_t begin = 0;
    std::uint16_t size = 0;

    [[nodiscard]] constexpr bool empty() const noexcept { return size == 0; }
    /// @param line  the line that was pushed; what a shorter one does not have is left out
    [[nodiscard]] constexpr std::string_view of(std::string_view line) const noexcept {
        const std::size_t from = begin < line.size() ? begin : line.size();
        const std::size_t left = line.size() - from;
        return {line.data() + from, size < left ? size : left};
    }
};

} // namespace splinefeed
