// SPDX-License-Identifier: MIT
//
// All drives have the same numbered segments, the same stop reserve and, within the uncertainty of their clocks, the
// same start time: so they are always at the same point of the path. If one of them is about to run dry (its ring lasts
// for less than the reserve and a guard time), all drives get the same last segment: each slows down by the rule of the
// map, and they stop together, on the path. They drop the segments beyond it, which are sent again.
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/link/wire_groups.hpp"
#include "splinefeed/hal/modbus/pvt/bus_rate.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_setup.hpp"
#include "splinefeed/hal/rt/wait_until.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t settle_us = 40'000; // from a start until the drive's state reflects it
constexpr std::uint64_t poll_interval_us = 1000;
constexpr std::uint32_t unplaced = 0;            // first sequence number while positions are not the machine's
constexpr std::uint64_t stop_exchanges = 8;      // lost in a row before a hold becomes a quick stop
constexpr std::uint64_t braking_us = 60'000'000; // of the slowest ramp that a quick stop is waited for
// For so long a drive is looked at before it gets anything: another host exchanges data with it every 20 ms at least.
constexpr std::uint64_t watch_us = 150'000;

} // namespace

ModbusPort::ModbusPort(const std::vector<DriveWiring>& wiring, const ModbusPortSettings& settings)
    : settings_(settings), stop_(wiring.size()) {
    order(settings.orders);
    std::vector<WireUse> uses;
    uses.reserve(wiring.size());
    for (const DriveWiring& drive : wiring) {
        uses.push_back({drive.link, drive.timing});
    }
    const WireGroups groups = group_by_wire(uses, settings.timing);
    for (const WireUse& wire : groups.wires) {
        settings_.timing = settings_.timing.slower(wire.timing); // the slowest wire determines the waiting times
        buses_.push_back(std::make_unique<ModbusBus>(settings.make_wire(wire.link, wire.timing, *settings.clock)));
    }
    for (const DriveWiring& drive : wiring) {
        ModbusBus& bus = *buses_[groups.of_drive[drives_.size()]];
        drives_.emplace_back(drive, bus.add(drive.link.unit, drive.both_in_one));
        stop_.add(drives_.back().client(), drive.axes);
    }
}

ModbusPort::~ModbusPort() {
    close();
}

void ModbusPort::close() noexcept {
    const bool ended = phase() == ModbusPhase::halted || phase() == ModbusPhase::done || phase() == ModbusPhase::fault;
    if (prepared_ && moves_ && !ended) {
        begin_stop(StopRequest::hold);
        await_stop();
    }
    prepared_ = false;
    for (const auto& bus : buses_) {
        bus->stop();
    }
}

PortFailure ModbusPort::failed(const DriveFailure& failure) {
    failure_ = failure;
    return this->failure();
}

PortFailure ModbusPort::failure() const {
    if (!failure_) {
        return {};
    }
    const auto [drive, problem] = *failure_;
    const DriveReport report = this->report(drive);
    const std::string what = describe(problem);
    switch (problem) {
    case DriveProblem::fault:
        return {what + ", " + fault_text(report.status, wiring(drive).axis_names), drive, Remedy::reset};
    case DriveProblem::unknown_state:
    case DriveProblem::not_standing:
        return {what + "; its state is " + std::to_string(static_cast<unsigned>(report.status.state)), drive};
    case DriveProblem::unreachable: return {what + ": " + drives_[drive].client().link().error(), drive};
    case DriveProblem::silent:
        return {report.last_fault == LinkFault::none
                    ? what
                    : what + ": " + describe(report.last_fault, wiring(drive).link.wire),
                drive};
    default: return {what, drive};
    }
}

PortFailure ModbusPort::open() {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const auto axes = static_cast<int>(drives_[i].wiring().axes.size());
        if (const DriveProblem problem = drives_[i].client().open(axes); problem != DriveProblem::none) {
            return failed({i, problem});
        }
    }
    return find_other_master();
}

// The nonce of a drive changes with every block that it gets, and this port has sent none.
PortFailure ModbusPort::find_other_master() {
    settings_.clock->sleep_us(watch_us);
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const std::uint16_t nonce = drives_[i].client().report().status.nonce;
        if (const DriveProblem problem = drives_[i].client().read_status(); problem != DriveProblem::none) {
            return failed({i, problem});
        }
        if (drives_[i].client().report().status.nonce != nonce) {
            return failed({i, DriveProblem::busy});
        }
    }
    return {};
}

double ModbusPort::least_segment_us() {
    double least = static_cast<double>(pvt::shortest_ticks) / ticks_per_us;
    for (const auto& bus : buses_) {
        least = std::max(least, splinefeed::hal::modbus::least_segment_us(*bus, settings_.timing));
    }
    return least;
}

