// SPDX-License-Identifier: MIT
//
// Machines whose axes differ by decades on paths whose steps do, in every plan and scalar: what comes out keeps every
// limit, ends where the path does, and takes no longer than it has to.
#include "wild_round.hpp"
#include "wild_run.hpp"

#include "host/temporary_folder.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

using namespace splinefeed_test;
using splinefeed::host::RunArguments;
using splinefeed::host::ScalarKind;

namespace {

constexpr std::uint64_t seed = 60818;
constexpr std::uint64_t most_segments = 15'000; // of a run in double: then it is left

/// Of all jerk-limited runs so far: JerkPlan::searched_legs and slow_legs.
struct Legs {
    std::uint64_t searched = 0;
    std::uint64_t slow = 0;
};
Legs in_small_windows; // of 16 cells: a bend that comes into sight there may leave no way but to stop before it
Legs in_windows;       // of 64 and 256

const char* name_of(ScalarKind scalar) {
    return scalar == ScalarKind::fixed ? "fixed" : scalar == ScalarKind::float32 ? "float" : "double";
}

/// @return  what the run was; false: it was refused
WildRun checked(ScalarKind scalar, const RunArguments& arguments, std::uint64_t most = most_segments) {
    INFO(printed(arguments, name_of(scalar)));
    RunArguments in_scalar = arguments;
    in_scalar.path.scalar = scalar;
    const WildRun run = wild_run(in_scalar, most);
    CHECK(run.fault == "");
    Legs& legs = arguments.motion.planner.window_cells < 256 ? in_small_windows : in_windows;
    legs.searched += run.searched_legs;
    legs.slow += run.slow_legs;
    return run;
}

/// The same run as one in double. @return  how much longer it takes; 1 where either was refused or left
double ratio(ScalarKind scalar, const RunArguments& arguments, const WildRun& wanted) {
    const WildRun run = checked(scalar, arguments, wanted.ended ? 20 * wanted.segments + 100 : most_segments);
    if (!wanted.ended || !run.refused.empty()) {
        return 1.0;
    }
    INFO(printed(arguments, name_of(scalar)));
    CHECK(run.ended);
    return (run.seconds - 4.0 * run.sample_s) / wanted.seconds;
}

} // namespace

TEST_CASE("wild machines keep every limit, in every plan and scalar", "[wild]") {
    const TemporaryFolder folder;
    int compared = 0;
    int slow_in_fixed = 0;
    int slow_in_float = 0; // where cells of long moves have few digits (docs/explanation/numbers.md)
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(40, 2000)); ++round) {
        CAPTURE(seed, round);
        const WildRound wild = wild_round(seed + round);
        for (const bool plain : {true, false}) {
            const RunArguments arguments = write_wild(wild, !plain, 0.0, folder.file(""));
            RunArguments on_chip = arguments;
            on_chip.motion.planner.jerk_scalar = ScalarKind::float32;
            const WildRun run = checked(ScalarKind::float64, arguments);
            if (!run.refused.empty()) {
                continue;
            }
            {
                INFO(printed(arguments, "double"));
                CAPTURE(run.seconds, run.least_s, run.most_s);
                CHECK((!run.ended || run.seconds <= 4.0 * std::max(run.most_s, run.least_s))); // least: with its feeds
                CHECK((!run.ended || !plain || run.short_window ||
                       run.seconds <= 3.0 * run.least_s + 20.0 * run.sample_s));
                const double in_fixed = ratio(ScalarKind::fixed, arguments, run);
                CHECK(in_fixed <= (plain ? 1.1 : 1.6));
                slow_in_fixed += plain && in_fixed > 1.02 ? 1 : 0;
                CHECK((plain || ratio(ScalarKind::fixed, on_chip, run) <= 1.6));
            }
            if (plain && run.ended) {
                ++compared;
                slow_in_float += ratio(ScalarKind::float32, arguments, run) > 1.2 ? 1 : 0;
            }
            if (wild.orders && run.ended) {
                RunArguments steered = write_wild(wild, !plain, run.seconds, folder.file(""));
                static_cast<void>(checked(ScalarKind::float64, steered, 4 * most_segments));
                static_cast<void>(checked(ScalarKind::fixed, steered, 4 * most_segments));
                steered.motion.planner.jerk_scalar = ScalarKind::float32;
                static_cast<void>(checked(ScalarKind::fixed, steered, 4 * most_segments));
                if (plain) {
                    static_cast<void>(checked(ScalarKind::float32, steered, 4 * most_segments));
                }
            }
        }
    }
    CAPTURE(compared, slow_in_fixed, slow_in_float);
    CAPTURE(in_small_windows.slow, in_small_windows.searched, in_windows.slow, in_windows.searched);
    if (whole_sweep()) { // no plan was found: more slowly, by an older one; most in few runs that crawl
        CHECK(25 * in_windows.slow <= in_windows.searched);
        CHECK(12 * in_small_windows.slow <= in_small_windows.searched);
    }
    CHECK((first_round() > 0 || 4 * compared > rounds(40, 2000))); // else nothing is compared
    CHECK(slow_in_fixed <= compared / 500);
    CHECK(slow_in_float <= 1 + compared / 10);
}

