// SPDX-License-Identifier: MIT
// ThreadCycle: G76, a thread in passes that go deeper and deeper, one move at a time.
#pragma once

#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/work_frame.hpp"

namespace splinefeed {

/// The passes are those of LinuxCNC (interp_convert.cc, convert_threading_cycle and threading_pass).
class ThreadCycle {
public:
    struct Move {
        bool cuts = false;  ///< with the turns of the spindle; else a rapid
        bool waits = false; ///< for the mark of the spindle
        Decimal x{};
        Decimal z{};
        Decimal way_of_turn{}; ///< where it cuts
    };

    /// @param x, z  where the tool stands: X is the drive line
    /// @param end_z  where the thread ends
    /// Error: thread_word_invalid.
    BlockStatus begin(const Block& block, const ModalState& modal, Decimal x, Decimal z, Decimal end_z) noexcept;
    /// False: behind the last move of the passes; the rapid to the end of the block comes then.
    [[nodiscard]] bool next(Move& out) noexcept;
    /// The place that is farthest from the start, of all passes.
    [[nodiscard]] Decimal deepest_x() const noexcept { return at_depth(end_depth_); }
    [[nodiscard]] Decimal first_z() const noexcept { return start_z_ - shift(end_depth_); }
    [[nodiscard]] Decimal last_z() const noexcept { return target_z_ - shift(peak_ + cut_); }
    /// The least and the greatest way of a turn.
    [[nodiscard]] Decimal pitch() const noexcept { return pitch_; }
    [[nodiscard]] Decimal taper_pitch() const noexcept { return taper_pitch_; }

private:
    enum class Phase : std::uint8_t { back, in, angled_in, over, angled_out, out };

    BlockStatus read_words(const Block& block, const ModalState& modal) noexcept;
    [[nodiscard]] Decimal at_depth(Decimal depth) const noexcept { return inside_ ? x_ + depth : x_ - depth; }
    [[nodiscard]] Decimal shift(Decimal depth) const noexcept;
    void go_deeper() noexcept;

    bool inside_ = false;
    Decimal x_{};
    Decimal start_z_{};
    Decimal target_z_{};
    Decimal peak_{};      // from the drive line to the crests
    Decimal cut_{};       // of the first pass
    Decimal height_{};    // of the thread
    Decimal end_depth_{}; // from the drive line
    Decimal pitch_{};
    Decimal taper_pitch_{};
    Decimal taper_{}; // its way along Z, as the thread goes
    Decimal exponent_{};
    SineCosine compound_{};
    std::int32_t tapers_ = 0;
    std::int32_t springs_ = 0; // passes that are left at full depth
    std::int32_t pass_ = 1;
    Decimal depth_{};
    Phase phase_ = Phase::back;
};

} // namespace splinefeed
