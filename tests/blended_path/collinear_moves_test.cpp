// SPDX-License-Identifier: MIT
//
// Points between the ends of a line cost nothing: the path is that of the line without them.
#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include "support/moves_deviation.hpp"
#include "support/programmed_moves.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 20261129;

/// A zigzag of lines, each in so many parts; the places of all parts are exact.
MoveProgram zigzag(int lines, int parts, PathMode mode, double tolerance_mm, double chain_tolerance_mm = 100.0) {
    MoveProgram program;
    PlaceMm at = program.start;
    for (int i = 0; i < lines; ++i) {
        const PlaceMm way{8.0L, i % 2 == 0 ? 4.0L : -6.0L, 1.0L};
        for (int part = 1; part <= parts; ++part) {
            PlaceMm to{};
            for (unsigned k = 0; k < 3; ++k) {
                to[k] = at[k] + way[k] * static_cast<Real>(part) / static_cast<Real>(parts);
            }
            ProgrammedMove& move = program.line(to);
            move.mode = mode;
            move.tolerance_mm = tolerance_mm;
            move.chain_tolerance_mm = chain_tolerance_mm;
        }
        at = program.moves.back().to;
    }
    return program;
}

/// The segments but for those of lines that go on in the next one.
template <Scalar S>
std::vector<CurveSegment<S>> without_parts(const std::vector<CurveSegment<S>>& segments) {
    std::vector<CurveSegment<S>> found;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (segments[i].degree > 1 || i + 1 == segments.size() || segments[i + 1].degree > 1 ||
            segments[i].stop_at_end) {
            found.push_back(segments[i]);
        }
    }
    return found;
}

/// That each move which ends on a line has a segment that ends there.
template <Scalar S>
void require_ends(const MoveProgram& program, const BlendedRun<S>& run, Real within_mm) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < run.segments.size(); ++i) {
        const CurveSegment<S>& segment = run.segments[i];
        CAPTURE(i, segment.waypoint);
        REQUIRE(segment.waypoint >= next);
        if (segment.degree == 1 && (i + 1 == run.segments.size() || run.segments[i + 1].degree == 1)) {
            REQUIRE(apart(place_of(segment, 1.0L), program.moves[segment.waypoint].to, 3) <= within_mm);
        }
        if (i > 0 && i + 1 < run.segments.size() && run.segments[i - 1].degree == 1 && segment.degree == 1 &&
            run.segments[i + 1].degree == 1) {
            REQUIRE(segment.waypoint == next);
        }
        next = segment.waypoint + (i + 1 == run.segments.size() || run.segments[i + 1].waypoint > segment.waypoint);
    }
}

template <Scalar S>
void require_same(const BlendedRun<S>& run, const BlendedRun<S>& other, int parts) {
    const std::vector<CurveSegment<S>> segments = without_parts(run.segments);
    REQUIRE(segments.size() == other.segments.size());
    CHECK(run.counts.joints.blended == other.counts.joints.blended);
    CHECK(run.counts.chains == other.counts.chains);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const CurveSegment<S>& a = segments[i];
        const CurveSegment<S>& b = other.segments[i];
        CAPTURE(i);
        REQUIRE(a.degree == b.degree);
        REQUIRE(apart(place_of(a, 1.0L), place_of(b, 1.0L), 3) < (std::same_as<S, float> ? 1e-4L : 1e-9L));
        REQUIRE(a.waypoint + 1 == (b.waypoint + 1) * static_cast<std::uint32_t>(parts));
    }
}

} // namespace

TEMPLATE_TEST_CASE("points on a line do not shorten the blends beside it", "[blended_path][collinear]", double, float,
                   Fixed) {
    using S = TestType;
    struct Row {
        PathMode mode;
        double tolerance_mm;
        double chain_tolerance_mm;
    };
    for (const Row& row : {Row{PathMode::continuous, 0.01, 100.0}, Row{PathMode::continuous, 0.3, 100.0},
                           Row{PathMode::continuous, 0.01, 0.0}}) {
        const auto whole = blended<S>(zigzag(6, 1, row.mode, row.tolerance_mm, row.chain_tolerance_mm));
        CHECK(whole.counts.joints.blended == 5);
        for (const int parts : {2, 4, 32}) { // halves and so on are exact
            CAPTURE(parts, row.tolerance_mm, row.chain_tolerance_mm);
            const MoveProgram program = zigzag(6, parts, row.mode, row.tolerance_mm, row.chain_tolerance_mm);
            const auto run = blended<S>(program, seed);
            require_same(run, whole, parts);
            require_ends(program, run, std::same_as<S, float> ? 1e-4L : 2e-9L);
            CHECK(deviation(program, run.segments, 8).most <= 1.001L);
        }
    }
}

