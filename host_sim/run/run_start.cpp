// SPDX-License-Identifier: MIT
#include "host_sim/run/run_start.hpp"

#include "host_sim/base/input_error.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

// Behind --home the machine moves to where the program begins, on GPIO lines by itself.
RunStart::RunStart(const MachineDescription& machine, const RunOptions& options,
                   const std::vector<RunTarget::AxisPlace>& standing)
    : machine_(&machine), way_(standing.empty()      ? StartWay::here
                               : options.orders.home ? StartWay::move
                                                     : options.start) {
    for (const RunTarget::AxisPlace& at : standing) {
        place_[at.axis] = at.mm;
    }
}

void RunStart::settle(PerAxis<std::optional<double>>& begins) noexcept {
    for (std::size_t k = 0; k < place_.size(); ++k) {
        place_[k] = place_[k] ? place_[k] : begins[k];
        begins[k] = begins[k] ? begins[k] : place_[k];
    }
}

std::string RunStart::names_of_unknown() const {
    std::string names;
    for (const unsigned k : indices(machine_->settings.axes)) {
        names += place_[k] ? "" : (names.empty() ? "" : ", ") + machine_->axis_name[k];
    }
    return names;
}

std::string RunStart::note() const {
    const std::string names = way_ == StartWay::here ? std::string() : names_of_unknown();
    return names.empty() ? names
                         : "nobody knows where " + names +
                               " stands: the run begins as if it stood where the program does (--home finds the "
                               "references, --start here leaves this note out)";
}

std::optional<PerAxis<double>> RunStart::move_from(const PerAxis<double>& begin) const {
    if (way_ == StartWay::here) {
        return std::nullopt;
    }
    if (way_ == StartWay::move && !names_of_unknown().empty()) {
        throw UsageError("--start move: nobody knows where {} stands; add --home, or --start here if the "
                         "machine stands where the program begins",
                         names_of_unknown());
    }
    PerAxis<double> from = begin;
    std::string stands;
    std::string begins;
    for (const unsigned k : indices(machine_->settings.axes)) {
        from[k] = place_[k].value_or(begin[k]);
        const double off_counts = std::fabs(from[k] - begin[k]) * machine_->settings.axis[k].steps_per_mm;
        if (off_counts > standstill_window_counts(*machine_, k)) {
            stands += fmt::format(" {}={:.4f}", machine_->axis_name[k], from[k]);
            begins += fmt::format(" {}={:.4f}", machine_->axis_name[k], begin[k]);
        }
    }
    if (stands.empty()) {
        return std::nullopt;
    }
    if (way_ == StartWay::check) {
        throw UsageError("the machine stands at{} mm, and the program begins at{} mm; add --start move, and "
                         "it goes there in a straight line first, or --start here, if that is where it "
                         "stands",
                         stands, begins);
    }
    return from;
}

} // namespace splinefeed::host
