// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/path_move.hpp"

#include "support/moves_deviation.hpp"
#include "support/rounds.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr Real unit = 4096.0L;

template <Scalar S>
PathMove<S> move_of(const ProgrammedMove& programmed, int axes) {
    PathMove<S> move;
    REQUIRE(move.set(position_of<S>(programmed.from), element_of<S>(programmed, axes), axes).ok());
    return move;
}

/// A state against differences of the programmed move at t.
template <Scalar S>
void require_state(const PathState<S>& state, const ProgrammedMove& move, Real t, const PlaceMm& from, int axes,
                   Real close_mm) {
    const Real h = 2e-4L / (1.0L + std::fabs(move.sweep));
    const PlaceMm behind = move.at(t - h, axes);
    const PlaceMm here = move.at(t, axes);
    const PlaceMm ahead = move.at(t + h, axes);
    PlaceMm first{};
    PlaceMm second{};
    for (const unsigned k : indices(axes)) {
        first[k] = (ahead[k] - behind[k]) / (2.0L * h);
        second[k] = (ahead[k] - 2.0L * here[k] + behind[k]) / (h * h);
    }
    const Real speed = apart(first, {}, axes);
    Real along = 0.0L;
    for (const unsigned k : indices(axes)) {
        first[k] /= speed;
        along += first[k] * second[k];
    }
    Real bend = 0.0L;
    for (const unsigned k : indices(axes)) {
        second[k] = (second[k] - along * first[k]) / (speed * speed);
        bend += second[k] * second[k];
    }
    bend = std::sqrt(bend);
    const Real digits = std::same_as<S, float> ? 1e-4L : 2e-6L;
    for (const unsigned k : indices(axes)) {
        CAPTURE(k, static_cast<double>(t));
        CHECK(std::fabs(exact(state.offset[k]) / unit - (here[k] - from[k])) < close_mm);
        CHECK(std::fabs(exact(state.tangent[k]) - first[k]) < digits);
        CHECK(std::fabs(std::ldexp(exact(state.bend[k]), -bend_log2) * unit - second[k]) <
              digits * (bend + 1.0L / speed));
    }
}

} // namespace

TEMPLATE_TEST_CASE("states near the ends of arcs, helices and Bezier segments", "[blended_path]", double, float,
                   Fixed) {
    using S = TestType;
    Random random(3);
    for (int round = 0; round < rounds(300, 300); ++round) {
        MoveProgram program;
        program.axes = random.integer(2, 4);
        const Real size = real_decades(random, 0.01, 1000.0);
        program.start = {real_between(random, -100.0, 100.0), real_between(random, -100.0, 100.0)};
        if (random.chance(0.5)) {
            program.arc(program.start[0] + size * real_between(random, 0.3, 1.0),
                        program.start[1] + size * real_between(random, 0.3, 1.0),
                        real_between(random, 0.3, 20.0) * (random.chance(0.5) ? 1.0L : -1.0L),
                        size * real_between(random, -1.0, 1.0));
        } else {
            std::vector<PlaceMm> offsets;
            for (int i = 1, degree = random.integer(2, 5); i <= degree; ++i) {
                offsets.push_back(
                    {size * i, size * real_between(random, -1.0, 1.0), size * real_between(random, -1.0, 1.0)});
            }
            program.bezier(offsets);
        }
        const ProgrammedMove& programmed = program.moves[0];
        const PathMove<S> move = move_of<S>(programmed, program.axes);
        CAPTURE(round, static_cast<double>(size), program.axes, programmed.points.size());
        const Real close = (std::same_as<S, float> ? 1e-5L : 1e-9L) * (size + 1e-3L);
        for (const Real share : {0.01L, 0.3L, 0.99L}) {
            const S way = from_double<S>(static_cast<double>(share * exact(move.longest_way())));
            const Real t = exact(way) / exact(move.length());
            PathState<S> state;
            move.behind_start(way, state);
            require_state(state, programmed, t, programmed.from, program.axes, close);
            move.before_end(way, state);
            require_state(state, programmed, 1.0L - t, programmed.to, program.axes, close);
            // A place off the move by a little: its distance
            PlaceMm place = programmed.at(1.0L - t, program.axes);
            PerAxis<S> offset{};
            for (const unsigned k : indices(program.axes)) {
                place[k] += 1e-3L * size * (k % 2 == 0 ? 1.0L : -0.7L);
                offset[k] = from_double<S>(static_cast<double>((place[k] - programmed.to[k]) * unit));
            }
            const Real distance = programmed.distance(place, program.axes);
            const Real found = exact(move.distance_near(true, offset)) / unit;
            CHECK(found >= distance - close);
            CHECK(found <= distance * 1.1L + 1e-3L * close);
        }
    }
}

