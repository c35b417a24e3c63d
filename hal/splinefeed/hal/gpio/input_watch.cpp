// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/input_watch.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/rt/real_time.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::uint32_t level_check_us = 5000;  // between two reads of the levels
constexpr std::uint64_t behind_ns = 50'000'000; // edges arrive within this time: older steps are not needed
constexpr std::size_t events_at_once = 256;
constexpr int lost_edge_checks = 3; // consecutive checks with a level that contradicts the edges

} // namespace

InputWatch::InputWatch(InputSource& source, const std::vector<WatchedInput>& inputs, const StepLog& log,
                       std::function<void()> disable, const InputWatchSettings& settings)
    : source_(&source), active_(inputs.size()), reader_(log), disable_(std::move(disable)),
      priority_(settings.priority), time_(settings.clock != nullptr ? settings.clock : &system_clock()) {
    for (const WatchedInput& input : inputs) {
        watched_.push_back({.input = input});
    }
}

InputWatch::~InputWatch() {
    ends_.store(true);
    if (thread_) {
        thread_->join();
    }
}

bool InputWatch::start() {
    const std::optional<std::uint64_t> levels = source_->levels();
    if (!levels) {
        error_ = errno;
        return false;
    }
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        const WatchedInput& input = watched_[i].input;
        const bool level = (*levels >> input.bit & 1U) != 0;
        watched_[i].debounce = Debounce(level, input.debounce_us);
        active_[i].store(level == input.active_level);
    }
    thread_ = time_->start([this] {
        if (priority_ > 0) { // StepPort's thread reports what the system refuses
            static_cast<void>(claim_real_time({.priority = priority_}));
        }
        work();
    });
    return true;
}

std::optional<InputChange> InputWatch::take() {
    const std::lock_guard lock(mutex_);
    if (changes_.empty()) {
        return std::nullopt;
    }
    InputChange first = changes_.front();
    changes_.erase(changes_.begin());
    return first;
}

std::string InputWatch::trouble() const {
    const std::lock_guard lock(mutex_);
    return error_ == 0 ? std::string() : std::strerror(error_); // NOLINT(concurrency-mt-unsafe)
}

// A machine whose switches cannot be read must not move.
void InputWatch::fail(int error) {
    disable_();
    const std::lock_guard lock(mutex_);
    error_ = error;
}

void InputWatch::change(std::size_t index, bool active) {
    const Watched& watched = watched_[index];
    InputChange change{index, active, watched.debounce.since_ns(), std::nullopt};
    for (std::size_t i = 0; i < std::min(watched.edge_count, max_edges); ++i) {
        if (watched.edges[i].time_ns == change.time_ns) {
            change.counts = watched.edges[i].counts;
        }
    }
    const std::lock_guard lock(mutex_);
    changes_.push_back(change);
    active_[index].store(active); // behind it: whoever sees the level can take the change
}

void InputWatch::edge(std::size_t index, std::uint64_t time_ns, bool level) {
    Watched& watched = watched_[index];
    if (watched.input.trips_estop && level == watched.input.active_level) {
        disable_();
    }
    watched.differs = 0;
    watched.edges[watched.edge_count++ % max_edges] = {time_ns, reader_.counts_at(time_ns)};
    if (watched.debounce.edge(time_ns, level)) {
        change(index, watched.debounce.settled(time_ns) == watched.input.active_level);
    }
}

void InputWatch::settle(std::uint64_t now_ns) {
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        Watched& watched = watched_[i];
        const std::uint64_t before = watched.debounce.since_ns();
        const bool level = watched.debounce.settled(now_ns);
        if (watched.debounce.since_ns() != before) {
            change(i, level == watched.input.active_level);
        }
    }
}

// A level that keeps contradicting the edges means that an edge was lost. A single contradiction may be an edge that is
// still on its way.
void InputWatch::check_levels(std::uint64_t now_ns) {
    const std::optional<std::uint64_t> levels = source_->levels();
    if (!levels) {
        fail(errno);
        return;
    }
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        Watched& watched = watched_[i];
        const bool level = (*levels >> watched.input.bit & 1U) != 0;
        const bool expected = watched.debounce.due_ns() == Debounce::never ? watched.debounce.settled(now_ns)
                                                                           : !watched.debounce.settled(now_ns);
        watched.differs = level == expected ? 0 : watched.differs + 1;
        if (watched.differs == lost_edge_checks) {
            missed_.fetch_add(1);
            edge(i, now_ns, level);
        }
    }
    static_cast<void>(reader_.counts_at(now_ns - behind_ns));
}

std::uint32_t InputWatch::wait_timeout_us(std::uint64_t now_ns) const noexcept {
    std::uint64_t until = now_ns + level_check_us * ns_per_us;
    for (const Watched& watched : watched_) {
        until = std::min(until, watched.debounce.due_ns());
    }
    return until > now_ns ? static_cast<std::uint32_t>((until - now_ns) / ns_per_us + 1) : 0;
}

void InputWatch::work() noexcept {
    std::array<InputEvent, events_at_once> events;
    std::uint64_t next_check = time_->now_ns();
    while (!ends_.load()) {
        const int count = source_->wait(events, wait_timeout_us(time_->now_ns()));
        if (count < 0) {
            fail(errno);
            return;
        }
        for (const InputEvent& event : std::span(events).first(static_cast<std::size_t>(count))) {
            missed_.fetch_add(event.missed);
            for (std::size_t i = 0; i < watched_.size(); ++i) {
                if (watched_[i].input.bit == event.line) {
                    // An instant of another clock (Linux before 5.7) would never have passed.
                    edge(i, std::min(event.time_ns, time_->now_ns()), event.rising);
                }
            }
        }
        const std::uint64_t now = time_->now_ns();
        settle(now);
        if (now >= next_check) {
            check_levels(now);
            next_check = now + level_check_us * ns_per_us;
        }
    }
}

} // namespace splinefeed::hal::gpio