TEMPLATE_TEST_CASE("points beside a long one take nothing either", "[blended_path][collinear]", double, Fixed) {
    using S = TestType;
    MoveProgram whole;
    whole.line({16.0L, 8.0L}).tolerance_mm = 0.02;
    whole.line({30.0L, -8.0L}).tolerance_mm = 0.02;
    MoveProgram parts;
    for (const Real share : {0.0009765625L, 0.0625L, 0.0634765625L, 0.5L, 0.5009765625L, 1.0L}) {
        parts.line({16.0L * share, 8.0L * share}).tolerance_mm = 0.02;
    }
    parts.line({30.0L, -8.0L}).tolerance_mm = 0.02;
    const BlendedRun<S> run = blended<S>(parts);
    const BlendedRun<S> other = blended<S>(whole);
    const std::vector<CurveSegment<S>> segments = without_parts(run.segments);
    REQUIRE(segments.size() == other.segments.size());
    CHECK(apart(place_of(segments[1], 1.0L), place_of(other.segments[1], 1.0L), 2) < 1e-9L);
}

TEMPLATE_TEST_CASE("a line in three decimals is one", "[blended_path][collinear]", double, Fixed) {
    using S = TestType;
    MoveProgram program;
    for (int i = 1; i <= 40; ++i) {
        program
            .line({std::round(333.3L * static_cast<Real>(i)) / 1000.0L,
                   std::round(141.7L * static_cast<Real>(i)) / 1000.0L})
            .tolerance_mm = 0.02;
    }
    program.line({14.0L, 20.0L}).tolerance_mm = 0.02;
    const BlendedRun<S> run = blended<S>(program);
    CHECK(without_parts(run.segments).size() == 3);
    require_ends(program, run, 0.001L);
    const Deviation found = deviation(program, run.segments, 64);
    CHECK(found.most <= 1.0L);
    CHECK(found.most > 0.9L); // next to nothing is kept back
}

TEMPLATE_TEST_CASE("lines of different feeds, and behind a stop, stay lines of their own", "[blended_path][collinear]",
                   double, Fixed) {
    using S = TestType;
    for (const double chain_mm : {100.0, 0.0}) {
        MoveProgram program = zigzag(1, 64, PathMode::continuous, 0.01, chain_mm);
        for (std::size_t i = 0; i < program.moves.size(); ++i) {
            program.moves[i].feed_mm_s = i < 16 ? 10.0 : i < 17 ? 20.0 : 30.0;
        }
        program.moves[47].stop_at_end = true;
        const BlendedRun<S> run = blended<S>(program, seed + 1);
        REQUIRE(run.segments.size() == 64);
        for (std::uint32_t i = 0; i < 64; ++i) {
            const CurveSegment<S>& segment = run.segments[i];
            CHECK(segment.waypoint == i);
            CHECK(apart(place_of(segment, 1.0L), program.moves[i].to, 3) < 1e-9L);
            CHECK(to_double(segment.feed_mm_s) == (i < 16 ? 10.0 : i < 17 ? 20.0 : 30.0));
            CHECK(segment.stop_at_end == (i == 47));
        }
    }
}

TEMPLATE_TEST_CASE("of a line without end the next parts are passed on with 64 known, however long it is",
                   "[blended_path][collinear]", double, Fixed) {
    using S = TestType;
    for (const double chain_mm : {100.0, 0.0}) {
        const MoveProgram program = zigzag(1, 1024, PathMode::continuous, 0.01, chain_mm);
        TolerancePath<S> path(3, {});
        REQUIRE(path.start(position_of<S>(program.start)).ok());
        std::uint32_t pushed = 0;
        CurveSegment<S> segment;
        for (std::uint32_t delivered = 0; delivered < 800;) {
            if (path.next(segment) == Pull::item) {
                CHECK(segment.waypoint == delivered);
                CHECK(segment.degree == 1);
                ++delivered;
            } else {
                REQUIRE(pushed - delivered <= 192); // a line of 32, and three that a blend looks ahead
                REQUIRE(path.push(element_of<S>(program.moves[pushed++], 3)).ok());
            }
        }
    }
}

TEMPLATE_TEST_CASE("lines of very many parts each are no worse than lines of some", "[blended_path][collinear]", double,
                   Fixed) {
    using S = TestType;
    const MoveProgram program = zigzag(24, 64, PathMode::continuous, 0.01);
    const BlendedRun<S> run = blended<S>(program, seed + 3);
    CHECK(run.counts.joints.blended == 23);
    CHECK(run.counts.joints.stopped == 1);
    CHECK(deviation(program, run.segments, 128).most <= 1.001L);
    std::size_t lines = 0;
    for (const CurveSegment<S>& segment : run.segments) {
        lines += segment.degree == 1 ? 1U : 0U;
    }
    CHECK(lines > LineParts::capacity / 2);
}

TEMPLATE_TEST_CASE("a straight run goes on into a curve without a joint", "[blended_path][collinear]", double, Fixed) {
    using S = TestType;
    MoveProgram program;
    for (int i = 1; i <= 300; ++i) {
        const Real x = 0.25L * static_cast<Real>(i);
        program.line({x, x < 40.0L ? 0.0L : 5.0L * (1.0L - std::cos((x - 40.0L) / 12.0L))}).tolerance_mm = 0.01;
    }
    const BlendedRun<S> run = blended<S>(program, seed + 2);
    const JointJumps joints = jumps(run.segments);
    CHECK(run.segments[0].degree == 1);
    CHECK(joints.corners == 0);
    CHECK(joints.curvature_corners == 0);
    CHECK(run.counts.joints.blended == 0);
    CHECK(deviation(program, run.segments, 16).most <= 1.0L);
}
