// SPDX-License-Identifier: MIT
//
// All drives have the same numbered segments, the same stop reserve and, within the uncertainty of their clocks, the
// same start time: so they are always at the same point of the path. If one of them is about to run dry (its ring lasts
// for less than the reserve and a guard time), all drives get the same last segment: each slows down by the rule of the
// map, and they stop together, on the path. They drop the segments beyond it, which are sent again.
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"

#include "splinefeed/hal/modbus/link/wire_groups.hpp"
#include "splinefeed/hal/modbus/pvt/bus_rate.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_setup.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t lead_us = 60'000;   // from sending a command to the instant that it names
constexpr std::uint64_t settle_us = 40'000; // from a start until the drive's state reflects it
constexpr double guard_us = 60'000.0;       // to send the last segment when one drive runs dry
constexpr std::uint64_t poll_interval_us = 1000;
constexpr double ticks_per_us = 8.0;
constexpr std::uint64_t stop_exchanges = 8; // lost in a row before a hold becomes a quick stop

} // namespace

ModbusPort::ModbusPort(const std::vector<DriveWiring>& wiring, const ModbusPortSettings& settings)
    : settings_(settings), stop_(wiring.size()) {
    std::vector<WireUse> uses;
    uses.reserve(wiring.size());
    for (const DriveWiring& drive : wiring) {
        uses.push_back({drive.link, drive.timing});
    }
    const WireGroups groups = group_by_wire(uses, settings.timing);
    for (const WireUse& wire : groups.wires) {
        settings_.timing = settings_.timing.slower(wire.timing); // the slowest wire determines the waiting times
        buses_.push_back(std::make_unique<ModbusBus>(settings.make_line(wire.link, wire.timing, *settings.clock)));
    }
    for (const DriveWiring& drive : wiring) {
        for (const PvtAxis& axis : drive.axes) {
            axes_ = std::max(axes_, axis.machine_axis + 1);
        }
        ModbusBus& bus = *buses_[groups.of_drive[drives_.size()]];
        drives_.emplace_back(drive, bus.add(drive.link.unit, drive.both_in_one));
        stop_.add(drives_.back().client());
    }
}

ModbusPort::~ModbusPort() {
    close();
}

void ModbusPort::close() noexcept {
    const bool ended = phase_ == ModbusPhase::halted || phase_ == ModbusPhase::done || phase_ == ModbusPhase::fault;
    if (prepared_ && !ended) {
        begin_stop(StopRequest::hold);
        await_stop();
    }
    prepared_ = false;
    for (const auto& bus : buses_) {
        bus->stop();
    }
}

std::optional<DriveFailure> ModbusPort::open() {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const auto axes = static_cast<int>(drives_[i].wiring().axes.size());
        if (const DriveProblem problem = drives_[i].client().open(axes); problem != DriveProblem::none) {
            return DriveFailure{i, problem};
        }
    }
    return std::nullopt;
}

double ModbusPort::least_segment_us() {
    double least = pvt::shortest_ticks / ticks_per_us;
    for (const auto& bus : buses_) {
        least = std::max(least, splinefeed::hal::modbus::least_segment_us(*bus, settings_.timing));
    }
    return least;
}

std::optional<DriveFailure> ModbusPort::prepare(const FeedSegment& first) {
    times_.segment_us = first.duration_ticks / ticks_per_us;
    double ring_us = settings_.buffer_us;
    for (const PortDrive& drive : drives_) {
        ring_us = std::min(ring_us, drive.client().report().identity.ring * times_.segment_us);
    }
    ring_us = std::min(ring_us, PvtClient::queue_capacity * times_.segment_us);
    buffer_segments_ = static_cast<std::uint32_t>(ring_us / times_.segment_us);
    const double reserve_ms = std::max(1.0, std::min<double>(settings_.stop_reserve_ms, ring_us / 4000.0));
    const auto stop_reserve_ms = static_cast<std::uint16_t>(reserve_ms);
    times_.reserve_us = 1000.0 * stop_reserve_ms;
    times_.silent_us = settings_.silent_us;
    times_.settling_us = settle_us;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        if (const DriveProblem problem = drives_[i].prepare(first, stop_reserve_ms); problem != DriveProblem::none) {
            return DriveFailure{i, problem};
        }
    }
    stop_times_.hold_us = lead_us + static_cast<std::uint64_t>(2.0 * times_.reserve_us) +
                          stop_exchanges * settings_.timing.answer_us + stop_times_.settle_us;
    stop_.set_times(stop_times_, times_);
    for (const auto& bus : buses_) {
        bus->start();
    }
    prepared_ = true;
    PvtSetup setup(drives_, times_, *settings_.clock);
    auto failure = setup.enable(settings_.away_us);
    failure = failure ? failure : setup.command(PvtCommand::begin, settings_.first_sequence);
    if (!failure && settings_.home) {
        failure = setup.home(settings_.interrupted);
        if (failure) { // drives that are still homing move
            quick_stop();
            await_stop();
        }
    }
    failure = failure ? failure : setup.command(PvtCommand::preset_position);
    if (!failure) {
        update_drives();
        executed_to_ = settings_.first_sequence;
        enter(ModbusPhase::filling);
    }
    return failure;
}

