// SPDX-License-Identifier: MIT
//
// Piece i leads from P_i to P_{i+1}, e_i = P_{i+1} - P_i. With the derivative t_i at the end of piece i - 1, and beta1
// t_i at the start of piece i, both by the parameter of the piece, the second derivatives there are
//   q''(1) = 2 beta1_{i-1} t_{i-1} + 4 t_i - 6 e_{i-1},    r''(0) = 6 e_i - 4 beta1_i t_i - 2 t_{i+1}.
// r'' = beta1^2 q'' + beta2 q' over 2 beta1^2, with r = 1/beta1_i:
//   beta1_{i-1} t_{i-1} + (2 + 2 r + beta2 r^2 / 2) t_i + r^2 t_{i+1} = 3 (e_{i-1} + r^2 e_i)
// and over 1 + r, with omega = r / (1 + r) and omega' = 1 / (1 + r), weights in [0, 1] that sum to 1:
//   omega' beta1_{i-1} t_{i-1} + (2 + beta2 r omega / 2) t_i + omega r t_{i+1} = 3 (omega' e_{i-1} + omega r e_i).
// Ends: 2 t_0 + t_1 = 3 e_0 and beta1_{n-2} t_{n-2} + 2 t_{n-1} = 3 e_{n-2} if natural (beta1_0 = 1).
//
// Only ratios of neighbouring joints appear: a beta1 other than 1 at thousands of joints causes neither overflow nor
// underflow. Elimination from above, t_i = rho_i - g_i t_{i+1}: the pivot is
//   p_i = 2 + beta2 r omega / 2 - omega'_i (omega_{i-1} / p_{i-1}),    g_i = omega r / p_i;
// beta1_{i-1} cancels against g_{i-1}. p >= 2 - 1/1 implies omega/p <= 1, and so by induction p_i >= 1 for all beta1 >
// 0 and beta2 >= 0 (in fact 3/2): no pivoting is needed, and rounding errors do not grow in units of the spans. (In t /
// h with h_i = beta1_i h_{i-1} the rows are diagonally dominant by 1.)
//
// Closed: t_{n-1} is eliminated last. Every row is t_i = rho_i - g_i t_{i+1} - s_i t_{n-1}. The only value needed of
// all rows is t_0 = a - c t_{i+1} - s t_{n-1}, which is carried along. The pass before the elimination finds t_{n-1}
// with a constant number of scalars; then the elimination is that of an open curve whose tangents are given.
#include "splinefeed/splines/g2_bezier.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/g2_bezier_rows.hpp"

namespace splinefeed {

namespace {

using detail::ChordOf;
using detail::each_axis;
using detail::Equations;
using detail::Numbers;
using detail::Row;

// x / p; in floating point by the reciprocal, which is already known.
template <Scalar S>
S over(S x, S p, S inverse) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        static_cast<void>(inverse);
        return x / p;
    } else {
        static_cast<void>(p);
        return x * inverse;
    }
}

/// Eliminates the rows of points 1 to n - 2 (closed: also of point 0), given the result of the point before: t = rho -
/// g t_next, omega / p of that row and its beta1.
template <Scalar S, int fixed_axes, bool plain>
class SweepElimination {
public:
    Equations<S, fixed_axes, plain>& equations;
    Numbers<S, fixed_axes> rho{};
    S g{};
    S pull{};                     ///< beta1 g = omega / p
    S beta1 = from_integer<S>(1); ///< of the previous point

    /// Next row.
    void step(const Row<S>& row, const ChordOf<S, fixed_axes>& a, const ChordOf<S, fixed_axes>& b) noexcept {
        const S p = row.diagonal - row.before * pull;
        S inverse{};
        if constexpr (!std::same_as<S, Fixed>) {
            inverse = from_integer<S>(1) / p;
        }
        pull = over(row.after, p, inverse);
        g = row.r * pull;
        const S lower = row.before * beta1;
        each_axis<fixed_axes>(equations.axes(), [&](std::size_t k) {
            rho[k] = over(equations.right_side(row, a, b, k) - equations.product(lower, rho[k]), p, inverse);
        });
        beta1 = row.beta1;
        last_pivot = p;
    }
    S last_pivot{};
};

