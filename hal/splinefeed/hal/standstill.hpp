// SPDX-License-Identifier: MIT
// Standstill: detects the standstill of an axis from its reported positions, for drives whose state does not report it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace splinefeed::hal {

/// A controlled shaft always moves a little. It counts as standing while its positions lie within a window, from the
/// lowest to the highest.
class Standstill {
public:
    Standstill() = default;
    explicit Standstill(std::int64_t window) noexcept : window_(window) {}

    /// Adds a reported position and its instant [us]. @pre instants do not decrease
    void update(std::uint64_t status_us, std::int64_t position) noexcept {
        lowest_ = std::min(lowest_, position);
        highest_ = std::max(highest_, position);
        if (since_us_ == 0 || highest_ - lowest_ > window_) {
            lowest_ = highest_ = position;
            since_us_ = status_us;
        }
        last_us_ = status_us;
    }
    /// How long the positions have stayed within the window, up to the last report. [us]
    [[nodiscard]] std::uint64_t still_us() const noexcept { return last_us_ - since_us_; }

private:
    std::int64_t window_ = 2; // counts
    std::int64_t lowest_ = 0;
    std::int64_t highest_ = 0;
    std::uint64_t since_us_ = 0; // 0: no report yet
    std::uint64_t last_us_ = 0;
};

} // namespace splinefeed::hal
