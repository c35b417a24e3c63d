// SPDX-License-Identifier: MIT
//
// Averaged motions: whatever the limits, the path, the window, the steering and the pace of the input, what is emitted
// keeps every limit at every instant, and ends exactly.
#include "support/allocations.hpp"
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

#include "splinefeed/s3_feed_plan/jerk/s_curve_profile.hpp"

#include <optional>

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 60817;

MachineSettings bounded_machine(Random& random, int axes) {
    MachineSettings machine = random_quick_machine(random, axes);
    limit_jerk(random, machine);
    machine.jerk_tier = JerkTier::bounded;
    return machine;
}

std::size_t random_window(Random& random) {
    constexpr std::size_t sizes[] = {16, 32, 64, 128, 256};
    return sizes[random.integer(0, 4)];
}

bool same(const FeedSegment& a, const FeedSegment& b) {
    return a.start == b.start && a.end == b.end && a.start_velocity == b.start_velocity &&
           a.end_velocity == b.end_velocity;
}

template <Scalar S>
bool has_digits(const MachineSettings& machine) {
    return MotionLimits<S>::make(machine).has_value();
}

} // namespace

TEMPLATE_TEST_CASE("averaged motions along splines and polylines keep every limit", "[stream][jerk][smooth]", double,
                   Fixed) {
    using S = TestType;
    Real most = 0.0L;
    int runs = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(80)); ++round) {
        Random random(seed + round);
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = bounded_machine(random, axes);
        const Program program = random_program(random, axes);
        const std::size_t window = random_window(random);
        if (!has_digits<S>(machine)) {
            continue;
        }
        CAPTURE(seed, round, window);
        const Stream stream = stream_of<S>(program, machine, window);
        if (stream.endless) {
            continue; // soft axes and a short window: minutes of the machine's time
        }
        ++runs;
        most = std::max(most, require_limits(stream, machine).jerk);
        require_ends(stream, machine, program);
    }
    CHECK(most > 0.95L); // the machines were used
    CHECK(3 * runs > 2 * rounds(80));
}

TEMPLATE_TEST_CASE("averaged motions that are steered keep every limit", "[stream][jerk][smooth][steering]", double,
                   Fixed) {
    using S = TestType;
    Real most = 0.0L;
    int steered = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(60, 1000)); ++round) {
        Random random(seed + 1000000 + round);
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = bounded_machine(random, axes);
        const BezierPath path = random_path(random, axes, 8, random.decades(0.5, 50.0), 0.15, 0.3);
        const std::size_t window = random_window(random);
        if (!has_digits<S>(machine)) {
            continue;
        }
        CAPTURE(seed, round, window);
        const SteeredRun plain = run_steered<S>(path, machine, window, {});
        if (plain.endless || plain.segments.size() > 20'000) {
            continue; // minutes of the machine's time
        }
        const std::vector<Event> events = random_events_and_abort(random, plain.segments.size());
        const SteeredRun run = run_steered<S>(path, machine, window, events);
        most = std::max({most, require_limits(plain, machine).jerk, require_limits(run, machine).jerk});
        REQUIRE(run.finished);
        for (unsigned k = 0; k < static_cast<unsigned>(axes) && run.activity != Activity::aborted; ++k) {
            REQUIRE(run.segments.back().end[k] == plain.segments.back().end[k]);
        }
        ++steered;
    }
    CHECK(4 * steered > rounds(60, 1000));
    CHECK(most > 0.95L);
}

TEMPLATE_TEST_CASE("orders that follow each other within the averaged time", "[stream][jerk][smooth][steering]", double,
                   Fixed) {
    using S = TestType;
    MachineSettings machine = machine_of(1, 900.0, 16000.0, 370.0);
    machine.jerk_tier = JerkTier::bounded;
    machine.axis[0].max_jerk_mm_s3 = 1e5;
    const BezierPath path{line_shape(1, 1, {900.0})};
    for (std::size_t at = 10; at < 900; at += 37) {
        const std::vector<Event> events{
            {at, Order::hold},      {at + 9, Order::resume},  {at + 15, Order::override_feed, 0.5},
            {at + 16, Order::hold}, {at + 60, Order::resume}, {at + 61, Order::override_feed, 1.0},
            {at + 90, Order::abort}};
        CAPTURE(at);
        require_limits(run_steered<S>(path, machine, 256, events), machine);
    }
}