/// t_{n-1} of a closed curve, by one pass that stores nothing.
template <Scalar S, int fixed_axes, bool plain>
Status find_last(const G2BezierInput<S>& input, Numbers<S, fixed_axes>& last) noexcept {
    Equations<S, fixed_axes, plain> equations(input);
    const std::size_t n = input.point_count();
    const ChordOf<S, fixed_axes> closing = equations.chord(n - 1);
    ChordOf<S, fixed_axes> a = closing;
    SweepElimination<S, fixed_axes, plain> above{equations};
    S s{};                           // weight of t_{n-1} in the row
    Numbers<S, fixed_axes> t0_rho{}; // t_0 = t0_rho - t0_next t_{i+1} - t0_last t_{n-1}
    S t0_next{};
    S t0_last{};
    // beta1 of the last point, which is the one before point 0
    const S beta1_last = equations.row(n - 1, equations.chord(n - 2), closing).beta1;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const ChordOf<S, fixed_axes> b = equations.chord(i);
        const Row<S> row = equations.row(i, a, b);
        const S before = row.before;
        const S lower = i == 0 ? beta1_last : above.beta1;
        above.step(row, a, b);
        const S part = over(before, above.last_pivot, from_integer<S>(1) / above.last_pivot);
        s = i == 0 ? part * lower : -(part * equations.product(lower, s));
        if (i == 0) {
            t0_rho = above.rho;
            t0_next = above.g;
            t0_last = s;
        } else {
            each_axis<fixed_axes>(equations.axes(), [&](std::size_t k) {
                t0_rho[k] = t0_rho[k] - equations.product(t0_next, above.rho[k]);
            });
            t0_last = t0_last - equations.product(t0_next, s);
            t0_next = -equations.product(t0_next, above.g);
        }
        a = b;
        if (equations.error() != Error::none) {
            return equations.error();
        }
    }
    const Row<S> row = equations.row(n - 1, a, closing);
    const S lower = row.before * above.beta1;
    const S upper = row.after * row.r;
    const S from_before = row.before * above.pull + equations.product(lower, s);
    const S from_first = equations.product(upper, t0_next + t0_last);
    const S pivot = row.diagonal - from_before - from_first;
    // The rounding that is left of a pivot that is zero: a few units of its terms.
    const S terms = row.diagonal + absolute(from_before) + absolute(from_first);
    const S noise = scale2(terms, std::same_as<S, double> ? -44 : std::same_as<S, float> ? -16 : -24);
    if (equations.error() != Error::none) {
        return equations.error();
    }
    if (!(absolute(pivot) > noise)) {
        return terms <= largest<S>() ? Error::system_singular : Error::result_out_of_range;
    }
    each_axis<fixed_axes>(equations.axes(), [&](std::size_t k) {
        const S right = equations.right_side(row, a, closing, k);
        last[k] = (right - equations.product(lower, above.rho[k]) - equations.product(upper, t0_rho[k])) / pivot;
    });
    return equations.error();
}

template <Scalar S, int fixed_axes, bool plain>
Status solve(const G2BezierInput<S>& input, S* tangents, S* scratch) noexcept {
    const S one = from_integer<S>(1);
    const S three = from_integer<S>(3);
    Equations<S, fixed_axes, plain> equations(input);
    const std::size_t axes = equations.axes();
    const std::size_t n = input.point_count();
    SweepElimination<S, fixed_axes, plain> above{equations};
    Numbers<S, fixed_axes> last{};
    ChordOf<S, fixed_axes> a;
    std::size_t i = 0; // the next row
    if (input.closed) {
        if (const Status status = find_last<S, fixed_axes, plain>(input, last); !status.ok()) {
            return status;
        }
        a = equations.chord(n - 1);
        above.rho = last;
        above.beta1 = equations.row(n - 1, equations.chord(n - 2), a).beta1;
    } else {
        a = equations.chord(0);
        const bool given = !input.start.empty();
        each_axis<fixed_axes>(axes, [&](std::size_t k) {
            above.rho[k] = given ? input.start[k] : literal<S>(1.5) * a.e[k];
            tangents[k] = above.rho[k];
        });
        above.g = above.pull = given ? S{} : literal<S>(0.5);
        scratch[0] = above.g;
        i = 1;
    }
    S* rho = tangents + i * axes;
    for (; i + 1 < n; ++i, rho += axes) {
        const ChordOf<S, fixed_axes> b = equations.chord(i);
        above.step(equations.row(i, a, b), a, b);
        scratch[i] = above.g;
        each_axis<fixed_axes>(axes, [&](std::size_t k) { rho[k] = above.rho[k]; });
        a = b;
        if (equations.error() != Error::none) {
            return equations.error();
        }
    }
    if (!input.closed) {
        const S p = from_integer<S>(2) - above.pull;
        each_axis<fixed_axes>(axes, [&](std::size_t k) {
            last[k] =
                input.end.empty() ? (three * a.e[k] - equations.product(above.beta1, above.rho[k])) / p : input.end[k];
        });
    }
    each_axis<fixed_axes>(axes, [&](std::size_t k) { rho[k] = last[k]; });
    for (std::size_t j = n - 1; j-- > 0;) {
        const S g = scratch[j];
        rho -= axes;
        each_axis<fixed_axes>(axes, [&](std::size_t k) {
            last[k] = rho[k] - equations.product(g, last[k]);
            rho[k] = last[k];
        });
    }
    // NaN spreads through the elimination to the last row, and back to the first.
    S sum{};
    each_axis<fixed_axes>(axes, [&](std::size_t k) { sum = sum + absolute(last[k]) * scale2(one, -3); });
    return sum <= largest<S>() ? equations.error() : Error::result_out_of_range;
}

