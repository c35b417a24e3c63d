// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr int probes = 20;
constexpr std::uint32_t frames_a_target = 3; // of a drive without a group: speed, target, start
constexpr std::uint32_t least_period_us = 2000;
constexpr std::uint64_t again_us = 300'000; // a drive that was told the end says that it is there
constexpr double margin = 1.3;              // of what was measured
constexpr std::uint32_t slack_us = 1000;    // and of a line's rate

} // namespace

std::uint64_t SetpointMotion::time_us(std::uint64_t now_us) noexcept {
    const std::uint64_t time = clock.time(now_us);
    if (!complete && time > 0 && !clock.stopping() && time + ahead_us + reserve > track.end_us()) {
        clock.stop(now_us);
    }
    return time;
}

SetpointDrive& SetpointBus::add(const DriveProfile& profile, int unit) {
    drives_.emplace_back(profile, *link_, unit);
    return drives_.back().drive;
}

std::uint32_t SetpointBus::shortest_period_us() {
    std::uint32_t sum = 0;
    std::uint32_t longest_own = least_period_us;
    std::uint32_t longest_read = 0;
    const bool serial = link_->address().wire == Wire::rtu;
    for (Place& place : drives_) {
        const DriveProfile& profile = place.drive.profile();
        StreamCost cost = stream_cost(profile, link_->address());
        if (!serial) {
            const std::uint64_t before = link_->clock().now_us();
            for (int i = 0; i < probes; ++i) {
                static_cast<void>(place.drive.read_next());
            }
            cost.read_us =
                static_cast<std::uint32_t>(margin * static_cast<double>(link_->clock().now_us() - before) / probes);
            cost.target_us = (profile.group_for(GroupUse::target) != nullptr ? 1 : frames_a_target) * cost.read_us;
        }
        sum += cost.target_us;
        longest_read = std::max(longest_read, cost.read_us);
        // A cyclic drive's own period is how long it takes to get to a target: the next one may come before.
        longest_own = std::max(longest_own, profile.stream == StreamWay::blocks ? profile.period_us : 0U);
    }
    return std::max(longest_own, sum + longest_read + (serial ? slack_us : 0U));
}

void SetpointBus::start(SetpointMotion& motion, std::uint32_t period_us) {
    stopping_.store(false);
    thread_ = link_->clock().start([this, &motion, period_us] { run(motion, period_us); });
}

void SetpointBus::stop() noexcept {
    stopping_.store(true);
    if (thread_) {
        thread_->join();
    }
}

SetpointReport SetpointBus::report(std::size_t drive) const noexcept {
    const std::lock_guard lock(mutex_);
    return drives_[drive].report;
}

void SetpointBus::keep(Place& place) noexcept {
    const std::lock_guard lock(mutex_);
    if (const std::uint64_t said_us = place.drive.said_us(); said_us > place.report.said_us) {
        place.report.said_us = said_us;
        place.shaft.see(said_us, place.drive.reading().position_q16);
        place.report.still_us = place.shaft.still_us();
    }
    place.report.reading = place.drive.reading();
    place.report.heard_us = place.drive.heard_us();
    place.report.fault = place.drive.last_answer().fault;
    place.report.clamped = place.drive.clamped();
    place.report.at_target = place.drive.at_target();
    place.report.counts = place.drive.counts();
}

// By the time at which its frame arrives.
void SetpointBus::tell(Place& place, SetpointMotion& motion, std::uint32_t period_us) noexcept {
    const std::uint64_t arrives_us = link_->next_us() + stream_cost(place.drive.profile(), link_->address()).arrival_us;
    bool told_end = false;
    {
        const std::lock_guard lock(motion.mutex);
        watch(place, motion, arrives_us, period_us);
        const MotionInstant instant{arrives_us, motion.time_us(arrives_us), motion.time_us(arrives_us + period_us)};
        if (motion.track.empty() || instant.motion_us == 0) {
            return; // not started
        }
        if (!motion.stops && place.ended_us != 0 && !(place.drive.reading().done && place.drive.at_target()) &&
            arrives_us > place.ended_us + again_us) {
            place.ended_us = 0;
            place.drive.arrived(UINT64_MAX); // it may not have seen the last one
        }
        if (place.told_us != 0 && arrives_us > place.told_us + std::max(period_us, place.drive.profile().period_us)) {
            place.drive.stood(motion.track, instant);
        }
        const bool path_stands = motion.clock.stands(arrives_us) || place.ended_us != 0;
        place.rests_us = !path_stands || !place.drive.at_rest() ? 0 : place.rests_us == 0 ? arrives_us : place.rests_us;
        if (!motion.stops && place.rests_us != 0 && arrives_us > place.rests_us + stand_still_us) {
            place.drive.correct();
        }
        place.drive.aim(motion.track, instant);
        told_end = motion.complete && place.drive.told_end(motion.track, instant.motion_us);
    }
    const bool sent = place.drive.send();
    keep(place);
    place.ended_us = !told_end || !sent ? 0 : place.ended_us == 0 ? arrives_us : place.ended_us;
    told(place, motion, sent, period_us);
}

