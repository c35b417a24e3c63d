// SPDX-License-Identifier: MIT
//
// One thread makes all edges:
//
//     segment ring ──► PulseTrain ──► edges of one tick ──► EdgeClock: wait until due ──► one write a chip
//
// It sleeps in slices, so that a cut is seen within one.
#include "splinefeed/hal/gpio/step_port.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <future>
#include <span>

namespace splinefeed::hal::gpio {

namespace {

constexpr std::int64_t ns_per_tick = 125;
constexpr std::uint64_t ns_per_ms = 1'000'000;
constexpr std::size_t ring_segments = 4096;
constexpr std::uint64_t lead_ns = 5 * ns_per_ms;   // longer than any set-up time
constexpr std::uint64_t slice_ns = ns_per_ms / 2;  // of a sleep
constexpr std::uint64_t supply_ns = ns_per_ms / 5; // between two looks for more segments

std::uint64_t guard_of(const StepTiming& timing) noexcept {
    return std::max({timing.high, timing.low, timing.setup, timing.hold}) * std::uint64_t{ns_per_tick};
}

} // namespace

StepPort::Train StepPort::train_for(const StepPortSettings& settings) {
    const LineDiscipline lines(settings.axes, settings.timing);
    if (settings.timing.grid > 1) {
        return PulseTrain<FixedRate>(FixedRate(settings.axes, settings.timing.grid), lines);
    }
    return PulseTrain<StepIntervals>(StepIntervals(settings.axes), lines);
}

// What is held is twice the reserve and more, so that a motion that has just begun is not told to slow down.
StepPort::StepPort(std::vector<ChipOutputs> chips, const StepPortSettings& settings)
    : chips_(std::move(chips)), change_(chips_.size()), settings_(settings), train_(train_for(settings)),
      clock_({.guard_ns = guard_of(settings.timing),
              .tolerated_ns = settings.tolerated_ns,
              .reserve_ns = settings.buffer_ms * ns_per_ms * 2 / 5}),
      ring_(ring_segments) {}

StepPort::~StepPort() {
    stop();
}

std::string StepPort::start() {
    if (!enable(true)) {
        error_.store(errno);
        state_.store(State::failed);
        return {};
    }
    if (!on_) {
        on_ = true;
        settled_ns_ = monotonic_ns() + settings_.settle_ms * ns_per_ms;
    }
    std::promise<std::string> claimed;
    std::future<std::string> missing = claimed.get_future();
    ends_.store(false);
    thread_ = std::thread([this, &claimed] {
        claimed.set_value(claim_real_time(settings_.real_time));
        work();
    });
    return missing.get();
}

void StepPort::stop() noexcept {
    ends_.store(true);
    if (thread_.joinable()) {
        thread_.join();
    }
}

void StepPort::reset() noexcept {
    train_ = train_for(settings_);
    ring_.clear();
    std::fill(change_.begin(), change_.end(), Change{});
    up_ = {};
    base_ = level_;
    have_ = false;
    gathered_ = false;
    overdue_ns_ = 0;
    finished_ = false;
    submitted_ticks_.store(0);
    motion_ns_.store(0);
    complete_.store(false);
    dry_.store(true);
    if (state_.load() != State::failed && !was_cut()) {
        state_.store(State::idle);
    }
}

StepPortReport StepPort::report() const noexcept {
    return {edges_.load(), slowdowns_.load(), stretched_ns_.load()};
}

std::string StepPort::trouble() const {
    const int error = error_.load();
    return error == 0 ? std::string("it was cut off")
                      : std::string("a line cannot be set: ") + std::strerror(error); // NOLINT(concurrency-mt-unsafe)
}

// Steps idle, directions down, where every motion begins.
bool StepPort::enable(bool on) noexcept {
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        const ChipOutputs& chip = chips_[c];
        const auto take = [&](const LevelMasks& lines, bool level) {
            change_[c].mask |= lines.mask;
            change_[c].levels |= level ? lines.mask & ~lines.inverted : lines.mask & lines.inverted;
        };
        take(chip.enable, on);
        // With step_on_edge any change of a step line would be a step.
        for (unsigned k = 0; k < static_cast<unsigned>(settings_.axes); ++k) {
            if (!settings_.timing.step_on_edge) {
                take(chip.step[k], false);
            }
            if (on) {
                take(chip.direction[k], false);
            }
        }
    }
    return write_collected();
}