TEST_CASE("an axis that turns round next to a sharp bend brakes within its limit", "[wild][braking]") {
    const ScalarKind scalar = GENERATE(ScalarKind::float64, ScalarKind::float32, ScalarKind::fixed);
    // What it had for accelerating was used for braking within the same segment: up to 1.16 of the limit
    const TemporaryFolder folder;
    for (const int round : {7, 22, 54, 79, 225, 294, 330, 5075, 5078, 5089}) {
        CAPTURE(round);
        static_cast<void>(
            checked(scalar, write_wild(wild_round(static_cast<std::uint64_t>(round)), false, 0.0, folder.file(""))));
    }
}

TEST_CASE("a way too short for a speed is crawled along within every limit", "[wild]") {
    const ScalarKind scalar = GENERATE(ScalarKind::float64, ScalarKind::fixed);
    // One tick was taken for it: 1.08 of the jerk limit
    const TemporaryFolder folder;
    static_cast<void>(checked(scalar, write_wild(wild_round(237), true, 0.0, folder.file(""))));
}

TEST_CASE("a bend that Fixed has few digits for is passed as fast as in double", "[wild]") {
    // It was a stop in each of its 340 cells of a nanometre
    const TemporaryFolder folder;
    const RunArguments arguments = write_wild(wild_round(seed + 501), true, 0.0, folder.file(""));
    const WildRun wanted = checked(ScalarKind::float64, arguments);
    REQUIRE(wanted.ended);
    CHECK(ratio(ScalarKind::fixed, arguments, wanted) < 1.05);
}

