// SPDX-License-Identifier: MIT
// SurfaceSpeed: G96, a speed of the spindle that follows from the radius of the work.
#pragma once

#include "splinefeed/s0_program/text/decimal.hpp"

namespace splinefeed {

struct SurfaceSpeed {
    Decimal at_one_mm{}; ///< the speed at a radius of 1 mm [1/min]
    Decimal most{};      ///< D, or what the spindle can do [1/min]; 0: G97 is in effect

    [[nodiscard]] constexpr bool applies() const noexcept { return most.raw > 0; }

    /// The speed of the spindle at a radius [1/min]. @param x  the radius in mm, on either side of the axis
    [[nodiscard]] Decimal at(Decimal x) const noexcept {
        const Decimal speed{product_quotient(at_one_mm.raw, Decimal::one, detail::magnitude(x.raw)).raw};
        return at_one_mm.raw == 0 ? Decimal{} : speed < most ? speed : most;
    }
    /// @param speed  S: m/min, in inches feet/min
    void set(Decimal speed, bool inches) noexcept {
        constexpr std::int64_t metre = 159'154'943'092; // 1000 / (2 pi)
        constexpr std::int64_t foot = 48'510'426'654;   // 304.8 / (2 pi)
        at_one_mm.raw =
            product_quotient(speed.raw, inches ? foot : metre, static_cast<std::uint64_t>(Decimal::one)).raw;
    }

    friend constexpr bool operator==(const SurfaceSpeed&, const SurfaceSpeed&) noexcept = default;
};

} // namespace splinefeed
