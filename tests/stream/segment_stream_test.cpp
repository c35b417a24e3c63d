// SPDX-License-Identifier: MIT
//
// Feed segments as a drive sees them: exact chains, every limit at every instant, targets to the last unit.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

/// Everything that holds for every stream.
void require_stream(const Stream& stream, const MachineSettings& machine, const Program& program) {
    require_limits(stream, machine);
    require_ends(stream, machine, program);
}

} // namespace

TEMPLATE_TEST_CASE("the programs of the machine run within every limit", "[stream]", double, float, Fixed) {
    const MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0);
    for (const Program& program : {loop_program(), circle_program(72), circle_program(720), raster_program(),
                                   star_program(true), star_program(false)}) {
        const Stream stream = stream_of<TestType>(program, machine);
        require_stream(stream, machine, program);
    }
}

TEMPLATE_TEST_CASE("sample periods from 50 us to 100 ms", "[stream]", double, float, Fixed) {
    const Program program = star_program(false);
    for (const int period : {50, 125, 333, 1000, 4000, 20000, 100000}) {
        MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0, period);
        if (!MotionLimits<TestType>::make(machine).has_value()) {
            CHECK(period == 50); // rounding of float needs more time
            continue;
        }
        CAPTURE(period);
        require_stream(stream_of<TestType>(program, machine), machine, program);
    }
}

TEMPLATE_TEST_CASE("steps per mm from 0.001 to a million", "[stream]", double, float, Fixed) {
    const Program program = raster_program(2);
    for (const double steps : {0.001, 0.7, 1.0, 3.14159, 80.0, 200.0 / 3.0, 1600.0, 12345.678, 1e6}) {
        // A thousandth of a step per mm resolves nothing within a millisecond
        const MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0, steps < 0.5 ? 20000 : 1000, steps);
        CAPTURE(steps);
        require_stream(stream_of<TestType>(program, machine), machine, program);
    }
}

TEMPLATE_TEST_CASE("a target on a count is reached in whole counts", "[stream]", double, float, Fixed) {
    Random random(61);
    for (int run = 0; run < rounds(24); ++run) {
        MachineSettings machine = machine_of(2, 100.0, 5000.0, 100.0);
        machine.axis[0].steps_per_mm = random.integer(20, 1000);
        machine.axis[1].steps_per_mm = random.integer(2, 8) * 12.5;
        Program program;
        program.axes = 2;
        program.polyline = run % 2 == 0;
        std::vector<std::array<std::int64_t, 2>> counts;
        for (int i = 0; i < 5; ++i) {
            Point point;
            std::array<std::int64_t, 2> c{};
            for (unsigned k = 0; k < 2; ++k) {
                c[k] = random.integer(-4000, 4000);
                point.mm[k] = static_cast<double>(c[k]) / machine.axis[k].steps_per_mm;
            }
            counts.push_back(c);
            point.corner = Corner::forced;
            program.points.push_back(point);
        }
        const Stream stream = stream_of<TestType>(program, machine);
        require_stream(stream, machine, program);
        // Every waypoint is a stop here, passed at one joint of two segments
        std::size_t next = 0;
        for (const FeedSegment& s : stream.segments) {
            bool at = next < counts.size();
            for (unsigned k = 0; at && k < 2; ++k) {
                at = s.start[k] == counts[next][k] * units_per_count && s.start_velocity[k] == 0 &&
                     motion_of(s, k).a0 == 0;
            }
            next += at ? 1U : 0U;
        }
        CAPTURE(run);
        CHECK(next == counts.size() - 1); // the last is the end of the last segment
        for (unsigned k = 0; k < 2; ++k) {
            CHECK(stream.segments.back().end[k] == counts.back()[k] * units_per_count);
        }
    }
}

TEMPLATE_TEST_CASE("totals are the targets in rounded counts", "[stream]", double, float, Fixed) {
    Random random(62);
    for (int run = 0; run < rounds(24); ++run) {
        MachineSettings machine = machine_of(3, 100.0, 5000.0, 100.0);
        for (AxisSettings& axis : machine.axis) {
            axis.steps_per_mm = random.decades(0.5, 5000.0);
        }
        BezierPath path = random_path(random, 3, 3, 5.0, 0.5, 0.0);
        PerAxis<double> start{};
        PerAxis<double> end{};
        for (unsigned k = 0; k < 3; ++k) {
            start[k] = end[k] = random.between(-1000.0, 1000.0);
            for (const TestShape& shape : path) {
                end[k] += shape.offset[k][static_cast<unsigned>(shape.degree)];
            }
        }
        const Stream stream = stream_of<TestType>(path, machine, 1024, start);
        REQUIRE_FALSE(stream.segments.empty());
        for (unsigned k = 0; k < 3; ++k) {
            // Positions are rounded to 2^-41 mm where they enter: three of them here
            const Real exact_counts = static_cast<Real>(end[k]) * static_cast<Real>(machine.axis[k].steps_per_mm);
            const Real got = static_cast<Real>(stream.segments.back().end[k]) / static_cast<Real>(units_per_count);
            CHECK(std::fabs(got - exact_counts) <
                  4.0L * 0x1p-41L * real(machine.axis[k].steps_per_mm) + std::fabs(exact_counts) * 0x1p-31L + 0x1p-29L);
        }
    }
}

