// SPDX-License-Identifier: MIT
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/splines/ferguson.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
Point<S> direction(const Point<S>& from, const Point<S>& to) noexcept {
    Point<S> out = chord_between(from, to);
    const S length = norm(out, max_axes);
    for (S& x : out) {
        x = length > S{} ? x / length : S{};
    }
    return out;
}

// (a ^ b) . (c ^ d): in the plane the product of two signed turns, in space that of their vectors.
template <Scalar S>
S turns_product(const Point<S>& a, const Point<S>& b, const Point<S>& c, const Point<S>& d) noexcept {
    return dot(a, c, max_axes) * dot(b, d, max_axes) - dot(a, d, max_axes) * dot(b, c, max_axes);
}

} // namespace

template <Scalar S>
void estimate_end_tangents(std::span<const Point<S>> points, std::span<const FergusonJoint<S>> joints, Point<S>& start,
                           Point<S>& end) noexcept {
    const std::size_t n = points.size();
    const Point<S> first = chord_between(points[0], points[1]);
    const Point<S> last = chord_between(points[n - 2], points[n - 1]);
    start = first;
    end = last;
    if (n == 2) {
        return;
    }
    // Spans 1 and lambda: the derivative in between is (lambda e_1 + e_2/lambda)/(1 + lambda), at the start twice the
    // chord minus that; from the other end the spans are 1 and 1/lambda.
    const S one = literal<S>(1);
    const Point<S> second = chord_between(points[1], points[2]);
    const Point<S> before = chord_between(points[n - 3], points[n - 2]);
    const S there = joints.front().lambda;
    const S back = one / joints.back().lambda;
    for (unsigned k = 0; k < all_axes; ++k) {
        start[k] = first[k] + first[k] - (there * first[k] + second[k] / there) / (one + there);
        end[k] = last[k] + last[k] - (back * last[k] + before[k] / back) / (one + back);
    }
}

template <Scalar S>
int automatic_sign(std::span<const Point<S>> points, std::size_t knot, bool closed) noexcept {
    const std::size_t n = points.size();
    if (n < 5 || (!closed && (knot < 2 || knot + 2 >= n))) {
        return 1;
    }
    const auto chord = [&](std::size_t i) {
        return direction(points[i % n], points[(i + 1) % n]);
    };
    const Point<S> a = chord(knot + n - 2);
    const Point<S> b = chord(knot + n - 1);
    const Point<S> c = chord(knot);
    const Point<S> d = chord(knot + 1);
    const S here = turns_product(b, c, b, c); // sine of the turn, squared
    const bool opposite = turns_product(a, b, c, d) < -literal<S>(0.001);
    return opposite && here < turns_product(a, b, a, b) && here < turns_product(c, d, c, d) ? -1 : 1;
}

template <Scalar S>
S stable_mu(S wish, int delta, S lambda, S lambda_before) noexcept {
    const FergusonJoint<S> joint{lambda, wish, delta};
    const CyclicRow<S> row = ferguson_row(joint, lambda_before);
    const S diagonal = row.on;
    const S others = absolute(row.below) + row.above;
    const S bound = others + scale2(others, -4);
    if (absolute(diagonal) >= bound) {
        return wish;
    }
    // mu/2 moves the diagonal entry to the nearer of +-bound.
    const S move = (diagonal < S{} ? -bound : bound) - diagonal;
    return wish + (move + move);
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template void estimate_end_tangents<S>(std::span<const Point<S>>, std::span<const FergusonJoint<S>>, Point<S>&,    \
                                           Point<S>&) noexcept;                                                        \
    template int automatic_sign<S>(std::span<const Point<S>>, std::size_t, bool) noexcept;                             \
    template S stable_mu<S>(S, int, S, S) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
