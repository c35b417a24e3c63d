// SPDX-License-Identifier: MIT
// CannedCycle: G73, G74, G81 to G86 and G89, one move at a time.
#pragma once

#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/work_frame.hpp"

namespace splinefeed {

/// What a cycle does next. A lift is a rapid before the cycle proper: it is blended as other moves are.
/// A spindle is reversed in the hole, and turned as before behind it.
enum class CycleStep : std::uint8_t {
    lift,
    rapid,
    feed,
    dwell,
    spindle_stop,
    spindle_start,
    spindle_reverse,
    finished
};

/// Words that stay in effect while the motion word does. In mm; Z and R as programmed, so increments under G91.
struct CycleWords {
    Decimal depth{};
    Decimal clearance{}; ///< R
    Decimal dwell_s{};
    Decimal peck{};
    std::int16_t motion = ModalState::no_motion; ///< the cycle that they are complete for
    bool begun = false;                          ///< one cycle of the series has been made
    Decimal initial{};                           ///< where the axis stood before the first one
};

/// The moves are those of the RS274/NGC report with LinuxCNC's levels. First comes a rapid to R if the series began
/// below it. Then the machine goes across at the level of retraction, down to R, and makes the hole. It goes back to R
/// (G99) or to the level before the series (G98).
class CannedCycle {
public:
    /// From the words of a block. @param at  where the machine stands, in program coordinates
    /// @param series  Z and R stay in effect from one cycle to another one, until something else ends the series
    /// Errors: the ProgramError::cycle_... of a missing or impossible word.
    BlockStatus begin(const Block& block, const ModalState& modal, const ModalState& before, const AxisLetters& letters,
                      const AxisPoint& at, bool series, CycleWords& words) noexcept;
    /// The next step; a move ends at `at`.
    CycleStep next(AxisPoint& at) noexcept;
    /// Where it ends.
    [[nodiscard]] AxisPoint end() const noexcept;
    /// The bottom of the hole, on the plane's normal.
    [[nodiscard]] Decimal bottom() const noexcept { return bottom_; }
    /// How far from X0 Y0 the holes are that lie about it, by @ and ^; else 0.
    [[nodiscard]] Decimal radius() const noexcept;
    [[nodiscard]] Decimal dwell_s() const noexcept { return dwell_s_; }

private:
    enum class Phase : std::uint8_t { lift, across, to_clearance, hole, retract, restart, finished };

    BlockStatus read_words(const Block& block, const ModalState& modal, bool fresh, bool placed, char normal,
                           CycleWords& words) noexcept;
    /// In the hole, by a P that it needs.
    [[nodiscard]] bool dwells() const noexcept { return code_ == 820 || code_ == 860 || code_ == 890; }
    [[nodiscard]] bool pecks() const noexcept { return code_ == 730 || code_ == 830; }
    BlockStatus check_steps(const Block& block, char first) const noexcept;
    /// Sets the place across, of so many steps.
    void step_to(AxisPoint& place, std::int32_t steps) const noexcept;
    CycleStep next_peck(AxisPoint& at) noexcept;
    CycleStep next_of_tap(AxisPoint& at) noexcept;
    CycleStep go(AxisPoint& at, Decimal level, CycleStep how) const noexcept;

    std::int16_t code_ = 0;
    Phase phase_ = Phase::finished;
    std::uint8_t hole_step_ = 0;
    bool polar_ = false; // the steps are of the radius and of the angle
    std::int32_t repeats_ = 0;
    std::int32_t holes_ = 0;         // begun
    std::array<int, 3> axes_{};      // first, second, normal
    AxisPoint place_{};              // across
    std::array<Decimal, 2> start_{}; // where it was before
    Decimal first_step_{};
    Decimal second_step_{};
    Decimal level_{}; // where the normal axis stands
    Decimal bottom_{};
    Decimal clearance_{};
    Decimal clear_{}; // where it retracts to
    Decimal depth_{}; // of the next peck
    Decimal peck_{};
    Decimal dwell_s_{};
};

} // namespace splinefeed
