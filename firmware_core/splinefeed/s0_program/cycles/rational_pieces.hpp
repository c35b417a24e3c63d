// SPDX-License-Identifier: MIT
// RationalPieces: a rational Bezier segment as polynomial ones.
#pragma once

#include "splinefeed/s0_program/words/block_motion.hpp"

namespace splinefeed {

/// Quintics with the position, direction and curvature of the curve at both ends of each. Each is halved until its
/// middle and quarters are within 1e-6 mm (float: 1e-3 mm) of the curve, or it is a 256th of the segment. A quintic's
/// error is largest near those places. @pre weights differ by a factor of 64 at most
template <Scalar S>
class RationalPieces {
public:
    void begin(const BezierPlan& curve) noexcept;
    [[nodiscard]] bool is_done() const noexcept { return at_ >= whole; }
    /// The next quintic: points as offsets from its own start, in chord units, of x, y, z.
    void next(std::array<std::array<S, 6>, 3>& points) noexcept;

private:
    static constexpr int whole = 256;
    /// Position and derivatives by the parameter of the segment.
    struct State {
        std::array<S, 3> position{};
        std::array<S, 3> first{};
        std::array<S, 3> second{};
    };
    [[nodiscard]] State state(S u) const noexcept;
    [[nodiscard]] bool fits(const State& from, const State& to, S u, S width,
                            std::array<std::array<S, 6>, 3>& points) const noexcept;

    int degree_ = 0;
    int unit_log2_ = 0; // of the points: the largest is below 2^10, so that derivatives stay in the range of Fixed
    std::array<std::array<S, 4>, BezierPlan::most_points> points_{}; // x w, y w, z w, w
    int at_ = 0;                                                     // in 256ths of the parameter
};

} // namespace splinefeed
