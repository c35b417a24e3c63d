// SPDX-License-Identifier: MIT
// NurbsCurve: the control points of G5.2 to Bezier pieces, as they come.
#pragma once

#include "splinefeed/s0_program/words/block_motion.hpp"

namespace splinefeed {

/// A clamped uniform NURBS in the plane XY, degree 2 to 5, of any number of points. Its knots are integers, so a
/// piece depends on 2 degree points only. One that is far from the end is known before the end is. Memory is constant.
class NurbsCurve {
public:
    static constexpr int least_order = 3;
    static constexpr int most_order = 6;

    [[nodiscard]] bool is_open() const noexcept { return now_.open; }
    [[nodiscard]] int order() const noexcept { return now_.degree + 1; }

    void begin(int order, const SpacePoint& start, Decimal weight) noexcept;
    /// The next control point, in machine coordinates. @pre weight > 0
    void add(const SpacePoint& point, Decimal weight) noexcept;
    /// No more points. False: there are fewer than the order.
    [[nodiscard]] bool finish() noexcept;
    /// Whether the weight is within a factor of 64 of all others: what curves are computed with.
    [[nodiscard]] bool accepts(Decimal weight) const noexcept {
        return weight.raw <= 64 * now_.lightest.raw && 64 * weight.raw >= now_.heaviest.raw;
    }
    void abandon() noexcept { now_.open = false; }
    /// The next piece; false: none is known yet, or all have been made (then is_open() is false).
    bool next(BezierPlan& out) noexcept;
    /// The last control point.
    [[nodiscard]] SpacePoint last() const noexcept { return at(now_.count - 1).place; }

    /// Where the curve is, but for the points: those that next() needs stay when one is added.
    struct Progress {
        Decimal lightest{};
        Decimal heaviest{};
        int degree = 2;
        std::int32_t count = 0; // points so far, with the start
        std::int32_t piece = 0; // the next one
        bool open = false;
        bool finished = false;
    };
    [[nodiscard]] const Progress& progress() const noexcept { return now_; }
    /// Takes back what was done since; none of begin(), add() and finish() has been followed by next().
    void go_back(const Progress& progress) noexcept { now_ = progress; }

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
    Progress now_{};
};

} // namespace splinefeed
