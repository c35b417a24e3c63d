// SPDX-License-Identifier: MIT
#include "host_sim/run/supervision.hpp"

#include "host_sim/base/abandon.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/output/place_text.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>
#include <exception>

namespace splinefeed::host {

using hal::system_clock;

namespace {

constexpr std::uint64_t poll_every_us = 1000;
constexpr std::uint64_t halt_us = 10 * us_per_s;    // then a hold becomes a quick stop,
constexpr std::uint64_t give_up_us = 15 * us_per_s; // and then nobody waits for the port any more
constexpr int looks_a_second = 100;
constexpr int not_finished = 1;

// No sentence is a run that ended well.
std::string or_unsaid(const std::string& why) {
    return why.empty() ? std::string("the motion was stopped, and nothing says why") : why;
}

} // namespace

Supervision::~Supervision() {
    if (thread_.joinable()) {
        stop();
    }
    leaves_.store(true);
    if (thread_.joinable()) {
        thread_.join(); // its run has one end, and each step of it is bounded
    }
    signals_->at_once({});
}

bool Supervision::room() const noexcept {
    const std::uint64_t ahead = pushed_ticks_ - taken_ticks_.load(std::memory_order_relaxed);
    return ring_.empty() || (ring_.room() > 0 && ahead < hand_over_us * static_cast<std::uint64_t>(ticks_per_us));
}

bool Supervision::submit(const FeedSegment& segment, std::uint64_t line, std::uint64_t moves) {
    while (!over() && !room()) {
        system_clock().sleep_us(poll_every_us);
    }
    if (over()) {
        return false;
    }
    const bool first = !thread_.joinable();
    if (first) {
        signals_->supervise(); // from here on a signal is obeyed by the one end
    }
    if (first && state_ != nullptr) {
        state_->moves();
    }
    begin_line(line, moves);
    pushed_ticks_ += segment.duration_ticks;
    ++pushed_;
    at_rest_ = segment.ends_at_rest();
    ring_.push(segment);
    if (first) {
        thread_ = std::thread([this] { work(); });
    }
    return true;
}

void Supervision::complete() {
    if (stop_.load()) {
        return;
    }
    if (at_rest_) {
        complete_.store(true);
    } else {
        stop("the plan ended while the axes moved");
    }
}

void Supervision::stop(const std::string& why) {
    if (!stop_.load() && !complete_.load()) {
        stop_why_ = why;
        stop_.store(true);
    }
}

bool Supervision::finish() {
    complete();
    while (thread_.joinable() && !over()) {
        system_clock().sleep_us(poll_every_us);
    }
    return ending_.empty();
}

// Requests to end, by now: the first one holds all axes on the path, the second one stops them at once.
void Supervision::ask_target(int requests) {
    if (requests <= obeyed_) {
        return;
    }
    obeyed_us_ = system_clock().now_us();
    obeyed_ = requests;
    if (requests > 1) {
        end_outputs();
        port_->quick_stop();
    } else {
        port_->halt();
    }
}

// Twice before one look counts twice.
void Supervision::obey() {
    if (stop_.load() && trouble_.empty()) {
        trouble_ = stop_why_;
    }
    ask_target(std::min(std::max(SignalWatch::interrupts(), stop_.load() ? 1 : 0), 2));
}

void Supervision::order(const ProgramAction& action, bool standing) {
    constexpr std::uint64_t stood = 2; // a port may take a segment before its last step is made
    const std::lock_guard lock(order_mutex_);
    orders_.push_back({action, pushed_ + (standing ? stood : 0)});
}

bool Supervision::carried_out() const {
    const std::lock_guard lock(order_mutex_);
    return orders_.empty() && (outputs_ == nullptr || outputs_->reached());
}

void Supervision::end_outputs() {
    if (outputs_ != nullptr) {
        outputs_->end();
    }
}

// Orders whose place the machine has reached; and the outputs' own trouble, which holds the motion.
void Supervision::tend_outputs(std::uint64_t executed) {
    if (outputs_ == nullptr) {
        return;
    }
    {
        const std::lock_guard lock(order_mutex_);
        while (obeyed_ == 0 && !orders_.empty() && executed >= orders_.front().after) {
            outputs_->act(orders_.front().action);
            orders_.pop_front();
        }
    }
    outputs_->update();
    if (obeyed_ > 0 || !trouble_.empty()) {
        return;
    }
    trouble_ = outputs_->trouble();
    if (!trouble_.empty()) {
        ask_target(1);
    }
}

void Supervision::begin_line(std::uint64_t line, std::uint64_t moves) {
    const std::lock_guard lock(lines_mutex_);
    if (lines_.empty() || lines_.back().line != line || lines_.back().moves != moves) {
        lines_.push_back({line, moves, pushed_});
    }
}

Supervision::Reached Supervision::reached() const {
    const std::lock_guard lock(lines_mutex_);
    return lines_.empty() ? Reached{} : Reached{lines_.front().line, lines_.front().moves, passed_};
}

// The machine is in the segment behind those that were executed.
void Supervision::come_to(std::uint64_t executed) {
    constexpr unsigned looks_a_place = 100;
    std::vector<RunTarget::AxisPlace> places;
    const bool looks = looks_++ % looks_a_place == 0;
    if (looks) {
        places = target_->places();
    }
    const std::lock_guard lock(lines_mutex_);
    if (looks) {
        passed_ = std::move(places);
    }
    while (lines_.size() > 1 && lines_[1].segment <= executed) {
        lines_.pop_front();
    }
}

std::string Supervision::with_trouble(const std::string& ending) const {
    if (trouble_.empty()) {
        return ending;
    }
    constexpr std::string_view begin = "interrupted: ";
    const bool prefixed = ending.compare(0, begin.size(), begin) == 0;
    const std::string rest = prefixed ? ending.substr(begin.size()) : ending;
    return rest.empty() ? trouble_ : trouble_ + "; " + rest;
}

// A spindle that was ended comes to a standstill by its own ramp, and modules confirm what they were told; a further
// signal does not wait for it.
std::string Supervision::outputs_end() const {
    if (outputs_ == nullptr) {
        return {};
    }
    const int signals = SignalWatch::interrupts();
    while (outputs_->ends() && SignalWatch::interrupts() == signals) {
        system_clock().sleep_us(poll_every_us);
    }
    return outputs_->unended();
}

void Supervision::hand_over() {
    FeedSegment segment;
    bool takes = true;
    while (takes && port_->room() > 0 && ring_.pop(segment)) {
        taken_ticks_.fetch_add(segment.duration_ticks, std::memory_order_relaxed);
        takes = port_->submit(segment);
        if (record_ != nullptr) {
            record_->handed(segment.duration_ticks);
        }
    }
    // In this order: what was pushed before complete_ is seen.
    const bool complete = complete_.load();
    if (complete && !completed_ && ring_.empty()) {
        completed_ = true;
        port_->complete();
    }
}

// Returns why the run ends before its first motion; empty: it begins.
std::string Supervision::begin() {
    if (SignalWatch::interrupted()) {
        return "interrupted before anything was moved; the drives were not enabled";
    }
    const FeedSegment first = ring_.front();
    began_ = true;
    if (const hal::PortFailure failure = port_->prepare(first)) {
        return target_->sentence(failure);
    }
    before_ = port_->poll().executed;
    return {};
}

// Returns why the run ended; empty: all was executed.
std::string Supervision::supervise() {
    for (std::uint64_t next_us = system_clock().now_us();;
         next_us = std::max(next_us + poll_every_us, system_clock().now_us())) {
        system_clock().sleep_until_us(next_us);
        hal::PortState state;
        const bool completed = completed_;
        try {
            obey();
            state = port_->poll();
            hold_asked_.store(!target_->holds().empty());
            hand_over();
        } catch (const std::exception& error) {
            trouble_ = trouble_.empty() ? error.what() : trouble_;
            ask_target(1);
            state = port_->poll();
        }
        const hal::PortPhase phase = state.phase;
        executed_.store(state.executed - before_);
        come_to(state.executed - before_);
        const std::uint64_t now_us = system_clock().now_us();
        if (record_ != nullptr) {
            record_->looked(now_us, state.executed - before_);
        }
        if (phase == hal::PortPhase::fault) {
            end_outputs();
            const hal::PortFailure failure = port_->failure();
            return or_unsaid(failure ? target_->sentence(failure) : std::string());
        }
        if (phase == hal::PortPhase::halted) {
            return or_unsaid(target_->halted(obeyed_ > 1));
        }
        if (phase == hal::PortPhase::idle && completed) {
            return target_->achieved() ? std::string() : target_->holds();
        }
        if (obeyed_ == 1 && now_us > obeyed_us_ + halt_us) {
            obeyed_ = 2;
            end_outputs();
            port_->quick_stop();
        } else if (obeyed_ == 2 && now_us > obeyed_us_ + give_up_us) {
            return "interrupted, but not every drive has confirmed that it stands";
        }
        tend_outputs(state.executed - before_);
    }
}

// Counted in looks, not in time: a process that was stopped meanwhile is no planner that is blocked.
void Supervision::await_planner() noexcept {
    std::uint64_t writes = OutputFile::writes();
    for (int looks = 0; looks < stall_s * looks_a_second && !leaves_.load(); ++looks) {
        system_clock().sleep_us(us_per_s / looks_a_second);
        if (const std::uint64_t now = OutputFile::writes(); now != writes) {
            writes = now;
            looks = 0;
        }
    }
    if (!leaves_.load()) {
        port_->close();
        abandon(ending_ + "; an output whose reader does not read was given up", not_finished);
    }
}

void Supervision::work() noexcept {
    std::string reason;
    try {
        reason = begin();
        if (reason.empty()) {
            reason = supervise();
        }
    } catch (const std::exception& error) { // while it was prepared or stopped
        reason = error.what();
        port_->quick_stop();
    }
    end(reason);
}

// The one end of a run. The axes stand, or are known not to have confirmed it.
void Supervision::end(const std::string& reason) noexcept {
    const auto add = [this](const std::string& what) {
        ending_ += what.empty() || ending_.empty() ? what : "; " + what;
    };
    const auto step = [&](const auto& what) {
        try {
            what();
        } catch (const std::exception& error) {
            add(error.what());
        }
    };
    end_outputs();
    if (outputs_ != nullptr && trouble_.empty()) {
        trouble_ = outputs_->trouble();
    }
    ending_ = with_trouble(reason);
    if (began_) {
        step([&] {
            places_ = target_->places();
            where_ = target_->where() + on_line(line());
        });
        step([&] { add(target_->finish()); });
    }
    step([&] { add(outputs_end()); });
    if (state_ != nullptr) {
        step([&] { state_->ends(places_); });
    }
    const std::string sentence =
        (ending_.empty() ? std::string("interrupted while outputs were written; the motion was complete") : ending_) +
        where_;
    signals_->at_once([this, sentence] {
        port_->close();
        abandon(sentence, not_finished);
    });
    if (!ending_.empty()) {
        ending_ += where_;
    }
    const bool complete = ending_.empty();
    over_.store(true);
    if (!complete) {
        await_planner();
    }
}

} // namespace splinefeed::host
