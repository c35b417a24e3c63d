// SPDX-License-Identifier: MIT
// 0, 1, ... n - 1 for a range-based loop: `for (const unsigned k : indices(cell.axes))`. Counts are int, subscripts are
// unsigned; this is the one place that converts them.
#pragma once

namespace splinefeed {

/// The numbers from 0 to `end` - 1. The loop compiles to the same instructions as one with a counter.
struct Indices {
    struct Iterator {
        unsigned at = 0;
        constexpr unsigned operator*() const noexcept { return at; }
        constexpr Iterator& operator++() noexcept {
            ++at;
            return *this;
        }
        friend constexpr bool operator==(const Iterator&, const Iterator&) noexcept = default;
    };
    unsigned count = 0;
    [[nodiscard]] static constexpr Iterator begin() noexcept { return {}; }
    [[nodiscard]] constexpr Iterator end() const noexcept { return {count}; }
};

/// 0 to count - 1. @pre count is not negative
template <class Count>
[[nodiscard]] constexpr Indices indices(Count count) noexcept {
    return {static_cast<unsigned>(count)};
}

} // namespace splinefeed