namespace {

/// A machine and a path that a plan was wrong for. Every run of it ends within all limits.
struct WildCase {
    const char* what;
    const char* method;
    std::vector<ScalarKind> scalars;
    const char* machine;
    const char* program;
    double most_s = 1e9;
    double most_of_least = 1e9;  ///< of OptimumTime
    double most_of_double = 0.0; ///< of the time that it takes in double; 0: whatever
    std::size_t window_cells = 1024;
    std::optional<std::string> corner_angle{};
};

constexpr ScalarKind in_double = ScalarKind::float64;
constexpr ScalarKind in_float = ScalarKind::float32;
constexpr ScalarKind in_fixed = ScalarKind::fixed;

const WildCase cases[] = {
    {.what = "a hairpin of a nanometre: no plan is slower than 1 um/s away from a stop, and at that the jerk was 1.4 "
             "times what the axis allows",
     .method = "catmull-rom-modified",
     .scalars = {in_double, in_fixed},
     .machine = R"(sample_period_us = 1000
path = {max_feed_mm_s = 800}
axis = [
    {name = "x", max_velocity_mm_s = 750, max_acceleration_mm_s2 = 6400, max_jerk_mm_s3 = 420000, steps_per_mm = 7700},
    {name = "y", max_velocity_mm_s = 45, max_acceleration_mm_s2 = 82, max_jerk_mm_s3 = 948, steps_per_mm = 1976},
    {name = "z", max_velocity_mm_s = 49, max_acceleration_mm_s2 = 956, max_jerk_mm_s3 = 16030}])",
     .program = "35.194105,40.189781,-37.127340\n35.194022,40.189519,-37.127068\n35.197188,40.199264,-37.136493\n"
                "35.196496,40.196994,-37.134226\n35.203530,40.218528,-37.155149\n",
     .corner_angle = "180"},
    {.what = "a bend too sharp for Fixed is a stop: its second derivative was asked for all the same; 10.9 s in double",
     .method = "g2",
     .scalars = {in_fixed},
     .machine = R"(sample_period_us = 2000
path = {max_feed_mm_s = 15.6846}
axis = [
    {name = "x", max_velocity_mm_s = 7.10134, max_acceleration_mm_s2 = 718.548, steps_per_mm = 9511.56, max_jerk_mm_s3 = 1312.51},
    {name = "y", max_velocity_mm_s = 17.2991, max_acceleration_mm_s2 = 417.662, steps_per_mm = 666.497, max_jerk_mm_s3 = 879.853}])",
     .program = "x,y,corner\n10.897864,20.450732,\n7.888008,16.989284,\n10.897941,20.450999,0\n10.897941,20.450999,\n"
                "7.874706,16.961706,\n11.001300,20.309303,0\n14.044241,23.818947,0\n",
     .most_s = 14.0,
     .window_cells = 24},
    {.what =
         "a machine at its largest speed braked along all of its last cell wherever rounding did not make it slower "
         "than that speed: 10 % of the time",
     .method = "ferguson",
     .scalars = {in_double, in_fixed},
     .machine = R"(sample_period_us = 324
path = {max_feed_mm_s = 875.25}
axis = [{name = "x", max_velocity_mm_s = 1.14497, max_acceleration_mm_s2 = 2089.11},
        {name = "y", max_velocity_mm_s = 10.8284, max_acceleration_mm_s2 = 86051.2},
        {name = "z", max_velocity_mm_s = 14.0806, max_acceleration_mm_s2 = 487.611}])",
     .program = "0,0,0\n-0.071871,-0.001537,0.083053\n",
     .most_of_least = 1.01},
    {.what =
         "float arrives at the ends of long moves without a step: rounding is 2^-24 of the move, 1 um, and the axis "
         "that is soft moves along it",
     .method = "polyline",
     .scalars = {in_float},
     .machine = R"(sample_period_us = 1000
path = {max_feed_mm_s = 70}
axis = [{name = "x", max_velocity_mm_s = 100, max_acceleration_mm_s2 = 20000},
        {name = "y", max_velocity_mm_s = 100, max_acceleration_mm_s2 = 2000},
        {name = "z", max_velocity_mm_s = 100, max_acceleration_mm_s2 = 44.8076}])",
     .program = "36.884463,-49.106353,-30.856842\n63.769175,-41.608288,-60.826221\n",
     .window_cells = 64},
    {.what = "float stands at the waypoint, but the next move began where the long one ends, 1 nm away: 1.003 of the "
             "limit",
     .method = "g2",
     .scalars = {in_float},
     .machine = R"(sample_period_us = 2283
path = {max_feed_mm_s = 845.878, centripetal_mm_s2 = 873.678}
axis = [{name = "x", max_velocity_mm_s = 50.7214, max_acceleration_mm_s2 = 2450.21},
        {name = "y", max_velocity_mm_s = 99.3082, max_acceleration_mm_s2 = 1652.9, max_braking_mm_s2 = 649.267},
        {name = "z", max_velocity_mm_s = 1000, max_acceleration_mm_s2 = 718.155},
        {name = "a", max_velocity_mm_s = 1000, max_acceleration_mm_s2 = 30168.9}])",
     .program = "35.651414,-127.642871,40.067098,77.263003\n0.092447,-174.452475,77.177875,100.43595\n"
                "0.009845,-174.610795,77.317131,100.464213\n"},
    {.what = "a soft axis moves along a long segment: its short cells know their direction although the segment's "
             "control points are known to 2^-24 of its length only",
     .method = "g2",
     .scalars = {in_float},
     .machine = R"(sample_period_us = 1000
path = {max_feed_mm_s = 93}
axis = [{name = "x", max_velocity_mm_s = 500, max_acceleration_mm_s2 = 10000},
        {name = "y", max_velocity_mm_s = 140, max_acceleration_mm_s2 = 12000},
        {name = "z", max_velocity_mm_s = 25, max_acceleration_mm_s2 = 47}])",
     .program = "0,0,0\n-4,7,1\n3,15,-1.3\n7,27,3\n5,43,0.7\n",
     .most_of_double = 1.05,
     .window_cells = 64},
    {.what = "a soft axis hardly moves",
     .method = "g2",
     .scalars = {in_float},
     .machine = R"(sample_period_us = 4000
path = {max_feed_mm_s = 465}
axis = [{name = "x", max_velocity_mm_s = 403, max_acceleration_mm_s2 = 4481},
        {name = "y", max_velocity_mm_s = 366, max_acceleration_mm_s2 = 48.85},
        {name = "z", max_velocity_mm_s = 100, max_acceleration_mm_s2 = 7964},
        {name = "a", max_velocity_mm_s = 44.6, max_acceleration_mm_s2 = 3592}])",
     .program = "13.730051,47.100598,40.223821,20.434744\n-4.799827,46.619125,41.241539,-0.004341\n",
     .most_of_double = 1.05},
};

} // namespace

TEST_CASE("what a plan was once wrong for", "[wild]") {
    const TemporaryFolder folder;
    for (const WildCase& of : cases) {
        RunArguments arguments;
        arguments.path.curve.method = of.method;
        arguments.path.curve.corner_angle = of.corner_angle;
        arguments.motion.planner.window_cells = of.window_cells;
        const RunArguments written = write_texts(arguments, of.machine, of.program, "", folder.file(""));
        for (const ScalarKind scalar : of.scalars) {
            CAPTURE(of.what, name_of(scalar));
            const WildRun run = checked(scalar, written, 400'000);
            CHECK(run.ended);
            CHECK(run.seconds < of.most_s);
            CHECK(run.seconds < of.most_of_least * run.least_s);
            if (of.most_of_double > 0.0) {
                const WildRun wanted = checked(in_double, written);
                REQUIRE(wanted.ended);
                CHECK(ratio(scalar, written, wanted) < of.most_of_double);
            }
        }
    }
}
