// SPDX-License-Identifier: MIT
// StepGenerator: the part of the firmware that runs in the timer's interrupt. It takes parts of motion from a ring and
// makes steps of them; it stops at once for an emergency stop, and along the path for a limit switch or where the ring
// runs out.
#pragma once

#include "pin_lines.hpp"

#include "splinefeed/base/spsc_ring.hpp"
#include "splinefeed/s5_pulse_train/tick_dda.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

namespace firmware {

/// A feed segment, in the form of the interrupt.
struct MotionPart {
    splinefeed::TickPart ticks;
    PerAxis<std::int32_t> end{};   ///< position at its end [counts]
    bool rest = false;             ///< the machine stands at its end
    std::uint8_t waypoint = 0;     ///< of its segment, modulo 256; for those who ask, as the next one
    std::uint16_t feed_mm_min = 0; ///< the generator does not need it
};

struct Inputs {
    bool estop = false;
    bool limit = false;
};

enum class Stop : std::uint8_t {
    none,
    estop,
    limit,
    halted, ///< as was asked: along the path
    cut     ///< likewise: at once
};

/// How much motion has to lie ahead, in parts of equal duration.
struct Lookahead {
    unsigned start = 1;        ///< a motion begins when the ring holds so many, or a standstill
    unsigned reserve_log2 = 0; ///< 2^this many parts, at most 64: with fewer the motion slows down
    std::uint32_t slew = 1;    ///< change of the rate in a tick: 2^16 / (2 * ticks of the reserve)
    /// So many ticks with a step may be made from a limit switch on which a motion began, until it is left: a switch
    /// that stays pressed is broken, or the motion goes the other way.
    std::uint32_t leaving_steps = 1000;
};

/// The time of the motion runs at a rate of its own, sigma, 2^16 at most. While no standstill lies ahead in the ring,
///
///     sigma = min(1, sqrt(R / S)),   R: parts ahead, S: the reserve,   rising by 1 / (2 S) at most,
///
/// so a machine whose planner is late slows down along the path with v / (2 S) and stands where the ring ends; nothing
/// is lost, and when parts come again it speeds up again. (docs/reference/pvt_map.md has the same law.) A limit switch
/// lets sigma fall to 0 by the same slope.
///
/// tick() belongs to the interrupt; all other functions belong to the main loop.
/// @tparam Lines  what shows the steps: PinLines or WordLines
template <unsigned Axes, class Lines = PinLines<Axes>>
class StepGenerator {
public:
    using Part = MotionPart;
    static constexpr std::uint32_t full_rate = 1U << 16;

    constexpr StepGenerator(std::span<Part> storage, const Lookahead& lookahead, const Lines& lines = {}) noexcept
        : ring_(storage), lines_(lines), dda_(lines.dda()), lookahead_(lookahead) {}

