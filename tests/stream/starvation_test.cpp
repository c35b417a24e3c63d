// SPDX-License-Identifier: MIT
//
// Input that comes too late for a machine that cannot wait: it goes on with what is known, stops at its end, and starts
// again, all within the limits.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 815;

/// Gives no more segments than were released.
template <Scalar S>
class GatedSource final : public CurveSource<S> {
public:
    GatedSource(ListSource<S>& list, std::size_t size) : list_(&list), size_(size) {}
    void release(std::size_t n) { released_ += n; }
    Pull next(CurveSegment<S>& out) noexcept override {
        if (given_ >= released_ && given_ < size_) {
            return Pull::starved;
        }
        const Pull pull = list_->next(out);
        given_ += pull == Pull::item ? 1U : 0U;
        return pull;
    }

private:
    ListSource<S>* list_;
    std::size_t size_;
    std::size_t released_ = 0;
    std::size_t given_ = 0;
};

/// Runs to the end. Segments of 0.5 mm are released one by one, `ahead` of them before the axis comes there: each is
/// the last that is known for a while. So many of them were released before.
template <Scalar S>
void run_in_time(AnyTrajectory<S>& any, GatedSource<S>& source, const MachineSettings& machine, unsigned axis,
                 Real ahead, SteeredRun& run) {
    FeedSegment segment;
    Real released = ahead;
    while (any.trajectory().next(segment, UnderrunPolicy::drain) == Pull::item) {
        run.segments.push_back(segment);
        const Real at = static_cast<Real>(segment.end[axis]) / units_per_mm(machine.axis[axis]);
        for (; released < at / 0.5L + ahead; released += 1.0L) {
            source.release(1);
        }
    }
}

} // namespace

TEMPLATE_TEST_CASE("late input is a controlled stop and a clean restart", "[stream][starvation]", double, float,
                   Fixed) {
    using S = TestType;
    int stops = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(8)); ++round) {
        Random random(seed + round);
        const auto drawn = random_quick_run<S>(random, 20, 256, [](MachineSettings&) {});
        if (!drawn) {
            continue;
        }
        const auto& [machine, limits, path, window_size, plain] = *drawn;
        const auto axes = static_cast<unsigned>(machine.axes);
        ListSource<S> list(segments_of<S>(path, {}), 0, 0);
        GatedSource<S> source(list, path.size());
        std::vector<PlannedCell<S>> window(window_size);
        AccelerationPlanner<S> planner(window);
        auto trajectory = Trajectory<S>::make(source, limits, planner).value();
        SteeredRun run;
        FeedSegment segment;
        const double pace =
            random.decades(0.3, 3.0) * static_cast<double>(path.size()) / static_cast<double>(plain.segments.size());
        bool stood = true;
        CAPTURE(seed, round, window_size);
        while (run.segments.size() < 300'000) {
            if (random.chance(std::min(1.0, pace))) {
                source.release(static_cast<std::size_t>(random.integer(1, 3)));
            }
            if (trajectory.next(segment, UnderrunPolicy::drain) == Pull::item) {
                stood = false;
            } else if (trajectory.state() == Pull::starved) {
                if (!run.segments.empty()) {
                    REQUIRE(ends_at_rest(run.segments.back(), axes));
                }
                stops += stood ? 0 : 1;
                stood = true;
                if (!trajectory.stand(segment)) {
                    continue; // nothing is known of the start
                }
            } else {
                break;
            }
            run.segments.push_back(segment);
        }
        REQUIRE(trajectory.state() == Pull::finished);
        require_limits(run, machine, std::same_as<S, float> ? 5e-2L : 0.0L);
        for (const unsigned k : splinefeed::indices(axes)) {
            REQUIRE(run.segments.back().end[k] == plain.segments.back().end[k]);
        }
        const Track<S> track(path, machine);
        typename Track<S>::Place place;
        for (std::size_t i = 1; i < run.segments.size() && run.segments.size() < 6'000; ++i) {
            REQUIRE(track.find(run.segments[i], place) <= (std::same_as<S, float> ? 1e-4L : 1e-7L));
        }
    }
    CHECK(4 * stops >= rounds(8));
}

