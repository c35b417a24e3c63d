// SPDX-License-Identifier: MIT
// Standstill: detects the standstill of an axis from its reported positions, for drives whose state does not report it.
#pragma once

#include <cstdint>

namespace splinefeed::hal {

/// A controlled shaft always moves a little. It counts as standing while its position stays within the tolerance.
class Standstill {
public:
    Standstill() = default;
    explicit Standstill(std::int64_t tolerance) noexcept : tolerance_(tolerance) {}

    /// Adds a reported position and its instant [us]. @pre instants do not decrease
    void update(std::uint64_t status_us, std::int64_t position) noexcept {
        const std::int64_t way = position > anchor_ ? position - anchor_ : anchor_ - position;
        if (since_us_ == 0 || way > tolerance_) {
            anchor_ = position;
            since_us_ = status_us;
        }
        last_us_ = status_us;
    }
    /// How long the position has stayed within the tolerance, up to the last report. [us]
    [[nodiscard]] std::uint64_t still_us() const noexcept { return last_us_ - since_us_; }

private:
    std::int64_t tolerance_ = 2; // counts
    std::int64_t anchor_ = 0;
    std::uint64_t since_us_ = 0; // 0: no report yet
    std::uint64_t last_us_ = 0;
};

} // namespace splinefeed::hal
