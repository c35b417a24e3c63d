// SPDX-License-Identifier: MIT
//
// The largest feasible speed of a whole path, by brute force: from above, every constraint is applied until none bites.
#pragma once

#include "pipeline.hpp"

namespace splinefeed_test {

/// b = v^2 at the nodes 0 ... n of n cells.
template <Scalar S>
std::vector<Real> largest_speeds(const std::vector<PlannedCell<S>>& cells, const MotionLimits<S>& limits) {
    const std::size_t n = cells.size();
    const auto axes = static_cast<unsigned>(limits.axes);
    std::vector<Real> cap(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Cell<S>& cell = cells[i].cell;
        const Real own = exact(cell.feed_mm_s);
        Real speed = exact(limits.feed_mm_s);
        // A programmed feed gives up what the machine's does for rounding, but never more than half.
        const Real usable = std::max(own * exact(limits.usable) - exact(limits.feed_noise_mm_s), own / 2.0L);
        speed = own > 0.0L ? std::min(speed, usable) : speed;
        if (const Real noise = exact(cell.direction_noise); noise > 0.0L) {
            speed = std::min(speed, exact(limits.jump_mm_s) / noise);
        }
        Real bend_sq = 0.0L;
        Real cap_sq = 1e30L;
        for (unsigned k = 0; k < axes; ++k) {
            const Real q1 = exact(cell.tangent_max[k]);
            const Real q2 = exact(cell.curvature_max[k]);
            speed = q1 > 0.0L ? std::min(speed, exact(limits.velocity_mm_s[k]) / q1) : speed;
            cap_sq = q2 > 0.0L ? std::min(cap_sq, exact(limits.acceleration_mm_s2[k]) / q2) : cap_sq;
            bend_sq += q2 * q2;
        }
        for (const Real limit : {exact(limits.centripetal_mm_s2), exact(limits.chord_mm_s2)}) {
            if (limit > 0.0L && bend_sq > 0.0L) {
                cap_sq = std::min(cap_sq, limit / std::sqrt(bend_sq));
            }
        }
        cap[i] = std::max(std::min(cap_sq, speed * speed), 1e-6L);
    }
    std::vector<Real> b(n + 1, 1e30L);
    b[0] = b[n] = 0.0L;
    for (std::size_t i = 0; i < n; ++i) {
        b[i] = std::min(b[i], cap[i]);
        b[i + 1] = cells[i].cell.stop_at_end ? 0.0L : std::min(b[i + 1], cap[i]);
    }
    const auto reach = [&](std::size_t i, Real from) {
        const Real twice = 2.0L * exact(cells[i].cell.length_mm);
        Real best = cap[i];
        for (unsigned k = 0; k < axes; ++k) {
            const Real q1 = exact(cells[i].cell.tangent_max[k]);
            const Real inertia = q1 + twice * exact(cells[i].cell.curvature_max[k]);
            if (inertia > 0.0L) {
                best = std::min(best, (twice * exact(limits.acceleration_mm_s2[k]) + q1 * from) / inertia);
            }
        }
        return best;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < n; ++i) { // in an order of its own: the fixed point does not depend on it
            const std::size_t j = n - 1 - i;
            for (const std::size_t c : {i, j}) {
                const Real up = reach(c, b[c]);
                const Real down = reach(c, b[c + 1]);
                if (up < b[c + 1]) {
                    b[c + 1] = up;
                    changed = true;
                }
                if (down < b[c]) {
                    b[c] = down;
                    changed = true;
                }
            }
        }
    }
    return b;
}

/// How much of its limits a plan uses at dense points, 1 being all. Limits are those of the machine, not the planner's.
/// Less what the rounding of the cell's control points makes of q' and q'': 4 n c / sigma and 8 n^2 c / sigma^2 with c
/// the rounding of a control point. That is nothing but for float.
struct Use {
    Real velocity = 0.0L;
    Real acceleration = 0.0L;
    Real feed = 0.0L;
    Real centripetal = 0.0L;
    Real chord = 0.0L;
};

template <Scalar S>
Use use_of(const std::vector<PlannedCell<S>>& cells, const MachineSettings& machine) {
    Use use;
    const Real period = real(machine.sample_period_us * 1e-6);
    const auto axes = static_cast<unsigned>(machine.axes);
    for (const PlannedCell<S>& planned : cells) {
        if (is_chord(planned.cell)) {
            continue; // a cusp: its derivatives are not those of the curve
        }
        const Real b0 = exact(planned.entry_sq);
        const Real b1 = exact(planned.exit_sq);
        const Real a = (b1 - b0) / (2.0L * exact(planned.cell.length_mm));
        Real feed = real(machine.max_feed_mm_s);
        if (const Real own = exact(planned.cell.feed_mm_s); own > 0.0L) {
            feed = std::min(feed, own);
        }
        const Real sigma = slowest_units(planned.cell);
        const auto n = static_cast<Real>(planned.cell.degree);
        const Real tangent_noise = 4.0L * n * control_rounding<S>() / sigma;
        const Real bend_noise =
            8.0L * n * n * control_rounding<S>() / (sigma * std::ldexp(sigma, planned.cell.unit_log2));
        for (int i = 0; i <= 12; ++i) {
            const Real x = i / 12.0L;
            const Real b = b0 + (b1 - b0) * x;
            Real unused = 0.0L;
            const Direction d = direction_at(planned.cell, inverse_at(planned.cell, x, unused));
            Real bend_sq = 0.0L;
            for (unsigned k = 0; k < axes; ++k) {
                const AxisSettings& axis = machine.axis[k];
                use.velocity = std::max(use.velocity, (std::fabs(d.tangent[k]) - tangent_noise) * std::sqrt(b) /
                                                          real(axis.max_velocity_mm_s));
                const Real noise = tangent_noise * std::fabs(a) + bend_noise * b;
                use.acceleration =
                    std::max(use.acceleration, (std::fabs(d.tangent[k] * a + d.curvature[k] * b) - noise) /
                                                   real(axis.max_acceleration_mm_s2));
                bend_sq += d.curvature[k] * d.curvature[k];
            }
            const Real bend = std::sqrt(bend_sq);
            use.feed = std::max(use.feed, std::sqrt(b) / feed);
            if (machine.centripetal_mm_s2 > 0.0) {
                use.centripetal = std::max(use.centripetal, (bend - bend_noise) * b / real(machine.centripetal_mm_s2));
            }
            if (machine.chord_error_mm > 0.0) {
                use.chord = std::max(use.chord,
                                     (bend - bend_noise) * b * period * period / 8.0L / real(machine.chord_error_mm));
            }
        }
    }
    return use;
}

} // namespace splinefeed_test
