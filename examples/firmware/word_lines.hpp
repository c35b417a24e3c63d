// SPDX-License-Identifier: MIT
// WordLines: step and direction lines that a coprocessor switches, by words {levels, how long they stay}.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/s5_pulse_train/dda_loader.hpp"
#include "splinefeed/s5_pulse_train/edge.hpp"
#include "splinefeed/s5_pulse_train/sample_dda.hpp"
#include "splinefeed/s5_pulse_train/step_timing.hpp"

#include <array>
#include <cstdint>

namespace firmware {

using splinefeed::PerAxis;

/// Levels of a port, and how long they stay [cycles of the coprocessor].
struct LineWord {
    std::uint32_t levels = 0;
    std::uint32_t cycles = 0;
};

struct WordSettings {
    splinefeed::StepTiming timing{}; ///< of InterpolatedSteps, not on edges; turn_gap() is shorter than a tick
    std::uint32_t cycles_per_us = 1; ///< of the coprocessor
    std::uint32_t lead_ticks = 0;    ///< the levels before a motion stay so long; then come its edges
    std::uint32_t late_ticks = 0;    ///< a word is executed so long after it was written, at most
};

/// The edges are those of StepDirSequencer behind InterpolatedSteps (tests/firmware compares them), by numbers of 32
/// bits. They come out turn_gap() and a tick after their steps are known, when no later step can have an edge there. No
/// word lasts longer than a tick: in a motion the coprocessor never waits, and the instants of all edges follow from
/// that of the first.
/// @tparam Axes  1 to 6
template <unsigned Axes, WordSettings settings>
class WordLines {
public:
    using Dda = splinefeed::SampleDda<Axes>;
    static constexpr auto samples = splinefeed::DdaLoader::Samples::at_ticks;
    static constexpr std::uint32_t counts_in_ticks[2] = {7, 1}; ///< the fastest axis travels less

    constexpr explicit WordLines(const PerAxis<splinefeed::LineMasks>& lines) noexcept : lines_(lines) {
        for (const unsigned k : splinefeed::indices(Axes)) {
            levels_ ^= lines_[k].inverted;
        }
    }

    [[nodiscard]] static constexpr Dda dda() noexcept { return Dda(settings.timing.tick); }
    /// The levels that the port has before the first word.
    [[nodiscard]] std::uint32_t levels() const noexcept { return levels_; }

    /// Writes the words of a tick by write(LineWord). Steps are counted by take().
    template <class Write, class Made>
    void show(Write&& write, Made&& /*made*/) noexcept {
        if (state_ == State::idle) {
            return;
        }
        if (state_ == State::begins) {
            constexpr std::uint32_t lead = settings.lead_ticks * settings.timing.tick * settings.cycles_per_us;
            state_ = State::runs;
            rest_ = lead % splinefeed::ticks_per_us;
            write(LineWord{levels_, lead / splinefeed::ticks_per_us});
        }
        std::array<const Toggle*, Axes> next;
        std::array<std::int32_t, Axes> due;
        for (unsigned k = 0; k < Axes; ++k) {
            next[k] = lane_[k].toggle.data();
            due[k] = next[k]->at;
        }
        std::int32_t from = 0; // the word
        std::uint32_t levels = levels_;
        std::uint32_t rest = rest_;
        for (bool ends = false; !ends;) {
            unsigned axis = 0;
            std::int32_t at = due[0];
            for (unsigned k = 1; k < Axes; ++k) {
                if (due[k] < at) {
                    at = due[k];
                    axis = k;
                }
            }
            ends = at >= tick;
            at = ends ? tick : at;
            if (at != from) {
                rest += static_cast<std::uint32_t>(at - from) * settings.cycles_per_us;
                write(LineWord{levels, rest / splinefeed::ticks_per_us});
                rest %= splinefeed::ticks_per_us;
                from = at;
            }
            if (!ends) {
                levels ^= next[axis]->lines;
                due[axis] = (++next[axis])->at;
            }
        }
        levels_ = levels;
        rest_ = rest;
        for (unsigned k = 0; k < Axes; ++k) {
            lane_[k].pass(next[k]);
        }
    }

    /// @param steps  from the tick before to this one   @param moving  more will come
    /// @param made  (axis, steps) -> void: of the ones that will be made
    template <class Made>
    void take(typename Dda::Steps steps, bool moving, Made&& made) noexcept {
        for (unsigned k = 0; steps != nullptr && k < Axes; ++k) {
            const splinefeed::LineSteps& line = (*steps)[k];
            if (line.count > 0) {
                moving = true;
                made(k, push(k, line));
            }
        }
        if (moving) {
            constexpr std::uint32_t shown_later = 3;
            state_ = state_ == State::idle ? State::begins : state_;
            left_ = shown_later + settings.lead_ticks + settings.late_ticks;
        } else if (state_ != State::idle && --left_ == 0) {
            state_ = State::idle; // the levels at its end were written, and are there
        }
    }