TEMPLATE_TEST_CASE("an averaged straight move takes the time of the S-curve", "[stream][jerk][smooth]", double, Fixed) {
    // Beside the tick in which it ends and the one in which the mean does, a motion needs three samples to stand.
    for (const int period : {250, 1000}) {
        for (const double length : {0.1, 1.0, 10.0, 100.0}) {
            for (const double jerk : {1e4, 3e4, 1e5, 1e6}) {
                if (period == 250 && jerk < 3e4) {
                    continue; // rounding of positions takes more than a hundredth of so small a limit
                }
                MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0, period);
                machine.jerk_tier = JerkTier::bounded;
                machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = jerk;
                const BezierPath path{line_shape(2, 1, {length, 0.0})};
                const Stream stream = stream_of<TestType>(path, machine, 2048);
                const double segment_s = stream.segments[0].duration_ticks / 8e6;
                const double seconds = static_cast<double>(stream.segments.size()) * segment_s;
                const double least = SCurveProfile(length, {100.0, 1000.0, jerk}).duration_s();
                CAPTURE(period, length, jerk, seconds, least, segment_s);
                require_limits(stream, machine);
                CHECK(seconds <= 1.001 * least + 5.0 * segment_s);
                CHECK(seconds >= least);
            }
        }
    }
}

TEMPLATE_TEST_CASE("averaged motions along mild bends keep every limit", "[stream][jerk][smooth]", double, Fixed) {
    // They are averaged over the time of a straight line
    Real most = 0.0L;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(40)); ++round) {
        Random random(seed + 4000000 + round);
        MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
        machine.jerk_tier = JerkTier::bounded;
        machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = random.decades(1e4, 1e5);
        const double length = random.decades(10.0, 200.0);
        const double side = length * random.decades(1e-4, 0.3);
        const BezierPath path{cubic_shape(length / 3.0, 0.0, 2.0 * length / 3.0, side, length, side),
                              cubic_shape(length / 3.0, 0.0, 2.0 * length / 3.0, -side, length, -side)};
        CAPTURE(seed, round, length, side, machine.axis[0].max_jerk_mm_s3);
        const Stream stream = stream_of<TestType>(path, machine, 512);
        most = std::max(most, require_limits(stream, machine).jerk);
    }
    CHECK(most > 0.95L);
}

TEMPLATE_TEST_CASE("an override of a long straight line is followed by an averaged motion at once",
                   "[stream][jerk][smooth][steering]", double, Fixed) {
    MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    machine.axis[0].max_jerk_mm_s3 = 1e5;
    const BezierPath path{line_shape(1, 1, {300.0})};
    for (const std::size_t at : {1000U, 1300U, 1700U}) { // anywhere in cells of 16 mm
        const SteeredRun run = run_steered<TestType>(
            path, machine, 64,
            {{0, Order::override_feed, 0.1}, {at, Order::override_feed, 1.0}, {at + 1000, Order::override_feed, 0.1}});
        const auto speed = [&](std::size_t i) {
            return static_cast<Real>(run.segments[i].start_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
        };
        CAPTURE(at);
        require_limits(run, machine);
        // 90 ms for 90 mm/s, 10 ms of averaging, and a few segments
        CHECK(speed(at) < 10.0L * 1.001L);
        CHECK(speed(at + 105) > 99.0L);
        CHECK(speed(at + 1105) < 10.0L * 1.001L);
    }
}

TEMPLATE_TEST_CASE("axes without a jerk limit beside one that takes ten seconds to its acceleration",
                   "[stream][jerk][smooth]", double, Fixed) {
    // The averaged time is up to 10 s: times the largest jerk it is beyond Fixed, which an assertion notices.
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0, 10000);
    machine.jerk_tier = JerkTier::bounded;
    for (const double jerk : {0.0, 1e9}) {
        machine.axis[0].max_jerk_mm_s3 = jerk;
        machine.axis[1].max_jerk_mm_s3 = 100.0;
        const BezierPath path{line_shape(2, 1, {900.0, 0.0}), line_shape(2, 1, {0.0, 5.0}),
                              line_shape(2, 1, {0.5, 0.5}), cubic_shape(20.0, 0.0, 40.0, 30.0, 60.0, 60.0)};
        const Stream stream = stream_of<TestType>(path, machine, 256);
        CAPTURE(jerk);
        require_limits(stream, machine);
        require_ends(stream, machine, {}, {960.5, 65.5});
    }
}

TEMPLATE_TEST_CASE("an averaged motion does not depend on when the input comes", "[stream][jerk][smooth]", double,
                   Fixed) {
    using S = TestType;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(10)); ++round) {
        Random random(seed + 2000000 + round);
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = bounded_machine(random, axes);
        const Program program = random_program(random, axes);
        if (!has_digits<S>(machine)) {
            continue;
        }
        CAPTURE(seed, round);
        const Stream at_once = stream_of<S>(program, machine, 64);
        const Stream in_pieces = stream_of<S>(program, machine, 64, &random);
        REQUIRE(at_once.segments.size() == in_pieces.segments.size());
        for (std::size_t i = 0; i < at_once.segments.size(); ++i) {
            REQUIRE(same(at_once.segments[i], in_pieces.segments[i]));
        }
    }
}

