// SPDX-License-Identifier: MIT
#include "wild_run.hpp"

#include "host_sim/analysis/optimum_time.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/machine/simulated_machine.hpp"
#include "host_sim/planning/curve_feeder.hpp"
#include "host_sim/planning/planned_trajectory.hpp"
#include "host_sim/program/event_file.hpp"
#include "host_sim/run/path_tee.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed_test {

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

template <Scalar S>
void obey(Trajectory<S>& trajectory, const OperatorEvent& event) {
    switch (event.operation) {
    case Operation::hold: trajectory.hold(); break;
    case Operation::resume: trajectory.resume(); break;
    case Operation::abort: trajectory.abort(); break;
    case Operation::override_feed: trajectory.override_feed(from_double<S>(event.value)); break;
    }
}

// From rest to rest over equal parts of a length, which takes more than over unequal ones.
double from_rest_to_rest(const MachineSettings& machine, double length_mm, double parts) {
    double speed = machine.max_feed_mm_s;
    double acceleration = 1e9;
    double rise_s = 0.0;
    for (const unsigned k : indices(machine.axes)) {
        const AxisSettings& axis = machine.axis[k];
        speed = std::min(speed, axis.max_velocity_mm_s);
        acceleration = std::min(acceleration, axis.smaller_acceleration_mm_s2());
        if (axis.max_jerk_mm_s3 > 0.0) {
            rise_s = std::max(rise_s, std::min(axis.smaller_acceleration_mm_s2() / axis.max_jerk_mm_s3,
                                               std::cbrt(length_mm / parts / axis.max_jerk_mm_s3)));
        }
    }
    return length_mm / speed +
           parts * (2.0 * std::sqrt(length_mm / parts / acceleration) + 4.0 * rise_s + 8e-6 * machine.sample_period_us);
}

} // namespace

template <Scalar S>
WildRun wild_run(const RunArguments& arguments, std::uint64_t most_segments) {
    WildRun run;
    const MachineDescription machine = read_machine_file(arguments.machine);
    const auto limits = MotionLimits<S>::make(machine.settings);
    if (!limits.has_value()) {
        run.refused = describe(limits.error());
        return run;
    }
    try {
        const auto axes = static_cast<std::size_t>(machine.settings.axes);
        PathInput input(arguments.path, PathUse::executed,
                        {machine.axis_name.begin(), machine.axis_name.begin() + axes});
        OptimumTime optimum(machine.settings, to_double(limits->refinement.direction_jump),
                            std::same_as<S, float> ? ScalarKind::float32 : ScalarKind::float64);
        CurveFeeder<S> feeder(input);
        PathTee<S> tee(feeder, input.name(), {.optimum = &optimum});
        PlannedTrajectory<S> planner(tee, *limits, arguments.motion.window_cells);
        Trajectory<S>& trajectory = planner.trajectory();
        SimulatedMachine simulated(machine, limits->segments_per_sample);
        const auto events =
            arguments.motion.events.empty() ? std::vector<OperatorEvent>{} : read_event_file(arguments.motion.events);
        std::size_t obeyed = 0;
        FeedSegment segment;
        run.sample_s = machine.settings.sample_period_us * 1e-6;
        while (run.segments < most_segments && run.fault.empty() && !run.ended) {
            for (; obeyed < events.size() && events[obeyed].time_s <= simulated.cycle_time_s() + 1e-9; ++obeyed) {
                obey(trajectory, events[obeyed]);
            }
            const bool moves = trajectory.next(segment) == Pull::item;
            if (!moves && trajectory.state() == Pull::held) {
                if (obeyed == events.size() || !trajectory.stand(segment)) {
                    run.fault = "held without an order, or where it has not begun";
                    break;
                }
            } else if (!moves && trajectory.state() == Pull::finished) {
                run.ended = true;
                break;
            } else if (!moves) {
                typename CurveFeeder<S>::Pushed ignored;
                static_cast<void>(feeder.more(ignored));
                continue;
            }
            ++run.segments;
            if (!simulated.submit(segment) || simulated.poll().phase == hal::PortPhase::fault) {
                run.fault = describe(simulated.fault().value());
            }
        }
        optimum.finish();
        run.seconds = simulated.cycle_time_s();
        run.least_s = optimum.seconds();
        run.most_s = from_rest_to_rest(machine.settings, length_to_mm(trajectory.arc_length().travelled()),
                                       static_cast<double>(tee.segments()));
        run.short_window = trajectory.feed_plan().window_limited() > 0;
    } catch (const InputError& error) {
        run.refused = error.what();
    } catch (const UsageError& error) {
        run.refused = error.what();
    }
    return run;
}

template WildRun wild_run<double>(const RunArguments& arguments, std::uint64_t most_segments);
template WildRun wild_run<float>(const RunArguments& arguments, std::uint64_t most_segments);
template WildRun wild_run<Fixed>(const RunArguments& arguments, std::uint64_t most_segments);

} // namespace splinefeed_test