TEMPLATE_TEST_CASE("states of spirals, from nearly round to nearly straight", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    Random random(55);
    for (int round = 0; round < rounds(300, 300); ++round) {
        MoveProgram program;
        program.axes = random.integer(2, 4);
        const Real radius = real_decades(random, 0.1, 1000.0);
        program.start = {radius, 0.0L};
        const Real sweep = real_decades(random, 0.01, 6.0) * (random.chance(0.5) ? 1.0L : -1.0L);
        ProgrammedMove& arc = program.arc(0.0L, 0.0L, sweep, radius * real_between(random, -1.0, 1.0));
        const Real wider = 1.0L + real_decades(random, 1e-4, 0.06) * (random.chance(0.5) ? 1.0L : -1.0L);
        arc.to[0] *= wider;
        arc.to[1] *= wider;
        const PathMove<S> move = move_of<S>(arc, program.axes);
        CAPTURE(round, static_cast<double>(radius), static_cast<double>(sweep), static_cast<double>(wider));
        const Real close = (std::same_as<S, float> ? 1e-5L : 1e-8L) * radius;
        for (const Real share : {0.0L, 0.3L, 0.99L}) {
            const S way = from_double<S>(static_cast<double>(share * exact(move.longest_way())));
            const Real t = exact(way) / exact(move.length());
            PathState<S> state;
            move.behind_start(way, state);
            require_state(state, arc, t, arc.from, program.axes, close);
            move.before_end(way, state);
            require_state(state, arc, 1.0L - t, arc.to, program.axes, close);
            PlaceMm place = arc.at(1.0L - t, program.axes);
            PerAxis<S> offset{};
            for (const unsigned k : indices(program.axes)) {
                place[k] += 1e-3L * std::min(radius, exact(move.length()) / unit) * (k % 2 == 0 ? 1.0L : -0.7L);
                offset[k] = from_double<S>(static_cast<double>((place[k] - arc.to[k]) * unit));
            }
            const Real distance = arc.distance(place, program.axes);
            const Real found = exact(move.distance_near(true, offset)) / unit;
            CHECK(found >= distance - close);
            CHECK(found <= distance * 1.1L + 0.1L * close);
        }
    }
}

TEMPLATE_TEST_CASE("quintics of spirals are within 1e-6 mm, whatever the radius", "[blended_path]", double, Fixed) {
    using S = TestType;
    Random random(56);
    for (int round = 0; round < rounds(100, 500); ++round) {
        MoveProgram program;
        const Real radius = real_decades(random, 0.1, 3000.0);
        program.start = {radius, 0.0L};
        ProgrammedMove& arc =
            program.arc(0.0L, 0.0L, real_decades(random, 0.001, 7.0), radius * real_between(random, -0.1, 0.1));
        const Real wider = 1.0L + real_decades(random, 1e-5, 0.06) * (random.chance(0.5) ? 1.0L : -1.0L);
        arc.to[0] *= wider;
        arc.to[1] *= wider;
        arc.mode = PathMode::exact_path;
        TolerancePath<S> path(3, {});
        REQUIRE(path.start(position_of<S>(arc.from)).ok());
        REQUIRE(path.push(element_of<S>(arc, 3)).ok());
        REQUIRE(path.finish().ok());
        std::vector<CurveSegment<S>> segments(1);
        while (path.next(segments.back()) == Pull::item) {
            segments.emplace_back();
        }
        segments.pop_back();
        const Real largest = deviation(program, segments, 8).most * static_cast<Real>(arc.tolerance_mm);
        CAPTURE(round, static_cast<double>(radius), static_cast<double>(arc.sweep), static_cast<double>(wider));
        // Frames in Fixed have 2^-32 of the radius, and an angle that is doubled four times.
        CHECK(largest < 1e-6L + (std::same_as<S, Fixed> ? 1e-8L * radius : 0.0L));
    }
}

