// SPDX-License-Identifier: MIT
// What a ModbusPort looks for in each of its phases, and which drive keeps it from going on.
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"

#include "splinefeed/hal/modbus/pvt/pvt_setup.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr double guard_us = 60'000.0;     // to send the last segment when one drive runs dry
constexpr unsigned most_vain_starts = 10; // in a row: on a bad line one or two may be

} // namespace

// What a drive does that keeps the phase from its end; `none`: nothing.
DriveProblem ModbusPort::delay_by(const PortDrive& drive) const noexcept {
    if (const DriveProblem problem = drive.lasting_problem(times_); problem != DriveProblem::none) {
        return problem;
    }
    switch (phase()) {
    case ModbusPhase::running:
        return !(complete_ && drive.executed_all())
                   ? drive.status().executed == executed() ? DriveProblem::frozen : DriveProblem::none
               : drive.at_standstill() ? DriveProblem::none
                                       : DriveProblem::unfinished;
    case ModbusPhase::stopping:
        return drive.presumed_at_standstill(times_) ? DriveProblem::none : DriveProblem::not_standing;
    default: return drive.unready(times_);
    }
}

// The drive that keeps the phase from its end, the first one of several.
DriveFailure ModbusPort::culprit() const noexcept {
    std::size_t lacks = 0; // segments
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        if (const DriveProblem problem = delay_by(drives_[i]); problem != DriveProblem::none) {
            return {i, problem};
        }
        lacks = drives_[lacks].has_all() ? i : lacks;
    }
    return {lacks, DriveProblem::takes_nothing};
}

// Whether every drive has enough segments to start, counted from the drive that is furthest behind, which determines
// the room. A drive ahead of it starts later and gets its segments meanwhile, or is at the end.
bool ModbusPort::filled() const noexcept {
    const std::uint32_t first = executed();
    return std::all_of(drives_.begin(), drives_.end(), [&](const PortDrive& drive) {
        const std::uint32_t has = drive.status().next - first;
        const bool all = complete_ && drive.has_all();
        return has > 0 && (all || 8 * has >= 7 * buffer_segments_) && drive.last_report().clock.known();
    });
}

// Includes time to repeat a lost start command.
std::uint64_t ModbusPort::start_lead_us() const noexcept {
    constexpr std::uint64_t lost = 2;
    return PortTimes::lead_us + lost * settings_.timing.answer_us;
}

// Starts all drives at one instant; a drive that stands ahead of the others starts later by that much.
void ModbusPort::start() noexcept {
    const std::uint32_t first = executed();
    for (PortDrive& drive : drives_) {
        const double ahead_us = (drive.status().executed - first) * times_.segment_us;
        const std::uint64_t at_us = now_us_ + start_lead_us() + static_cast<std::uint64_t>(ahead_us);
        started_us_ = std::max(started_us_, at_us + times_.settling_us);
        drive.start(at_us, times_);
    }
    moves_ = true;
    phase_times_.start_us = started_us_ - now_us_;
    phases_.set_bounds(modbus_phase_bounds(phase_times_));
}

// The drive that has executed fewer segments than all others; if there is none, the one for which all stopped last.
std::size_t ModbusPort::latest() const noexcept {
    const std::uint32_t least = executed();
    const auto last = [least](const PortDrive& drive) {
        return drive.status().executed == least;
    };
    const auto first = std::find_if(drives_.begin(), drives_.end(), last);
    return std::count_if(drives_.begin(), drives_.end(), last) == 1 ? static_cast<std::size_t>(first - drives_.begin())
                                                                    : disturber_;
}

// Whether the drives were started again and again, and nothing came of it.
bool ModbusPort::starts_in_vain() noexcept {
    vain_starts_ = executed_ == started_at_ ? vain_starts_ + 1 : 0;
    started_at_ = executed_;
    return vain_starts_ > most_vain_starts;
}

