// SPDX-License-Identifier: MIT
#include "wild_run.hpp"

#include "host_sim/analysis/optimum_time.hpp"
#include "host_sim/base/input_error.hpp"
#include "host_sim/config/machine_file.hpp"
#include "host_sim/machine/simulated_machine.hpp"
#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/program/event_file.hpp"
#include "host_sim/run/path_watch.hpp"
#include "host_sim/run/run_machine.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed_test {

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

void obey(PlannedPath& path, const OperatorEvent& event) {
    switch (event.operation) {
    case Operation::hold: path.stream().hold(); break;
    case Operation::resume: path.stream().resume(); break;
    case Operation::abort: path.stream().abort(); break;
    case Operation::override_feed: path.stream().override_feed(Fixed::from_double(event.value)); break;
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

WildRun wild_run(const RunArguments& arguments, std::uint64_t most_segments) {
    WildRun run;
    const RunMachine stated(read_machine_file(arguments.machine), arguments.path.format->is_gcode());
    const MachineDescription& machine = stated.machine;
    try {
        const PlanFigures figures = plan_figures(arguments.path.scalar, machine);
        PathInput input(arguments.path, PathUse::executed, stated.path());
        OptimumTime optimum(machine.settings, figures.direction_jump, arguments.path.scalar);
        PathWatch watch(input.name(), {.optimum = &optimum});
        const auto path = plan_path(input, machine, watch, arguments.motion.planner);
        SimulatedMachine simulated(machine, figures.segments_per_sample);
        const auto events =
            arguments.motion.events.empty() ? std::vector<OperatorEvent>{} : read_event_file(arguments.motion.events);
        std::size_t obeyed = 0;
        FeedSegment segment;
        run.sample_s = machine.settings.sample_period_us * 1e-6;
        while (run.segments < most_segments && run.fault.empty() && !run.ended) {
            for (; obeyed < events.size() && events[obeyed].time_s <= simulated.cycle_time_s() + 1e-9; ++obeyed) {
                obey(*path, events[obeyed]);
            }
            const bool moves = path->next(segment, Supply::flows) == Pull::item;
            if (!moves && path->stream().state() == Pull::held) {
                if (obeyed == events.size() || !path->stream().stand(segment)) {
                    run.fault = "held without an order, or where it has not begun";
                    break;
                }
            } else if (!moves && path->stream().state() == Pull::finished) {
                run.ended = true;
                break;
            } else if (!moves) {
                PathFeeder::Pushed ignored;
                path->stream().go_on();
                static_cast<void>(path->feeder().more(ignored));
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
        const PlannedPath::Statistics statistics = path->statistics();
        run.most_s =
            from_rest_to_rest(machine.settings, statistics.length_mm, static_cast<double>(statistics.curve_segments));
        run.searched_legs = statistics.searched_legs.value_or(0);
        run.slow_legs = statistics.slow_legs.value_or(0);
        run.short_window = statistics.window_limited > 0;
    } catch (const InputError& error) {
        run.refused = error.what();
    } catch (const UsageError& error) {
        run.refused = error.what();
    }
    return run;
}

} // namespace splinefeed_test
