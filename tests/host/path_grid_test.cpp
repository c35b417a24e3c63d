// SPDX-License-Identifier: MIT
//
// The intervals against the curve in long double: lengths, travels, and what caps the speed at the nodes.
#include "host_sim/analysis/path_grid.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;
using splinefeed::host::PathGrid;
using splinefeed::host::PathInterval;

namespace {

std::vector<PathInterval> grid_of(const BezierPath& path, const MachineSettings& machine, double jump = 1e-6) {
    PathGrid grid(machine, jump);
    std::vector<PathInterval> intervals;
    for (const CurveSegment<double>& segment : segments_of<double>(path)) {
        grid.append(segment, intervals);
    }
    return intervals;
}

// Whether some acceleration along the path keeps every axis within its limit at b: the best of many.
bool room(const MachineSettings& machine, const PerAxis<Real>& q1, const PerAxis<Real>& q2, Real b) {
    Real low = -1e12L;
    Real high = 1e12L;
    for (const unsigned k : splinefeed::indices(machine.axes)) {
        const Real limit = real(machine.axis[k].max_acceleration_mm_s2);
        const Real sign = q1[k] < 0.0L ? -1.0L : 1.0L;
        if (std::fabs(q1[k]) < 1e-15L) {
            if (std::fabs(q2[k]) * b > limit) {
                return false;
            }
            continue;
        }
        low = std::max(low, (-limit - sign * q2[k] * b) / std::fabs(q1[k]));
        high = std::min(high, (limit - sign * q2[k] * b) / std::fabs(q1[k]));
    }
    return low <= high;
}

} // namespace

TEST_CASE("lengths and travels of the intervals add up to the curve's") {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const int axes = random.integer(1, 4);
        const BezierPath path{random_shape(random, axes, random.integer(1, 9), random.decades(0.01, 100.0))};
        const auto intervals = grid_of(path, machine_of(axes, 100.0, 1000.0, 100.0));
        const auto segment = segments_of<double>(path).front();
        const Real length =
            quadrature().adaptive([&](Real u) { return evaluate(segment, u).speed(axes); }, 0.0L, 1.0L, 1e-12L);
        double sum = 0.0;
        PerAxis<double> travel{};
        for (const PathInterval& interval : intervals) {
            sum += interval.length_mm;
            for (const unsigned k : splinefeed::indices(axes)) {
                travel[k] += interval.travel_mm[k];
            }
        }
        CHECK(sum == Approx(static_cast<double>(length)).epsilon(1e-5));
        for (const unsigned k : splinefeed::indices(axes)) {
            const Real to_and_fro = quadrature().adaptive([&](Real u) { return std::fabs(evaluate(segment, u).d1[k]); },
                                                          0.0L, 1.0L, 1e-10L);
            CHECK(travel[k] == Approx(static_cast<double>(to_and_fro)).epsilon(1e-3));
        }
    }
}

TEST_CASE("the cap of a node is the largest speed that leaves room for the axes") {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        CAPTURE(seed);
        Random random(seed);
        const int axes = random.integer(2, 6);
        const MachineSettings machine = random_machine(random, axes);
        const BezierPath path{random_shape(random, axes, 3, random.decades(0.1, 20.0))};
        const double cap = grid_of(path, machine).front().entry_cap_sq;
        const Jet jet = evaluate(segments_of<double>(path).front(), 0.0L);
        const Real sigma = jet.speed(axes);
        Real along = 0.0L;
        for (const unsigned k : splinefeed::indices(axes)) {
            along += jet.d1[k] * jet.d2[k] / (sigma * sigma);
        }
        PerAxis<Real> q1{};
        PerAxis<Real> q2{};
        Real curvature = 0.0L;
        for (const unsigned k : splinefeed::indices(axes)) {
            q1[k] = jet.d1[k] / sigma;
            q2[k] = (jet.d2[k] - jet.d1[k] * along) / (sigma * sigma);
            curvature += q2[k] * q2[k];
        }
        curvature = std::sqrt(curvature);
        const auto allowed = [&](Real b) {
            bool ok = room(machine, q1, q2, b) && b <= real(machine.max_feed_mm_s) * real(machine.max_feed_mm_s);
            for (const unsigned k : splinefeed::indices(axes)) {
                ok = ok && std::fabs(q1[k]) * std::sqrt(b) <= real(machine.axis[k].max_velocity_mm_s);
            }
            const Real period = real(machine.sample_period_us) * 1e-6L;
            ok = ok && (machine.centripetal_mm_s2 == 0.0 || curvature * b <= real(machine.centripetal_mm_s2));
            return ok && (machine.chord_error_mm == 0.0 ||
                          curvature * b * period * period <= 8.0L * real(machine.chord_error_mm));
        };
        CHECK(allowed(real(cap) * (1.0L - 1e-9L)));
        CHECK_FALSE(allowed(real(cap) * (1.0L + 1e-9L)));
    }
}

TEST_CASE("intervals are short where it bends, and a straight line is one") {
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    CHECK(grid_of({line_shape(2, 1, {300.0, 100.0})}, machine).size() == 1);
    CHECK(grid_of({cubic_shape(0.1, 0.0, 0.2, 0.0001, 0.3, 0.0003)}, machine).size() == 4);
    CHECK(grid_of({cubic_shape(3.0, 0.0, 6.0, 0.0, 9.0, 0.1)}, machine).size() == 16);
    CHECK(grid_of({cubic_shape(0.1, 0.0, 0.2, 0.1, 0.2, 0.2)}, machine).size() >= 32);  // a quarter turn
    CHECK(grid_of({cubic_shape(1.0, 1.0, 0.0, 1.0, 1.0, 0.0)}, machine).size() < 1000); // a cusp
}

TEST_CASE("a point of a curve without extent does no harm") {
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    for (const PathInterval& interval : grid_of({cubic_shape(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)}, machine)) {
        CHECK(interval.length_mm == 0.0);
        CHECK(interval.middle_cap_sq > 0.0);
    }
}