// Whether all drives run and have segments for long enough to stop the others in time.
std::optional<ModbusEvent> ModbusPort::look_at_motion() noexcept {
    if (now_us_ < started_us_) {
        phases_.progress(now_us_);
        return std::nullopt;
    }
    bool all_done = complete_;
    bool must_stop = false;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const PortDrive& drive = drives_[i];
        const bool has_all = complete_ && drive.has_all();
        const bool done = has_all && drive.executed_all();
        const bool disturbs = drive.last_report().problem != DriveProblem::none ||
                              (!done && drive.status().state != PvtState::running) ||
                              (!done && drive.lag_us() > PortDrive::lag_limit_us) ||
                              (!has_all && drive.left_us(times_) < times_.reserve_us + guard_us) ||
                              (has_all && drive.age_us() > times_.away_us);
        all_done = all_done && done && drive.at_standstill();
        disturber_ = disturbs && !must_stop ? i : disturber_;
        must_stop = must_stop || disturbs;
    }
    return all_done    ? std::optional(ModbusEvent::executed)
           : must_stop ? std::optional(ModbusEvent::disturbed)
                       : std::nullopt;
}

// The end of the shortest ring.
std::uint32_t ModbusPort::common_end() const noexcept {
    std::optional<std::uint32_t> first;
    for (const PortDrive& drive : drives_) {
        if (drive.last_report().problem == DriveProblem::none) {
            first = pvt::earlier(first.value_or(drive.status().next), drive.status().next);
        }
    }
    return first.value_or(executed());
}

void ModbusPort::stop_together() noexcept {
    for (PortDrive& drive : drives_) {
        if (drive.online(times_) && !drive.at_standstill() && drive.status().next != stop_at_) {
            drive.end_at(stop_at_, now_us_, times_);
        }
    }
}

bool ModbusPort::accepted_more() noexcept {
    std::uint32_t sum = 0;
    for (const PortDrive& drive : drives_) {
        sum += drive.status().next;
    }
    const bool more = sum != accepted_to_;
    accepted_to_ = sum;
    return more;
}

// Starts or resumes all together as soon as every drive is online, ready and filled. Segments that nobody has submitted
// yet no drive owes: for those the port waits as long as it takes.
std::optional<ModbusEvent> ModbusPort::look_at_standstill() noexcept {
    bool ready = true;
    bool done = complete_;
    bool has_all = true;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const PortDrive& drive = drives_[i];
        if (const DriveProblem problem = drive.lasting_problem(times_); problem != DriveProblem::none) {
            fail(i, problem);
            return std::nullopt;
        }
        ready = ready && drive.unready(times_) == DriveProblem::none;
        done = done && drive.executed_all();
        has_all = has_all && drive.has_all();
    }
    if (ready && done) {
        return ModbusEvent::executed;
    }
    if (ready && filled()) {
        if (starts_in_vain()) {
            const std::size_t late = latest();
            fail(late, drives_[late].refuses_start() ? DriveProblem::refused : DriveProblem::frozen);
            return std::nullopt;
        }
        resumes_ += phase() == ModbusPhase::waiting ? 1U : 0U;
        start();
        return ModbusEvent::ready;
    }
    if (accepted_more() || (ready && has_all)) {
        phases_.progress(now_us_);
    }
    return std::nullopt;
}

// A host that paused may be late for each of its requests, so the phase's bound counts from the last one.
void ModbusPort::follow_stop() noexcept {
    if (stop_.update(now_us_, drives_)) {
        phases_.progress(now_us_);
    }
}

std::optional<ModbusEvent> ModbusPort::look() noexcept {
    switch (phase()) {
    case ModbusPhase::filling:
    case ModbusPhase::waiting: return look_at_standstill();
    case ModbusPhase::starting:
        return PvtSetup::carried_out(drives_) ? std::optional(ModbusEvent::started) : std::nullopt;
    case ModbusPhase::running: return look_at_motion();
    case ModbusPhase::stopping:
        stop_together();
        return std::ranges::all_of(drives_,
                                   [&](const PortDrive& drive) { return drive.presumed_at_standstill(times_); })
                   ? std::optional(ModbusEvent::stands)
                   : std::nullopt;
    case ModbusPhase::halting:
    case ModbusPhase::halted:
    case ModbusPhase::fault:
        follow_stop();
        return !stop_.sequence().settled() ? std::nullopt
                                           : std::optional(failure_ ? ModbusEvent::failed : ModbusEvent::settled);
    default: return std::nullopt;
    }
}

} // namespace splinefeed::hal::modbus
