// SPDX-License-Identifier: MIT
//
// A drive in state `standing` may have a pending start: `hold` is not allowed there, and a late quick stop would take
// the drive off the path. `begin` with the next segment cancels the start, and the drive refuses it if it runs already:
// then it gets a hold like the others.
#include "splinefeed/hal/modbus/pvt/pvt_stop.hpp"

#include <algorithm>
#include <cstdlib>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t still_us = 15'000; // standstill of an unpowered drive, by its position
constexpr std::uint64_t look_us = 100'000; // two looks tell whether it slows down

} // namespace

PvtStop::PvtStop(PvtClient& client, std::span<const PvtAxis> axes) noexcept : client_(&client) {
    window_.fill(PvtAxis().window_counts);
    for (std::size_t k = 0; k < axes.size(); ++k) {
        window_[k] = axes[k].window_counts;
    }
    forget_positions();
}

void PvtStop::forget_positions() noexcept {
    for (std::size_t k = 0; k < window_.size(); ++k) {
        standstill_[k] = Standstill(window_[k]);
    }
}

// By the ways of successive looks, each as long: quantities of counts would spoil shorter ones.
void PvtStop::watch_speed() noexcept {
    if (report_.status_us < looked_us_ + look_us) {
        return;
    }
    std::int64_t way = 0;
    for (const unsigned k : indices(client_->axes())) {
        way += std::abs(std::int64_t{report_.status.position[k]} - looked_.position[k]);
    }
    // By time, since answers may be late.
    way = way * static_cast<std::int64_t>(look_us) / static_cast<std::int64_t>(report_.status_us - looked_us_);
    slows_ = way < way_counts_;
    way_counts_ = way;
    looked_us_ = report_.status_us;
    looked_ = report_.status;
}

bool PvtStop::powerless() const noexcept {
    return report_.status.state == PvtState::fault || report_.status.state == PvtState::disabled;
}

bool PvtStop::still(std::uint64_t least_us) const noexcept {
    return std::all_of(standstill_.begin(), standstill_.begin() + client_->axes(),
                       [least_us](const Standstill& axis) { return axis.still_us() >= least_us; });
}

// The drive gets no more segments before the hold. If its ring is shorter than the reserve by then, it slows down
// earlier, unless a segment in it ends at rest.
PvtStop::Hold PvtStop::hold_by(const DriveReport& answer, const PortTimes& times) const noexcept {
    const PvtStatus& status = answer.status;
    const bool held_then = state_then_ == PvtState::held && status.state == PvtState::held;
    if (command_ == PvtCommand::begin || held_then) {
        return Hold::at_rest;
    }
    bool full_rate = static_cast<double>(status.next - status.executed) * times.segment_us >=
                     times.reserve_us + static_cast<double>(hold_at_us_) - static_cast<double>(answer.status_us);
    // A drive that is out of step may report any numbers.
    const std::uint32_t queued = std::min<std::uint32_t>(status.next - status.executed, PvtClient::queue_capacity);
    for (std::uint32_t i = 0; i < queued && !full_rate; ++i) {
        full_rate = client_->segment(status.executed + i).rest;
    }
    return full_rate && answer.status_us <= hold_at_us_ ? Hold::in_time : Hold::apart;
}

void PvtStop::update(const DriveReport& report, const PortTimes& times) noexcept {
    const bool is_new = report.status_us != report_.status_us;
    if (report.status.state != report_.status.state || state_since_us_ == 0) {
        forget_positions(); // what made it change may have moved the shaft since the last report
        state_since_us_ = report.status_us;
    }
    report_ = report;
    for (std::size_t k = 0; is_new && k < static_cast<std::size_t>(client_->axes()); ++k) {
        standstill_[k].update(report_.status_us, report_.status.position[k]);
    }
    watch_speed();
    if (pending_ == StopRequest::none || report_.command_pending) {
        return;
    }
    if (!report_.command_refused) {
        hold_ = pending_ == StopRequest::hold ? hold_by(report_, times) : hold_;
        const bool quick =
            command_ == PvtCommand::quick_stop; // instead of a power off, which its state does not allow yet
        executed_ = std::max(executed_, quick ? std::min(pending_, StopRequest::quick_stop) : pending_);
        executed_us_ = report_.status_us;
    }
    pending_ = StopRequest::none;
}

PvtCommand PvtStop::command_for(StopRequest request) const noexcept {
    const PvtState state = report_.status.state;
    if (request == StopRequest::hold) {
        return state == PvtState::standing ? PvtCommand::begin
               : state == PvtState::homing ? PvtCommand::quick_stop
                                           : PvtCommand::hold;
    }
    const bool can_disable = state == PvtState::standing || state == PvtState::held || state == PvtState::disabled;
    return request == StopRequest::disable && can_disable ? PvtCommand::disable : PvtCommand::quick_stop;
}

void PvtStop::send_once(StopRequest request, std::uint64_t hold_at_us) noexcept {
    if (request <= pending_) {
        return; // the command is on its way
    }
    pending_ = request;
    command_ = command_for(request);
    state_then_ = report_.status.state;
    hold_at_us_ = hold_at_us;
    const std::uint32_t hold_at = report_.clock.known() ? report_.clock.drive_clock(hold_at_us)
                                                        : report_.status.clock_us; // in the past, so it acts at once
    client_->interrupt(command_, command_ == PvtCommand::begin ? report_.status.executed : hold_at);
}

// The state `standing` or `held` is that of the reference: a load may have pushed the shaft since the report before.
// But a shaft that dithers beyond its window for longer than a push lasts stands by its drive's word. A drive without
// power or in fault needs no command and would refuse one. But a pending command may be `enable`.
StopFacts PvtStop::facts() const noexcept {
    const PvtState state = report_.status.state;
    const bool stands = state == PvtState::standing || state == PvtState::held;
    StopFacts facts{.status_us = report_.status_us,
                    .standstill = (stands && (still(1) || report_.status_us >= state_since_us_ + own_word_us)) ||
                                  (powerless() && still(still_us)),
                    .braking = slows_ && (state == PvtState::stopping || state == PvtState::fault),
                    .executed = executed_,
                    .executed_us = executed_us_};
    if (powerless() && !report_.command_pending) {
        facts.executed = StopRequest::disable;
        facts.executed_us = report_.status_us;
    }
    return facts;
}

} // namespace splinefeed::hal::modbus