std::uint64_t ModbusPort::busy_us() const noexcept {
    std::uint64_t sum = 0;
    for (const auto& bus : buses_) {
        sum += bus->busy_us();
    }
    return sum;
}

std::uint32_t ModbusPort::executed() const noexcept {
    std::uint32_t least = drives_.front().status().executed;
    for (const PortDrive& drive : drives_) {
        least = pvt::earlier(least, drive.status().executed);
    }
    return least;
}

int ModbusPort::do_room() const noexcept {
    std::size_t room = PvtClient::queue_capacity;
    for (const PortDrive& drive : drives_) {
        const std::size_t held = PvtClient::queue_capacity - drive.client().room();
        room = std::min({room, drive.client().room(), held < buffer_segments_ ? buffer_segments_ - held : 0});
    }
    return phase_ == ModbusPhase::fault || phase_ == ModbusPhase::halted ? 0 : static_cast<int>(room);
}

bool ModbusPort::do_submit(const FeedSegment& segment) noexcept {
    if (phase_ == ModbusPhase::fault || phase_ == ModbusPhase::halting || phase_ == ModbusPhase::halted) {
        return false;
    }
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const bool carried = drives_[i].carries(segment);
        if (!carried || drives_[i].client().room() == 0) { // no drive gets it
            fail(i, carried ? DriveProblem::overrun : DriveProblem::range);
            return false;
        }
    }
    const std::span<const std::int64_t> velocities(segment.end_velocity.data(), static_cast<std::size_t>(axes_));
    const bool rests = std::all_of(velocities.begin(), velocities.end(), [](std::int64_t v) { return v == 0; });
    return std::all_of(drives_.begin(), drives_.end(), [&](PortDrive& drive) { return drive.push(segment, rests); });
}

void ModbusPort::update_drives() noexcept {
    now_us_ = settings_.clock->now_us();
    for (PortDrive& drive : drives_) {
        drive.update(now_us_, times_);
    }
}

void ModbusPort::enter(ModbusPhase phase) noexcept {
    phase_ = phase;
    entered_us_ = now_us_;
    for (PortDrive& drive : drives_) {
        drive.clear_sent();
        drive.client().hold_back(phase == ModbusPhase::stopping || phase == ModbusPhase::halting ||
                                 phase == ModbusPhase::halted || phase == ModbusPhase::fault);
    }
}

// Stops the other drives on the path; the port is in fault when they stand.
void ModbusPort::fail(std::size_t drive, DriveProblem problem) noexcept {
    failure_ = DriveFailure{drive, problem};
    begin_stop(StopRequest::hold);
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
    return lead_us + lost * settings_.timing.answer_us;
}

// Starts all drives at one instant; a drive that stands ahead of the others starts later by that much.
void ModbusPort::start() noexcept {
    const std::uint32_t first = executed();
    for (PortDrive& drive : drives_) {
        const double ahead_us = (drive.status().executed - first) * times_.segment_us;
        const std::uint64_t at_us = now_us_ + start_lead_us() + static_cast<std::uint64_t>(ahead_us);
        started_us_ = std::max(started_us_, at_us + settle_us);
        drive.start(at_us, times_);
    }
    enter(ModbusPhase::starting);
}

// Checks whether all drives run and have segments for long enough to stop the others in time. If not, stops all.
void ModbusPort::check_drives() noexcept {
    if (now_us_ < started_us_) {
        return;
    }
    bool all_done = complete_;
    bool must_stop = false;
    for (const PortDrive& drive : drives_) {
        const bool has_all = complete_ && drive.has_all();
        const bool done = has_all && drive.executed_all();
        all_done = all_done && done && drive.at_standstill();
        must_stop = must_stop || drive.last_report().problem != DriveProblem::none ||
                    drive.status().state == PvtState::stopping || (!done && drive.lag_us() > PortDrive::lag_limit_us) ||
                    (!has_all && drive.left_us(times_) < times_.reserve_us + guard_us) ||
                    (has_all && drive.age_us() > settings_.away_us) || (drive.at_standstill() && !done);
    }
    if (all_done) {
        enter(ModbusPhase::done);
    } else if (must_stop) {
        std::optional<std::uint32_t> first;
        for (const PortDrive& drive : drives_) {
            if (drive.last_report().problem == DriveProblem::none) {
                first = pvt::earlier(first.value_or(drive.status().next), drive.status().next);
            }
        }
        stop_at_ = first.value_or(executed());
        enter(ModbusPhase::stopping);
    }
}

