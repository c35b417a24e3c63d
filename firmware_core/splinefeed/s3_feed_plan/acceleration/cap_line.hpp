// SPDX-License-Identifier: MIT
// CapLine: the largest speeds in a cell.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// v^2 [mm^2/s^2] in a cell is at most the line between these two. A plan in which v^2 is linear, too, keeps that if
/// it keeps both.
template <Scalar S>
struct CapLine {
    S entry_sq{};
    S exit_sq{};

    /// What is allowed anywhere in the cell.
    [[nodiscard]] S least_sq() const noexcept { return smaller(entry_sq, exit_sq); }
    [[nodiscard]] S most_sq() const noexcept { return larger(entry_sq, exit_sq); }
    [[nodiscard]] CapLine limited_to(S sq) const noexcept { return limited_to({sq, sq}); }
    [[nodiscard]] CapLine limited_to(const CapLine& other) const noexcept {
        return {smaller(entry_sq, other.entry_sq), smaller(exit_sq, other.exit_sq)};
    }
    /// @param sq  it is not lower
    [[nodiscard]] CapLine raised_to(S sq) const noexcept { return {larger(entry_sq, sq), larger(exit_sq, sq)}; }

    bool operator==(const CapLine&) const = default;
};

} // namespace splinefeed
