// SPDX-License-Identifier: MIT
// PointCurve: what makes a curve through the points of G5.5.
#pragma once

#include "splinefeed/s0_program/words/block_motion.hpp"

namespace splinefeed {

/// An interpreter has none, or one of the caller's: a program that makes none does not link it.
template <Scalar S>
class PointCurve {
public:
    struct Point {
        PerAxis<Position> to{};
        S feed_mm_s{}; ///< of the leg that ends there
        Decimal feed{};
        std::uint32_t line = 0;
    };

    /// The curve begins here. All of its moves are made in this manner.
    virtual void begin(const PerAxis<Position>& from, const MoveManner& manner, int axes) noexcept = 0;
    /// @pre next() has given all that is known
    virtual void add(const Point& point) noexcept = 0;
    /// The last point was the last one.
    virtual void finish() noexcept = 0;
    /// Fills the line, the feed and the shape of the next move. false: more points are needed, or all moves are given
    virtual bool next(ProgramItem<S>& out) noexcept = 0;
    [[nodiscard]] virtual const MoveManner& manner() const noexcept = 0;

protected:
    PointCurve() = default;
    PointCurve(const PointCurve&) = default;
    PointCurve& operator=(const PointCurve&) = default;
    ~PointCurve() = default;
};

} // namespace splinefeed
