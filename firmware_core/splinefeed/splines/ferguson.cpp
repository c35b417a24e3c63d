// SPDX-License-Identifier: MIT
#include "splinefeed/splines/ferguson.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
S signed_square(const FergusonJoint<S>& joint) noexcept {
    const S square = joint.lambda * joint.lambda;
    return joint.delta < 0 ? -square : square;
}

template <Scalar S>
Status check(const FergusonJoint<S>& joint) noexcept {
    constexpr bool fixed = std::same_as<S, Fixed>;
    const S most_lambda = fixed ? literal<S>(16) : literal<S>(0x1p20);
    const S least_lambda = fixed ? literal<S>(0.0625) : literal<S>(0x1p-20);
    const S most_mu = fixed ? literal<S>(0x1p16) : literal<S>(0x1p30) * literal<S>(0x1p30);
    if (!(joint.lambda > S{})) {
        return Error::lambda_not_positive;
    }
    if (joint.delta != 1 && joint.delta != -1) {
        return Error::curvature_sign_invalid;
    }
    if (joint.lambda > most_lambda || joint.lambda < least_lambda || !within(joint.mu, most_mu)) {
        return Error::lambda_or_mu_out_of_range;
    }
    return {};
}

template <Scalar S>
Status check(const FergusonInput<S>& input, std::size_t count) noexcept {
    if (first_bad_point(input.points) != input.points.size()) {
        return Error::position_out_of_range;
    }
    if (count < (input.closed ? 3U : 2U)) {
        return Error::too_few_points;
    }
    if (input.joints.size() != (input.closed ? count : count - 2)) {
        return Error::parameters_invalid;
    }
    for (const FergusonJoint<S>& joint : input.joints) {
        if (const Status status = check(joint); !status.ok()) {
            return status;
        }
    }
    const std::array<Point<S>, 2> ends{input.start_tangent, input.end_tangent};
    if (!input.closed && first_bad_point<S>(ends) != ends.size()) {
        return Error::tangent_out_of_range;
    }
    return {};
}

// 3 (r_{i+1} - (1 - delta lambda^2) r_i - delta lambda^2 r_{i-1}) from the chords, so that it does not depend on the
// origin.
template <Scalar S>
Point<S> right_side(const FergusonJoint<S>& joint, const Point<S>& before, const Point<S>& here,
                    const Point<S>& after) noexcept {
    const S weight = signed_square(joint);
    Point<S> out{};
    for (unsigned k = 0; k < all_axes; ++k) {
        out[k] = from_integer<S>(3) * ((after[k] - here[k]) + weight * (here[k] - before[k]));
    }
    return out;
}

template <Scalar S>
bool vanishes(const Point<S>& tangent, S noise) noexcept {
    for (const S& x : tangent) {
        if (!within(x, noise)) {
            return false;
        }
    }
    return true;
}

// A tangent that is zero except for rounding: below 2^-40 (float 2^-18, Fixed at least 2^-32) of the points and
// tangents.
template <Scalar S>
void find_vanishing(const FergusonInput<S>& input, const FergusonOutput<S>& out, std::size_t count,
                    FergusonReport<S>& report) noexcept {
    S size{};
    for (std::size_t i = 0; i < count; ++i) {
        const Point<S>& next = input.points[(i + 1) % count];
        for (unsigned k = 0; k < all_axes; ++k) {
            size = larger(size, larger(absolute(next[k] - input.points[i][k]), absolute(out.tangents_in[i][k])));
        }
    }
    const S noise = report.tangent_noise = std::same_as<S, Fixed> ? scale2(size, -32) + scale2(literal<S>(1), -28)
                                                                  : scale2(size, std::same_as<S, float> ? -18 : -40);
    for (std::size_t i = count; i-- > 0;) {
        if (vanishes(out.tangents_in[i], noise)) {
            ++report.vanishing;
            report.first_vanishing = i;
        }
    }
}

template <Scalar S>
BezierPiece<S> hermite(const Point<S>& from, const Point<S>& to, const Point<S>& leaving,
                       const Point<S>& arriving) noexcept {
    BezierPiece<S> piece;
    piece.degree = 3;
    for (unsigned k = 0; k < all_axes; ++k) {
        piece.control[k][0] = from[k];
        piece.control[k][1] = from[k] + leaving[k] / from_integer<S>(3);
        piece.control[k][2] = to[k] - arriving[k] / from_integer<S>(3);
        piece.control[k][3] = to[k];
    }
    return piece;
}