TEMPLATE_TEST_CASE("an averaged motion that cannot wait for its input keeps every limit", "[stream][jerk][smooth]",
                   double, Fixed) {
    using S = TestType;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(15)); ++round) {
        Random random(seed + 3000000 + round);
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = bounded_machine(random, axes);
        const BezierPath path = random_path(random, axes, 12, random.decades(0.3, 20.0), 0.1, 0.3);
        if (!has_digits<S>(machine)) {
            continue;
        }
        const SteeredRun plain = run_steered<S>(path, machine, 64, {});
        if (plain.endless || plain.segments.size() > 20'000) {
            continue;
        }
        CAPTURE(seed, round);
        // The source is starved many times, whatever is asked of it
        ListSource<S> source(segments_of<S>(path, {}), seed + round, 200);
        const MotionLimits<S> limits = MotionLimits<S>::make(machine).value();
        AnyTrajectory<S> any(source, limits, 64);
        SteeredRun run;
        run_steered<S>(
            any.trajectory(), {}, run, [] {}, UnderrunPolicy::drain);
        require_limits(run, machine);
        REQUIRE(run.finished);
        for (const unsigned k : splinefeed::indices(axes)) {
            REQUIRE(run.segments.back().end[k] == plain.segments.back().end[k]);
        }
    }
}

TEMPLATE_TEST_CASE("a leg that comes into view piece by piece is averaged like one that is seen at once",
                   "[stream][jerk][smooth]", double, Fixed) {
    // T was chosen when the first cell behind a stop was known: a tick, for all of the leg
    MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    machine.axis[0].max_jerk_mm_s3 = machine.axis[1].max_jerk_mm_s3 = 3e4;
    BezierPath path;
    for (int i = 0; i < 10; ++i) {
        path.push_back(line_shape(2, 3, {i % 2 == 0 ? 20.0 : -18.0, 8.0}));
    }
    const Stream at_once = stream_of<TestType>(path, machine, 1024);
    for (const std::size_t window : {24U, 48U, 64U}) {
        CAPTURE(window);
        const Stream in_pieces = stream_of<TestType>(path, machine, window);
        require_limits(in_pieces, machine);
        CHECK(100 * in_pieces.segments.size() <= 101 * at_once.segments.size());
    }
}

TEST_CASE("averaged motions in Fixed are those in double", "[stream][jerk][smooth]") {
    Random random(seed);
    for (int round = 0; round < rounds(10); ++round) {
        const MachineSettings machine = [&] {
            MachineSettings quick = machine_of(2, 100.0, 1000.0, 100.0);
            quick.jerk_tier = JerkTier::bounded;
            quick.axis[0].max_jerk_mm_s3 = quick.axis[1].max_jerk_mm_s3 = random.decades(2e4, 1e6);
            return quick;
        }();
        const BezierPath path = random_path(random, 2, 6, random.decades(1.0, 20.0), 0.15, 0.3);
        const Stream wide = stream_of<double>(path, machine, 256);
        const Stream narrow = stream_of<Fixed>(path, machine, 256);
        CAPTURE(seed, round);
        const auto difference = static_cast<double>(wide.segments.size()) - static_cast<double>(narrow.segments.size());
        CHECK(std::fabs(difference) <= 2.0 + 1e-3 * static_cast<double>(wide.segments.size()));
        // So much later or earlier they are at the same place, at up to 0.1 mm a segment
        Real apart = 0.0L;
        for (std::size_t i = 0; i < std::min(wide.segments.size(), narrow.segments.size()); ++i) {
            const Real late = 2.0L + 1e-3L * static_cast<Real>(i);
            for (unsigned k = 0; k < 2; ++k) {
                const auto off = static_cast<Real>(wide.segments[i].end[k] - narrow.segments[i].end[k]);
                apart = std::max(apart, std::fabs(off) / (units_per_mm(machine.axis[k]) * 0.1L * late));
            }
        }
        CHECK(apart <= 1.0L);
        for (unsigned k = 0; k < 2; ++k) {
            CHECK(wide.segments.back().end[k] == narrow.segments.back().end[k]);
        }
    }
}

TEST_CASE("an averaged motion allocates nothing", "[stream][jerk][smooth]") {
    MachineSettings machine = machine_of(3, 100.0, 1000.0, 100.0);
    machine.jerk_tier = JerkTier::bounded;
    for (AxisSettings& axis : machine.axis) {
        axis.max_jerk_mm_s3 = 5e4;
    }
    const auto limits = MotionLimits<Fixed>::make(machine).value();
    Random random(seed);
    ListSource<Fixed> source(segments_of<Fixed>(random_path(random, 3, 10, 5.0, 0.2, 0.3), {}), 0, 0);
    AnyTrajectory<Fixed> any(source, limits, 64);
    FeedSegment segment;
    const std::size_t before = allocations();
    while (any.trajectory().next(segment) == Pull::item) {
    }
    CHECK(allocations() == before);
}
