// SPDX-License-Identifier: MIT
//
// The fastest plan of a whole path by its definition: which speeds can still stop, found by bisection; then the largest
// of them, node by node.
#pragma once

#include "catch.hpp"
#include "pipeline.hpp"

namespace splinefeed_test {

/// A cell of any shape: straight axes, axes that turn round, and one without inertia now and then.
template <Scalar S>
Cell<S> random_cell(Random& random, const MotionLimits<S>& limits) {
    Cell<S> cell;
    cell.axes = limits.axes;
    cell.length_mm = from_double<S>(random.decades(1e-3, 1.0));
    using R = Ratio<S>;
    for (const unsigned k : splinefeed::indices(limits.axes)) {
        const double bend = random.integer(0, 3) == 0 ? 0.0 : random.decades(1e-4, 0.4);
        const double tangent = random.integer(0, 5) == 0 ? 0.0 : random.between(-1.0, 1.0);
        AxisShape<S>& shape = cell.shape[k];
        for (unsigned j = 0; j < 3; ++j) {
            shape.bend[j] = from_double<R>(bend * random.between(-1.0, 1.0));
        }
        shape.tangent = {from_double<R>(tangent), from_double<R>(tangent + bend * random.between(-0.5, 0.5))};
        shape.error_bound = from_double<R>(random.decades(1e-8, 1e-5));
    }
    return cell;
}

/// One of the half-planes that a cell allows: entry * entry_sq + exit * exit_sq <= limit.
struct HalfPlane {
    Real entry = 0.0L;
    Real exit = 0.0L;
    Real limit = 0.0L;
};

/// What an axis is told by in a part of its cell: Bezier points of q', a cubic, and of 2 L q'', a parabola, where L is
/// the length of the part, by Taylor's polynomials at its ends.
struct PartShape {
    std::array<Real, 4> tangent{};
    std::array<Real, 3> bend{};
};

template <Scalar S>
PartShape part_of(const AxisShape<S>& shape, Real from, Real to) {
    const std::array<Real, 3> b{exact(shape.bend[0]), exact(shape.bend[1]), exact(shape.bend[2])};
    const std::array<Real, 4> t{exact(shape.tangent[0]), exact(shape.tangent[0]) + b[0] / 6.0L,
                                exact(shape.tangent[1]) - b[2] / 6.0L, exact(shape.tangent[1])};
    const Real b1 = 2.0L * (b[1] - b[0]);
    const Real b2 = b[0] - 2.0L * b[1] + b[2];
    const Real t1 = 3.0L * (t[1] - t[0]);
    const Real t2 = 3.0L * (t[0] - 2.0L * t[1] + t[2]);
    const Real t3 = t[3] - 3.0L * t[2] + 3.0L * t[1] - t[0];
    const auto bend = [&](Real x) {
        return b[0] + x * (b1 + x * b2);
    };
    const auto tangent = [&](Real x) {
        return t[0] + x * (t1 + x * (t2 + x * t3));
    };
    const auto slope = [&](Real x) {
        return t1 + x * (2.0L * t2 + x * 3.0L * t3);
    };
    const Real length = to - from;
    return {{tangent(from), tangent(from) + slope(from) * length / 3.0L, tangent(to) - slope(to) * length / 3.0L,
             tangent(to)},
            {bend(from) * length, (bend(from) + length / 2.0L * (b1 + 2.0L * b2 * from)) * length, bend(to) * length}};
}

/// Those of a part of the cell, from one fraction of its length to another; eight an axis.
template <Scalar S>
std::vector<HalfPlane> half_planes_of(const Cell<S>& cell, const MotionLimits<S>& limits, Real from = 0.0L,
                                      Real to = 1.0L) {
    std::vector<HalfPlane> planes;
    for (const unsigned k : splinefeed::indices(limits.axes)) {
        const AxisShape<S>& shape = cell.shape[k];
        const Real speeding = exact(limits.acceleration_mm_s2[k]);
        const Real braking = exact(limits.braking_mm_s2[k]);
        const int way =
            cell.heading[k] == 1 || cell.heading[k] == -1 ? cell.heading[k] : 0; // proved on what is emitted
        const auto [t, c] = part_of(shape, from, to);
        // Of 2 L q'' b, as a cubic
        const std::array<Real, 4> entry{c[0], 2.0L * c[1] / 3.0L, c[2] / 3.0L, 0.0L};
        const std::array<Real, 4> exit{0.0L, c[0] / 3.0L, 2.0L * c[1] / 3.0L, c[2]};
        for (unsigned j = 0; j < 4; ++j) {
            for (const Real sign : {1.0L, -1.0L}) {
                const Real spread = exact(shape.error_bound) * (to - from);
                const Real most = static_cast<Real>(way) * sign > 0.0L   ? speeding
                                  : static_cast<Real>(way) * sign < 0.0L ? braking
                                                                         : std::min(speeding, braking);
                const Real limit = 2.0L * exact(cell.length_mm) * (to - from) * most;
                planes.push_back({spread + sign * (entry[j] - t[j]), spread + sign * (exit[j] + t[j]), limit});
            }
        }
    }
    return planes;
}

/// The exits that a cell allows for an entry: from low to high. Nothing if low > high.
struct Exits {
    Real low = 0.0L;
    Real high = 0.0L;
};

inline Exits exits_of(const std::vector<HalfPlane>& planes, Real entry_sq, Real at_most) {
    Exits exits{0.0L, at_most};
    for (const HalfPlane& plane : planes) {
        const Real left = plane.limit - plane.entry * entry_sq;
        if (plane.exit > 0.0L) {
            exits.high = std::min(exits.high, left / plane.exit);
        } else if (plane.exit < 0.0L) {
            exits.low = std::max(exits.low, left / plane.exit);
        } else if (left < 0.0L) {
            exits.high = -1.0L;
        }
    }
    return exits;
}

/// The largest entry up to cap that leaves an exit up to at_most, by bisection.
inline Real entry_for(const std::vector<HalfPlane>& planes, Real at_most, Real cap) {
    const auto allowed = [&](Real entry) {
        const Exits exits = exits_of(planes, entry, at_most);
        return exits.low <= exits.high;
    };
    Real low = 0.0L;
    Real high = cap;
    if (allowed(high)) {
        return high;
    }
    for (int step = 0; step < 100; ++step) {
        const Real middle = (low + high) / 2.0L;
        (allowed(middle) ? low : high) = middle;
    }
    return low;
}

/// Up to where a plan enters a cell: from its peak on, while a steep half-plane bounds the exits more than the others
/// do, to where the two meet (acceleration_bound.cpp).
inline Real fastest_entry(const std::vector<HalfPlane>& planes, Real entry_cap, Real exit_cap) {
    const auto bound_at = [&](Real entry, bool steep) {
        HalfPlane nearest{0.0L, 1.0L, exit_cap};
        for (const HalfPlane& plane : planes) {
            const bool is_steep = plane.exit < plane.entry / 8.0L;
            if (plane.exit > 0.0L && is_steep == steep &&
                (plane.limit - plane.entry * entry) / plane.exit <
                    (nearest.limit - nearest.entry * entry) / nearest.exit) {
                nearest = plane;
            }
        }
        return nearest;
    };
    Real entry = entry_for(planes, exit_cap, entry_cap);
    for (int step = 0; step < 100; ++step) {
        const HalfPlane steep = bound_at(entry, true);
        const HalfPlane other = bound_at(entry, false);
        const Real meet = (steep.limit / steep.exit - other.limit / other.exit) /
                          (steep.entry / steep.exit - other.entry / other.exit);
        if (!(steep.entry > 0.0L && meet < entry)) {
            break;
        }
        entry = std::max(meet, 0.0L);
    }
    return entry;
}

/// v^2 at both ends of a cell up to which an axis keeps its velocity: V^2 / U^2 lies above its tangent in the middle of
/// the cell, with |q'| <= U.
template <Scalar S>
std::array<Real, 2> velocity_line(const Cell<S>& cell, unsigned axis, Real velocity) {
    const AxisShape<S>& shape = cell.shape[axis];
    const Real first = std::fabs(exact(shape.tangent[0]));
    const Real last = std::fabs(exact(shape.tangent[1]));
    const Real above =
        std::max(std::fabs(exact(shape.tangent[0]) + exact(shape.bend[0]) / 6.0L) - (2.0L * first + last) / 3.0L,
                 std::fabs(exact(shape.tangent[1]) - exact(shape.bend[2]) / 6.0L) - (first + 2.0L * last) / 3.0L);
    const Real middle = (first + last) / 2.0L + 0.75L * std::max(above, 0.0L) + exact(shape.error_bound) / 4.0L;
    const Real largest = exact(cell.tangent_max[axis]);
    const bool bounded = middle >= largest || std::fabs(last - first) >= middle / 2.0L;
    const Real speed_sq = std::pow(velocity / (bounded ? largest : middle), 2.0L);
    const Real change = bounded ? 0.0L : (last - first) / middle * speed_sq;
    return {speed_sq + change, speed_sq - change};
}

/// The part of the path's speed that the feed counts at most, from the Bezier points of q'.
template <Scalar S>
Real share_of(const Cell<S>& cell, const MotionLimits<S>& limits) {
    if (!limits.mixed) {
        return 1.0L;
    }
    std::array<Real, 2> largest{};
    for (unsigned j = 0; j < 4; ++j) {
        std::array<Real, 2> sum{};
        for (const unsigned k : splinefeed::indices(limits.axes)) {
            const AxisShape<S>& shape = cell.shape[k];
            const Real inner = j == 1 ? exact(shape.bend[0]) : j == 2 ? -exact(shape.bend[2]) : 0.0L;
            const Real q1 = exact(shape.tangent[j / 2]) + inner / 6.0L;
            sum[limits.rotary[k] ? 1 : 0] += q1 * q1;
        }
        largest = {std::max(largest[0], std::sqrt(sum[0])), std::max(largest[1], std::sqrt(sum[1]))};
    }
    return std::min(1.0L, largest[0] > 0x1p-17L ? largest[0] : largest[1]);
}

/// The largest b = v^2 at the nodes 0 ... n of n cells from which the path can still be travelled to its end.
template <Scalar S>
std::vector<Real> reachable_speeds(const std::vector<PlannedCell<S>>& cells, const MotionLimits<S>& limits) {
    const std::size_t n = cells.size();
    const auto axes = static_cast<unsigned>(limits.axes);
    std::vector<std::array<Real, 2>> cap(n);
    std::vector<std::array<Real, 2>> machine_cap(n); // whatever is programmed
    for (std::size_t i = 0; i < n; ++i) {
        const Cell<S>& cell = cells[i].cell;
        // A programmed feed gives up what the machine's does for rounding, but never more than half.
        const auto up_to = [&](Real feed, Real own) {
            const Real usable = std::max(own * exact(limits.usable) - exact(limits.feed_noise_mm_s), own / 2.0L);
            return own > 0.0L ? std::min(feed, usable) : feed;
        };
        const auto along_path = [&](Real feed) {
            return std::min({feed / share_of(cell, limits), exact(limits.path_mm_s), exact(cell.steady_mm_s)});
        };
        const Real feed = up_to(exact(limits.feed_mm_s), exact(cell.max_feed_mm_s));
        const Real fastest = along_path(feed); // whatever is programmed
        const Real speed = along_path(up_to(feed, exact(cell.feed_mm_s)));
        Real bend_sq = 0.0L;
        Real cap_sq = 1e30L;
        for (unsigned k = 0; k < axes; ++k) {
            const Real q2 = exact(cell.curvature_max[k]);
            if (2.0L * exact(cell.length_mm) * q2 > real(Cell<S>::sharp_turn)) {
                cap_sq =
                    std::min(cap_sq, std::min(exact(limits.acceleration_mm_s2[k]), exact(limits.braking_mm_s2[k])) /
                                         (2.0L * q2));
            }
            bend_sq += q2 * q2;
        }
        for (const Real limit : {exact(limits.centripetal_mm_s2), exact(limits.chord_mm_s2)}) {
            if (limit > 0.0L && bend_sq > 0.0L) {
                cap_sq = std::min(cap_sq, limit / std::sqrt(bend_sq));
            }
        }
        std::array<Real, 2> most{std::min(cap_sq, fastest * fastest), std::min(cap_sq, fastest * fastest)};
        for (unsigned k = 0; k < axes; ++k) {
            if (fastest * exact(cell.tangent_max[k]) > exact(limits.velocity_mm_s[k])) {
                const auto line = velocity_line(cell, k, exact(limits.velocity_mm_s[k]));
                most = {std::min(most[0], line[0]), std::min(most[1], line[1])};
            }
        }
        for (unsigned e = 0; e < 2; ++e) {
            machine_cap[i][e] = std::max(most[e], 1e-6L);
            cap[i][e] = std::max(std::min(most[e], speed * speed), 1e-6L);
        }
    }
    std::vector<Real> largest(n + 1, 0.0L);
    for (std::size_t i = n; i-- > 1;) {
        const Cell<S>& cell = cells[i].cell;
        const Real beyond = largest[i + 1];
        Real high = cells[i - 1].cell.stop_at_end ? 0.0L : std::min(cap[i - 1][1], cap[i][0]);
        const auto planes = half_planes_of(cell, limits);
        high = std::min(high, fastest_entry(planes, machine_cap[i][0], machine_cap[i][1]));
        high = std::min(high, entry_for(planes, beyond, high));
        largest[i] = high;
    }
    return largest;
}

/// Roundings on the way from a stop to a node add up, of numbers as large as the speed there. Half-planes that are
/// nearly parallel magnify them, cell after cell where an axis has next to no inertia.
template <class S>
Real tolerance(std::size_t cells, Real b) {
    const Real rounded =
        256.0L * static_cast<Real>(cells) * ratio_rounding<S>() * (b + (std::same_as<S, Fixed> ? 1.0L : 0.0L));
    return std::max(rounded, 1e-7L * b);
}

/// Every cell ends as fast as its entry allows and what follows can be travelled from. From the plan's own entry: where
/// axes have next to no inertia, what two entries differ by grows from cell to cell.
template <Scalar S>
void require_largest_exits(const std::vector<PlannedCell<S>>& cells, const MotionLimits<S>& limits,
                           Real coarser = 1.0L) {
    const std::vector<Real> reachable = reachable_speeds(cells, limits);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Real b = exact(cells[i].exit_sq);
        const auto planes = half_planes_of(cells[i].cell, limits);
        const Real best = std::max(0.0L, exits_of(planes, exact(cells[i].entry_sq), reachable[i + 1]).high);
        CAPTURE(scalar_name<S>(), i, static_cast<double>(b), static_cast<double>(best));
        REQUIRE(std::fabs(b - best) <= coarser * tolerance<S>(cells.size(), best));
    }
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
        for (const Real own : {exact(planned.cell.feed_mm_s), exact(planned.cell.max_feed_mm_s)}) {
            feed = own > 0.0L ? std::min(feed, own) : feed;
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
            std::array<Real, 2> square{}; // of dq/ds, on linear and on rotary axes
            for (unsigned k = 0; k < axes; ++k) {
                square[machine.axis[k].rotary ? 1 : 0] += d.tangent[k] * d.tangent[k];
                const AxisSettings& axis = machine.axis[k];
                use.velocity = std::max(use.velocity, (std::fabs(d.tangent[k]) - tangent_noise) * std::sqrt(b) /
                                                          real(axis.max_velocity_mm_s));
                const Real noise = tangent_noise * std::fabs(a) + bend_noise * b;
                const Real f = d.tangent[k] * a + d.curvature[k] * b;
                const double limit = f * d.tangent[k] < 0.0L ? axis.braking_mm_s2() : axis.max_acceleration_mm_s2;
                use.acceleration = std::max(use.acceleration, (std::fabs(f) - noise) / real(limit));
                bend_sq += d.curvature[k] * d.curvature[k];
            }
            const Real bend = std::sqrt(bend_sq);
            const Real counted = square[0] > 1e-9L ? square[0] : square[1];
            use.feed = std::max(use.feed, std::sqrt(b * (square[1] > 0.0L ? counted : 1.0L)) / feed);
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

/// The planner keeps 6e-6 of every limit (float: 1e-3) for rounding, so that nothing here may exceed 1; only the chord
/// error may be off by what the bound of the curvature is: 1e-3.
template <class S>
Use require_feasible(const std::vector<PlannedCell<S>>& cells, const MachineSettings& machine) {
    const Use use = use_of(cells, machine);
    CAPTURE(scalar_name<S>());
    CHECK(use.velocity <= 1.0L);
    CHECK(use.feed <= 1.0L);
    CHECK(use.acceleration <= 1.0L);
    CHECK(use.centripetal <= 1.0L);
    CHECK(use.chord <= 1.0L + 1e-3L);
    return use;
}

/// Plans of random paths for random machines that `change` altered, with a window that holds all and with one of 16
/// cells: every limit holds at dense points, and in the first no node can be faster. Returns the most that was used.
template <Scalar S, class Change>
Use require_best_plans(std::uint64_t seed, int runs, Change&& change, Real coarser = 1.0L) {
    Random random(seed);
    Use most;
    for (int run = 0; run < runs; ++run) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = changed_machine<S>(random, axes, change);
        const BezierPath path = random_path(random, axes, 15, random.decades(1.0, 30.0), 0.15, 0.3);
        CAPTURE(seed, run);
        const auto whole = plan_of<S>(path, machine, 8192);
        REQUIRE(whole.limited == 0);
        require_largest_exits(whole.cells, MotionLimits<S>::make(machine).value(), coarser);
        for (const auto& cells : {whole.cells, plan_of<S>(path, machine, 16).cells}) {
            const Use use = require_feasible(cells, machine);
            most.feed = std::max(most.feed, use.feed);
            most.acceleration = std::max(most.acceleration, use.acceleration);
        }
    }
    return most;
}

} // namespace splinefeed_test
