// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_group.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/link/wire_groups.hpp"
#include "splinefeed/hal/modbus/profile/drive_timing.hpp"
#include "splinefeed/hal/modbus/setpoint/setpoint_setup.hpp"
#include "splinefeed/hal/rt/wait_until.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t online_us = 50'000;

bool homes(const PortOrders& orders, const SetpointWiring& wiring) noexcept {
    return orders.home && (orders.home_axes >> static_cast<unsigned>(wiring.axis) & 1U) != 0;
}

} // namespace

SetpointGroup::SetpointGroup(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings)
    : settings_(&settings) {
    std::vector<WireUse> uses;
    uses.reserve(wiring.size());
    for (const SetpointWiring& drive : wiring) {
        uses.push_back({drive.link, timing_of(drive.profile->link)});
    }
    const WireGroups groups = group_by_wire(uses, settings.timing);
    for (const WireUse& wire : groups.wires) {
        buses_.push_back(std::make_unique<SetpointBus>(settings.make_wire(wire.link, wire.timing, *settings.clock)));
    }
    for (const SetpointWiring& drive : wiring) {
        Slot slot;
        slot.wiring = drive;
        slot.bus = buses_[groups.of_drive[slots_.size()]].get();
        slot.index = slot.bus->drives();
        static_cast<void>(slot.bus->add(*drive.profile, drive.link.unit, drive.standstill_counts));
        slot.frame = AxisFrame(drive.inverted, drive.profile->field_of(FieldRole::target_position));
        slots_.push_back(std::move(slot));
    }
}

PortFailure SetpointGroup::open() {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (std::string what = drive(i).open(); !what.empty()) {
            return {what, i};
        }
    }
    for (const auto& bus : buses_) {
        period_us_ = std::max(period_us_, bus->shortest_period_us());
    }
    return {};
}

PortFailure SetpointGroup::await_standstill(const PortOrders& orders) const {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        Standstill still(std::llround(tolerance_counts(i) * (1 << physical_bits)));
        std::string why;
        const auto stands = [&] {
            const bool read = drive(i).read_status();
            why = read ? "it moves already; end the program that moves it, or wait until it stands"
                       : silence(drive(i).last_answer(), &drive(i).link());
            if (read) {
                still.update(settings_->clock->now_us(), drive(i).reading().position_q16);
            } else if (!drive(i).link().connected()) {
                static_cast<void>(drive(i).link().connect());
            }
            return read && still.still_us() >= standstill_us;
        };
        if (wait_until(*settings_->clock, stands, settings_->away_us, "") != nullptr) {
            return {why, i};
        }
        if (drive(i).reading().state == DriveState::fault && !orders.reset) {
            return {fault_sentence(drive(i).reading()), i, Remedy::reset};
        }
    }
    return {};
}

// One that is enabled, or was stopped, was not switched off: it would have to be enabled. A fault may be what it was
// switched on with, if nobody heard it before.
bool SetpointGroup::keeps_place(std::size_t i) const noexcept {
    const SetpointReport last = report(i);
    if (!slots_[i].frame.aligned() || last.lost) {
        return false;
    }
    switch (drive(i).reading().state) {
    case DriveState::enabled:
    case DriveState::moving:
    case DriveState::quick_stop:
    case DriveState::halted: return true;
    case DriveState::fault: return settings_->clock->now_us() < last.answered_us + SetpointBus::restart_us;
    default: return false;
    }
}

PortFailure SetpointGroup::configure(const PortOrders& orders) {
    PortFailure trouble;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const SetpointWiring& wiring = slots_[i].wiring;
        if (homes(orders, wiring) && wiring.profile->steps_of(DriveCommand::home).empty()) {
            trouble = {"its profile has no home command; home it by its own means", i, Remedy::omit_home};
        }
        drive(i).configure({.axis = wiring.axis,
                            .period_us = period_us_,
                            .acceleration_counts_s2 = wiring.acceleration_counts_s2,
                            .ramp_counts_s2 = wiring.ramp_counts_s2,
                            .fastest_counts_s = wiring.fastest_counts_s,
                            .standstill_counts = wiring.standstill_counts});
    }
    return trouble;
}

// Polls each of the first drives, which are enabled, but one, while that one is made ready: it feeds their watchdogs
// and detects their faults.
PortFailure SetpointGroup::poll_others(std::size_t but, std::size_t enabled) const {
    for (std::size_t i = 0; i < enabled; ++i) {
        if (i == but) {
            continue;
        }
        static_cast<void>(drive(i).read_next());
        const DriveReading& reading = drive(i).reading();
        if (reading.state == DriveState::fault) {
            return {fault_sentence(reading), i};
        }
        if (reading.state == DriveState::disabled) {
            return {"it was disabled while another drive was prepared", i};
        }
        if (settings_->clock->now_us() > drive(i).answered_us() + settings_->away_us) {
            return {silence(drive(i).last_answer(), &drive(i).link()), i};
        }
    }
    return {};
}