void ModbusPort::stop_together() noexcept {
    for (PortDrive& drive : drives_) {
        if (drive.online(times_) && !drive.at_standstill() && drive.status().next != stop_at_) {
            drive.end_at(stop_at_, now_us_, times_);
        }
    }
    if (all_at_standstill()) {
        enter(ModbusPhase::waiting);
    }
}

bool ModbusPort::all_at_standstill() const noexcept {
    return std::all_of(drives_.begin(), drives_.end(),
                       [&](const PortDrive& drive) { return drive.presumed_at_standstill(times_); });
}

// Waits until every drive is online and ready, then starts or resumes all together.
void ModbusPort::await_all() noexcept {
    bool ready = true;
    bool done = complete_;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const PortDrive& drive = drives_[i];
        const DriveProblem problem = drive.last_report().problem != DriveProblem::none ? drive.last_report().problem
                                     : drive.age_us() > settings_.away_us              ? DriveProblem::silent
                                     : drive.status().state == PvtState::disabled      ? DriveProblem::refused
                                                                                       : DriveProblem::none;
        if (problem != DriveProblem::none) {
            fail(i, problem);
            return;
        }
        ready = ready && drive.online(times_) && drive.at_standstill() && !drive.pending();
        done = done && drive.executed_all();
    }
    if (ready && done) {
        enter(ModbusPhase::done);
    } else if (ready && filled()) {
        resumes_ += phase_ == ModbusPhase::waiting ? 1U : 0U;
        start();
    }
}

void ModbusPort::begin_stop(StopRequest request) noexcept {
    update_drives();
    stop_.request(request, now_us_, now_us_ + lead_us, drives_);
    if (phase_ != ModbusPhase::halting) {
        enter(ModbusPhase::halting);
    }
}

void ModbusPort::follow_stop() noexcept {
    stop_.update(now_us_, drives_);
    if (phase_ == ModbusPhase::halting && stop_.sequence().settled()) {
        enter(failure_ ? ModbusPhase::fault : ModbusPhase::halted);
    }
}

void ModbusPort::await_stop() noexcept {
    while (phase_ == ModbusPhase::halting) {
        settings_.clock->sleep_us(poll_interval_us);
        update_drives();
        follow_stop();
    }
}

std::uint64_t ModbusPort::longest_stop_us() const noexcept {
    return stop_times_.hold_us + stop_times_.quick_stop_us + stop_times_.disable_us;
}

PortState ModbusPort::do_poll() noexcept {
    update_drives();
    switch (phase_) {
    case ModbusPhase::filling:
    case ModbusPhase::waiting: await_all(); break;
    case ModbusPhase::starting:
        if (PvtSetup::carried_out(drives_)) {
            enter(ModbusPhase::running);
        } else if (now_us_ > entered_us_ + PvtSetup::command_us) {
            enter(ModbusPhase::stopping);
        }
        break;
    case ModbusPhase::running: check_drives(); break;
    case ModbusPhase::stopping: stop_together(); break;
    case ModbusPhase::halting:
    case ModbusPhase::halted:
    case ModbusPhase::fault: follow_stop(); break;
    case ModbusPhase::done: break;
    }
    const PortPhase phase = phase_ == ModbusPhase::fault    ? PortPhase::fault
                            : phase_ == ModbusPhase::done   ? PortPhase::idle
                            : phase_ == ModbusPhase::halted ? PortPhase::halted
                                                            : PortPhase::running;
    const std::uint32_t now = executed();
    executed_ += now - executed_to_; // sequence numbers wrap
    executed_to_ = now;
    return {phase, executed_};
}

void ModbusPort::quick_stop() noexcept {
    begin_stop(StopRequest::quick_stop);
}

void ModbusPort::power_off() noexcept {
    begin_stop(StopRequest::disable);
    await_stop();
}

void ModbusPort::do_halt() noexcept {
    if (phase_ != ModbusPhase::fault && phase_ != ModbusPhase::done) {
        begin_stop(StopRequest::hold);
    }
}

} // namespace splinefeed::hal::modbus