    /// No pulse begins any more. `write.cut(levels, f)` forgets the words that are not executed, calls f(levels before,
    /// levels) for each of them and for `levels`, and returns those that the port keeps.
    /// @return the steps that were shown and not made
    template <class Write>
    PerAxis<std::int32_t> cut(Write&& write) noexcept {
        PerAxis<std::int32_t> back{};
        if (state_ == State::idle) {
            return back;
        }
        const auto take_back = [&](std::uint32_t before, std::uint32_t levels) {
            for (unsigned k = 0; k < Axes; ++k) {
                back[k] += is_on(before, k) || !is_on(levels, k) ? 0 : is_up(levels, k) ? 1 : -1;
            }
        };
        const std::uint32_t kept = write.cut(levels_, take_back);
        for (unsigned k = 0; k < Axes; ++k) {
            std::uint32_t levels = levels_;
            for (const Toggle* toggle = lane_[k].toggle.data(); toggle->lines != 0; ++toggle) {
                take_back(levels, levels ^ toggle->lines);
                levels ^= toggle->lines;
            }
        }
        levels_ = kept;
        for (unsigned k = 0; k < Axes; ++k) {
            lane_[k] = Lane{};
            lane_[k].up = is_up(kept, k);
            levels_ ^= is_on(kept, k) ? lines_[k].step : 0;
        }
        state_ = State::idle;
        return back;
    }
    [[nodiscard]] bool empty() const noexcept { return state_ == State::idle; }

private:
    enum class State : std::uint8_t { idle, begins, runs };

    static constexpr auto tick = static_cast<std::int32_t>(settings.timing.tick); // [1/8 us], as all instants
    static constexpr auto turn_gap = static_cast<std::int32_t>(settings.timing.turn_gap());
    static constexpr auto setup = static_cast<std::int32_t>(settings.timing.setup);
    static constexpr auto high = static_cast<std::int32_t>(settings.timing.high);
    static_assert(turn_gap <= tick && !settings.timing.step_on_edge);

    /// Lines that change their level.
    struct Toggle {
        std::int32_t at = INT32_MAX; // from the start of the tick that is shown next
        std::uint32_t lines = 0;     // 0: behind the last one
    };
    /// An axis: its changes that are to come, in order; behind each step there is room for its three.
    struct Lane {
        // In a tick and turn_gap, 4 ticks of 1/8 us apart at least: two a step, and two of a change of direction.
        static constexpr unsigned capacity = 2 * (2 * tick / static_cast<int>(settings.timing.step_gap()) + 2) + 4;
        unsigned size = 0;
        std::int32_t last = -tick; // the last step
        bool last_turns = false;   // it has changed the direction
        bool up = false;
        std::array<Toggle, capacity> toggle{};

        void push(std::int32_t at, std::uint32_t lines) noexcept { toggle[size++] = {at, lines}; }
        /// A tick is over, and what lies before `first`.
        void pass(const Toggle* first) noexcept {
            const unsigned gone = static_cast<unsigned>(first - toggle.data());
            size -= gone;
            for (unsigned i = 0; i < size; ++i) {
                toggle[i] = {first[i].at - tick, first[i].lines};
            }
            toggle[size] = {};
            last = last - tick < -tick ? -tick : last - tick;
        }
    };

    [[nodiscard]] bool is_on(std::uint32_t levels, unsigned k) const noexcept {
        return ((levels ^ lines_[k].inverted) & lines_[k].step) != 0;
    }
    [[nodiscard]] bool is_up(std::uint32_t levels, unsigned k) const noexcept {
        return ((levels ^ lines_[k].inverted) & lines_[k].direction) != 0;
    }

    /// Adds the changes of these steps; returns how many more will be made, downwards negative.
    std::int32_t push(unsigned axis, const splinefeed::LineSteps& steps) noexcept {
        Lane& lane = lane_[axis];
        const std::int32_t made = static_cast<std::int32_t>(steps.up ? steps.count : 0U - steps.count);
        const std::uint32_t lines = lines_[axis].step;
        Toggle* end = lane.toggle.data() + lane.size;
        std::uint32_t left = steps.count;
        std::uint32_t at = steps.at;
        // Only the first one can turn: neither it nor the one before it is made if they are too close.
        if (lane.up != steps.up && turn_gap + static_cast<std::int32_t>(steps.instant()) - lane.last < turn_gap) {
            end -= lane.last_turns ? 3 : 2;
            lane.up ^= lane.last_turns;
            lane.last_turns = false;
            lane.last = -tick;
            at += steps.interval;
            --left;
        }
        if (left > 0) {
            lane.last_turns = lane.up != steps.up && left == 1;
            if (lane.up != steps.up) {
                lane.up = steps.up;
                *end++ = {turn_gap - setup + static_cast<std::int32_t>(at >> 16), lines_[axis].direction};
            }
            std::int32_t instant = 0;
            do {
                instant = turn_gap + static_cast<std::int32_t>(at >> 16);
                *end++ = {instant, lines};
                *end++ = {instant + high, lines};
                at += steps.interval;
            } while (--left > 0);
            lane.last = instant;
        }
        *end = {};
        lane.size = static_cast<unsigned>(end - lane.toggle.data());
        return made;
    }

    PerAxis<splinefeed::LineMasks> lines_;
    std::uint32_t levels_ = 0;
    std::array<Lane, Axes> lane_{};
    std::uint32_t rest_ = 0; // of a cycle, in eighths
    std::uint32_t left_ = 0; // ticks, until all is executed
    State state_ = State::idle;
};

} // namespace firmware