TEMPLATE_TEST_CASE("an arc in pieces", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    MoveProgram program;
    program.arc(3.0L, 4.0L, 39.9L, 2.0L);
    const PathMove<S> move = move_of<S>(program.moves[0], 3);
    CHECK(std::fabs(exact(move.length()) / unit - std::hypot(5.0L * 39.9L, 2.0L)) < 1e-3L);
    const S none{};
    const int count = move.pieces(none, none);
    CHECK(count == 100);
    for (int i = 0; i + 1 < count; ++i) {
        PathState<S> state;
        move.piece_end(none, none, i, count, state);
        require_state(state, program.moves[0], static_cast<Real>(i + 1) / static_cast<Real>(count), {}, 3,
                      std::same_as<S, float> ? 1e-4L : 5e-8L); // 2^-32 of its length
    }
}

TEMPLATE_TEST_CASE("moves that are none are refused", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    PathMove<S> move;
    MoveProgram program;
    program.arc(1.0L, 0.0L, 1.0L);
    PathElement<S> element = element_of<S>(program.moves[0], 3);
    element.arc.centre = {};
    CHECK(move.set({}, element, 3).error() == Error::arc_invalid); // the start is the centre
    for (const std::int64_t end :
         {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
        element.arc.centre[0].raw = end;
        PerAxis<Position> from{};
        from[0].raw = end < 0 ? 1 : -2;
        CHECK(move.set(from, element, 3).error() == Error::move_too_long);
    }
    element = element_of<S>(program.moves[0], 3);
    element.to[0] = position_from_mm(40.0);
    CHECK(move.set({}, element, 3).error() == Error::arc_invalid); // the radius is another one
    element = element_of<S>(program.moves[0], 3);
    element.arc.sweep_rad = from_double<S>(1e5);
    CHECK(move.set({}, element, 3).error() == Error::arc_invalid); // too many turns
    element = element_of<S>(program.moves[0], 3);
    element.arc.centre[1] = position_from_mm(-600000.0);
    CHECK(move.set({}, element, 3).error() == Error::move_too_long); // a radius of 600 m
    MoveProgram turns;
    turns.arc(-1000.0L, 0.0L, 200.0L * 6.2831853L, 1.0L);
    CHECK(move.set({}, element_of<S>(turns.moves[0], 3), 3).error() == Error::move_too_long); // 1257 m of way
    MoveProgram bezier;
    bezier.bezier({{1.0L}, {2.0L}, {3.0L}});
    element = element_of<S>(bezier.moves[0], 3);
    CHECK(move.set({}, element, 3).ok());
    element.bezier.points[0][1] = S{};
    CHECK(move.set({}, element, 3).error() == Error::curve_invalid); // no direction at its start
    element.bezier.degree = 6;
    CHECK(move.set({}, element, 3).error() == Error::curve_invalid);
    element = {};
    element.to[0] = position_from_mm(70000.0);
    CHECK(move.set({}, element, 3).error() == Error::move_too_long);
    element.to[0] = position_from_mm(0.00005);
    CHECK(move.set({}, element, 3).ok());
    CHECK(move.length() == S{});
}

TEMPLATE_TEST_CASE("a place of a short arc is the same from both of its ends", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    Random random(4);
    for (int round = 0; round < rounds(200, 2000); ++round) {
        MoveProgram program;
        const Real radius = real_decades(random, 0.1, 100.0);
        program.start = {radius, 0.0L};
        ProgrammedMove& arc = program.arc(0.0L, 0.0L, real_between(random, 0.05, 0.9), radius * 0.01L);
        const Real wider = 1.0L + real_between(random, -1e-3, 1e-3); // as four decimals leave it, and more
        arc.to[0] *= wider;
        arc.to[1] *= wider;
        const PathMove<S> move = move_of<S>(arc, 3);
        // Half of the length, as two blends share it, and a place where only one of them wants so much
        const S length = move.length();
        for (const S way : {scale2(length, -1), smaller(move.longest_way(), literal<S>(0.8) * length)}) {
            if (move.longest_way() < way || move.longest_way() < length - way) {
                continue;
            }
            PathState<S> behind;
            PathState<S> before;
            move.behind_start(way, behind);
            move.before_end(length - way, before);
            const Real digits = std::same_as<S, float> ? 1e-6L : 1e-9L;
            for (unsigned k = 0; k < 3; ++k) {
                CAPTURE(round, k, exact(way / length), exact(behind.tangent[k]) - exact(before.tangent[k]));
                CHECK(std::fabs(exact(behind.tangent[k]) - exact(before.tangent[k])) < digits);
                CHECK(std::fabs((exact(behind.offset[k]) - exact(before.offset[k])) / unit -
                                (arc.to[k] - arc.from[k])) < radius * (digits + 1e-9L));
            }
        }
    }
}
