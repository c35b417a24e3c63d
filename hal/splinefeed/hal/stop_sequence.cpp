// SPDX-License-Identifier: MIT
#include "splinefeed/hal/stop_sequence.hpp"

#include <algorithm>

namespace splinefeed::hal {

const char* name(StopRequest request) noexcept {
    switch (request) {
    case StopRequest::none: return "none";
    case StopRequest::hold: return "feed hold";
    case StopRequest::quick_stop: return "quick stop";
    case StopRequest::disable: return "power off";
    }
    return "";
}

void StopSequence::reset() noexcept {
    std::fill(axes_.begin(), axes_.end(), Axis());
    strongest_ = StopRequest::none;
}

std::uint64_t StopSequence::bound_us(StopRequest request) const noexcept {
    return request == StopRequest::hold         ? times_.hold_us
           : request == StopRequest::quick_stop ? times_.quick_stop_us
                                                : times_.disable_us;
}

void StopSequence::request(std::size_t axis, StopRequest request, std::uint64_t now_us) noexcept {
    strongest_ = std::max(strongest_, request);
    Axis& stopped = axes_[axis];
    if (request > stopped.report.request) {
        stopped = {.report = {.request = request, .status_us = stopped.report.status_us}, .since_us = now_us};
    }
}

void StopSequence::request(StopRequest request, std::uint64_t now_us) noexcept {
    strongest_ = std::max(strongest_, request);
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
        this->request(axis, request, now_us);
    }
}

// A status from before the execution says nothing about the stop. The settling time counts from the first status that
// reports standstill.
void StopSequence::assess(Axis& axis, const StopFacts& facts) const noexcept {
    axis.report.status_us = facts.status_us;
    axis.report.on_path = facts.on_path;
    axis.executed = facts.executed >= axis.report.request;
    const bool stands = axis.executed && facts.standstill && facts.status_us >= facts.executed_us;
    axis.standstill_since_us = !stands ? 0 : axis.standstill_since_us == 0 ? facts.status_us : axis.standstill_since_us;
    axis.statuses = !stands ? 0 : axis.statuses + (facts.status_us != axis.status_us || axis.statuses == 0 ? 1U : 0U);
    axis.status_us = facts.status_us;
    const bool settled =
        stands && axis.statuses >= least_statuses && facts.status_us >= axis.standstill_since_us + times_.settle_us;
    axis.report.state = settled ? StopState::confirmed : axis.executed ? StopState::stopping : StopState::moving;
}

// An axis that was confirmed and moves again has used up its time: it escalates at once.
bool StopSequence::escalate(Axis& axis, const StopFacts& facts, std::uint64_t now_us) const noexcept {
    const std::uint64_t most_us = bound_us(axis.report.request);
    // Who has not been heard for the whole bound is not known to brake any more.
    const bool brakes = axis.executed && facts.braking && now_us <= facts.status_us + most_us;
    if (now_us <= axis.since_us + (brakes ? std::max(most_us, times_.braking_us) : most_us)) {
        return false;
    }
    if (axis.report.request >= times_.last) {
        axis.report.state = StopState::unconfirmed;
        return false;
    }
    axis.report.request = static_cast<StopRequest>(static_cast<int>(axis.report.request) + 1);
    axis.since_us = now_us;
    axis.standstill_since_us = 0;
    axis.statuses = 0;
    axis.executed = false;
    axis.report.state = StopState::moving;
    return true;
}

bool StopSequence::update(std::uint64_t now_us, std::span<const StopFacts> facts) noexcept {
    bool grew = false;
    for (std::size_t i = 0; i < axes_.size() && requested(); ++i) {
        assess(axes_[i], facts[i]);
        grew = (axes_[i].report.state != StopState::confirmed && escalate(axes_[i], facts[i], now_us)) || grew;
    }
    return grew;
}

StopRequest StopSequence::to_send(std::size_t axis) const noexcept {
    return axes_[axis].executed ? StopRequest::none : axes_[axis].report.request;
}

StopReport StopSequence::report(std::size_t axis) const noexcept {
    return axes_[axis].report;
}

bool StopSequence::settled() const noexcept {
    return requested() && std::all_of(axes_.begin(), axes_.end(), [](const Axis& axis) {
               return axis.report.state == StopState::confirmed || axis.report.state == StopState::unconfirmed;
           });
}

std::size_t StopSequence::unconfirmed() const noexcept {
    std::size_t i = 0;
    while (i + 1 < axes_.size() && axes_[i].report.state == StopState::confirmed) {
        ++i;
    }
    return i;
}

} // namespace splinefeed::hal