/// Fills the rows of the unknown tangents; known ones go to the right side.
template <Scalar S>
void assemble(const FergusonInput<S>& input, std::size_t count, std::span<CyclicRow<S>> rows) noexcept {
    const std::size_t n = rows.size();
    const std::size_t first = input.closed ? 0 : 1;
    for (std::size_t j = 0; j < n; ++j) {
        const std::size_t i = j + first;
        const FergusonJoint<S>& joint = input.joints[j];
        const bool after_start = !input.closed && j == 0;
        const S lambda_before = after_start ? literal<S>(1) : input.joints[(j + n - 1) % n].lambda;
        CyclicRow<S>& row = rows[j];
        row = ferguson_row(joint, lambda_before);
        row.right =
            right_side(joint, input.points[(i + count - 1) % count], input.points[i], input.points[(i + 1) % count]);
        if (input.closed) {
            continue;
        }
        for (unsigned k = 0; k < all_axes; ++k) {
            row.right[k] -= j == 0 ? row.below * input.start_tangent[k] : S{};
            row.right[k] -= j + 1 == n ? row.above * input.end_tangent[k] : S{};
        }
        row.below = j == 0 ? S{} : row.below;
        row.above = j + 1 == n ? S{} : row.above;
    }
}

} // namespace

template <Scalar S>
FergusonClass ferguson_class(const FergusonJoint<S>& joint, bool tangent_vanishes) noexcept {
    const bool same_speed = joint.lambda == literal<S>(1);
    if (tangent_vanishes) {
        return FergusonClass::undefined;
    }
    if (joint.delta < 0) {
        return same_speed ? FergusonClass::c1_abs_kappa : FergusonClass::g1_abs_kappa;
    }
    return !same_speed ? FergusonClass::g2 : joint.mu == S{} ? FergusonClass::c2 : FergusonClass::c1_g2;
}

template <Scalar S>
CyclicRow<S> ferguson_row(const FergusonJoint<S>& joint, S lambda_before) noexcept {
    const S square = signed_square(joint);
    const S half = scale2(joint.mu, -2) + (square + joint.lambda);
    CyclicRow<S> row;
    row.below = square * lambda_before;
    row.on = half + half;
    row.above = literal<S>(1);
    return row;
}

template <Scalar S>
Status ferguson(const FergusonInput<S>& input, const FergusonOutput<S>& out, FergusonReport<S>& report) noexcept {
    report = {};
    const std::size_t count = input.closed ? closed_count(input.points) : input.points.size();
    if (const Status status = check(input, count); !status.ok()) {
        return status;
    }
    const std::size_t unknowns = input.joints.size();
    const std::size_t segments = input.closed ? count : count - 1;
    if (out.tangents_in.size() < count || out.tangents_out.size() < count || out.pieces.size() < segments ||
        out.system.size() < unknowns) {
        return Error::storage_too_small;
    }
    const std::size_t first = input.closed ? 0 : 1;
    if (unknowns > 0) {
        const auto rows = out.system.first(unknowns);
        assemble(input, count, rows);
        report.diagonally_dominant = diagonally_dominant<S>(rows);
        CyclicReport<S> solved;
        const Status status = solve_cyclic(rows, input.closed, out.tangents_in.subspan(first, unknowns), solved);
        report.elimination_without_pivoting_ok = solved.without_pivoting;
        report.condition = solved.condition;
        report.weakest_knot = solved.weakest + first;
        if (!status.ok()) {
            return status;
        }
    } else {
        report.diagonally_dominant = report.elimination_without_pivoting_ok = true;
        report.condition = literal<S>(1);
    }
    if (!input.closed) {
        out.tangents_in[0] = input.start_tangent;
        out.tangents_in[count - 1] = input.end_tangent;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const bool joint = i >= first && i - first < unknowns;
        for (unsigned k = 0; k < all_axes; ++k) {
            const S in = out.tangents_in[i][k];
            out.tangents_out[i][k] = joint ? input.joints[i - first].lambda * in : in;
        }
    }
    for (std::size_t i = 0; i < segments; ++i) {
        const std::size_t next = (i + 1) % count;
        out.pieces[i] = hermite(input.points[i], input.points[next], out.tangents_out[i], out.tangents_in[next]);
    }
    report.segments = segments;
    find_vanishing(input, out, count, report);
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template FergusonClass ferguson_class<S>(const FergusonJoint<S>&, bool) noexcept;                                  \
    template CyclicRow<S> ferguson_row<S>(const FergusonJoint<S>&, S) noexcept;                                        \
    template Status ferguson<S>(const FergusonInput<S>&, const FergusonOutput<S>&, FergusonReport<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
