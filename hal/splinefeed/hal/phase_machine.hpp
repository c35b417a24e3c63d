// SPDX-License-Identifier: MIT
// PhaseMachine: the phases of a port as data. What each event makes of each phase, and how long a phase may last.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace splinefeed::hal {

/// How long a phase may last without progress, and the sentence for a phase that lasts longer.
struct PhaseBound {
    static constexpr std::uint64_t final_us = UINT64_MAX; ///< nothing is awaited in it, but perhaps the caller

    std::uint64_t most_us = 0;
    const char* sentence = "";
};

/// A port changes its phase by take() alone, so its table of phase x event is what it does. No phase waits for a
/// machine for ever: each one has a bound, is final, or waits for the caller alone. Has no clock; all instants are of
/// one clock [us].
/// @tparam Phase, Event  enumerations from 0 to their last value `count`, which is none of them
template <class Phase, class Event>
class PhaseMachine {
public:
    static constexpr auto phases = static_cast<std::size_t>(Phase::count);
    static constexpr auto events = static_cast<std::size_t>(Event::count);
    /// table[phase][event]: the next phase; the same phase: the event changes nothing.
    using Table = std::array<std::array<Phase, events>, phases>;
    using Bounds = std::array<PhaseBound, phases>;
    struct Change {
        Phase from;
        Event event;
        Phase to;
    };
    struct Bound {
        Phase phase;
        PhaseBound bound;
    };

    /// The cell of a table.
    [[nodiscard]] static constexpr Phase& cell(Table& table, Phase phase, Event event) noexcept {
        return table[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
    }
    /// Where nothing is said, an event leaves the phase as it is.
    [[nodiscard]] static constexpr Table table_of(std::span<const Change> changes) noexcept {
        Table table{};
        for (std::size_t i = 0; i < phases; ++i) {
            table[i].fill(static_cast<Phase>(i));
        }
        for (const Change& change : changes) {
            cell(table, change.from, change.event) = change.to;
        }
        return table;
    }
    /// Where nothing is said, a phase is final.
    [[nodiscard]] static Bounds bounds_of(std::initializer_list<Bound> bounded) noexcept {
        Bounds bounds;
        bounds.fill({PhaseBound::final_us, ""});
        for (const Bound& each : bounded) {
            bounds[static_cast<std::size_t>(each.phase)] = each.bound;
        }
        return bounds;
    }

    /// @param table  must outlive the object
    PhaseMachine(const Table& table, Phase first) noexcept : table_(&table), phase_(first) {}

    void set_bounds(const Bounds& bounds) noexcept { bounds_ = bounds; }
    /// Returns whether the phase is another one now.
    bool take(Event event, std::uint64_t now_us) noexcept {
        const auto row = static_cast<std::size_t>(phase_);
        const auto column = static_cast<std::size_t>(event);
        ++visits_[row][column];
        const Phase next = (*table_)[row][column];
        if (next == phase_) {
            return false;
        }
        phase_ = next;
        entered_us_ = since_us_ = now_us;
        return true;
    }
    /// What the phase waits for came nearer: its bound counts from now.
    void progress(std::uint64_t now_us) noexcept { since_us_ = now_us; }

    [[nodiscard]] Phase phase() const noexcept { return phase_; }
    [[nodiscard]] std::uint64_t entered_us() const noexcept { return entered_us_; }
    /// Why the phase has lasted too long; null: it has not.
    [[nodiscard]] const char* overdue(std::uint64_t now_us) const noexcept {
        const PhaseBound& bound = bounds_[static_cast<std::size_t>(phase_)];
        const bool over = bound.most_us != PhaseBound::final_us && now_us > since_us_ + bound.most_us;
        return over ? bound.sentence : nullptr;
    }
    /// How often an event came in a phase.
    [[nodiscard]] std::uint32_t visits(Phase phase, Event event) const noexcept {
        return visits_[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
    }

private:
    const Table* table_;
    Bounds bounds_{};
    std::array<std::array<std::uint32_t, events>, phases> visits_{};
    Phase phase_;
    std::uint64_t entered_us_ = 0;
    std::uint64_t since_us_ = 0; // begin, or last progress
};

} // namespace splinefeed::hal
