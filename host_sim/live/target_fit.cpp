// SPDX-License-Identifier: MIT
#include "host_sim/live/target_fit.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/standard_streams.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

PlanFigures fit_to_target(MachineDescription& machine, ScalarKind scalar, const RunTarget& target, bool quiet) {
    constexpr int longest_us = 100'000;
    constexpr int step_us = 50;
    const int asked_us = machine.settings.sample_period_us;
    const TargetFacts facts = target.facts();
    const std::string lowered = target.fit(machine);
    PlanFigures figures = plan_figures(scalar, machine);
    for (const std::string& note : {lowered, facts.note}) {
        tell_note(quiet ? "" : note);
    }
    const auto check = [&] {
        target.check(machine, static_cast<double>(figures.segment_ticks) / ticks_per_us);
        return figures;
    };
    if (figures.segment_ticks >= facts.least_segment_us * ticks_per_us) {
        return check();
    }
    const int period_us = step_us * static_cast<int>(std::ceil(facts.least_segment_us / step_us));
    if (!facts.resamples || period_us > longest_us) {
        throw UsageError("the drives' lines carry a segment every {:.2f} ms at most often, and the machine "
                         "file asks for one every {:.2f} ms; raise sample_period_us, or take a faster line",
                         facts.least_segment_us * 1e-3, figures.segment_ticks * 1e-3 / ticks_per_us);
    }
    machine.settings.sample_period_us = std::max(period_us, asked_us);
    machine.settings.segments_per_sample = 1;
    figures = plan_figures(scalar, machine);
    if (!quiet) {
        tell("splinefeed: note: the drives' lines carry a segment every {:.2f} ms at most often: segments and "
             "samples are {:.2f} ms long, not {:.2f} ms; what that smoothes the path is in the summary\n",
             facts.least_segment_us * 1e-3, machine.settings.sample_period_us * 1e-3, asked_us * 1e-3);
    }
    return check();
}

} // namespace splinefeed::host
