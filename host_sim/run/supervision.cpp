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
constexpr int looks_a_second = 100;
constexpr int not_finished = 1;

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
    at_rest_ = segment.ends_at_rest();
    feed_.push(segment);
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
        feed_.complete();
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

// Requests to end, by now. Twice before one look counts twice.
int Supervision::requests() {
    if (stop_.load()) {
        feed_.set_trouble(stop_why_);
    }
    return std::min(std::max(SignalWatch::interrupts(), stop_.load() ? 1 : 0), 2);
}

void Supervision::begin_line(std::uint64_t line, std::uint64_t moves) {
    const std::lock_guard lock(lines_mutex_);
    if (lines_.empty() || lines_.back().line != line || lines_.back().moves != moves) {
        lines_.push_back({line, moves, feed_.pushed()});
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
    const std::string& trouble = feed_.trouble();
    if (trouble.empty()) {
        return ending;
    }
    constexpr std::string_view begin = "interrupted: ";
    const bool prefixed = ending.compare(0, begin.size(), begin) == 0;
    const std::string rest = prefixed ? ending.substr(begin.size()) : ending;
    return rest.empty() ? trouble : trouble + "; " + rest;
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

// Returns why the run ends before its first motion; empty: it begins.
std::string Supervision::begin() {
    if (SignalWatch::interrupted()) {
        return "interrupted before anything was moved; the drives were not enabled";
    }
    const FeedSegment first = feed_.front();
    began_ = true;
    if (const hal::PortFailure failure = port_->prepare(first)) {
        return target_->sentence(failure);
    }
    feed_.begin(port_->poll().executed);
    return {};
}

// Returns why the run ended; empty: all was executed.
std::string Supervision::supervise() {
    for (std::uint64_t next_us = system_clock().now_us();;
         next_us = std::max(next_us + poll_every_us, system_clock().now_us())) {
        system_clock().sleep_until_us(next_us);
        std::optional<MotionEnd> end = feed_.look(requests());
        come_to(feed_.executed());
        if (end) {
            return std::move(end->why);
        }
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
    feed_.end_outputs();
    if (outputs_ != nullptr) {
        feed_.set_trouble(outputs_->trouble());
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
