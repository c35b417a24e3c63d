// SPDX-License-Identifier: MIT
// SurfacePath: a move under G96, in pieces that have one speed of the spindle each.
#pragma once

#include "splinefeed/s0_program/words/program_step.hpp"
#include "splinefeed/s0_program/words/work_frame.hpp"

namespace splinefeed {

/// Along a piece the speeds differ by at most 5 %, where it is longer than 1/256 of the move; it has the least of them.
class SurfacePath {
public:
    /// Of a line or an arc. Cost of a piece: up to 27 points of the move, with a sine each on an arc.
    /// @param manner  how it is made: its surface speed applies
    /// @param frame  that of the program, for as long as it gives
    /// @param x  the axis of the radius
    /// @param plane  the axes of an arc: the first, the second, across
    /// @param space  the axes x, y and z; -1: the machine does not have it
    void begin(const ProgramStep& move, const MoveManner& manner, const WorkFrame& frame, unsigned x,
               const std::array<unsigned, 3>& plane, const std::array<int, 3>& space) noexcept;
    [[nodiscard]] bool gives() const noexcept { return at_ < whole; }
    void clear() noexcept { at_ = whole; }

    /// The speed of the spindle along the next piece [1/min]. @pre gives()
    [[nodiscard]] Decimal speed() const noexcept { return speed_; }
    /// The next piece; what it refers to, and its manner, stay until the next call. @pre gives()
    void next(const WorkFrame& frame, ProgramStep& out) noexcept;
    [[nodiscard]] const MoveManner& manner() const noexcept { return manner_; }

private:
    static constexpr std::uint32_t whole = 512; // two for the shortest piece, which has a middle

    [[nodiscard]] AxisPoint place(std::uint32_t at) const noexcept;
    [[nodiscard]] Decimal speed_at(std::uint32_t at) const noexcept;
    void choose() noexcept;

    ProgramStep move_{}; // from where the last piece ended
    ArcPlan arc_{};      // of the piece
    MoveManner manner_{};
    Decimal sweep_deg_{}; // these two of the whole move
    Decimal feed_{};
    PathMode mode_ = PathMode::continuous;
    AxisPoint from_{}; // these in the program's coordinates
    AxisPoint to_{};
    PlanePoint centre_{};
    Decimal first_radius_{};
    Decimal last_radius_{};
    std::array<std::uint8_t, 2> plane_{};
    std::array<std::int8_t, 3> space_{}; // the axes x, y and z; -1: the machine does not have it
    std::uint8_t x_ = 0;
    Decimal speed_{};
    std::uint32_t at_ = whole;
    std::uint32_t end_ = whole; // of the next piece
};

} // namespace splinefeed