void StepPort::collect(const Edge& edge) noexcept {
    // Where each edge is a step a line stays as the motion before left it.
    const bool turned = edge.line == Line::step && settings_.timing.step_on_edge && base_[edge.axis];
    const bool level = edge.level != turned;
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        const LevelMasks& lines = edge.line == Line::step ? chips_[c].step[edge.axis] : chips_[c].direction[edge.axis];
        change_[c].mask |= lines.mask;
        change_[c].levels |= level ? lines.mask & ~lines.inverted : lines.mask & lines.inverted;
    }
    (edge.line == Line::direction ? up_ : level_)[edge.axis] = level;
}

bool StepPort::write_collected() noexcept {
    bool written = true;
    for (std::size_t c = 0; c < chips_.size(); ++c) {
        Change& change = change_[c];
        if (change.mask != 0) {
            written = chips_[c].writer->set(change.mask, change.levels) && written;
        }
        change = {};
    }
    return written;
}

bool StepPort::filled() const noexcept {
    const std::uint64_t held = submitted_ticks_.load(std::memory_order_relaxed) * ns_per_tick;
    return complete_.load(std::memory_order_acquire) || ring_.room() == 0 ||
           held >= motion_ns_.load(std::memory_order_relaxed) + settings_.buffer_ms * ns_per_ms;
}

// The clock slows down before the segments run out, and goes on when there are enough of them. It never runs ahead of
// what is still to be made: a process that stood still goes on where it was.
void StepPort::watch_supply(std::uint64_t now_ns) noexcept {
    const std::int64_t to_be_made =
        gathered_ ? gathered_tick_ * ns_per_tick
                  : static_cast<std::int64_t>(submitted_ticks_.load(std::memory_order_relaxed)) * ns_per_tick;
    if (const std::uint64_t late = clock_.wait_for(to_be_made, now_ns); late > 0) {
        overdue_ns_ += late;
        stretched_ns_.store(clock_.stretched_ns(), std::memory_order_relaxed);
    }
    const auto motion = static_cast<std::uint64_t>(std::max<std::int64_t>(clock_.motion_ns(now_ns), 0));
    motion_ns_.store(motion, std::memory_order_relaxed);
    if (clock_.stopping()) {
        const bool resumes = clock_.stands(now_ns) && filled();
        if (resumes) {
            clock_.resume(now_ns);
        }
        dry_.store(!resumes && clock_.stands(now_ns), std::memory_order_relaxed);
        return;
    }
    const std::uint64_t end = submitted_ticks_.load(std::memory_order_relaxed) * ns_per_tick;
    const std::uint64_t reserve = settings_.buffer_ms * ns_per_ms * 2 / 5 + slice_ns;
    if (!complete_.load(std::memory_order_acquire) && end < motion + reserve) {
        clock_.stop(now_ns);
        slowdowns_.fetch_add(at_rest_.load(std::memory_order_relaxed) ? 0 : 1, std::memory_order_relaxed);
    }
}

template <class Engine>
bool StepPort::next_of(PulseTrain<Engine>& train, Edge& edge) noexcept {
    while (!train.next(edge)) {
        FeedSegment segment;
        // In this order: what was submitted before complete() is seen.
        const bool complete = complete_.load(std::memory_order_acquire);
        if (ring_.pop(segment)) {
            train.take(segment);
            taken_.fetch_add(1, std::memory_order_relaxed);
        } else if (complete && !finished_) {
            train.finish();
            finished_ = true;
        } else {
            return false;
        }
    }
    return true;
}

// The next edge of the motion, as far as it is known.
bool StepPort::next(Edge& edge) noexcept {
    if (auto* const train = std::get_if<PulseTrain<StepIntervals>>(&train_)) {
        return next_of(*train, edge);
    }
    return next_of(*std::get_if<PulseTrain<FixedRate>>(&train_), edge);
}

