// SPDX-License-Identifier: MIT
//
// With P the homogeneous numerator and w the weight, C = P / w:
//     C' = (P' - w' C) / w,   C'' = (P'' - 2 w' C' - w'' C) / w.
// A quintic with C, C' h and C'' h^2 at both ends has the inner points
//     b1 = b0 + C' h / 5,  b2 = 2 b1 - b0 + C'' h^2 / 20,  and mirrored.
#include "splinefeed/s0_program/cycles/rational_pieces.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

template <Scalar S>
void RationalPieces<S>::begin(const BezierPlan& curve) noexcept {
    degree_ = curve.degree;
    at_ = 0;
    std::int64_t largest = 1;
    for (unsigned i = 1; i <= static_cast<unsigned>(degree_); ++i) {
        for (unsigned k = 0; k < 3; ++k) {
            const auto size = static_cast<std::int64_t>(
                detail::magnitude(to_position(curve.points[i][k]).raw - to_position(curve.points[0][k]).raw));
            largest = size > largest ? size : largest;
        }
    }
    unit_log2_ = 64 - std::countl_zero(static_cast<std::uint64_t>(largest)) - Position::fraction_bits - 10;
    for (unsigned i = 0; i <= static_cast<unsigned>(degree_); ++i) {
        const S weight = to_scalar<S>(curve.weights[i]);
        for (unsigned k = 0; k < 3; ++k) {
            points_[i][k] =
                weight * distance<S>(to_position(curve.points[0][k]), to_position(curve.points[i][k]), unit_log2_);
        }
        points_[i][3] = weight;
    }
}

template <Scalar S>
typename RationalPieces<S>::State RationalPieces<S>::state(S u) const noexcept {
    // De Casteljau, keeping the last three points for the derivatives.
    std::array<std::array<S, 4>, BezierPlan::most_points> work = points_;
    std::array<std::array<S, 4>, 3> derivative{}; // P, P', P''
    const S degree = from_integer<S>(degree_);
    for (int level = degree_; level > 0; --level) {
        if (level == 2) {
            const S factor = degree * (degree - from_integer<S>(1));
            for (unsigned k = 0; k < 4; ++k) {
                derivative[2][k] = factor * (work[2][k] - work[1][k] - (work[1][k] - work[0][k]));
            }
        }
        if (level == 1) {
            for (unsigned k = 0; k < 4; ++k) {
                derivative[1][k] = degree * (work[1][k] - work[0][k]);
            }
        }
        for (const unsigned i : indices(level)) {
            for (unsigned k = 0; k < 4; ++k) {
                work[i][k] = work[i][k] + u * (work[i + 1][k] - work[i][k]);
            }
        }
    }
    derivative[0] = work[0];
    State out;
    const S w = derivative[0][3];
    for (unsigned k = 0; k < 3; ++k) {
        out.position[k] = derivative[0][k] / w;
        out.first[k] = (derivative[1][k] - derivative[1][3] * out.position[k]) / w;
        out.second[k] =
            (derivative[2][k] - scale2(derivative[1][3] * out.first[k], 1) - derivative[2][3] * out.position[k]) / w;
    }
    return out;
}

template <Scalar S>
bool RationalPieces<S>::fits(const State& from, const State& to, S u, S width,
                             std::array<std::array<S, 6>, 3>& points) const noexcept {
    const S fifth = width * literal<S>(0.2);
    const S twentieth = width * width * literal<S>(0.05);
    for (unsigned k = 0; k < 3; ++k) {
        std::array<S, 6>& b = points[k];
        const S way = to.position[k] - from.position[k];
        b[0] = S{};
        b[1] = fifth * from.first[k];
        b[2] = scale2(b[1], 1) + twentieth * from.second[k];
        b[5] = way;
        b[4] = way - fifth * to.first[k];
        b[3] = scale2(b[4], 1) - way + twentieth * to.second[k];
    }
    // 1e-6 mm in chord units is 0.004; between the places the error is larger.
    const S bound = scale2(std::same_as<S, float> ? literal<S>(4.0) : literal<S>(0.001), chord_unit_log2 - unit_log2_);
    for (const S t : {literal<S>(0.5), literal<S>(0.25), literal<S>(0.75)}) {
        const State exact = state(u + t * width);
        std::array<S, 3> apart{};
        for (unsigned k = 0; k < 3; ++k) {
            std::array<S, 6> work = points[k];
            for (unsigned level = 5; level > 0; --level) {
                for (unsigned i = 0; i < level; ++i) {
                    work[i] = work[i] + t * (work[i + 1] - work[i]);
                }
            }
            apart[k] = work[0] - (exact.position[k] - from.position[k]);
        }
        if (norm(apart, 3) > bound) {
            return false;
        }
    }
    return true;
}

template <Scalar S>
void RationalPieces<S>::next(std::array<std::array<S, 6>, 3>& points) noexcept {
    const S unit = literal<S>(1.0 / whole);
    const S u = unit * from_integer<S>(at_);
    const State from = state(u);
    int width = whole - at_;
    for (;;) {
        const State to = state(unit * from_integer<S>(at_ + width));
        if (fits(from, to, u, unit * from_integer<S>(width), points) || width == 1) {
            at_ += width;
            for (std::array<S, 6>& axis : points) {
                for (S& point : axis) {
                    point = scale2(point, unit_log2_ - chord_unit_log2);
                }
            }
            return;
        }
        width = (width + 1) / 2;
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(RationalPieces)
#endif

} // namespace splinefeed