void ModbusPort::set_times(const FeedSegment& first) noexcept {
    times_.segment_us = static_cast<double>(first.duration_ticks) / ticks_per_us;
    double ring_us = std::min<double>(settings_.buffer_us, PvtClient::queue_capacity * times_.segment_us);
    for (const PortDrive& drive : drives_) {
        const double holds_us = drive.client().report().identity.ring * times_.segment_us;
        ring_us = std::min(ring_us, holds_us);
        phase_times_.ring_us = std::max(phase_times_.ring_us, static_cast<std::uint64_t>(holds_us));
    }
    buffer_segments_ = static_cast<std::uint32_t>(ring_us / times_.segment_us);
    times_.reserve_us =
        1000.0 * std::floor(std::max(1.0, std::min<double>(settings_.stop_reserve_ms, ring_us / 4000.0)));
    times_.silent_us = settings_.silent_us;
    times_.away_us = settings_.away_us;
    times_.settling_us = settle_us;
    phase_times_.port = times_;
    phase_times_.command_us = PortTimes::lead_us + stop_exchanges * settings_.timing.answer_us;
    // A hold may wait for a start that is near, and for what the drives report behind it.
    stop_times_.hold_us = 2 * PortTimes::lead_us + phase_times_.command_us +
                          static_cast<std::uint64_t>(2.0 * times_.reserve_us) + stop_times_.settle_us +
                          PvtStop::own_word_us;
    stop_times_.braking_us = braking_us;
    stop_.set_times(stop_times_, times_);
    phase_times_.stop_us = longest_stop_us() + braking_us;
    phases_.set_bounds(modbus_phase_bounds(phase_times_));
}

PortFailure ModbusPort::prepare(const FeedSegment& first) {
    failure_.reset();
    moves_ = referenced_ = false;
    begin_anew();
    set_times(first);
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const auto reserve_ms = static_cast<std::uint16_t>(times_.reserve_us / 1000.0);
        if (const DriveProblem problem = drives_[i].prepare(first, reserve_ms); problem != DriveProblem::none) {
            return failed({i, problem});
        }
    }
    for (const auto& bus : buses_) {
        bus->start();
    }
    prepared_ = true;
    const auto failure = make_ready();
    if (failure && moves_) { // what was homing still moves
        fail(failure->drive, failure->problem);
        await_stop();
    }
    if (!failure) {
        begin_motion();
    }
    return failure ? failed(*failure) : PortFailure{};
}

// A port whose motion is over takes no stop any more: not even of a homing that follows.
void ModbusPort::begin_anew() noexcept {
    update_drives();
    stop_.reset();
    phases_.take(ModbusEvent::renewed, now_us_);
    phases_.progress(now_us_);
}

void ModbusPort::begin_motion() noexcept {
    begin_anew();
    executed_to_ = drives_.front().client().pushed();
    complete_ = false;
    for (PortDrive& drive : drives_) {
        drive.clear_sent();
        drive.client().hold_back(false);
    }
}

// Behind a motion that was halted the drives may have segments left, which nobody wants any more.
PortFailure ModbusPort::renew(const FeedSegment& first) {
    if (phase() == ModbusPhase::halted) {
        for (std::size_t i = 0; i < drives_.size(); ++i) {
            if (!drives_[i].stand_at(first)) {
                return failed({i, DriveProblem::range});
            }
        }
        PvtSetup setup(drives_, times_, *settings_.clock);
        if (const auto failure = setup.command(PvtCommand::begin, settings_.first_sequence)) {
            return failed(*failure);
        }
    }
    begin_motion();
    return {};
}

std::optional<DriveFailure> ModbusPort::make_ready() {
    PvtSetup setup(drives_, times_, *settings_.clock);
    bool stay_placed = !orders().home;
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        stay_placed = stay_placed && placed(i);
    }
    auto failure = setup.enable(orders().reset);
    failure = failure ? failure : setup.command(PvtCommand::begin, stay_placed ? settings_.first_sequence : unplaced);
    if (!failure && orders().home) {
        moves_ = true;
        failure = setup.home(orders().home_axes, settings_.interrupted);
    }
    failure = failure ? failure : setup.command(PvtCommand::preset_position);
    if (!failure && !stay_placed) { // now they are
        failure = setup.command(PvtCommand::begin, settings_.first_sequence);
    }
    referenced_ = !failure;
    return failure;
}

PortFailure ModbusPort::await_standstill() {
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        PvtClient& client = drives_[i].client();
        DriveProblem problem = DriveProblem::silent;
        const auto stands = [&] {
            if (!client.probe().ok()) {
                problem = DriveProblem::silent;
                return false;
            }
            problem = drives_[i].moves() ? DriveProblem::moves : DriveProblem::none;
            return problem == DriveProblem::none;
        };
        if (wait_until(*settings_.clock, stands, settings_.away_us, "") != nullptr) {
            return failed({i, problem});
        }
        if (client.report().status.state == PvtState::fault && !orders().reset) {
            return failed({i, DriveProblem::fault});
        }
    }
    return {};
}