TEMPLATE_TEST_CASE("random interleavings of pushing and pulling give the same bits", "[stream]", double, float, Fixed) {
    const MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0);
    for (const Program& program : {loop_program(), star_program(true), star_program(false)}) {
        for (const std::size_t window : {16U, 256U}) {
            const Stream reference = stream_of<TestType>(program, machine, window);
            for (std::uint64_t seed = 1; seed <= 4; ++seed) {
                Random interleaving(seed);
                const Stream stream = stream_of<TestType>(program, machine, window, &interleaving);
                REQUIRE(stream.segments.size() == reference.segments.size());
                for (std::size_t i = 0; i < stream.segments.size(); ++i) {
                    const FeedSegment& a = stream.segments[i];
                    const FeedSegment& b = reference.segments[i];
                    REQUIRE((a.index == b.index && a.duration_ticks == b.duration_ticks && a.waypoint == b.waypoint &&
                             a.start == b.start && a.end == b.end && a.start_velocity == b.start_velocity &&
                             a.end_velocity == b.end_velocity));
                }
            }
        }
    }
}

TEST_CASE("Fixed and double differ by less than a tenth of a micrometre", "[stream]") {
    const MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0);
    for (const Program& program :
         {loop_program(), circle_program(720), raster_program(), star_program(true), star_program(false)}) {
        const Stream a = stream_of<double>(program, machine, 4096);
        const Stream b = stream_of<Fixed>(program, machine, 4096);
        REQUIRE(a.segments.size() == b.segments.size());
        std::int64_t worst = 0;
        for (std::size_t i = 0; i < a.segments.size(); ++i) {
            REQUIRE(a.segments[i].waypoint == b.segments[i].waypoint);
            for (unsigned k = 0; k < 3; ++k) {
                worst = std::max(worst, std::abs(a.segments[i].end[k] - b.segments[i].end[k]));
            }
        }
        CHECK(static_cast<Real>(worst) / units_per_mm(machine.axis[0]) < 1e-4L);
    }
}

TEMPLATE_TEST_CASE("a stop dwells one to two segments, not more", "[stream]", double, Fixed) {
    // Control points repeat three times. The motion arrives on a sample or up to 0.414 of a segment before the next
    // one, and leaves as much earlier.
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    for (const double length : {0.5, 1.0, 3.7, 20.0}) {
        const BezierPath path{line_shape(1, 3, {length}), line_shape(1, 3, {-length})};
        const Stream stream = stream_of<TestType>(path, machine);
        const auto planned = plan_of<TestType>(path, machine, 1024);
        const double least = planned.seconds() * 1e3;
        const auto count = static_cast<double>(stream.segments.size());
        // Two moves, each followed by two segments
        CHECK(count >= least + 4.0 - 4.0 * 0.414);
        CHECK(count <= least + 4.0 + 2.0 * (1.0 - 2.0 * 0.414) + 0.01);
        int stopped = 0;
        const std::int64_t target = target_units(length, machine.axis[0]);
        for (const FeedSegment& s : stream.segments) {
            stopped += s.end[0] == target && s.end_velocity[0] == 0 ? 1 : 0;
        }
        CHECK(stopped == 1);
    }
}

TEMPLATE_TEST_CASE("arriving on a joint is not decided by rounding", "[stream]", double, Fixed) {
    // A move that takes a whole number of segments, found by bisection, and its neighbours a billionth longer or
    // shorter: a thousandth of a segment early counts as arrival.
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    for (const int segments : {50, 137, 280}) {
        double low = 0.5;
        double high = 60.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            const auto planned = plan_of<TestType>({line_shape(1, 3, {middle})}, machine, 1024);
            (planned.seconds() * 1e3 < segments ? low : high) = middle;
        }
        const auto planned = plan_of<TestType>({line_shape(1, 3, {high})}, machine, 1024);
        REQUIRE(planned.seconds() * 1e3 == Approx(segments).epsilon(1e-7));
        const std::size_t expected = static_cast<std::size_t>(segments) + 2;
        for (const double factor : {1.0 - 1e-8, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.0 + 1e-8, 1.0 + 1e-7}) {
            const Stream stream = stream_of<TestType>(BezierPath{line_shape(1, 3, {high * factor})}, machine);
            CAPTURE(segments, high, factor);
            CHECK(stream.segments.size() == expected);
        }
    }
}
