// SPDX-License-Identifier: MIT
//
// Knots of n points and degree d: d + 1 times 0, then 1, 2, ..., n - d - 1, then d + 1 times n - d. Bezier point i of
// the piece over [a, a + 1] is the blossom at d - i times a and i times a + 1; by de Boor's recursion each step is a
// mean of two points with weights that are ratios of integers up to d.
#include "splinefeed/s0_program/cycles/nurbs_curve.hpp"

namespace splinefeed {

void NurbsCurve::begin(int order, const SpacePoint& start, Decimal weight) noexcept {
    now_.degree = order - 1;
    now_.count = 0;
    now_.piece = 0;
    now_.open = true;
    now_.finished = false;
    now_.lightest = now_.heaviest = weight;
    add(start, weight);
}

void NurbsCurve::add(const SpacePoint& point, Decimal weight) noexcept {
    points_[static_cast<unsigned>(now_.count % window)] = {point, weight};
    now_.lightest = weight < now_.lightest ? weight : now_.lightest;
    now_.heaviest = weight > now_.heaviest ? weight : now_.heaviest;
    ++now_.count;
}

bool NurbsCurve::finish() noexcept {
    now_.finished = now_.count > now_.degree;
    return now_.finished;
}

std::int32_t NurbsCurve::knot(std::int32_t index) const noexcept {
    const std::int32_t last =
        now_.finished ? now_.count - now_.degree : index; // before the end is known it is far away
    const std::int32_t inner = index - now_.degree;
    return inner < 0 ? 0 : inner > last ? last : inner;
}

bool NurbsCurve::next(BezierPlan& out) noexcept {
    const std::int32_t known = now_.finished ? now_.count - now_.degree : now_.count - 2 * now_.degree + 1;
    if (!now_.open || now_.piece >= known) {
        now_.open = now_.open && !now_.finished;
        return false;
    }
    const int d = now_.degree;
    // The control points of the piece; homogeneous where weights differ: numbers are below 2^20 mm and weights 1.
    std::int64_t heaviest = 0;
    bool equal = true;
    for (int i = 0; i <= d; ++i) {
        const std::int64_t weight = at(now_.piece + i).weight.raw;
        heaviest = weight > heaviest ? weight : heaviest;
        equal = equal && weight == at(now_.piece).weight.raw;
    }
    const SpacePoint& origin = at(now_.piece).place;
    for (int i = 0; i <= d; ++i) {
        std::array<std::int64_t, std::size_t{4} * most_order> work{};
        for (int j = 0; j <= d; ++j) {
            const Point& point = at(now_.piece + j);
            const std::int64_t weight =
                equal ? Decimal::one
                      : product_quotient(point.weight.raw, Decimal::one, static_cast<std::uint64_t>(heaviest)).raw;
            for (unsigned k = 0; k < 3; ++k) {
                const std::int64_t offset = (point.place[k] - origin[k]).raw;
                work[static_cast<unsigned>(4 * j) + k] =
                    equal ? offset : product_quotient(offset, weight, static_cast<std::uint64_t>(Decimal::one)).raw;
            }
            work[static_cast<unsigned>(4 * j) + 3] = weight;
        }
        for (int r = 1; r <= d; ++r) {
            const std::int32_t t = now_.piece + (r > d - i ? 1 : 0);
            for (int j = d; j >= r; --j) {
                const std::int32_t low = knot(now_.piece + j);
                const std::int32_t high = knot(now_.piece + j + d + 1 - r);
                for (unsigned k = 0; k < 4; ++k) {
                    std::int64_t& to = work[static_cast<unsigned>(4 * j) + k];
                    const std::int64_t from = work[static_cast<unsigned>(4 * (j - 1)) + k];
                    to = from + product_quotient(to - from, t - low, static_cast<std::uint64_t>(high - low)).raw;
                }
            }
        }
        const auto result = static_cast<unsigned>(4 * d);
        const std::int64_t weight = work[result + 3];
        for (unsigned k = 0; k < 3; ++k) {
            const std::int64_t offset =
                equal ? work[result + k]
                      : product_quotient(work[result + k], Decimal::one, static_cast<std::uint64_t>(weight)).raw;
            out.points[static_cast<unsigned>(i)][k] = origin[k] + Decimal{offset};
        }
        out.weights[static_cast<unsigned>(i)] = {weight};
    }
    if (now_.finished && now_.piece + 1 == known) {
        out.points[static_cast<unsigned>(d)] = last(); // without the rounding of its weight: there the program stands
    }
    out.degree = d;
    out.rational = !equal;
    ++now_.piece;
    return true;
}

} // namespace splinefeed