std::optional<std::int32_t> ModbusPort::known_position(std::size_t drive, std::size_t axis) const noexcept {
    const DriveReport report = drives_[drive].client().report();
    switch (report.problem) {
    case DriveProblem::power_cycled: // it counts from anywhere
    case DriveProblem::out_of_step:  // and who ended the session may have preset it
    case DriveProblem::taken: return std::nullopt;
    default: return referenced_ ? std::optional(report.status.position[axis]) : std::nullopt;
    }
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

// They slow down by what they have. What waits for its exchange is on no drive yet: on a serial line some segments.
std::uint64_t ModbusPort::least_ahead_us() const noexcept {
    constexpr double late_us = 20'000.0;
    constexpr double on_their_way = 8.0; // segments
    return static_cast<std::uint64_t>(2000.0 * settings_.stop_reserve_ms + late_us + on_their_way * times_.segment_us);
}

int ModbusPort::room() const noexcept {
    std::size_t room = PvtClient::queue_capacity;
    for (const PortDrive& drive : drives_) {
        const std::size_t held = PvtClient::queue_capacity - drive.client().room();
        room = std::min({room, drive.client().room(), held < buffer_segments_ ? buffer_segments_ - held : 0});
    }
    return phase() == ModbusPhase::fault || phase() == ModbusPhase::halted ? 0 : static_cast<int>(room);
}

bool ModbusPort::submit(const FeedSegment& segment) noexcept {
    if (phase() == ModbusPhase::fault || phase() == ModbusPhase::halting || phase() == ModbusPhase::halted) {
        return false;
    }
    for (std::size_t i = 0; i < drives_.size(); ++i) {
        const bool carried = drives_[i].carries(segment);
        if (!carried || drives_[i].client().room() == 0) { // no drive gets it
            fail(i, carried ? DriveProblem::overrun : DriveProblem::range);
            return false;
        }
    }
    return std::all_of(drives_.begin(), drives_.end(), [&](PortDrive& drive) { return drive.push(segment); });
}

void ModbusPort::update_drives() noexcept {
    now_us_ = settings_.clock->now_us();
    for (PortDrive& drive : drives_) {
        drive.update(now_us_, times_);
    }
}

void ModbusPort::take(ModbusEvent event) noexcept {
    if (!phases_.take(event, now_us_)) {
        return;
    }
    const ModbusPhase entered = phase();
    const bool holds_back = entered == ModbusPhase::stopping || entered == ModbusPhase::halting ||
                            entered == ModbusPhase::halted || entered == ModbusPhase::fault;
    for (PortDrive& drive : drives_) {
        drive.clear_sent();
        drive.client().hold_back(holds_back);
    }
    stop_at_ = entered == ModbusPhase::stopping ? common_end() : stop_at_;
}

// All drives are held on the path; the port is in fault when they stand.
void ModbusPort::fail(std::size_t drive, DriveProblem problem, ModbusEvent event) noexcept {
    failure_ = DriveFailure{drive, problem};
    begin_stop(StopRequest::hold, event);
}

void ModbusPort::begin_stop(StopRequest request, ModbusEvent event) noexcept {
    update_drives();
    stop_.request(request, now_us_);
    take(event);
}

void ModbusPort::await_stop() noexcept {
    while (phase() == ModbusPhase::halting) {
        settings_.clock->sleep_us(poll_interval_us);
        poll();
    }
}

PortState ModbusPort::poll() noexcept {
    update_drives();
    if (const auto event = look()) {
        take(*event);
    } else if (phases_.overdue(now_us_) != nullptr) {
        if (phase() == ModbusPhase::starting) {
            take(ModbusEvent::overdue);
        } else if (phase() == ModbusPhase::halting) { // a fault without a reason would be none
            failure_ = failure_.value_or(DriveFailure{stop_.sequence().unconfirmed(), DriveProblem::not_standing});
            take(ModbusEvent::overdue);
        } else {
            const DriveFailure late = culprit();
            fail(late.drive, late.problem, ModbusEvent::overdue);
        }
    }
    const std::uint32_t now = executed();
    if (now != executed_to_ && phase() == ModbusPhase::running) {
        phases_.progress(now_us_);
    }
    executed_ += now - executed_to_; // sequence numbers wrap
    executed_to_ = now;
    const PortPhase phase = this->phase() == ModbusPhase::fault    ? PortPhase::fault
                            : this->phase() == ModbusPhase::done   ? PortPhase::idle
                            : this->phase() == ModbusPhase::halted ? PortPhase::halted
                                                                   : PortPhase::running;
    return {phase, executed_};
}

void ModbusPort::quick_stop() noexcept {
    begin_stop(StopRequest::quick_stop);
}

void ModbusPort::power_off() noexcept {
    begin_stop(StopRequest::disable);
    await_stop();
}

void ModbusPort::halt() noexcept {
    if (phase() != ModbusPhase::fault && phase() != ModbusPhase::done) {
        begin_stop(StopRequest::hold);
    }
}

} // namespace splinefeed::hal::modbus
