// SPDX-License-Identifier: MIT
//
// A drive counts its own positions: its position at the start of the motion becomes a constant offset, so that nothing
// jumps. If a drive is in fault or offline, the motion's clock slows down for all others, which stay on the path. The
// offline drive stops by itself and leaves the path.
#include "splinefeed/hal/modbus/setpoint/setpoint_port.hpp"

#include "splinefeed/hal/modbus/link/wire_groups.hpp"
#include "splinefeed/hal/modbus/profile/drive_timing.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_standby.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::size_t buffer_segments = 4096;
constexpr double ticks_per_us = 8.0;
constexpr std::uint64_t lead_us = 50'000;
constexpr std::uint64_t online_us = 50'000;
constexpr std::uint64_t retain_us = 100'000;   // of past segments: bus threads may still read them
constexpr std::uint64_t arrive_us = 5'000'000; // time limit for the drives to report arrival
constexpr std::uint64_t settle_us = 50'000;    // settling time of the shafts
constexpr double us_per_s = 1e6;
constexpr std::uint64_t poll_interval_us = 1000;
constexpr double standstill_counts = 2.0; // distance from the target that still counts as standing there
constexpr unsigned stop_turns = 10;       // periods of a bus until a command and its status have passed

} // namespace

SetpointPort::SetpointPort(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings)
    : settings_(settings), motion_(buffer_segments, settings.reserve_us), facts_(wiring.size()),
      stop_(wiring.size(), {}) {
    std::vector<WireUse> uses;
    uses.reserve(wiring.size());
    for (const SetpointWiring& drive : wiring) {
        uses.push_back({drive.link, timing_of(drive.profile->link)});
    }
    const WireGroups groups = group_by_wire(uses, settings.timing);
    for (const WireUse& wire : groups.wires) {
        buses_.push_back(std::make_unique<SetpointBus>(settings.make_line(wire.link, wire.timing, *settings.clock)));
    }
    for (const SetpointWiring& drive : wiring) {
        Slot slot;
        slot.wiring = drive;
        slot.bus = buses_[groups.of_drive[slots_.size()]].get();
        slot.index = slot.bus->drives();
        static_cast<void>(slot.bus->add(*drive.profile, drive.link.unit));
        slot.frame = AxisFrame(drive.inverted, drive.profile->field_of(FieldRole::target_position));
        slots_.push_back(std::move(slot));
    }
}

std::string SetpointPort::open() {
    for (trouble_with_ = 0; trouble_with_ < slots_.size(); ++trouble_with_) {
        const Slot& slot = slots_[trouble_with_];
        if (std::string what = slot.bus->drive(slot.index).open(); !what.empty()) {
            return what;
        }
    }
    trouble_with_ = 0;
    for (const auto& bus : buses_) {
        period_us_ = std::max(period_us_, bus->shortest_period_us());
    }
    return {};
}

LinkAnswer SetpointPort::probe(std::size_t drive) noexcept {
    SetpointDrive& asked = slots_[drive].bus->drive(slots_[drive].index);
    static_cast<void>(asked.read_next());
    return asked.last_answer();
}

