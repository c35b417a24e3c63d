// SPDX-License-Identifier: MIT
// LineMotion: a motion without end, fed line by line, whatever its scalar.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/s0_program/block_interpreter.hpp"
#include "splinefeed/s0_program/program_item.hpp"
#include "splinefeed/s3_feed_plan/steering/steering.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed {

/// What became of the items of a line.
enum class LineProgress : std::uint8_t {
    done,  ///< all of them are passed on
    full,  ///< the path has no room: take segments first
    waits, ///< the first one is for the controller: waiting() says what it is, and whether the machine has to stand
};

/// What comes behind the moves so far.
enum class Supply : std::uint8_t {
    flows,  ///< more moves, in time
    late,   ///< more moves, but the machine cannot wait for them: it goes on along what is known, and may have to brake
    pauses, ///< nothing for now: the last move, or curve, ends at rest
};

/// Steering is that of Trajectory.
class LineMotion {
public:
    /// What is not for the path.
    struct Waiting {
        ItemKind kind = ItemKind::event;
        MoveKind move = MoveKind::feed; ///< of a move: probe or home
        ProbeCondition probe{};
        std::uint32_t home_axes = 0;
        Decimal dwell_s{};
        ProgramEvent event{};

        [[nodiscard]] bool needs_rest() const noexcept { return kind != ItemKind::event || event.stops; }
    };

    /// Lines are pushed here; then pass_on().
    [[nodiscard]] virtual BlockInterpreter& interpreter() noexcept = 0;
    /// Passes the items of the line on.
    virtual LineProgress pass_on() noexcept = 0;
    /// The same where nothing shall move.
    virtual void leave_out() noexcept = 0;
    /// @pre pass_on() has said `waits`
    [[nodiscard]] virtual const Waiting& waiting() const noexcept = 0;
    /// It is carried out, or left out; pass_on() goes on behind it.
    virtual void carried_out() noexcept = 0;
    /// Its move begins. @pre it is a probe move
    virtual void begin_waiting() noexcept = 0;
    /// Passes a jog on, cut where it would leave the travel. @pre push_jog() was ok
    virtual LineProgress pass_jog() noexcept = 0;
    /// The oldest event whose place the motion has come to. false: there is none
    virtual bool take_event(ProgramEvent& out) noexcept = 0;

    /// The next segment.
    virtual Pull next(FeedSegment& out, Supply supply) noexcept = 0;
    /// Plans ahead what the path has, so that it takes more moves. Returns whether it does so now, and did not before.
    virtual bool look_ahead() noexcept = 0;
    /// Whether all that is known has been delivered, to standstill.
    [[nodiscard]] virtual bool exhausted() const noexcept = 0;
    /// Whether the last segment ended at rest.
    [[nodiscard]] virtual bool at_rest() const noexcept = 0;
    /// The line of the program that a segment of that waypoint belongs to, as the interpreter was told; 0: unknown.
    [[nodiscard]] virtual std::uint32_t line_of(std::uint32_t waypoint) const noexcept = 0;
    /// Why the path ended before its end: a move leaves the travel, or what the counters hold.
    [[nodiscard]] virtual bool left_travel() const noexcept = 0;

    virtual void hold() noexcept = 0;
    virtual void resume() noexcept = 0;
    virtual void abort() noexcept = 0;
    [[nodiscard]] virtual Activity activity() const noexcept = 0;
    /// @param feed  per cent
    /// @param rapids  likewise
    virtual void set_overrides(int feed, int rapids) noexcept = 0;
    /// Goes on from where the motion stands: forgets what is left of it, also of a line, and what was asked of it. @pre
    /// at_rest()
    virtual void restart() noexcept = 0;
    /// The machine stands elsewhere: the motion begins anew there.
    virtual void place(const PerAxis<Position>& position) noexcept = 0;

protected:
    LineMotion() = default;
    LineMotion(const LineMotion&) = default;
    LineMotion& operator=(const LineMotion&) = default;
    ~LineMotion() = default;
};

} // namespace splinefeed
