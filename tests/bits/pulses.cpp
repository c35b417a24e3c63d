// SPDX-License-Identifier: MIT
// Feed segments to edges of step and direction lines, by both engines.
#include "corpus.hpp"
#include "machines.hpp"
#include "random.hpp"
#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s5_pulse_train/pulse_train.hpp"
#include "splinefeed/trajectory.hpp"

using namespace splinefeed;

namespace bits {
namespace {

constexpr auto timing = StepTiming::make({});
constexpr std::uint32_t tick_ticks = 80; // 10 us

template <class Engine>
void run_engine(const char* name, const Engine& engine) {
    PulseTrain<Engine> train(engine, StepDirSequencer(axes, *timing));
    G2Spline<Fixed> curve(CurveOptions<Fixed>{});
    std::array<PlannedCell<Fixed>, 32> window;
    AccelerationPlanner<Fixed> planner(window);
    auto trajectory = Trajectory<Fixed>::make(curve, *uneven_limits<Fixed>, planner);
    bool good = trajectory.has_value();
    Wandering<Fixed> path(77, 8);
    Hash hash;
    const auto drain = [&] {
        for (Edge edge; train.next(edge);) {
            hash.add(static_cast<std::uint64_t>(edge.tick));
            hash.add(edge.axis * 4U + (edge.line == Line::step ? 2U : 0U) + (edge.level ? 1U : 0U));
        }
    };
    FeedSegment segment;
    for (Pull pull = Pull::starved; good && pull != Pull::finished; pull = trajectory->next(segment)) {
        if (pull == Pull::item) {
            train.take(segment);
            drain();
        } else {
            good = (path.empty() ? curve.finish() : curve.push(path.next())).ok();
        }
    }
    train.finish();
    drain();
    report<Fixed>(name, hash, good);
}

} // namespace

void run_pulses() {
    run_engine("pulses at solved intervals", StepIntervals(axes));
    run_engine("pulses at a fixed rate", FixedRate(axes, tick_ticks));
    run_engine("pulses between ticks", InterpolatedSteps(axes, 320));
}

} // namespace bits