template <Scalar S>
Status check(const G2BezierInput<S>& input) noexcept {
    if (input.axes < 1 || input.axes > max_axes) {
        return Error::axes_out_of_range;
    }
    const auto axes = static_cast<std::size_t>(input.axes);
    const std::size_t n = input.point_count();
    const std::size_t joints = input.closed ? n : n - 2;
    if (n < (input.closed ? 3U : 2U) || input.coordinates.size() != n * axes) {
        return Error::too_few_points;
    }
    if (input.joints.size() > 1 && input.joints.size() != joints) {
        return Error::too_few_points;
    }
    for (const G2BezierJoint<S>& joint : input.joints) {
        if (!joint.chord_ratio && !(joint.beta1 > S{} && joint.beta1 <= largest<S>())) {
            return Error::beta1_not_positive;
        }
        if (!(joint.beta2 >= S{} && joint.beta2 <= largest<S>())) {
            return Error::beta2_out_of_range;
        }
    }
    if constexpr (std::same_as<S,
                               Fixed>) { // no sum of the rows overflows; floating-point numbers show it in the result
        const S most = from_integer<S>(1 << 27);
        for (const std::span<const S> numbers : {input.coordinates, input.start, input.end}) {
            for (const S& x : numbers) {
                if (absolute(x) > most) {
                    return Error::result_out_of_range;
                }
            }
        }
    }
    for (const std::span<const S> end : {input.start, input.end}) {
        if (!end.empty() && (end.size() != axes || input.closed)) {
            return Error::tangent_out_of_range;
        }
    }
    return {};
}

template <Scalar S>
bool has_tension_or_bias(const G2BezierInput<S>& input) noexcept {
    for (const G2BezierJoint<S>& joint : input.joints) {
        if (!joint.chord_ratio || joint.beta2 > S{}) {
            return true;
        }
    }
    return false;
}

} // namespace

template <Scalar S>
Status g2_bezier_tangents(const G2BezierInput<S>& input, std::span<S> tangents, std::span<S> scratch) noexcept {
    if (const Status status = check(input); !status.ok()) {
        return status;
    }
    if (tangents.size() < input.coordinates.size() || scratch.size() < input.point_count()) {
        return Error::storage_too_small;
    }
    if (has_tension_or_bias(input)) {
        return solve<S, 0, false>(input, tangents.data(), scratch.data());
    }
    if constexpr (!std::same_as<S, Fixed> && max_axes >= 3) {
        if (input.axes == 3) {
            return solve<S, 3, true>(input, tangents.data(), scratch.data());
        }
    }
    return solve<S, 0, true>(input, tangents.data(), scratch.data());
}

template <Scalar S>
Status g2_bezier_pieces(const G2BezierInput<S>& input, std::span<const S> tangents,
                        std::span<BezierPiece<S>> pieces) noexcept {
    if (const Status status = check(input); !status.ok()) {
        return status;
    }
    const std::size_t n = input.point_count();
    const std::size_t count = input.closed ? n : n - 1;
    if (tangents.size() < input.coordinates.size() || pieces.size() < count) {
        return Error::storage_too_small;
    }
    Equations<S, 0, false> equations(input);
    const std::size_t axes = equations.axes();
    ChordOf<S, 0> a = equations.chord(input.closed ? n - 1 : 0);
    for (std::size_t i = 0; i < count; ++i) {
        const ChordOf<S, 0> b = equations.chord(i);
        const S beta1 = i > 0 || input.closed ? equations.row(i, a, b).beta1 : from_integer<S>(1);
        const S* const from = input.coordinates.data() + i * axes;
        const S* const t = tangents.data() + i * axes;
        const std::size_t next = i + 1 < n ? (i + 1) * axes : 0;
        pieces[i] = BezierPiece<S>{};
        pieces[i].degree = 3;
        each_axis<0>(axes, [&](std::size_t k) {
            PerDegree<S>& control = pieces[i].control[k];
            control[0] = from[k];
            control[1] = from[k] + equations.product(beta1, t[k]) / from_integer<S>(3);
            control[3] = input.coordinates[next + k];
            control[2] = control[3] - tangents[next + k] / from_integer<S>(3);
        });
        a = b;
    }
    return equations.error();
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status g2_bezier_tangents(const G2BezierInput<S>&, std::span<S>, std::span<S>) noexcept;                  \
    template Status g2_bezier_pieces(const G2BezierInput<S>&, std::span<const S>, std::span<BezierPiece<S>>) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
