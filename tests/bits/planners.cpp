// SPDX-License-Identifier: MIT
// Each planner: a path as it stands, and paths that an operator steers at random times.
#include "corpus.hpp"
#include "machines.hpp"
#include "random.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/jerk_planner.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/trajectory.hpp"

using namespace splinefeed;

namespace bits {
namespace {

constexpr std::size_t cells = 24;

/// How much of a planner is run. In double a chip takes a thousand times as long as a host.
struct Amount {
    int points;
    std::uint64_t steered_paths;
};
constexpr Amount much{20, 3};
constexpr Amount little{8, 1};

/// One request of an operator, now and then.
template <Scalar S>
void steer(Random& random, Trajectory<S>& trajectory) {
    switch (random.below(150)) {
    case 0: trajectory.hold(); break;
    case 1:
    case 2: trajectory.resume(); break;
    case 3:
    case 4: trajectory.override_feed(scale2(from_integer<S>(1 + random.below(127)), -6)); break;
    case 5:
        if (random.below(40) == 0) {
            trajectory.abort();
        }
        break;
    default: break;
    }
}

/// @param seed  0: nobody steers, and the input is never late
template <Scalar S>
bool run_path(Hash& hash, const MotionLimits<S>& limits, Planner<S>& planner, int points, std::uint64_t seed) {
    G2Spline<S> curve(CurveOptions<S>{});
    auto trajectory = Trajectory<S>::make(curve, limits, planner);
    bool good = trajectory.has_value();
    Random random(seed + 1000);
    Wandering<S> path(seed + 40, points);
    FeedSegment segment;
    Pull pull = Pull::starved;
    int stood = 0;
    while (good && pull != Pull::finished) {
        const bool late = seed != 0 && random.below(40) == 0;
        if (pull == Pull::starved && !late) {
            const bool one = seed != 0;
            do {
                good = good && (path.empty() ? curve.finish() : curve.push(path.next())).ok();
            } while (!one && good && !path.empty() && curve.has_room());
        }
        if (seed != 0) {
            steer<S>(random, *trajectory);
        }
        pull = trajectory->next(segment, late ? UnderrunPolicy::drain : UnderrunPolicy::wait);
        if (pull == Pull::held) {
            stood += trajectory->stand(segment) ? 1 : 0;
            if (stood % 5 == 4) {
                trajectory->resume();
                trajectory->override_feed(from_integer<S>(1));
            }
        }
        if (pull == Pull::item || pull == Pull::held) {
            hash.add(segment);
        }
        hash.add(static_cast<std::uint64_t>(trajectory->activity()));
    }
    return good && trajectory->status().ok();
}

template <Scalar S>
void run_planner(const char* name, const char* steered, const MotionLimits<S>& limits, Planner<S>& planner,
                 const Amount& amount) {
    Hash alone;
    bool good = run_path<S>(alone, limits, planner, amount.points, 0);
    report<S>(name, alone, good);
    Hash hash;
    for (std::uint64_t seed = 1; seed <= amount.steered_paths; ++seed) {
        good = run_path<S>(hash, limits, planner, amount.points, seed) && good;
    }
    report<S>(steered, hash, good);
}

template <Scalar S, Floating R>
void run_jerk_planner(const char* name, const char* steered, const Amount& amount) {
    std::array<PlannedCell<S>, cells> window;
    std::array<Cell<S>, cells> known;
    std::array<JerkNode<R>, cells + 1> nodes;
    std::array<LegNode<R>, cells + 1> scratch;
    JerkPlanner<S, R> planner(window, {known, nodes, scratch});
    run_planner<S>(name, steered, *jerk_limits<S>, planner, amount);
}

} // namespace

template <Scalar S>
void run_planners() {
    std::array<PlannedCell<S>, cells> window;
    {
        AccelerationPlanner<S> planner(window);
        run_planner<S>("planner acceleration", "planner acceleration, steered", *uneven_limits<S>, planner, much);
    }
    if constexpr (!std::same_as<S, float>) { // which no jerk limit takes
        run_jerk_planner<S, float>("planner jerk, float", "planner jerk, float, steered", much);
        run_jerk_planner<S, double>("planner jerk, double", "planner jerk, double, steered", little);
    }
}

template void run_planners<Fixed>();
template void run_planners<float>();
template void run_planners<double>();

} // namespace bits
