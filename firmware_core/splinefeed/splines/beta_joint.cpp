// SPDX-License-Identifier: MIT
//
// r'(0) = d (W1 - W0), q'(1) = d (C - B), r''(0) = d (d-1)(W0 - 2 W1 + W2), q''(1) = d (d-1)(A - 2 B + C). The
// constraint of order 2, divided by d (d-1), is W0 - 2 W1 + W2 = beta1^2 (A - 2 B + C) + c (C - B), c = beta2/(d-1):
// the second derivatives have the factor d (d-1), the first one d, so beta2 keeps 1/(d-1) and no factor d. With W0 and
// W1 inserted,
//   W2 = C + (2 beta1 + c)(C - B) + beta1^2 ((C - B) - (B - A)).
// Differences are computed first: the result does not depend on the origin.
//
// gamma = (d-1)(1 + beta1) / (beta2 + beta1 (d-1)(1 + beta1)), T = B + beta1^2 gamma (B - A).
#include "splinefeed/splines/beta_joint.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/splines/product_fits.hpp"

namespace splinefeed {

namespace {

// Largest beta1 for which 8 beta1 (1 + beta1) and (2 beta1 + 1)^2 fit in S.
template <Scalar S>
constexpr S beta1_most() noexcept {
    return from_integer<S>(std::same_as<S, Fixed> ? 1 << 13 : 1 << 30);
}
template <Scalar S>
constexpr S beta2_most() noexcept {
    return std::same_as<S, Fixed> ? from_integer<S>(1 << 29) : scale2(from_integer<S>(1), 60);
}

template <Scalar S>
bool is_number(S x) noexcept {
    return absolute(x) <= largest<S>();
}

template <Scalar S>
S largest_component(const Point<S>& point) noexcept {
    S most{};
    for (const S& x : point) {
        most = larger(most, absolute(x));
    }
    return most;
}

template <Scalar S>
bool all_numbers(const Point<S>& point) noexcept {
    bool fine = true;
    for (const S& x : point) {
        fine = fine && is_number(x);
    }
    return fine;
}

template <Scalar S>
void add_gamma(BetaJoint<S>& joint, const Beta<S>& beta, int degree, const Point<S>& a, const Point<S>& b,
               S coordinate) noexcept {
    const S one = from_integer<S>(1);
    const S numerator = from_integer<S>(degree - 1) * (one + beta.beta1);
    const S denominator = beta.beta2 + beta.beta1 * numerator;
    const S size = quotient_or_max(numerator, absolute(denominator));
    const S square = beta.beta1 * beta.beta1;
    // |B - A| <= 2 coordinate
    if (denominator == S{} || !product_fits(size, square) || !product_fits(size * square, coordinate + coordinate)) {
        return;
    }
    joint.gamma_known = true;
    joint.gamma = denominator < S{} ? -size : size;
    for (unsigned k = 0; k < a.size(); ++k) {
        joint.apex[k] = b[k] + square * joint.gamma * (b[k] - a[k]);
    }
}

} // namespace

template <Scalar S>
Result<S> beta_growth(const Beta<S>& beta, int degree, int order) noexcept {
    if (order < 1 || order > 2 || degree < order || degree > max_degree) {
        return Error::degree_out_of_range;
    }
    if (!(beta.beta1 > S{})) {
        return Error::beta1_not_positive;
    }
    if (order == 2 && !is_number(beta.beta2)) {
        return Error::beta2_out_of_range;
    }
    if (beta.beta1 > beta1_most<S>() || (order == 2 && absolute(beta.beta2) > beta2_most<S>())) {
        return Error::result_out_of_range;
    }
    const S line = from_integer<S>(1) + beta.beta1 + beta.beta1;
    if (order == 1) {
        return line;
    }
    return line * line + from_integer<S>(2) * absolute(beta.beta2) / from_integer<S>(degree - 1);
}

template <Scalar S>
Result<BetaJoint<S>> beta_joint(const BezierPiece<S>& before, const Beta<S>& beta, int order) noexcept {
    const int degree = before.degree;
    const Result<S> growth = beta_growth(beta, degree, order);
    if (!growth.has_value()) {
        return growth.error();
    }
    const Point<S> c = before.point(degree);
    const Point<S> b = before.point(degree - 1);
    const Point<S> a = order == 2 ? before.point(degree - 2) : b;
    const S coordinate = larger(largest_component(a), larger(largest_component(b), largest_component(c)));
    if (!all_numbers(a) || !all_numbers(b) || !all_numbers(c) || !product_fits(coordinate, *growth)) {
        return Error::result_out_of_range;
    }
    if (b == c) {
        return Error::tangent_vanishes;
    }
    BetaJoint<S> joint;
    joint.w0 = c;
    const S tension = order == 2 ? beta.beta2 / from_integer<S>(degree - 1) : S{};
    for (unsigned k = 0; k < c.size(); ++k) {
        const S leg = c[k] - b[k];
        joint.w1[k] = c[k] + beta.beta1 * leg;
        if (order == 2) {
            const S bend = leg - (b[k] - a[k]);
            joint.w2[k] = c[k] + ((beta.beta1 + beta.beta1 + tension) * leg + beta.beta1 * beta.beta1 * bend);
        }
    }
    if (order == 2) {
        add_gamma(joint, beta, degree, a, b, coordinate);
    }
    return joint;
}

namespace {

/// Derivatives by the parameters of two pieces where they meet.
template <Scalar S>
struct MeetingEnds {
    Point<S> q1{}; // of the piece before
    Point<S> q2{};
    Point<S> r1{}; // of the piece behind
    Point<S> r2{};
    Point<S> step{}; // from one to the other
};

template <Scalar S>
Status take_ends(const BezierPiece<S>& before, const BezierPiece<S>& after, MeetingEnds<S>& out) noexcept {
    const int n = before.degree;
    const int m = after.degree;
    if (n < 1 || n > max_degree || m < 1 || m > max_degree) {
        return Error::degree_out_of_range;
    }
    // |second derivative| <= 4 N (N-1) coordinates: below 2^30, so that norm may square it.
    const int highest = n > m ? n : m;
    const int max_path_acceleration = highest > 1 ? highest * (highest - 1) : 1;
    const S coordinate_most =
        scale2(from_integer<S>(1), std::same_as<S, Fixed> ? 28 : 50) / from_integer<S>(max_path_acceleration);
    for (unsigned k = 0; k < out.q1.size(); ++k) {
        const PerDegree<S>& q = before.control[k];
        const PerDegree<S>& r = after.control[k];
        const auto last = static_cast<unsigned>(n);
        for (unsigned i = 0; i < 3; ++i) {
            if ((i <= last && !(absolute(q[last - i]) <= coordinate_most)) ||
                (i <= static_cast<unsigned>(m) && !(absolute(r[i]) <= coordinate_most))) {
                return Error::result_out_of_range;
            }
        }
        out.step[k] = r[0] - q[last];
        out.q1[k] = from_integer<S>(n) * (q[last] - q[last - 1]);
        out.r1[k] = from_integer<S>(m) * (r[1] - r[0]);
        if (n > 1) {
            out.q2[k] = from_integer<S>(n * (n - 1)) * ((q[last] - q[last - 1]) - (q[last - 1] - q[last - 2]));
        }
        if (m > 1) {
            out.r2[k] = from_integer<S>(m * (m - 1)) * ((r[2] - r[1]) - (r[1] - r[0]));
        }
    }
    return {};
}

} // namespace

template <Scalar S>
Result<BetaMeasure<S>> measure_joint(const BezierPiece<S>& before, const BezierPiece<S>& after) noexcept {
    MeetingEnds<S> ends;
    if (const Status status = take_ends(before, after, ends); !status.ok()) {
        return status.error();
    }
    const auto& [q1, q2, r1, r2, step] = ends;
    const S speed_before = norm(q1, max_axes);
    const S speed_after = norm(r1, max_axes);
    if (!(speed_before > S{}) || !(speed_after > S{})) {
        return Error::tangent_vanishes;
    }
    BetaMeasure<S> out;
    out.gap = norm(step, max_axes);
    out.beta.beta1 = quotient_or_max(speed_after, speed_before);
    if (out.beta.beta1 > beta1_most<S>()) {
        return Error::result_out_of_range;
    }
    const S square = out.beta.beta1 * out.beta.beta1;
    if (!product_fits(square, larger(largest_component(q2), from_integer<S>(1)))) {
        return Error::result_out_of_range;
    }
    Point<S> turn{};
    Point<S> left{};
    S along{};
    for (unsigned k = 0; k < q1.size(); ++k) {
        const S unit = q1[k] / speed_before;
        turn[k] = r1[k] / speed_after - unit;
        left[k] = r2[k] - square * q2[k];
        if (!(absolute(left[k]) <= scale2(largest<S>(), -4))) {
            return Error::result_out_of_range; // six products and norm must fit
        }
        along += left[k] * unit;
    }
    for (unsigned k = 0; k < q1.size(); ++k) {
        left[k] = left[k] - along * (q1[k] / speed_before);
    }
    const S tension = quotient_or_max(absolute(along), speed_before);
    out.beta.beta2 = along < S{} ? -tension : tension;
    out.tangent_jump = norm(turn, max_axes);
    out.curvature_jump = quotient_or_max(quotient_or_max(norm(left, max_axes), speed_after), speed_after);
    return out;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Result<S> beta_growth(const Beta<S>&, int, int) noexcept;                                                 \
    template Result<BetaJoint<S>> beta_joint(const BezierPiece<S>&, const Beta<S>&, int) noexcept;                     \
    template Result<BetaMeasure<S>> measure_joint(const BezierPiece<S>&, const BezierPiece<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
