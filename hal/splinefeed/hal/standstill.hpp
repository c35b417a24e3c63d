// SPDX-License-Identifier: MIT
// Standstill: detects the standstill of an axis from its reported positions, for drives whose state does not report it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace splinefeed::hal {

/// A controlled shaft always moves a little. It counts as standing while its positions lie within a window, from the
/// lowest to the highest. So it does, for twice as long, within twice the window, and so on up to eight times: it
/// dithers, and goes nowhere.
class Standstill {
public:
    Standstill() = default;
    explicit Standstill(std::int64_t window) noexcept : window_(window) {}

    /// Adds a reported position and its instant [us]. @pre instants do not decrease
    void update(std::uint64_t status_us, std::int64_t position) noexcept {
        for (std::size_t i = 0; i < spans_.size(); ++i) {
            Span& span = spans_[i];
            span.lowest = std::min(span.lowest, position);
            span.highest = std::max(span.highest, position);
            if (span.since_us == 0 || span.highest - span.lowest > window_ << i) {
                span = {position, position, status_us};
            }
        }
        last_us_ = status_us;
    }
    /// How long the positions have stayed within the window, up to the last report; half of the time within twice the
    /// window, and so on. [us]
    [[nodiscard]] std::uint64_t still_us() const noexcept {
        std::uint64_t longest_us = 0;
        for (std::size_t i = 0; i < spans_.size(); ++i) {
            longest_us = std::max(longest_us, (last_us_ - spans_[i].since_us) >> i);
        }
        return longest_us;
    }

private:
    struct Span {
        std::int64_t lowest = 0;
        std::int64_t highest = 0;
        std::uint64_t since_us = 0; // 0: no report yet
    };

    std::int64_t window_ = 2;     // counts
    std::array<Span, 4> spans_{}; // within the window, twice the window, ...
    std::uint64_t last_us_ = 0;
};

} // namespace splinefeed::hal