TEMPLATE_TEST_CASE("a jerk-limited motion with late input travels what is known, and rests only at its end",
                   "[stream][starvation][jerk]", DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    int compared = 0;
    std::size_t taken = 0;
    std::size_t shortest = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(4)); ++round) {
        Random random(seed + round);
        const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), random.decades(2e4, 1e6));
        const BezierPath path = random_path(random, 2, 14, random.decades(3.0, 20.0), 0.0, 0.0);
        // One segment is kept back until the next is known
        const std::size_t released = 8;
        const BezierPath known(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(released) - 1);
        const SteeredRun least = run_steered<S, R>(known, machine, 512, {});
        const auto limits = limits_for<S, R>(machine).value();
        ListSource<S> list(segments_of<S>(path, {}), 0, 0);
        GatedSource<S> source(list, path.size());
        source.release(released);
        AnyTrajectory<S, R> any(source, limits, 512);
        SteeredRun run;
        FeedSegment segment;
        std::size_t rests = 0;
        const auto travel = [&] {
            while (any.trajectory().next(segment, UnderrunPolicy::drain) == Pull::item) {
                const bool moved = segment.start != segment.end;
                run.segments.push_back(segment);
                rests += moved && ends_at_rest(segment, 2) ? 1U : 0U;
            }
        };
        travel();
        CAPTURE(seed, round, run.segments.size(), least.segments.size(), rests);
        REQUIRE(any.trajectory().state() == Pull::starved);
        const SteeredRun cusps = least; // jumps of the curvature are stops of the plan
        std::size_t stops = 0;
        for (const FeedSegment& s : cusps.segments) {
            stops += s.start != s.end && ends_at_rest(s, 2) ? 1U : 0U;
        }
        CHECK(rests <= stops);
        CHECK(run.segments.size() <= least.segments.size() + least.segments.size() / 20 + 10);
        ++compared;
        // And what comes while it still moves is no stop
        source.release(path.size());
        travel();
        REQUIRE(any.trajectory().state() == Pull::finished);
        require_limits(run, machine);
        ListSource<S> again(segments_of<S>(path, {}), 0, 0);
        GatedSource<S> in_time(again, path.size());
        in_time.release(released);
        AnyTrajectory<S, R> other(in_time, limits, 512);
        SteeredRun smooth;
        std::size_t made = 0;
        while (other.trajectory().next(segment, UnderrunPolicy::drain) == Pull::item) {
            smooth.segments.push_back(segment);
            if (++made == least.segments.size() / 2) {
                in_time.release(path.size());
            }
        }
        REQUIRE(other.trajectory().state() == Pull::finished);
        require_limits(smooth, machine);
        const SteeredRun whole = run_steered<S, R>(path, machine, 512, {});
        CAPTURE(whole.segments.size(), smooth.segments.size());
        CHECK(smooth.segments.size() <= whole.segments.size() + whole.segments.size() / 20 + 10);
        taken += smooth.segments.size();
        shortest += whole.segments.size();
    }
    CHECK(taken <= shortest + shortest / 40 + 10);
    CHECK(compared == rounds(4));
}