    /// One tick. `write`, as the lines call it, comes first: the levels were computed in the tick before, so edges do
    /// not wait for computations.
    template <class Write>
    void tick(const Inputs& inputs, Write&& write) noexcept {
        ticks_.store(ticks_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        if (inputs.estop) {
            cut(Stop::estop, write);
        }
        obey(write);
        bool steps = false;
        const auto made = [this, &steps](unsigned axis, std::int32_t by) {
            count_[axis].store(count(axis) + by, std::memory_order_relaxed);
            steps = true;
        };
        lines_.show(write, made);
        watch_limit(inputs.limit, steps);
        const auto taken = advance();
        lines_.take(taken, moving_, made);
        active_.store(moving_ || !lines_.empty(), std::memory_order_release);
    }

    /// For the writer of the ring.
    [[nodiscard]] std::size_t room() const noexcept { return ring_.room(); }
    /// Parts that lie ahead.
    [[nodiscard]] std::size_t level() const noexcept { return ring_.size(); }
    /// Adds a part. @pre room() > 0
    void push(const Part& part) noexcept {
        if (part.rest) { // before the part: it must not be seen without its mark
            rests_pushed_.store(rests_pushed_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
        }
        ring_.push(part);
    }

    /// Asks for Stop::halted or Stop::cut: the motion ends, and what is in the ring is not travelled.
    void order(Stop stop) noexcept { order_.store(stop, std::memory_order_relaxed); }
    /// Whether nothing moves, nor will.
    [[nodiscard]] bool stands() const noexcept {
        return order_.load(std::memory_order_relaxed) == Stop::none && level() == 0 && !active();
    }
    /// Along the path, at the rate that time has.
    [[nodiscard]] std::uint32_t feed_mm_min() const noexcept {
        return active() ? feed_.load(std::memory_order_relaxed) * (rate_seen_.load(std::memory_order_relaxed) >> 8) >> 8
                        : 0;
    }

    /// Of the part that is executed, or was the last one.
    [[nodiscard]] std::uint8_t waypoint() const noexcept { return waypoint_.load(std::memory_order_relaxed); }

    /// Whether steps are made, or still will be: false at standstill, also where the ring ran out.
    [[nodiscard]] bool active() const noexcept { return active_.load(std::memory_order_acquire); }
    /// What stopped the machine, first or by the emergency stop: it moves again after restart() and forgive().
    [[nodiscard]] Stop stopped() const noexcept { return stop_.load(std::memory_order_acquire); }
    /// How many times the ring ran out in a motion.
    [[nodiscard]] std::uint32_t underruns() const noexcept { return underruns_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint32_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }
    /// Where the machine stands: the pulses that were written, counted.
    [[nodiscard]] std::int32_t count(unsigned axis) const noexcept {
        return count_[axis].load(std::memory_order_relaxed);
    }

    /// Empties the ring, and begins a motion where the machine stands. @pre not active(), and stopped() or the ring is
    /// empty
    void restart() noexcept {
        ring_.clear();
        rests_passed_ = rests_pushed_.load(std::memory_order_relaxed);
        rest_ = true;
        in_part_ = false;
        dda_ = lines_.dda();
        stand();
    }
    /// Forgets what stopped the machine. Apart from restart(): a stop that comes while a motion is prepared stays.
    void forgive() noexcept { stop_.store(Stop::none, std::memory_order_release); }
    /// States where the machine stands. @pre as for restart()
    void set_counts(const PerAxis<std::int32_t>& counts) noexcept {
        for (unsigned k = 0; k < Axes; ++k) {
            count_[k].store(counts[k], std::memory_order_relaxed);
        }
        stand();
    }

private:
    using DdaSteps = typename Lines::Dda::Steps;

    static constexpr unsigned places_log2 = 6;
    /// sqrt(i / 64), in 1/2^16.
    static constexpr std::array<std::uint32_t, 1U << places_log2> roots = [] {
        std::array<std::uint32_t, 1U << places_log2> table{};
        std::uint64_t root = 0;
        for (std::size_t i = 0; i < table.size(); ++i) {
            while ((root + 1) * (root + 1) <= std::uint64_t{i} << (32 - places_log2)) {
                ++root;
            }
            table[i] = static_cast<std::uint32_t>(root);
        }
        return table;
    }();
    [[nodiscard]] std::uint32_t rate_at(std::size_t level) const noexcept {
        const std::size_t place = level << (places_log2 - lookahead_.reserve_log2);
        return place < roots.size() ? roots[place] : full_rate;
    }

    void stand() noexcept {
        PerAxis<std::int32_t> counts{};
        for (unsigned k = 0; k < Axes; ++k) {
            counts[k] = count(k);
        }
        dda_.stand(counts);
    }
    /// A machine that stands on a switch, or was stopped by it, may move off it, but not far.
    void watch_limit(bool pressed, bool steps) noexcept {
        if (pressed && !on_limit_) {
            leaving_ = moving_ ? 0 : lookahead_.leaving_steps;
        }
        on_limit_ = pressed;
        if (pressed && moving_ && leaving_ == 0) {
            stopping_ = Stop::limit;
        }
        leaving_ -= leaving_ > 0 && steps ? 1U : 0U;
    }
    /// No pulse begins any more.
    template <class Write>
    void cut(Stop reason, Write& write) noexcept {
        end_with(reason);
        const PerAxis<std::int32_t> back = lines_.cut(write);
        for (unsigned k = 0; k < Axes; ++k) {
            count_[k].store(count(k) - back[k], std::memory_order_relaxed);
        }
    }
    /// What was asked for.
    template <class Write>
    void obey(Write& write) noexcept {
        const Stop order = order_.load(std::memory_order_relaxed);
        if (order == Stop::none) {
            return;
        }
        order_.store(Stop::none, std::memory_order_relaxed);
        if (order == Stop::cut) {
            cut(Stop::cut, write);
        } else if (!moving_) {
            end_with(Stop::halted);
        } else if (stopping_ == Stop::none) {
            stopping_ = Stop::halted;
        }
    }
    void end_with(Stop reason) noexcept {
        leaving_ = lookahead_.leaving_steps;
        stopping_ = Stop::none;
        moving_ = false;
        if (reason == Stop::estop || stop_.load(std::memory_order_relaxed) == Stop::none) {
            stop_.store(reason, std::memory_order_relaxed);
        }
    }
    [[nodiscard]] bool rest_ahead() const noexcept {
        return rests_pushed_.load(std::memory_order_acquire) != rests_passed_;
    }

    /// The steps of a tick, if the motion's time comes to one.
    DdaSteps advance() noexcept {
        if (!moving_) {
            if (stop_.load(std::memory_order_relaxed) != Stop::none || ring_.empty() ||
                !(ring_.size() >= lookahead_.start || rest_ahead())) {
                return {};
            }
            moving_ = true;
            rate_ = 0; // from where the ring ran out as slowly as it ended; from standstill begin_part() sets it
            phase_ = full_rate;
        }
        if (stopping_ != Stop::none) {
            if (rate_ <= lookahead_.slew) {
                end_with(stopping_);
                return {};
            }
            rate_ -= lookahead_.slew;
        } else {
            rate_ = rate_ + lookahead_.slew < target_ ? rate_ + lookahead_.slew : target_;
        }
        rate_seen_.store(rate_, std::memory_order_relaxed);
        phase_ += rate_;
        if (phase_ < full_rate) {
            return {};
        }
        phase_ -= full_rate;
        return dda_.left() > 0 ? dda_.tick() : begin_part();
    }

    DdaSteps begin_part() noexcept {
        if (in_part_ && rest_) {
            ++rests_passed_;
        }
        in_part_ = !ring_.empty();
        if (!in_part_) {
            if (stopping_ != Stop::none) {
                end_with(stopping_);
            }
            moving_ = false;
            if (rest_) {
                return dda_.finish(end_); // the step of a crossing in the last half tick
            }
            underruns_.store(underruns_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
            return {};
        }
        const Part& part = ring_.front();
        const DdaSteps steps = dda_.begin(part.ticks);
        target_ = rest_ahead() ? full_rate : rate_at(ring_.size());
        if (rest_ && stopping_ == Stop::none) {
            rate_ = target_; // at standstill time may jump
        }
        rest_ = part.rest;
        feed_.store(part.feed_mm_min, std::memory_order_relaxed);
        waypoint_.store(part.waypoint, std::memory_order_relaxed);
        end_ = part.end;
        ring_.drop();
        return steps;
    }

    // The main loop writes these, the interrupt reads them; or the other way round.
    splinefeed::SpscRing<Part> ring_;
    std::atomic<std::uint32_t> rests_pushed_{0};
    std::array<std::atomic<std::int32_t>, Axes> count_{};
    std::atomic<std::uint32_t> ticks_{0};
    std::atomic<std::uint8_t> waypoint_{0};
    std::atomic<std::uint32_t> underruns_{0};
    std::atomic<Stop> stop_{Stop::none};
    std::atomic<Stop> order_{Stop::none};
    std::atomic<std::uint32_t> feed_{0};
    std::atomic<std::uint32_t> rate_seen_{0};
    std::atomic<bool> active_{false};

    // The interrupt's own, but for restart().
    Lines lines_;
    typename Lines::Dda dda_;
    Lookahead lookahead_;
    PerAxis<std::int32_t> end_{};
    std::uint32_t rests_passed_ = 0;
    std::uint32_t rate_ = 0;
    std::uint32_t target_ = 0;
    std::uint32_t phase_ = 0;   // part of a tick of the motion that has passed
    std::uint32_t leaving_ = 0; // steps that are left to leave the switch on which the motion began
    bool moving_ = false;
    bool in_part_ = false;
    bool rest_ = true;           // the last part that was begun ends at standstill
    Stop stopping_ = Stop::none; // why the rate falls to 0
    bool on_limit_ = false;
};

} // namespace firmware
