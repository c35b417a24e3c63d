// SPDX-License-Identifier: MIT
// NurbsCurve: the control points of G5.2 to Bezier pieces, as they come.
#pragma once

#include "splinefeed/s0_program/block_motion.hpp"

namespace splinefeed {

/// A clamped uniform NURBS in the plane XY, degree 2 to 5, of any number of points: its knots are integers, so a piece
/// depends on 2 degree points only, and one that is far from the end is known before the end is. Memory is constant.
class NurbsCurve {
public:
    static constexpr int least_order = 3;
    static constexpr int most_order = 6;

    [[nodiscard]] bool is_open() const noexcept { return open_; }
    [[nodiscard]] int order() const noexcept { return degree_ + 1; }
    /// Points so far, with the start.
    [[nodiscard]] std::int32_t points() const noexcept { return count_; }

    void begin(int order, const SpacePoint& start, Decimal weight) noexcept;
    /// The next control point, in machine coordinates. @pre has_room(); weight > 0
    void add(const SpacePoint& point, Decimal weight) noexcept;
    /// No more points. False: there are fewer than the order.
    [[nodiscard]] bool finish() noexcept;
    /// Whether the weight is within a factor of 64 of all others: what curves are computed with.
    [[nodiscard]] bool accepts(Decimal weight) const noexcept {
        return weight.raw <= 64 * lightest_.raw && 64 * weight.raw >= heaviest_.raw;
    }
    void abandon() noexcept { open_ = false; }
    /// The next piece; false: none is known yet, or all have been made (then is_open() is false).
    bool next(BezierPlan& out) noexcept;
    /// The last control point.
    [[nodiscard]] SpacePoint last() const noexcept { return at(count_ - 1).place; }

private:
    struct Point {
        SpacePoint place{};
        Decimal weight{};
    };
    static constexpr int window = 2 * (most_order - 1);

    [[nodiscard]] const Point& at(std::int32_t index) const noexcept {
        return points_[static_cast<unsigned>(index % window)];
    }
    [[nodiscard]] std::int32_t knot(std::int32_t index) const noexcept;

    std::array<Point, window> points_{};
    Decimal lightest_{};
    Decimal heaviest_{};
    int degree_ = 2;
    std::int32_t count_ = 0;
    std::int32_t piece_ = 0; // the next one
    bool open_ = false;
    bool finished_ = false;
};

} // namespace splinefeed