// The drive goes on as it was told before, but not for long: then all stop. Where nobody was told anything meanwhile
// they have all stopped by themselves, and the path waits for them there.
void SetpointBus::watch(const Place& place, SetpointMotion& motion, std::uint64_t now_us,
                        std::uint32_t period_us) noexcept {
    const std::uint64_t due_us = place.told_us + period_us;
    if (place.told_us != 0 && place.ended_us == 0 && now_us > due_us + period_us + allowed_late_us &&
        !motion.clock.stopping()) {
        motion.clock.stop(std::clamp(motion.told_us, due_us, now_us));
    }
}

void SetpointBus::told(Place& place, SetpointMotion& motion, bool sent, std::uint32_t period_us) noexcept {
    const LinkAnswer& answer = place.drive.last_answer();
    const std::uint64_t arrived_us = sent ? (answer.arrived_us + answer.replied_us) / 2 : link_->clock().now_us();
    const bool ended = place.ended_us != 0;
    const std::uint64_t due_us = place.told_us + period_us;
    const std::uint64_t latest_us = sent ? answer.replied_us : arrived_us;
    const std::uint64_t late_us = place.told_us != 0 && !ended && latest_us > due_us ? latest_us - due_us : 0;
    {
        const std::lock_guard lock(motion.mutex);
        watch(place, motion, latest_us, period_us);
        place.drive.arrived(sent ? arrived_us : UINT64_MAX);
        motion.told_us = sent ? std::max(motion.told_us, arrived_us) : motion.told_us;
    }
    if (sent) {
        place.told_us = arrived_us;
    }
    const std::lock_guard lock(mutex_);
    place.report.told_us = place.told_us;
    place.report.told_end = ended;
    place.report.late_us = std::max(place.report.late_us, late_us);
}

void SetpointBus::carry_out(Place& place, StopRequest request) noexcept {
    if (place.report.executed >= request || !place.drive.stop(request)) {
        return;
    }
    const std::lock_guard lock(mutex_);
    place.report.executed = request;
    place.report.executed_us = place.drive.last_answer().answered_us;
}

// One frame of one drive's in turn; of drives that are to stop of each, since they get no targets.
void SetpointBus::read_statuses() noexcept {
    const std::size_t next = asked_++ % drives_.size();
    for (std::size_t i = 0; i < drives_.size() && link_->connected(); ++i) {
        Place& place = drives_[i];
        if (i == next || place.wanted.load(std::memory_order_relaxed) != StopRequest::none) {
            static_cast<void>(place.drive.read_next());
        }
        keep(place);
    }
}

// What a bus does in a period.
void SetpointBus::turn(SetpointMotion& motion, std::uint32_t period_us) noexcept {
    if (!link_->connected() && !link_->connect()) {
        for (Place& place : drives_) {
            keep(place);
            const std::lock_guard lock(motion.mutex);
            watch(place, motion, link_->clock().now_us(), period_us);
        }
        return;
    }
    for (Place& place : drives_) {
        const StopRequest wanted = place.wanted.load(std::memory_order_relaxed);
        if (wanted == StopRequest::none) {
            tell(place, motion, period_us);
        } else {
            carry_out(place, wanted);
        }
    }
    read_statuses();
}

void SetpointBus::run(SetpointMotion& motion, std::uint32_t period_us) noexcept {
    Clock& clock = link_->clock();
    std::uint64_t next_us = clock.now_us();
    while (!stopping_.load(std::memory_order_relaxed)) {
        clock.sleep_until_us(next_us);
        next_us += period_us;
        turn(motion, period_us);
        busy_us_.store(thread_us(), std::memory_order_relaxed);
        const std::uint64_t now = clock.now_us();
        if (now > next_us + period_us) { // behind: never a burst of old targets
            next_us += (now - next_us) / period_us * period_us;
        }
    }
}

} // namespace splinefeed::hal::modbus