TEMPLATE_TEST_CASE("a hold while the input is late stops the motion", "[stream][starvation][steering]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    MachineSettings plain = machine_of(2, 100.0, 1000.0, 100.0);
    std::vector<MachineSettings> machines(2, plain);
    for (std::size_t i = 0; i < 2; ++i) {
        for (AxisSettings& axis : machines[i].axis) {
            axis.max_jerk_mm_s3 = i > 0 ? 5e4 : 0.0;
        }
        const auto limits = limits_for<S, R>(machines[i]).value();
        const BezierPath path(60, line_shape(2, 3, {3.0, 4.0})); // no stop of its own
        ListSource<S> list(segments_of<S>(path, {}), 0, 0);
        GatedSource<S> source(list, path.size());
        AnyTrajectory<S, R> any(source, limits, 32);
        SteeredRun run;
        FeedSegment segment;
        source.release(1);
        while (run.segments.size() < 150) { // waits in the middle of the path, at speed
            if (any.trajectory().next(segment) == Pull::item) {
                run.segments.push_back(segment);
            } else {
                source.release(1);
            }
        }
        while (any.trajectory().next(segment) == Pull::item) {
            run.segments.push_back(segment);
        }
        REQUIRE(any.trajectory().state() == Pull::starved);
        const bool moves = !ends_at_rest(run.segments.back(), 2);
        any.trajectory().hold();
        while (any.trajectory().next(segment) == Pull::item) {
            run.segments.push_back(segment);
        }
        CAPTURE(i, moves, run.segments.size());
        CHECK(any.trajectory().state() == Pull::held);
        CHECK(any.trajectory().activity() == Activity::held);
        CHECK(moves);
        require_limits(run, machines[i]);
    }
}

TEMPLATE_TEST_CASE("what is known is travelled to its end, be it one short move", "[stream][starvation][jerk]",
                   DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    for (const double length : {0.004, 0.02, 0.1, 0.5}) {
        for (const double before : {0.0, 5.0}) { // to a corner
            const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 1e5);
            const auto limits = limits_for<S, R>(machine).value();
            BezierPath known{line_shape(2, 3, {0.0, length})};
            if (before > 0.0) {
                known.insert(known.begin(), line_shape(2, 3, {before, 0.0}));
            }
            const SteeredRun least = run_steered<S, R>(known, machine, 64, {});
            // The last move is kept back until the next is known, and no stop lies before it
            BezierPath path = known;
            path.push_back(line_shape(2, 3, {0.0, 5.0}));
            ListSource<S> list(segments_of<S>(path, {}), 0, 0);
            GatedSource<S> source(list, path.size() + 1);
            source.release(path.size());
            AnyTrajectory<S, R> any(source, limits, 64);
            SteeredRun run;
            run_steered<S>(any.trajectory(), {}, run, {}, UnderrunPolicy::drain);
            CAPTURE(length, before, run.segments.size(), least.segments.size());
            REQUIRE(any.trajectory().state() == Pull::starved);
            REQUIRE_FALSE(run.segments.empty());
            require_limits(run, machine);
            CHECK(run.segments.back().end == least.segments.back().end);
            CHECK(run.segments.size() <= least.segments.size() + least.segments.size() / 20 + 10);
        }
    }
}

TEST_CASE("a motion of which the input comes in time rests for no end of it that was known",
          "[stream][starvation][jerk]") {
    for (const double slow : {5.0, 20.0, 50.0}) {
        const MachineSettings machine = with_jerk(machine_of(1, 100.0, 1000.0, 100.0), 2e5);
        const auto limits = MotionLimits<double>::make(machine).value();
        BezierPath path(90, line_shape(1, 3, {0.5}));
        for (std::size_t i = 0; i < path.size(); i += 6) {
            path[i].max_feed_mm_s = slow;
        }
        ListSource<double> list(segments_of<double>(path, {}), 0, 0);
        GatedSource<double> source(list, path.size());
        source.release(24); // twice the way that braking takes
        AnyTrajectory<double> any(source, limits, 256);
        SteeredRun run;
        run_in_time(any, source, machine, 0, 24.0L, run);
        CAPTURE(slow, run.segments.size());
        REQUIRE(any.trajectory().state() == Pull::finished);
        require_limits(run, machine);
        std::size_t rests = 0;
        for (const FeedSegment& s : run.segments) {
            rests += ends_at_rest(s, 1) ? 1U : 0U;
        }
        CAPTURE(rests, any.slow_legs());
        CHECK(any.slow_legs() < rests);
        CHECK((any.slow_legs() > 0) == (rests > 1));
    }
}
