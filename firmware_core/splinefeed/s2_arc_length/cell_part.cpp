// SPDX-License-Identifier: MIT
//
// Let w0, w1 be the parameters at the ends of the part. The position is a polynomial of omega = (w - w0) / (w1 - w0),
// and omega is one of xi = (x - from) / l, with l the length of the part. Both are shifted to their start (repeated
// Horner's rule) and scaled. The Bezier points of the shape are those on the part. 2 L q'' and the error of its
// parabola, which are per length of the cell, shrink with the length.
#include "splinefeed/s2_arc_length/cell_part.hpp"

#include "splinefeed/number/division_by.hpp"
#include "splinefeed/number/instantiate.hpp"

#include <span>

namespace splinefeed {

namespace {

// Coefficients of the polynomial in x - x0.
template <Numeric N, Numeric X>
void shift(std::span<N> power, X x0) noexcept {
    for (std::size_t i = 0; i + 1 < power.size(); ++i) {
        for (std::size_t j = power.size() - 1; j-- > i;) {
            power[j] = power[j] + power[j + 1] * x0;
        }
    }
}

} // namespace

template <Scalar S>
Cell<S> part_of(const Cell<S>& cell, const CellInterval<S>& stretch) noexcept {
    using R = Ratio<S>;
    const S one = from_integer<S>(1);
    const S length = stretch.length();
    const auto share = shortened<R>(length);
    Cell<S> out = cell;
    const S w0 = stretch.from == S{} ? S{} : cell.parameter_at(stretch.from);
    const S w1 = stretch.to == one ? one : cell.parameter_at(stretch.to);
    const S width = w1 - w0;
    const auto degree = static_cast<std::size_t>(cell.degree);
    const R sixth = literal<R>(1.0 / 6.0);
    for (const unsigned k : indices(cell.axes)) {
        PerDegree<S>& power = out.power[k];
        shift(std::span<S>(power).first(degree + 1), w0);
        S scale = width;
        for (std::size_t i = 1; i <= degree; ++i) {
            power[i] = power[i] * scale;
            scale = scale * width;
        }
        out.origin[k] = displaced(cell.origin[k], power[0], cell.unit_log2);
        power[0] = power[0] - distance<S>(cell.origin[k], out.origin[k], cell.unit_log2);
        AxisShape<S>& shape = out.shape[k];
        const std::array<R, 4> tangent =
            points_on(stretch, std::array<R, 4>{shape.tangent[0], shape.tangent[0] + sixth * shape.bend[0],
                                                shape.tangent[1] - sixth * shape.bend[2], shape.tangent[1]});
        shape.tangent = {tangent[0], tangent[3]};
        R steepest = absolute(tangent[0]);
        for (const R t : tangent) {
            steepest = larger(steepest, absolute(t));
        }
        out.tangent_max[k] = smaller(cell.tangent_max[k], steepest + scale2(shape.error_bound, -2));
        shape.bend = points_on(stretch, shape.bend);
        for (R& b : shape.bend) {
            b = b * share;
        }
        shape.error_bound = shape.error_bound * share;
    }
    // inverse[i] belongs to x^(i+1). With l and omega as above omega = xi + ((l - width) xi + deviation / 4) / width,
    // and 1 at its end.
    std::array<R, 7> deviation{};
    for (std::size_t i = 0; i < 6; ++i) {
        deviation[i + 1] = cell.inverse[i];
    }
    shift(std::span<R>(deviation), shortened<R>(stretch.from));
    const DivisionBy<R> by_width(shortened<R>(width));
    R scale = share;
    R rest{};
    for (std::size_t i = 1; i < 6; ++i) {
        scale = scale * share;
        out.inverse[i] = deviation[i + 1] * scale / by_width;
        rest += out.inverse[i];
    }
    out.inverse[0] = -rest; // exactly: at its end the part is where it ends, and the path has no step
    out.length_mm = cell.length_mm * length;
    out.stop_before = cell.stop_before && stretch.from == S{};
    if (!(stretch.to == one)) {
        out.stop_at_end = false;
        cell.position_at(stretch.to, out.end);
    }
    return out;
}

#define SPLINEFEED_INSTANTIATE(S) template Cell<S> part_of(const Cell<S>&, const CellInterval<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
