// SPDX-License-Identifier: MIT
// ChainSmoother: runs of short lines to few long quintics.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/s1_blended_path/chain_points.hpp"
#include "splinefeed/s1_blended_path/line_parts.hpp"
#include "splinefeed/s1_blended_path/path_element.hpp"
#include "splinefeed/s1_blended_path/path_state.hpp"

namespace splinefeed {

/// A move and the index of the programmed one at its end.
template <Scalar S>
struct IndexedMove {
    PathElement<S> element{};
    std::uint32_t index = 0;
};

/// Passes moves on, but for chains. Lines that are one, to rounding or a part of the tolerance, and have one feed, are
/// passed on as one for each 32 of them at most. Other chains are lines in continuous
/// mode that meet in small angles. A chain becomes quintics that
/// join each other with direction and curvature (`joined`). Each is within the tolerance of the programmed lines, which
/// is checked before it is passed on. That is chain_tolerance_mm, if it is less than tolerance_mm. What is left of the
/// latter is that of the joints at the ends of the chain. Where not even one line becomes a quintic, it stays a line,
/// and the chain ends there.
///
/// Class: G2 along a chain; no curvature at its ends. Look-ahead: 64 points; what is passed on does not depend on the
/// times of the calls. Memory: a ring of 72 points. Cost per point: 13 steps of smoothing, and about 50 points of a
/// quintic with their distances.
template <Scalar S>
class ChainSmoother {
public:
    /// @param half_sine  SharpestBlend::half_sine: with more of phi/2 two lines are no chain; 0: with 20 degrees
    ChainSmoother(int axes, S half_sine) noexcept : points_(axes), most_turn_(scale2(half_sine, 1)) {}

    /// Where the first move begins. Call it once, before push().
    void start(const PerAxis<Position>& position) noexcept { start_ = position; }
    /// Whether push() may be called.
    [[nodiscard]] bool has_room() const noexcept;
    /// @pre has_room(), not finished; the element is valid
    void push(const PathElement<S>& element, std::uint32_t index) noexcept;
    void finish() noexcept { finished_ = true; }
    /// The next move to pass on; starved: it needs more to decide.
    /// @param parts  where moves end within a line that is passed on, in its order
    Pull next(IndexedMove<S>& out, LineParts& parts) noexcept;

    /// Runs of lines that became quintics.
    [[nodiscard]] std::uint64_t chains() const noexcept { return chains_; }

private:
    static constexpr std::uint64_t look_ahead = 64;
    static constexpr double longest_line = 0x1p27; // 33 m, of a line and of a piece: half of what a move may be
    enum class Kind : std::uint8_t { nothing, single, chain, closed }; // a closed chain has ended

    [[nodiscard]] static S tolerance_of(const PathElement<S>& element) noexcept {
        return scale2(smaller(element.tolerance_mm, element.chain_tolerance_mm), -chord_unit_log2);
    }
    [[nodiscard]] bool goes_on(const PathElement<S>& element) const noexcept;
    [[nodiscard]] bool too_short(S length) const noexcept;
    [[nodiscard]] S off_left_out(const PathElement<S>& element) const noexcept;
    [[nodiscard]] bool may_leave_out(const PathElement<S>& element) const noexcept;
    void restore() noexcept;
    void smooth_newest() noexcept;
    void begin(const PathElement<S>& element, std::uint32_t index, const PerAxis<Position>& from) noexcept;
    void begin_pending(const PerAxis<Position>& from) noexcept;
    void append(const PathElement<S>& element, std::uint32_t index) noexcept;
    void add_point(const PerAxis<Position>& place, std::uint32_t index) noexcept;
    void close() noexcept;
    [[nodiscard]] S length_to(const PerAxis<Position>& place, PerAxis<S>& direction) const noexcept;
    [[nodiscard]] std::uint64_t farthest() const noexcept;
    [[nodiscard]] bool merged(std::uint64_t to) const noexcept;
    [[nodiscard]] S limit_of(std::uint64_t to) const noexcept;
    [[nodiscard]] std::uint64_t longest_piece(PathState<S>& end, BezierShape<S>& shape, S& limit) noexcept;
    [[nodiscard]] bool pass_straight(PathElement<S>& out, LineParts& parts) noexcept;
    void pass_line(PathElement<S>& out) noexcept;
    [[nodiscard]] bool pass_piece(PathElement<S>& out) noexcept;

    ChainPoints<S> points_;
    S most_turn_; // 2 sin(phi/2) of lines of a chain; 0: that of 40 degrees
    PerAxis<Position> start_{};
    PerAxis<S> direction_{};   // of the last line of the chain
    PathState<S> state_{};     // where the chain was passed on to
    IndexedMove<S> kept_{};    // a move that is no chain
    IndexedMove<S> pending_{}; // the move behind the chain
    PathElement<S> end_{};     // the last one of the chain
    std::uint32_t end_index_ = 0;
    bool left_out_ = false;      // the end of end_ is no point of its own
    bool merged_before_ = false; // the last point, had that place not been left out
    S tolerance_{};              // of the chain, in chord units
    S spare_{};                  // what its joints have beyond that
    std::uint64_t front_ = 0;    // the point that was passed on last
    std::uint64_t span_ = 8;     // lines of the last quintic
    std::uint64_t chains_ = 0;
    std::uint32_t passed_ = 0; // moves passed on, modulo 2^32
    Kind kind_ = Kind::nothing;
    bool straight_ = false; // all of the chain that was passed on is lines
    bool has_pending_ = false;
    bool finished_ = false;
};

} // namespace splinefeed