// All edges of the next instant, as far as they are known: before the wait, so that a line changes when it is over.
bool StepPort::gather() noexcept {
    if (!have_ && !(have_ = next(edge_))) {
        return false;
    }
    gathered_ = true;
    gathered_tick_ = edge_.tick;
    stepped_ = {};
    do {
        collect(edge_);
        stepped_[edge_.axis] = stepped_[edge_.axis] || steps(edge_);
    } while ((have_ = next(edge_)) && edge_.tick == gathered_tick_);
    return true;
}

// False: a line could not be set.
bool StepPort::make() noexcept {
    gathered_ = false;
    if (!write_collected()) {
        return false;
    }
    const std::uint64_t at_ns = monotonic_ns();
    for (unsigned k = 0; k < static_cast<unsigned>(settings_.axes); ++k) {
        if (stepped_[k]) {
            counts_[k].fetch_add(up_[k] ? 1 : -1, std::memory_order_relaxed);
            log_.add(at_ns, k, up_[k]);
        }
    }
    late_.add(clock_.made(gathered_tick_ * ns_per_tick, at_ns) + overdue_ns_);
    overdue_ns_ = 0;
    edges_.fetch_add(1, std::memory_order_relaxed);
    stretched_ns_.store(clock_.stretched_ns(), std::memory_order_relaxed);
    return true;
}

bool StepPort::steps(const Edge& edge) const noexcept {
    return edge.line == Line::step && (edge.level || settings_.timing.step_on_edge);
}

void StepPort::work() noexcept {
    while (!ends_.load(std::memory_order_relaxed)) {
        const std::uint64_t now = monotonic_ns();
        if (cut_.load(std::memory_order_acquire)) {
            std::fill(change_.begin(), change_.end(), Change{}); // what was to come
            static_cast<void>(enable(false));
            state_.store(State::cut);
            return;
        }
        const bool idle = state_.load(std::memory_order_relaxed) == State::idle;
        const bool ready = !(idle && (now < settled_ns_ || !filled())) && (gathered_ || gather());
        if (!idle) {
            watch_supply(now);
        }
        if (!ready) {
            if (finished_) {
                state_.store(State::done);
                return;
            }
            wait_until_ns(now + supply_ns, 0);
            continue;
        }
        if (idle) {
            clock_.start(now + lead_ns, 0);
            dry_.store(false, std::memory_order_relaxed);
            state_.store(State::running);
        }
        const std::uint64_t due = clock_.due_ns(gathered_tick_ * ns_per_tick);
        if (due > now + slice_ns) {
            wait_until_ns(now + slice_ns, 0);
            continue;
        }
        wait_until_ns(due, settings_.real_time.spin_ns);
        if (!make()) {
            error_.store(errno);
            state_.store(State::failed);
            return;
        }
    }
}

int StepPort::do_room() const noexcept {
    const std::uint64_t held = submitted_ticks_.load(std::memory_order_relaxed) * ns_per_tick;
    const std::uint64_t most = motion_ns_.load(std::memory_order_relaxed) + settings_.buffer_ms * ns_per_ms;
    return held > most ? 0 : static_cast<int>(std::min<std::size_t>(ring_.room(), 1));
}

bool StepPort::do_submit(const FeedSegment& segment) noexcept {
    const State state = state_.load();
    if (state == State::cut || state == State::failed) {
        return false;
    }
    const auto moving = std::span(segment.end_velocity).first(static_cast<std::size_t>(settings_.axes));
    at_rest_.store(std::all_of(moving.begin(), moving.end(), [](std::int64_t v) { return v == 0; }));
    ring_.push(segment);
    submitted_ticks_.fetch_add(segment.duration_ticks);
    return true;
}

PortState StepPort::do_poll() noexcept {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    switch (state_.load()) {
    case State::cut:
    case State::failed: return {PortPhase::fault, taken};
    case State::done: return {PortPhase::idle, taken};
    case State::idle:
    case State::running: break;
    }
    return {PortPhase::running, taken};
}

} // namespace splinefeed::hal::gpio