std::string SetpointPort::prepare(const FeedSegment& first) {
    segment_us_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(first.duration_ticks / ticks_per_us));
    SetpointStandby standby(settings_.away_us);
    for (const bool enabled : {false, true}) { // enable all drives before the first one is homed
        for (trouble_with_ = 0; trouble_with_ < slots_.size(); ++trouble_with_) {
            Slot& slot = slots_[trouble_with_];
            SetpointDrive& drive = slot.bus->drive(slot.index);
            bool elsewhere = false;
            const auto poll_others = [&] {
                std::string what = standby.poll_others(drive);
                elsewhere = elsewhere || !what.empty();
                return what;
            };
            const SetpointSettings settings{.axis = slot.wiring.axis,
                                            .period_us = period_us_,
                                            .acceleration_counts_s2 = slot.wiring.acceleration_counts_s2,
                                            .home = settings_.home,
                                            .interrupted = settings_.interrupted,
                                            .ramp_counts_s2 = slot.wiring.ramp_counts_s2,
                                            .fastest_counts_s = slot.wiring.fastest_counts_s,
                                            .meanwhile = poll_others};
            if (std::string what = enabled ? drive.begin(settings) : drive.enable(settings); !what.empty()) {
                trouble_with_ = elsewhere ? standby.troubled() : trouble_with_;
                return what;
            }
            const std::int64_t start = first.start[static_cast<std::size_t>(slot.wiring.axis)];
            if (!enabled) {
                standby.add(drive);
            } else if (!slot.frame.align(drive.reading().position_q16, start)) {
                return AxisFrame::out_of_range;
            }
        }
    }
    for (const Slot& slot : slots_) {
        motion_.ahead_us = std::max(motion_.ahead_us, std::uint64_t{2} * horizon_us(slot.wiring, period_us_));
    }
    const std::uint64_t turns_us = stop_turns * std::uint64_t{period_us_} * slots_.size() + standstill_us;
    stop_times_.hold_us = lead_us + std::uint64_t{2} * settings_.reserve_us + turns_us + answers_us();
    stop_times_.quick_stop_us += turns_us;
    stop_times_.disable_us += turns_us;
    stop_.set_times(stop_times_);
    began_us_ = settings_.clock->now_us();
    const auto ahead_us = static_cast<std::uint32_t>(motion_.ahead_us);
    settings_.buffer_us = std::max(settings_.buffer_us, 2 * (settings_.reserve_us + ahead_us));
    for (const auto& bus : buses_) {
        bus->start(motion_, period_us_);
    }
    return {};
}

// Duration of a few consecutive failed exchanges on the slowest wire.
std::uint64_t SetpointPort::answers_us() const noexcept {
    constexpr std::uint64_t lost = 4;
    std::uint64_t longest_us = settings_.timing.answer_us;
    for (const Slot& slot : slots_) {
        const LinkSettings& link = slot.wiring.profile->link;
        longest_us = std::max<std::uint64_t>(longest_us, link.response_timeout_us + link.turnaround_us);
    }
    return lost * longest_us;
}

void SetpointPort::complete() noexcept {
    const std::lock_guard lock(motion_.mutex);
    motion_.complete = true;
}

bool SetpointPort::online(std::size_t drive) const noexcept {
    const std::uint64_t now = settings_.clock->now_us();
    return now < report(drive).answered_us + online_us + std::uint64_t{drives()} * period_us_;
}

double SetpointPort::deviation_counts(std::size_t drive) const noexcept {
    const Slot& slot = slots_[drive];
    return slot.deviation_counts + rounding_counts(slot.wiring, period_us_) +
           late_counts(slot.wiring, period_us_, report(drive).late_us, slot.speed_counts_s,
                       SetpointBus::allowed_late_us + settings_.reserve_us);
}

double SetpointPort::deviation_bound_counts(std::size_t drive) const noexcept {
    const Slot& slot = slots_[drive];
    const double period_s = period_us_ / us_per_s;
    return slot.wiring.acceleration_counts_s2 * period_s * period_s / 8.0 + rounding_counts(slot.wiring, period_us_);
}

std::uint64_t SetpointPort::busy_us() const noexcept {
    std::uint64_t sum = 0;
    for (const auto& bus : buses_) {
        sum += bus->busy_us();
    }
    return sum;
}

void SetpointPort::close() noexcept {
    if (began_us_ != 0 && phase_ != Phase::done) {
        if (!stop_.requested()) {
            begin_stop(StopRequest::hold);
        }
        await_stop();
    }
    began_us_ = 0;
    for (const auto& bus : buses_) {
        bus->stop();
    }
}