// Enables all drives before the first one is homed.
PortFailure SetpointGroup::make_ready(const FeedSegment& first, const PortOrders& orders, bool placed) {
    if (PortFailure trouble = configure(orders)) {
        return trouble;
    }
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (homes(orders, slots_[i].wiring)) {
            slots_[i].bus->set_lost(slots_[i].index, true);
        } else if (placed && slots_[i].frame.aligned() && report(i).lost) {
            return {"it was switched off and on: nobody knows where it stands", i};
        }
    }
    std::size_t ready = 0;
    for (const bool enabled : {false, true}) {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            Slot& slot = slots_[i];
            std::size_t troubled = i;
            SetpointSetup setup(drive(i), {.home = homes(orders, slot.wiring),
                                           .reset = orders.reset,
                                           .away_us = settings_->away_us,
                                           .interrupted = settings_->interrupted,
                                           .meanwhile = [&] {
                                               PortFailure other = poll_others(i, ready);
                                               troubled = other ? other.drive : troubled;
                                               return other.what;
                                           }});
            if (std::string what = enabled ? setup.begin() : setup.enable(); !what.empty()) {
                slot.homing = setup.homing();
                return {what, troubled, setup.needs_reset() ? Remedy::reset : Remedy::none};
            }
            const std::int64_t start = first.start[static_cast<std::size_t>(slot.wiring.axis)];
            if (!enabled) {
                ++ready;
            } else if (!(placed && slot.frame.aligned())) {
                if (!slot.frame.align(drive(i).reading().position_q16, start)) {
                    return {AxisFrame::out_of_range, i};
                }
                slot.bus->set_lost(slot.index, false);
            }
        }
    }
    return {};
}

void SetpointGroup::start(SetpointMotion& motion) {
    for (const auto& bus : buses_) {
        bus->start(motion, period_us_);
    }
}

void SetpointGroup::reset() noexcept {
    for (const auto& bus : buses_) {
        bus->reset();
    }
    for (Slot& slot : slots_) {
        slot.watch = {};
        slot.homing = false;
    }
}

void SetpointGroup::stop() noexcept {
    for (const auto& bus : buses_) {
        bus->stop();
    }
}

bool SetpointGroup::online(std::size_t i) const noexcept {
    return settings_->clock->now_us() < report(i).answered_us + online_us + std::uint64_t{size()} * period_us_;
}

std::optional<std::size_t> SetpointGroup::convert(FeedSegment& segment) noexcept {
    FeedSegment moved = segment;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (!slots_[i].frame.apply(moved, static_cast<std::size_t>(slots_[i].wiring.axis))) {
            return i;
        }
    }
    for (Slot& slot : slots_) {
        const auto axis = static_cast<std::size_t>(slot.wiring.axis);
        const auto way =
            static_cast<double>(std::max(std::abs(segment.start_velocity[axis]), std::abs(segment.end_velocity[axis])));
        slot.speed_counts_s = std::max(slot.speed_counts_s, way / static_cast<double>(units_per_count) * ticks_per_s /
                                                                segment.duration_ticks);
        slot.deviation_counts =
            std::max(slot.deviation_counts, line_deviation_counts(segment, slot.wiring.axis, period_us_));
    }
    segment = moved;
    return std::nullopt;
}

PortFailure SetpointGroup::watch(std::uint64_t began_us) {
    const std::uint64_t now_us = settings_->clock->now_us();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (std::string what = slots_[i].watch.trouble(report(i), now_us, settings_->away_us, began_us);
            !what.empty()) {
            return {what, i};
        }
    }
    return {};
}

// A drive that lost blocks must first reach the path.
std::optional<std::size_t> SetpointGroup::not_ready(std::uint64_t since_us) const noexcept {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const SetpointReport last = report(i);
        const bool returns = slots_[i].wiring.profile->stream == StreamWay::blocks && last.still_us < standstill_us;
        if (!online(i) || last.answered_us < since_us || returns || last.behind) {
            return i;
        }
    }
    return std::nullopt;
}

// A cyclic drive has no move to complete: its position decides.
std::optional<std::size_t> SetpointGroup::not_arrived(SetpointMotion& motion) const noexcept {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const SetpointReport last = report(i);
        bool there = last.reading.done && last.at_target;
        if (slots_[i].wiring.profile->stream == StreamWay::cyclic) {
            const std::lock_guard lock(motion.mutex);
            const TrajectoryPoint end = motion.trajectory.at(slots_[i].wiring.axis, motion.trajectory.end_us());
            there = std::fabs(static_cast<double>(last.reading.position_q16 - end.position_q16)) <=
                    slots_[i].wiring.standstill_counts * (1 << physical_bits);
        }
        if (!last.end_sent || !there) {
            return i;
        }
    }
    return std::nullopt;
}

bool SetpointGroup::heard_since(std::uint64_t since_us) const noexcept {
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        if (report(i).position_us < since_us) {
            return false;
        }
    }
    return true;
}

std::uint64_t SetpointGroup::ahead_us() const noexcept {
    std::uint64_t most_us = 0;
    for (const Slot& slot : slots_) {
        most_us = std::max(most_us, std::uint64_t{2} * horizon_us(slot.wiring, period_us_));
    }
    return most_us;
}

std::uint64_t SetpointGroup::answers_us() const noexcept {
    constexpr std::uint64_t lost = 4;
    std::uint64_t longest_us = settings_->timing.answer_us;
    for (const Slot& slot : slots_) {
        const LinkSettings& link = slot.wiring.profile->link;
        longest_us = std::max<std::uint64_t>(longest_us, link.response_timeout_us + link.turnaround_us);
    }
    return lost * longest_us;
}

double SetpointGroup::deviation_counts(std::size_t i) const noexcept {
    const Slot& slot = slots_[i];
    return slot.deviation_counts + rounding_counts(slot.wiring, period_us_) +
           late_counts(slot.wiring, period_us_, report(i).late_us, slot.speed_counts_s,
                       SetpointBus::allowed_late_us + settings_->reserve_us);
}

double SetpointGroup::deviation_bound_counts(std::size_t i) const noexcept {
    const Slot& slot = slots_[i];
    const double period_s = us_to_s(period_us_);
    return slot.wiring.acceleration_counts_s2 * period_s * period_s / 8.0 + rounding_counts(slot.wiring, period_us_);
}

std::uint64_t SetpointGroup::busy_us() const noexcept {
    std::uint64_t sum = 0;
    for (const auto& bus : buses_) {
        sum += bus->busy_us();
    }
    return sum;
}

} // namespace splinefeed::hal::modbus
