// SPDX-License-Identifier: MIT
// How a motion ends, why, and what it leaves behind.
#include "host_sim/run/motion.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/output/place_text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

template <Scalar S>
std::string Motion<S>::run(std::optional<std::uint64_t> waypoints) {
    try {
        execute_all(waypoints);
    } catch (const OutputError& error) {
        if (target_ == nullptr || segments_ == 0) {
            throw;
        }
        // Nobody would know where the drives are: they come to rest at the end of what they have.
        static_cast<void>(target_->finish());
        throw OutputError(error.what() + target_->where());
    }
    if (tee_.failure()) {
        keep_failure(tee_.failure());
    } else if (const Status status = trajectory_.status(); !status.ok()) {
        keep_failure(std::make_exception_ptr(InputError(input_->name(), 0, describe(status.error()))));
    }
    if (trajectory_.activity() == Activity::aborted) {
        stopped_ = "aborted by an event";
    } else if (trajectory_.activity() == Activity::held && trajectory_.state() == Pull::held && !held_by_target_) {
        stopped_ = "held, and no event resumes it";
    }
    machine_.finish();
    optimum_.finish();
    require_tolerance();
    if (const auto& fault = machine_.fault()) {
        Fault whole = *fault;
        whole.waypoint = feeder_.whole_row(static_cast<std::uint32_t>(fault->waypoint));
        const auto row = static_cast<std::uint32_t>(whole.waypoint);
        stopped_ =
            describe(whole, input_->within_tolerance() && !input_->lines_within_tolerance() ? feeder_.name_of_row(row)
                                                                                            : std::string());
    }
    if (target_ == nullptr) {
        keep_state();
        return stopped_.empty() ? stopped_ : stopped_ + where();
    }
    // Whatever ended the run: the drives come to rest at the end of what they have.
    if (!target_->finish()) {
        keep_places();
        stopped_ = target_->ending();
        return stopped_;
    }
    keep_state();
    return stopped_.empty() ? stopped_ : stopped_ + target_->where();
}

// Offsets as the motion has come to them, and where the machine stands.
template <Scalar S>
void Motion<S>::keep_state() {
    if (state_.empty()) {
        return;
    }
    if (steps_.offsets() != nullptr) {
        kept_.offsets = *steps_.offsets();
    }
    if (segments_ > 0) {
        std::ranges::copy(machine_.position_mm(), kept_.position_mm.begin());
    }
    write_state_file(state_, input_->axes(), kept_);
}

// The drives did not come to the end of the plan.
template <Scalar S>
void Motion<S>::keep_places() {
    if (state_.empty()) {
        return;
    }
    for (const RunTarget::AxisPlace& at : target_->places()) {
        kept_.position_mm[at.axis] = at.known();
        if (!at.known()) {
            kept_.unknown_why = "the last run ended before its place was known";
        }
    }
    write_state_file(state_, input_->axes(), kept_);
}

// A path that is too far from its moves is a fault, whatever else happened.
template <Scalar S>
void Motion<S>::require_tolerance() {
    if (!input_->within_tolerance()) {
        return;
    }
    if (trajectory_.state() == Pull::finished && stopped_.empty()) {
        deviation_.finish();
    }
    if (enforce_ && stopped_.empty()) {
        stopped_ = excess();
    }
}

// Before the first move what is wrong is thrown; after it, it is why the machine stopped.
template <Scalar S>
void Motion<S>::keep_failure(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const InputError& error) {
        if (segments_ == 0) {
            throw;
        }
        stopped_ = error.what();
    }
}

template <Scalar S>
std::string Motion<S>::where() const {
    PlaceText place("; the machine stands at", 6);
    const PerAxis<double> position = machine_.position_mm();
    for (unsigned k = 0; k < static_cast<unsigned>(limits_->axes); ++k) {
        place.add(description_->axis_name[k], position[k]);
    }
    return place.text() + fmt::format(", {:.6f} s after its start", machine_.cycle_time_s()) + on_line(line_);
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template std::string Motion<S>::run(std::optional<std::uint64_t>);                                                 \
    template void Motion<S>::keep_state();                                                                             \
    template void Motion<S>::keep_failure(const std::exception_ptr&);
SPLINEFEED_INSTANTIATE(double)
SPLINEFEED_INSTANTIATE(float)
SPLINEFEED_INSTANTIATE(Fixed)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed::host