int SetpointPort::do_room() const noexcept {
    if (!accepts_segments()) {
        return 0;
    }
    const std::lock_guard lock(motion_.mutex);
    const std::uint64_t now = motion_.clock.time(settings_.clock->now_us());
    const std::uint64_t held = motion_.trajectory.end_us() - std::min(now, motion_.trajectory.end_us());
    const std::uint64_t most = settings_.buffer_us + period_us_;
    const std::uint64_t room = held < most ? (most - held) / segment_us_ + 1 : 0;
    return static_cast<int>(std::min<std::uint64_t>(room, motion_.trajectory.room()));
}

bool SetpointPort::do_submit(const FeedSegment& segment) noexcept {
    if (!accepts_segments()) {
        return false;
    }
    FeedSegment moved = segment;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (!slots_[i].frame.apply(moved,
                                   static_cast<std::size_t>(slots_[i].wiring.axis))) { // no drive gets any of it
            trouble_ = AxisFrame::out_of_range;
            trouble_with_ = i;
            begin_stop(StopRequest::hold); // on the path
            return false;
        }
    }
    for (Slot& slot : slots_) {
        const auto axis = static_cast<std::size_t>(slot.wiring.axis);
        const auto way =
            static_cast<double>(std::max(std::abs(segment.start_velocity[axis]), std::abs(segment.end_velocity[axis])));
        slot.speed_counts_s = std::max(slot.speed_counts_s, way / static_cast<double>(units_per_count) * ticks_per_us *
                                                                us_per_s / segment.duration_ticks);
        slot.deviation_counts =
            std::max(slot.deviation_counts, line_deviation_counts(segment, slot.wiring.axis, period_us_));
    }
    const std::lock_guard lock(motion_.mutex);
    ++submitted_;
    return motion_.trajectory.push(moved);
}

// All drives slow down on the path; a drive that is not on the path stops by itself.
void SetpointPort::begin_stop(StopRequest request) noexcept {
    const std::uint64_t now = settings_.clock->now_us();
    if (!stop_.requested()) {
        stop_began_us_ = now;
    }
    stop_.request(request, now);
    const std::lock_guard lock(motion_.mutex);
    motion_.stop_requested = true;
    if (phase_ != Phase::filling && !motion_.clock.stopping()) { // otherwise the clock was never started
        motion_.clock.stop(now);
    }
    phase_ = Phase::ending;
}

// Returns false if a drive has failed.
bool SetpointPort::check_drives() noexcept {
    const std::uint64_t now = settings_.clock->now_us();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        trouble_ = slots_[i].watch.trouble(report(i), now, settings_.away_us, began_us_);
        if (!trouble_.empty()) {
            trouble_with_ = i;
            return false;
        }
    }
    return true;
}

void SetpointPort::follow_stop(std::uint64_t now_us) noexcept {
    bool together = true;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const SetpointReport last = report(i);
        const double tolerance = standstill_counts + rounding_counts(slots_[i].wiring, period_us_);
        facts_[i] = stop_facts(last, motion_, stop_began_us_);
        together = together && stands_on_path(last, motion_, slots_[i].wiring.axis, tolerance);
    }
    for (StopFacts& facts : facts_) {
        facts.on_path = together;
    }
    stop_.update(now_us, facts_);
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (const StopRequest request = stop_.to_send(i); request > StopRequest::hold) {
            slots_[i].bus->stop_drive(slots_[i].index, request);
        }
    }
    if (phase_ == Phase::ending && stop_.settled()) {
        phase_ = trouble_.empty() ? Phase::halted : Phase::fault;
    }
}

// A cyclic drive has no move to complete: its position decides.
bool SetpointPort::arrived() noexcept {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const SetpointReport last = report(i);
        bool there = last.reading.done && last.at_target;
        if (slots_[i].wiring.profile->stream == StreamWay::cyclic) {
            const std::lock_guard lock(motion_.mutex);
            const TrajectoryPoint end = motion_.trajectory.at(slots_[i].wiring.axis, motion_.trajectory.end_us());
            there = std::abs(last.reading.position_q16 - end.position_q16) <= (1 << physical_bits);
        }
        if (!last.end_sent || !there) {
            trouble_with_ = i;
            return false;
        }
    }
    return true;
}

