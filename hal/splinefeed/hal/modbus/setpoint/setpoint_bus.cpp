// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_bus.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr int probes = 20;
constexpr std::uint32_t frames_a_target = 3; // for a drive without a target group: speed, target, start
constexpr std::uint32_t least_period_us = 2000;
constexpr std::uint64_t end_retry_us = 300'000; // if a drive does not report arrival by then, the end is sent again
constexpr std::uint64_t passing_us = 150'000;   // a state between two others lasts less
constexpr double margin = 1.3;                  // on measured times
constexpr std::uint32_t slack_us = 1000;        // on the line's rate

} // namespace

std::uint64_t SetpointMotion::time_us(std::uint64_t now_us) noexcept {
    const std::uint64_t time = clock.time(now_us);
    if (!complete && time > 0 && !clock.stopping() && time + ahead_us + reserve > trajectory.end_us()) {
        clock.stop(now_us);
    }
    return time;
}

SetpointDrive& SetpointBus::add(const DriveProfile& profile, int unit, double standstill_counts) {
    drives_.emplace_back(profile, *link_, unit, standstill_counts);
    return drives_.back().drive;
}

std::uint32_t SetpointBus::shortest_period_us() {
    std::uint32_t sum = 0;
    std::uint32_t longest_own = least_period_us;
    std::uint32_t longest_read = 0;
    const bool serial = link_->address().wire == Wire::rtu;
    for (Slot& slot : drives_) {
        const DriveProfile& profile = slot.drive.profile();
        StreamCost cost = stream_cost(profile, link_->address());
        if (!serial) {
            const std::uint64_t before = link_->clock().now_us();
            for (int i = 0; i < probes; ++i) {
                static_cast<void>(slot.drive.read_next());
            }
            cost.read_us =
                static_cast<std::uint32_t>(margin * static_cast<double>(link_->clock().now_us() - before) / probes);
            cost.target_us = (profile.group_for(GroupUse::target) != nullptr ? 1 : frames_a_target) * cost.read_us;
        }
        sum += cost.target_us;
        longest_read = std::max(longest_read, cost.read_us);
        // A cyclic drive's own period is its time to reach a target; the next target may come earlier.
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

// Where the drives stand is still known.
void SetpointBus::reset() noexcept {
    stop();
    const std::lock_guard lock(mutex_);
    for (Slot& slot : drives_) {
        SetpointReport fresh;
        fresh.reading = slot.report.reading;
        fresh.answered_us = slot.report.answered_us;
        fresh.counts = slot.report.counts;
        fresh.late_us = slot.report.late_us;
        fresh.lost = slot.report.lost;
        slot.report = fresh;
        slot.stop_request.store(StopRequest::none, std::memory_order_relaxed);
        slot.word_since_us = slot.setpoint_us = slot.rest_setpoint_us = slot.end_sent_us = slot.path_rest_us = 0;
        slot.heard_us = slot.back_us = slot.off_since_us = 0;
    }
}

void SetpointBus::set_lost(std::size_t drive, bool lost) noexcept {
    const std::lock_guard lock(mutex_);
    drives_[drive].report.lost = lost;
}

SetpointReport SetpointBus::report(std::size_t drive) const noexcept {
    const std::lock_guard lock(mutex_);
    return drives_[drive].report;
}

// A drive that was switched off and on counts from elsewhere. It is off then, or in a fault. One that is off though
// nobody told it to stop may have been. On a serial line one status proves nothing: it may be another drive's.
void SetpointBus::note_loss(Slot& slot, std::uint64_t status_us) noexcept {
    const DriveState state = slot.drive.reading().state;
    const bool off = state == DriveState::disabled || state == DriveState::not_ready;
    const bool suspect = off || state == DriveState::unknown;
    const bool told = slot.stop_request.load(std::memory_order_relaxed) != StopRequest::none;
    const bool again = off && slot.off_since_us != 0;
    const bool lasts = suspect && slot.off_since_us != 0 && status_us > slot.off_since_us + passing_us;
    const bool was_away = slot.back_us != 0 && status_us >= slot.back_us;
    slot.report.lost =
        slot.report.lost || (!told && (again || lasts)) || (was_away && (suspect || state == DriveState::fault));
    slot.off_since_us = !suspect ? 0 : slot.off_since_us == 0 ? status_us : slot.off_since_us;
    slot.back_us = was_away ? 0 : slot.back_us;
}

void SetpointBus::publish_report(Slot& slot) noexcept {
    const std::lock_guard lock(mutex_);
    // By the instants of the positions alone: the state may come in another frame, and would make one position two.
    if (const std::uint64_t position_us = slot.drive.position_us(); position_us > slot.position_us) {
        slot.position_us = position_us;
        slot.standstill.update(position_us, slot.drive.reading().position_q16);
    }
    const std::uint64_t heard_us = slot.drive.answered_us();
    slot.back_us = slot.heard_us != 0 && heard_us > slot.heard_us + restart_us ? slot.drive.last_answer().arrived_us
                                                                               : slot.back_us;
    slot.heard_us = heard_us;
    if (const std::uint64_t status_us = slot.drive.status_us(); status_us > slot.report.status_us) {
        slot.report.status_us = status_us;
        note_loss(slot, status_us);
        slot.word_since_us = !slot.drive.says_it_stands() ? 0
                             : slot.word_since_us == 0    ? status_us
                                                          : slot.word_since_us;
        const std::uint64_t by_word_us = slot.word_since_us != 0 ? status_us - slot.word_since_us : 0;
        slot.report.still_us = std::max(slot.standstill.still_us(), by_word_us);
    }
    slot.report.position_us = slot.drive.position_us();
    slot.report.reading = slot.drive.reading();
    slot.report.answered_us = slot.drive.answered_us();
    slot.report.last = slot.drive.last_answer();
    slot.report.clamped = slot.drive.clamped();
    slot.report.at_target = slot.drive.at_target();
    slot.report.counts = slot.drive.counts();
}

// Sends a drive its target for the instant at which the frame arrives.
void SetpointBus::send_setpoint(Slot& slot, SetpointMotion& motion, std::uint32_t period_us) noexcept {
    const std::uint64_t arrives_us = link_->next_us() + stream_cost(slot.drive.profile(), link_->address()).arrival_us;
    bool end_sent = false;
    {
        const std::lock_guard lock(motion.mutex);
        check_lateness(slot, motion, arrives_us, period_us);
        const MotionInstant instant{arrives_us, motion.time_us(arrives_us), motion.time_us(arrives_us + period_us)};
        if (motion.trajectory.empty() || instant.motion_us == 0) {
            return; // the motion has not started
        }
        if (!motion.stop_requested && slot.end_sent_us != 0 && !(slot.drive.reading().done && slot.drive.at_target()) &&
            arrives_us > slot.end_sent_us + end_retry_us) {
            slot.end_sent_us = 0;
            slot.drive.on_arrival(arrives_us, UINT64_MAX); // the last block may be lost
        }
        if (slot.setpoint_us != 0 &&
            arrives_us > slot.setpoint_us + std::max(period_us, slot.drive.profile().period_us)) {
            slot.drive.on_setpoint_timeout(motion.trajectory, instant);
        }
        const bool path_stands = motion.clock.at_standstill(arrives_us) || slot.end_sent_us != 0;
        slot.path_rest_us = !path_stands || !slot.drive.at_rest() ? 0
                            : slot.path_rest_us == 0              ? arrives_us
                                                                  : slot.path_rest_us;
        if (!motion.stop_requested && slot.path_rest_us != 0 && arrives_us > slot.path_rest_us + standstill_us) {
            slot.drive.resync_position();
        }
        slot.drive.prepare_frames(motion.trajectory, instant);
        end_sent = motion.complete && slot.drive.end_sent(motion.trajectory, instant.motion_us);
    }
    const bool sent = slot.drive.send();
    publish_report(slot);
    slot.end_sent_us = !end_sent || !sent ? 0 : slot.end_sent_us == 0 ? arrives_us : slot.end_sent_us;
    on_sent(slot, motion, sent, arrives_us, period_us);
}

// A drive without a new target continues for a short time only, so all drives stop. If no drive got a target meanwhile,
// all have stopped by themselves: the clock then stops from the last target on, and the path waits there. While the
// clock stood, no target was late.
void SetpointBus::check_lateness(Slot& slot, SetpointMotion& motion, std::uint64_t now_us,
                                 std::uint32_t period_us) noexcept {
    if (motion.runs_from_us == 0 || motion.clock.stopping() || slot.end_sent_us != 0) {
        return;
    }
    const std::uint64_t due_us = std::max(slot.setpoint_us, motion.runs_from_us) + period_us;
    if (now_us > due_us + period_us + allowed_late_us) {
        motion.clock.stop(std::clamp(motion.last_setpoint_us, due_us, now_us));
        slot.late_stops.fetch_add(1, std::memory_order_relaxed);
    }
}

void SetpointBus::on_sent(Slot& slot, SetpointMotion& motion, bool sent, std::uint64_t arrives_us,
                          std::uint32_t period_us) noexcept {
    const LinkAnswer& answer = slot.drive.last_answer();
    const std::uint64_t arrived_us = sent ? (answer.arrived_us + answer.replied_us) / 2 : link_->clock().now_us();
    const bool end_sent = slot.end_sent_us != 0;
    const std::uint64_t due_us = slot.setpoint_us + period_us;
    const std::uint64_t latest_us = sent ? answer.replied_us : arrived_us;
    const std::uint64_t late_us = slot.setpoint_us != 0 && !end_sent && latest_us > due_us ? latest_us - due_us : 0;
    std::uint64_t stands_us = UINT64_MAX;
    {
        const std::lock_guard lock(motion.mutex);
        check_lateness(slot, motion, latest_us, period_us);
        stands_us = motion.clock.stopping() ? motion.clock.standstill_from() : stands_us;
        slot.drive.on_arrival(arrives_us, sent ? answer.replied_us : UINT64_MAX);
        motion.last_setpoint_us = sent ? std::max(motion.last_setpoint_us, arrived_us) : motion.last_setpoint_us;
    }
    if (sent) {
        slot.setpoint_us = arrived_us;
    }
    if (sent && arrived_us >= stands_us && slot.rest_setpoint_us < stands_us) {
        slot.rest_setpoint_us = arrived_us;
    }
    const std::lock_guard lock(mutex_);
    slot.report.setpoint_us = slot.setpoint_us;
    slot.report.rest_setpoint_us = slot.rest_setpoint_us;
    slot.report.end_sent = end_sent;
    slot.report.behind = slot.drive.behind();
    slot.report.late_us = std::max(slot.report.late_us, late_us);
}

void SetpointBus::carry_out(Slot& slot, StopRequest request) noexcept {
    if (slot.report.executed >= request || !slot.drive.stop(request)) {
        return;
    }
    const std::lock_guard lock(mutex_);
    slot.report.executed = request;
    slot.report.executed_us = slot.drive.last_answer().answered_us;
}

// Reads one status frame of one drive in turn, and one of each drive that is being stopped, because it gets no targets.
void SetpointBus::read_statuses() noexcept {
    const std::size_t next = next_read_++ % drives_.size();
    for (std::size_t i = 0; i < drives_.size() && link_->connected(); ++i) {
        Slot& slot = drives_[i];
        // One that may still confirm an earlier target is asked, too, or the next target would have to wait for that.
        const bool asked = i == next || slot.stop_request.load(std::memory_order_relaxed) != StopRequest::none ||
                           link_->owes_answer(slot.drive.unit());
        if (asked && link_->clock().now_us() >= link_->read_from_us(slot.drive.unit())) {
            static_cast<void>(slot.drive.read_next());
        }
        publish_report(slot);
    }
}

// The work of one period.
void SetpointBus::run_period(SetpointMotion& motion, std::uint32_t period_us) noexcept {
    if (!link_->connected() && !link_->connect()) {
        for (Slot& slot : drives_) {
            publish_report(slot);
            const std::lock_guard lock(motion.mutex);
            check_lateness(slot, motion, link_->clock().now_us(), period_us);
        }
        return;
    }
    for (Slot& slot : drives_) {
        const StopRequest stop_request = slot.stop_request.load(std::memory_order_relaxed);
        if (stop_request == StopRequest::none) {
            send_setpoint(slot, motion, period_us);
        } else {
            carry_out(slot, stop_request);
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
        run_period(motion, period_us);
        busy_us_.store(thread_us(), std::memory_order_relaxed);
        const std::uint64_t now = clock.now_us();
        if (now > next_us + period_us) { // late: skip periods, never send a burst of old targets
            next_us += (now - next_us) / period_us * period_us;
        }
    }
}

} // namespace splinefeed::hal::modbus
