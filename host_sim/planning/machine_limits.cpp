// SPDX-License-Identifier: MIT
#include "host_sim/planning/machine_limits.hpp"

#include "host_sim/base/input_error.hpp"

#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

struct AxisLimit {
    const char* key;
    double AxisSettings::*value;
    double largest;
};

constexpr std::array axis_limits{
    AxisLimit{"max_jerk_mm_s3", &AxisSettings::max_jerk_mm_s3, 1e9},
    AxisLimit{"max_acceleration_mm_s2", &AxisSettings::max_acceleration_mm_s2, 1e6},
    AxisLimit{"max_braking_mm_s2", &AxisSettings::max_braking_mm_s2, 1e6},
    AxisLimit{"max_velocity_mm_s", &AxisSettings::max_velocity_mm_s, 1e4},
    AxisLimit{"travel_end_velocity_mm_s", &AxisSettings::travel_end_velocity_mm_s, 1e4},
};

/// The one value that is too small for the sample period: with a large one in its place, all goes together.
template <Scalar S>
std::string lost_in_rounding(const MachineDescription& machine, SampledIn sampled) {
    for (const unsigned k : indices(machine.settings.axes)) {
        for (const AxisLimit& limit : axis_limits) {
            MachineSettings raised = machine.settings;
            double& value = raised.axis[k].*limit.value;
            const double given = value;
            value = limit.largest;
            if (given > 0.0 && MotionLimits<S>::make(raised, sampled).has_value()) {
                return fmt::format(
                    "axis {}: {} = {} is lost in rounding, with a sample_period_us of {}; raise one of "
                    "them{}",
                    machine.axis_name[k], limit.key, given, machine.settings.sample_period_us,
                    MotionLimits<double>::make(machine.settings).has_value() ? ", or give --scalar double" : "");
            }
        }
    }
    return describe(LimitError::period_too_short);
}

template <Scalar S>
PlanFigures figures_of(const MotionLimits<S>& limits) {
    return {limits.axes, limits.segment_ticks, limits.segments_per_sample, to_double(limits.refinement.direction_jump),
            limits.steps_per_mm_q32};
}

} // namespace

template <Scalar S>
MotionLimits<S> machine_limits(const MachineDescription& machine, SampledIn sampled) {
    const auto limits = MotionLimits<S>::make(machine.settings, sampled);
    if (!limits.has_value()) {
        throw InputError(machine.file, 0,
                         limits.error() == LimitError::period_too_short ? lost_in_rounding<S>(machine, sampled)
                                                                        : describe(limits.error()));
    }
    return *limits;
}

PlanFigures plan_figures(ScalarKind scalar, const MachineDescription& machine) {
    switch (scalar) {
    case ScalarKind::fixed: return figures_of(machine_limits<Fixed>(machine));
    case ScalarKind::float32: return figures_of(machine_limits<float>(machine));
    case ScalarKind::float64: break;
    }
    return figures_of(machine_limits<double>(machine));
}

template MotionLimits<double> machine_limits(const MachineDescription&, SampledIn);
template MotionLimits<float> machine_limits(const MachineDescription&, SampledIn);
template MotionLimits<Fixed> machine_limits(const MachineDescription&, SampledIn);

} // namespace splinefeed::host
