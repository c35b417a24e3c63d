// SPDX-License-Identifier: MIT
// SplinePoints: a G2 curve through the points of a program.
#pragma once

#include "splinefeed/base/slot.hpp"
#include "splinefeed/s0_program/cycles/point_curve.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"

namespace splinefeed {

/// The curve of G2Spline with chordal spans: a turn of more than 60 degrees is a corner. Each move is a cubic that ends
/// exactly in its point, and goes on with the direction and curvature of the one before. Points within 0.1 um of the
/// one before are left out; at the end of the curve a line leads to the last of them. A leg without a direction at an
/// end is a line. Look-ahead: 17 points. Memory: that of G2Spline and 0.7 KB.
template <Scalar S>
class SplinePoints final : public PointCurve<S> {
public:
    SplinePoints() = default;

    void begin(const PerAxis<Position>& from, const MoveManner& manner, int axes) noexcept override;
    void add(const typename PointCurve<S>::Point& point) noexcept override;
    void finish() noexcept override;
    bool next(ProgramItem<S>& out) noexcept override;
    [[nodiscard]] const MoveManner& manner() const noexcept override { return manner_; }

private:
    static constexpr std::uint32_t most_known = 32; // as many as the curve holds
    struct Leg {
        Decimal feed{};
        std::uint32_t line = 0;
    };

    void fill_piece(const CurveSegment<S>& piece, PathElement<S>& out) noexcept;

    Slot<G2Spline<S>> curve_;
    MoveManner manner_{};
    std::array<Leg, most_known> legs_{};
    PerAxis<Position> here_{}; // where the moves so far end
    PerAxis<Position> knot_{}; // the last point of the curve
    PerAxis<Position> last_{}; // the last point; near that
    std::uint32_t count_ = 0;
    int axes_ = 0;
    bool joined_ = false; // the next move goes on with the direction of the last one
    bool finished_ = false;
};

extern template class SplinePoints<double>;
extern template class SplinePoints<float>;
extern template class SplinePoints<Fixed>;

} // namespace splinefeed
