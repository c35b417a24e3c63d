// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/port_drive.hpp"

#include <algorithm>
#include <cstdlib>

namespace splinefeed::hal::modbus {

namespace {

constexpr double command_transit_us = 10'000.0; // time for a command to arrive

} // namespace

bool PortDrive::stand_at(const FeedSegment& first) noexcept {
    const PvtStatus status = client_->report().status;
    for (const unsigned k : indices(client_->axes())) {
        last_.end[k] = std::int64_t{status.position[k]} * (1 << PvtSegment::position_bits);
    }
    FeedSegment standing = first;
    standing.end = first.start;
    standing.end_velocity = {};
    if (!to_pvt(standing, wiring_.axes, last_)) {
        return false;
    }
    last_.rest = false;
    preset_ = last_.end;
    trim_ = {};
    lag_us_ = 0.0;
    starting_ = start_refused_ = false;
    return true;
}

DriveProblem PortDrive::prepare(const FeedSegment& first, std::uint16_t stop_reserve_ms) noexcept {
    if (!stand_at(first)) {
        return DriveProblem::range;
    }
    return client_->configure({stop_reserve_ms, wiring_.watchdog_ms, wiring_.following_window});
}

double PortDrive::gain_us(double host_us) const noexcept {
    const auto at_us = static_cast<std::uint64_t>(host_us);
    return static_cast<double>(client_->drive_us(at_us) - static_cast<std::int64_t>(at_us));
}

bool PortDrive::carries(const FeedSegment& segment) const noexcept {
    PvtSegment ignored;
    return to_pvt(segment, wiring_.axes, ignored);
}

bool PortDrive::push(const FeedSegment& segment) noexcept {
    if (!to_pvt(segment, wiring_.axes, last_)) {
        return false;
    }
    if (trim_.anchored()) {
        const double gain = gain_us(trim_.next_end_us(segment.duration_ticks)) - gained_us_;
        last_.duration_ticks =
            std::clamp(trim_.trimmed(segment.duration_ticks, gain), pvt::shortest_ticks, pvt::longest_ticks);
    }
    return client_->push(last_);
}

// After n executed segments the drive is within the next one, no further than its end. Answers come at different points
// of a segment, so some of them bound the lag closely.
void PortDrive::update(std::uint64_t now_us, const PortTimes& times) noexcept {
    report_ = client_->report();
    age_us_ = now_us > report_.answered_us ? now_us - report_.answered_us : 0;
    const auto status_us = static_cast<double>(report_.status_us);
    if (starting_ && !report_.command_pending) { // a start that arrived too late took place then
        starting_ = false;
        start_refused_ = report_.command_refused;
        lag_us_ = std::max(lag_us_, status_us - start_us_);
    }
    ran_ += status().executed - ran_to_; // sequence numbers wrap
    ran_to_ = status().executed;
    if (trim_.anchored() && status_us > full_rate_us_ && !executed_all()) {
        const double most_us = static_cast<double>(ran_ + 1) * times.segment_us;
        lag_us_ =
            std::max(lag_us_, status_us - began_us_ - most_us - clock_uncertainty_us_ - report_.clock.uncertainty_us());
    }
}

DriveProblem PortDrive::lasting_problem(const PortTimes& times) const noexcept {
    return report_.problem != DriveProblem::none  ? report_.problem
           : age_us_ > times.away_us              ? DriveProblem::silent
           : status().state == PvtState::disabled ? DriveProblem::switched_off
                                                  : DriveProblem::none;
}

DriveProblem PortDrive::unready(const PortTimes& times) const noexcept {
    return !online(times) || !report_.clock.known() ? DriveProblem::silent
           : report_.command_pending                ? DriveProblem::ignores
           : !at_standstill()                       ? DriveProblem::not_standing
                                                    : DriveProblem::none;
}

// By its positions: `executed` is what the last `begin` said, which a drive that has moved since its last answer
// accepts, too.
bool PortDrive::at_joint() const noexcept {
    const bool first = status().executed == client_->first();
    if (first && status().state != PvtState::standing) {
        return false;
    }
    const PerAxis<std::int64_t>& joint = first ? preset_ : client_->segment(status().executed - 1).end;
    for (std::size_t k = 0; k < wiring_.axes.size(); ++k) {
        const std::int64_t off = (std::int64_t{status().position[k]} << PvtSegment::position_bits) - joint[k];
        if (std::abs(off) > wiring_.axes[k].window_counts << PvtSegment::position_bits) {
            return false;
        }
    }
    return true;
}

bool PortDrive::moves() const noexcept {
    const PvtState state = client_->report().status.state;
    return state == PvtState::running || state == PvtState::stopping || state == PvtState::homing;
}

bool PortDrive::at_standstill() const noexcept {
    const PvtState state = status().state;
    return state == PvtState::held || state == PvtState::standing || state == PvtState::disabled ||
           state == PvtState::fault;
}

bool PortDrive::presumed_at_standstill(const PortTimes& times) const noexcept {
    const bool counts =
        report_.problem != DriveProblem::words_swapped && report_.problem != DriveProblem::unknown_state;
    if (counts && online(times)) {
        return at_standstill();
    }
    const double whole_us = (status().next - status().executed) * times.segment_us;
    return static_cast<double>(age_us_) > whole_us + 2.0 * times.reserve_us + static_cast<double>(times.settling_us);
}

double PortDrive::left_us(const PortTimes& times) const noexcept {
    return static_cast<std::int32_t>(status().next - status().executed) * times.segment_us -
           static_cast<double>(age_us_);
}

void PortDrive::send_once(PvtCommand command, std::uint32_t argument) noexcept {
    if (!sent_ && !report_.command_pending) {
        client_->command(command, argument);
        sent_ = report_.command_pending = true;
        report_.command_refused = false;
    }
}

void PortDrive::start(std::uint64_t at_us, const PortTimes& times) noexcept {
    const bool held = status().state == PvtState::held;
    clear_sent();
    send_once(held ? PvtCommand::resume : PvtCommand::start, report_.clock.drive_clock(at_us));
    starting_ = true;
    start_us_ = static_cast<double>(at_us);
    from_joint_ = at_joint();
    // A drive that speeds up from rest loses one reserve of motion time.
    began_us_ = static_cast<double>(at_us) + (held ? times.reserve_us : 0.0);
    full_rate_us_ = began_us_ + (held ? times.reserve_us : 0.0);
    ran_ = 0;
    ran_to_ = status().executed;
    clock_uncertainty_us_ = report_.clock.uncertainty_us();
    max_clock_uncertainty_us_ = std::max(max_clock_uncertainty_us_, clock_uncertainty_us_);
    lag_us_ = 0.0;
    const double queued_us = (client_->pushed() - status().executed) * times.segment_us;
    trim_.anchor(began_us_ + queued_us);
    gained_us_ = gain_us(trim_.next_end_us(0));
}

bool PortDrive::starts_about(std::uint64_t now_us) const noexcept {
    constexpr auto lead_us = static_cast<double>(PortTimes::lead_us);
    return std::abs(static_cast<double>(now_us) - start_us_) < lead_us &&
           static_cast<double>(report_.status_us) <= start_us_;
}

void PortDrive::end_at(std::uint32_t sequence, std::uint64_t now_us, const PortTimes& times) noexcept {
    const double left =
        static_cast<std::int32_t>(sequence - status().executed) * times.segment_us - static_cast<double>(age_us_);
    const bool too_near = refused() || left < times.reserve_us + command_transit_us;
    if (refused()) {
        clear_sent();
    }
    send_once(too_near ? PvtCommand::hold : PvtCommand::end, too_near ? report_.clock.drive_clock(now_us) : sequence);
}

} // namespace splinefeed::hal::modbus
