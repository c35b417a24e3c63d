// SPDX-License-Identifier: MIT
//
// What a Cell claims, computed again in long double from its own polynomial.
#pragma once

#include "bezier_paths.hpp"
#include "splinefeed/s2_arc_length/arc_length.hpp"

#include <algorithm>

namespace splinefeed_test {

/// Position (from the cell's origin) and derivatives by w, in mm, of the polynomial that the cell carries.
template <Scalar S>
Jet evaluate(const Cell<S>& cell, Real w) {
    Jet jet;
    const Real unit = std::ldexp(1.0L, cell.unit_log2);
    for (const unsigned k : splinefeed::indices(cell.axes)) {
        for (unsigned i = static_cast<unsigned>(cell.degree) + 1; i-- > 0;) {
            jet.d2[k] = jet.d2[k] * w + 2.0L * jet.d1[k];
            jet.d1[k] = jet.d1[k] * w + jet.r[k];
            jet.r[k] = jet.r[k] * w + exact(cell.power[k][i]) * unit;
        }
    }
    return jet;
}

/// dq/ds and d2q/ds2 at w, in 1 and 1/mm.
struct Direction {
    PerAxis<Real> tangent{};
    PerAxis<Real> curvature{};
};

template <Scalar S>
Direction direction_at(const Cell<S>& cell, Real w) {
    const Jet jet = evaluate(cell, w);
    const Real sigma = jet.speed(cell.axes);
    Direction d;
    Real slope = 0.0L;
    for (const unsigned k : splinefeed::indices(cell.axes)) {
        d.tangent[k] = jet.d1[k] / sigma;
        slope += d.tangent[k] * jet.d2[k];
    }
    for (const unsigned k : splinefeed::indices(cell.axes)) {
        d.curvature[k] = (jet.d2[k] - d.tangent[k] * slope) / (sigma * sigma);
    }
    return d;
}

/// w(x) and its derivative, without the rounding of S.
template <Scalar S>
Real inverse_at(const Cell<S>& cell, Real x, Real& slope) {
    Real w = 0.0L;
    slope = 0.0L;
    for (unsigned i = 6; i-- > 0;) {
        slope = slope * x + w;
        w = w * x + exact(cell.inverse[i]);
    }
    slope = 1.0L + (slope * x + w) / 4.0L;
    return x + w * x / 4.0L;
}

/// A piece that is taken as it is, because another halving would only add rounding: at the deepest level a piece is
/// 2^-18 of its segment, 1/4 unit (float: 16 units).
template <Scalar S>
constexpr Real finest_units() {
    return std::same_as<S, float> ? 16.0L : 1.0L / 4.0L;
}

/// What is left of a cusp is passed as its chord, from stop to stop: a line shorter than a few finest pieces.
template <Scalar S>
bool is_chord(const Cell<S>& cell) {
    return cell.degree == 1 && cell.stop_before &&
           exact(cell.length_mm) <= std::max(8.0L * std::ldexp(finest_units<S>(), cell.unit_log2), 1.1e-8L);
}

/// Smallest |dr/dw| over the cell, in units of the segment: what rounding has to be compared with.
template <Scalar S>
Real slowest_units(const Cell<S>& cell) {
    Real slowest = evaluate(cell, 0.0L).speed(cell.axes);
    for (int i = 1; i <= 8; ++i) {
        slowest = std::min(slowest, evaluate(cell, i / 8.0L).speed(cell.axes));
    }
    return std::ldexp(slowest, -cell.unit_log2);
}

/// All cells of a path; stops after `most` (an endless run must fail, not hang). `starvations` counts them.
template <Scalar S>
std::vector<Cell<S>> cells_of(CurveSource<S>& source, const Refinement<S>& refinement, std::size_t most = 1U << 18,
                              int* starvations = nullptr) {
    ArcLength<S> arc_length(source, refinement);
    std::vector<Cell<S>> cells;
    Cell<S> cell;
    int starved = 0;
    while (cells.size() < most) {
        const Pull pull = arc_length.next(cell);
        if (pull == Pull::finished) {
            break;
        }
        if (pull == Pull::starved) {
            ++starved;
            continue;
        }
        cells.push_back(cell);
    }
    if (starvations != nullptr) {
        *starvations = starved;
    }
    return cells;
}

} // namespace splinefeed_test
