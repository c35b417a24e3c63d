// SPDX-License-Identifier: MIT
// Standstill: whether an axis stands, by what it says of its position: for drives whose state does not tell.
#pragma once

#include <cstdint>

namespace splinefeed::hal {

/// A shaft under control is never quite still: within the tolerance it stands.
class Standstill {
public:
    Standstill() = default;
    explicit Standstill(std::int64_t tolerance) noexcept : tolerance_(tolerance) {}

    /// Its position at an instant, not before the last one.
    void update(std::uint64_t status_us, std::int64_t position) noexcept {
        const std::int64_t way = position > anchor_ ? position - anchor_ : anchor_ - position;
        if (since_us_ == 0 || way > tolerance_) {
            anchor_ = position;
            since_us_ = status_us;
        }
        last_us_ = status_us;
    }
    /// For how long it stands by now, as far as it said. [us]
    [[nodiscard]] std::uint64_t still_us() const noexcept { return last_us_ - since_us_; }

private:
    std::int64_t tolerance_ = 2; // counts
    std::int64_t anchor_ = 0;
    std::uint64_t since_us_ = 0; // 0: nothing was seen yet
    std::uint64_t last_us_ = 0;
};

} // namespace splinefeed::hal
