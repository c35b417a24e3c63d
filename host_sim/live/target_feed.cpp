// SPDX-License-Identifier: MIT
#include "host_sim/live/target_feed.hpp"

#include "splinefeed/base/units.hpp"

#include <exception>

namespace splinefeed::host {

namespace {

// No sentence is a run that ended well.
std::string or_unsaid(const std::string& why) {
    return why.empty() ? std::string("the motion was stopped, and nothing says why") : why;
}

} // namespace

bool TargetFeed::room() const noexcept {
    const std::uint64_t ahead = pushed_ticks_ - taken_ticks_.load(std::memory_order_relaxed);
    return ring_.empty() || (ring_.room() > 0 && ahead < hand_over_us * static_cast<std::uint64_t>(ticks_per_us));
}

// In this order: what is pushed behind an end is not taken for a part of the motion before.
void TargetFeed::push(const FeedSegment& segment) noexcept {
    complete_.store(false);
    pushed_ticks_ += segment.duration_ticks;
    ++pushed_;
    ring_.push(segment);
}

void TargetFeed::order(const ProgramAction& action, bool standing) {
    constexpr std::uint64_t stood = 2; // a port may take a segment before its last step is made
    const std::lock_guard lock(order_mutex_);
    orders_.push_back({action, pushed_ + (standing ? stood : 0)});
}

bool TargetFeed::carried_out() const {
    const std::lock_guard lock(order_mutex_);
    return orders_.empty() && (outputs_ == nullptr || outputs_->reached());
}

bool TargetFeed::spindle_stands() const {
    const std::lock_guard lock(order_mutex_);
    return outputs_ == nullptr || outputs_->spindle_stands();
}

int TargetFeed::answer() const {
    const std::lock_guard lock(order_mutex_);
    return outputs_ != nullptr ? outputs_->answer() : 0;
}

void TargetFeed::end_outputs() {
    if (outputs_ != nullptr) {
        outputs_->end();
        outputs_ended_ = true;
    }
}

void TargetFeed::set_outputs(ProgramOutputs* outputs) {
    const std::lock_guard lock(order_mutex_);
    outputs_ = outputs;
    orders_.clear();
    outputs_ended_ = false;
    trouble_.clear();
}

// Orders whose place the machine has reached; and the outputs' own trouble, which holds the motion.
void TargetFeed::tend_outputs() {
    if (outputs_ == nullptr) {
        return;
    }
    {
        const std::lock_guard lock(order_mutex_);
        while (!stops() && !orders_.empty() && executed() >= orders_.front().after) {
            outputs_->act(orders_.front().action);
            orders_.pop_front();
        }
    }
    outputs_->update();
    if (!stops()) {
        set_trouble(outputs_->trouble());
    }
}

void TargetFeed::ask(hal::StopRequest stop) {
    if (stop > stop_.report(0).request) {
        stop_.request(stop, clock_->now_us());
        obey(stop);
    }
}

void TargetFeed::obey(hal::StopRequest stop) {
    if (stop > hal::StopRequest::hold) {
        end_outputs();
        port_->quick_stop();
    } else {
        port_->halt();
    }
}

void TargetFeed::begin(std::uint64_t done) noexcept {
    done_before_ = done;
    began_at_ = taken_;
    executed_.store(taken_);
    stop_.reset();
    completed_ = false;
}

// M62 to M65 behind what was not executed: the program never came there. Spindle and coolant become as they were told
// last, which is off, where a program ends.
void TargetFeed::drop() {
    FeedSegment segment;
    while (ring_.pop(segment)) {
        taken_ticks_.fetch_add(segment.duration_ticks, std::memory_order_relaxed);
        ++taken_;
    }
    const std::lock_guard lock(order_mutex_);
    std::erase_if(orders_, [reached = executed()](const DueOrder& order) {
        return order.after > reached && is_output(order.action.kind);
    });
}

void TargetFeed::hand_over() {
    FeedSegment segment;
    bool takes = !completed_;
    while (takes && port_->room() > 0 && ring_.pop(segment)) {
        taken_ticks_.fetch_add(segment.duration_ticks, std::memory_order_relaxed);
        ++taken_;
        last_ = segment;
        takes = port_->submit(segment);
        if (record_ != nullptr) {
            record_->handed(segment.duration_ticks);
        }
    }
    // In this order: what was pushed before complete_ is seen. An end may be that of a motion that was halted.
    const bool complete = complete_.load() && taken_ != began_at_;
    if (complete && !completed_ && ring_.empty()) {
        completed_ = true;
        port_->complete();
    }
}

std::optional<MotionEnd> TargetFeed::end_of(hal::PortPhase phase, bool completed) {
    switch (phase) {
    case hal::PortPhase::fault: {
        end_outputs();
        const hal::PortFailure failure = port_->failure();
        return MotionEnd{phase, or_unsaid(failure ? target_->sentence(failure) : std::string())};
    }
    case hal::PortPhase::halted:
        return MotionEnd{phase, or_unsaid(target_->halted(stop_.report(0).request > hal::StopRequest::hold))};
    case hal::PortPhase::idle:
        if (completed) {
            const RunTarget::Signs signs = target_->signs();
            return MotionEnd{phase, signs.achieved ? std::string() : signs.holds};
        }
        break;
    case hal::PortPhase::running: break;
    }
    return std::nullopt;
}

// A stop that does not end.
std::optional<MotionEnd> TargetFeed::insist() {
    const hal::StopFacts unconfirmed{};
    if (stop_.update(clock_->now_us(), {&unconfirmed, 1})) {
        obey(stop_.to_send(0));
    }
    return stop_.settled() ? std::optional(MotionEnd{hal::PortPhase::fault, "interrupted, but not every drive has "
                                                                            "confirmed that it stands"})
                           : std::nullopt;
}

std::optional<MotionEnd> TargetFeed::look(hal::StopRequest stop, bool hands_over) {
    hal::PortState state;
    const bool completed = completed_;
    try {
        ask(stop);
        state = port_->poll();
        hold_asked_.store(!target_->signs().holds.empty());
        if (hands_over) {
            hand_over();
        }
    } catch (const std::exception& error) {
        set_trouble(error.what());
        ask(hal::StopRequest::hold); // before outputs are told anything more
        state = port_->poll();
    }
    executed_.store(began_at_ + (state.executed - done_before_));
    if (record_ != nullptr) {
        record_->looked(clock_->now_us(), executed());
    }
    std::optional<MotionEnd> end = end_of(state.phase, completed);
    end = end ? end : insist();
    if (!end) {
        tend_outputs();
        ask(trouble_.empty() ? hal::StopRequest::none : hal::StopRequest::hold);
    }
    return end;
}

} // namespace splinefeed::host