// Estimated by the clock.
std::uint64_t SetpointPort::executed() const noexcept {
    const std::lock_guard lock(motion_.mutex);
    return std::min(motion_.clock.time(settings_.clock->now_us()) / segment_us_, submitted_);
}

// Updates the phase: any bus may have stopped the clock for all drives.
void SetpointPort::follow_clock(std::uint64_t now_us) noexcept {
    bool all_online = true;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        // A drive that lost blocks must first reach the path.
        const bool returns = phase_ == Phase::waiting && slots_[i].wiring.profile->stream == StreamWay::blocks &&
                             report(i).still_us < standstill_us;
        all_online = all_online && online(i) && !returns;
    }
    const std::lock_guard lock(motion_.mutex);
    const std::uint64_t time_us = motion_.time_us(now_us);
    const std::uint64_t end_us = motion_.trajectory.end_us();
    const bool filled = motion_.complete || end_us >= time_us + settings_.buffer_us;
    switch (phase_) {
    case Phase::filling:
        if (filled && !motion_.trajectory.empty()) {
            motion_.clock.start(now_us + lead_us);
            phase_ = Phase::running;
        }
        break;
    case Phase::running:
        motion_.trajectory.release(time_us > retain_us ? time_us - retain_us : 0);
        if (motion_.clock.stopping()) {
            phase_ = Phase::stopping;
        } else if (motion_.complete && time_us >= end_us) {
            phase_ = Phase::arriving;
            arriving_us_ = now_us;
        }
        break;
    case Phase::stopping: phase_ = motion_.clock.at_standstill(now_us) ? Phase::waiting : phase_; break;
    case Phase::waiting:
        if (filled && all_online && now_us > waiting_since_us_ + settle_us) {
            motion_.clock.resume(now_us + lead_us);
            ++resumes_;
            phase_ = Phase::running;
        }
        break;
    case Phase::arriving: // a bus may have stopped the clock meanwhile, at an instant before the end
        phase_ = motion_.clock.stopping() ? Phase::stopping : phase_;
        break;
    case Phase::ending:
    case Phase::halted:
    case Phase::done:
    case Phase::fault: break;
    }
    waiting_since_us_ = phase_ == Phase::waiting ? waiting_since_us_ : now_us;
}

PortState SetpointPort::do_poll() noexcept {
    const std::uint64_t now = settings_.clock->now_us();
    if (!stop_.requested() && phase_ != Phase::done && !check_drives()) {
        begin_stop(StopRequest::hold);
    }
    follow_clock(now);
    arrived_since_us_ = phase_ != Phase::arriving || !arrived() ? 0 : arrived_since_us_ == 0 ? now : arrived_since_us_;
    if (arrived_since_us_ != 0 && now > arrived_since_us_ + settle_us) {
        phase_ = Phase::done;
    } else if (phase_ == Phase::arriving && now > arriving_us_ + arrive_us) {
        trouble_ = "it does not report that it has arrived";
        begin_stop(StopRequest::hold);
    }
    if (stop_.requested()) {
        follow_stop(now);
    }
    const PortPhase phase = phase_ == Phase::fault    ? PortPhase::fault
                            : phase_ == Phase::halted ? PortPhase::halted
                            : phase_ == Phase::done   ? PortPhase::idle
                                                      : PortPhase::running;
    return {phase, executed()};
}

void SetpointPort::do_halt() noexcept {
    if (accepts_segments() || phase_ == Phase::arriving) {
        begin_stop(StopRequest::hold);
    }
}

void SetpointPort::quick_stop() noexcept {
    begin_stop(StopRequest::quick_stop);
}

void SetpointPort::power_off() noexcept {
    begin_stop(StopRequest::disable);
    await_stop();
}

void SetpointPort::await_stop() noexcept {
    while (phase_ == Phase::ending) {
        settings_.clock->sleep_us(poll_interval_us);
        follow_stop(settings_.clock->now_us());
    }
}

} // namespace splinefeed::hal::modbus
