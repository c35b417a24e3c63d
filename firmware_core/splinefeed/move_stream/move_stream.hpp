// SPDX-License-Identifier: MIT
// MoveStream: moves and stops in, feed segments out, whatever the scalar is.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/s1_blended_path/path_element.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"
#include "splinefeed/s3_feed_plan/motion_plan.hpp"
#include "splinefeed/s3_feed_plan/steering/steering.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed {

/// What programs are interpreted in, whatever the motion is planned in.
#ifdef SPLINEFEED_WITHOUT_FIXED
using ProgramScalar = float;
#else
using ProgramScalar = Fixed;
#endif

/// What comes behind the moves so far.
enum class Supply : std::uint8_t {
    flows,  ///< more moves, in time: the motion waits for them
    late,   ///< more moves, but the machine cannot wait for them: it goes on along what is known, and may have to brake
    urgent, ///< as late; and where the work of a call is spent, the motion goes on by the plan that there is
    pauses, ///< nothing for now: the last move ends at rest
};

/// A motion without end. Everybody who drives one pushes moves and stops here, and takes segments:
///
///     while (more && stream.has_room()) { stream.push(move); ... if (something needs the machine at rest)
///     stream.stop(); } while (stream.next(segment, Supply::flows, work) == Pull::item) port.submit(segment); if
///     (stream.stands()) { ... it is done ... stream.go_on(); }
///
/// The newest move is kept back, until the next one, stop(), a pause or finish() tells whether the machine stands at
/// its end. What happens behind a move, and does not need the machine at rest, is due once passed() is true of the
/// number of moves before it. FeedSegment::waypoint is the number of the move, from 0 at each place() and restart(), at
/// the end of the segment's piece of path. Steering and answers are those of Trajectory.
class MoveStream {
public:
    // ---- in

    /// The motion begins anew at that place, and what was there is forgotten. Error: position_out_of_range; then it has
    /// no place until the next call.
    virtual Status place(const PerAxis<Position>& position) noexcept = 0;
    /// Goes on from where the motion stands: forgets what is left of it, and what was asked of it. @pre at_rest()
    virtual void restart() noexcept = 0;

    /// Whether push() takes a move. It does not behind stop(), before go_on().
    [[nodiscard]] virtual bool has_room() const noexcept = 0;
    /// The next move, from where the one before ends. false: it is too short to be one (below 0.1 um), and a stop at
    /// its end is one at the end of the move before. Errors: those of TolerancePath::push(); nothing has changed then.
    [[nodiscard]] virtual Result<bool> push(const PathElement<ProgramScalar>& move) noexcept = 0;
#if __STDC_HOSTED__ // a firmware computes nothing in double
    [[nodiscard]] virtual Result<bool> push(const PathElement<double>& move) noexcept = 0;
#endif
    /// The machine stands at the end of the moves so far, until go_on(). false: there is no room yet, call it again.
    virtual bool stop() noexcept = 0;
    virtual void go_on() noexcept = 0;
    /// The machine stands there, too, but nobody waits for it. false: there is no room yet.
    bool rest() noexcept {
        const bool taken = stop();
        go_on();
        return taken;
    }
    /// No more moves will come. Errors: too_few_waypoints.
    virtual Status finish() noexcept = 0;
    /// Number of moves that were taken, modulo 2^32.
    [[nodiscard]] virtual std::uint32_t moves() const noexcept = 0;
    /// Whether the newest one is kept back.
    [[nodiscard]] virtual bool keeps_back() const noexcept = 0;
    /// Whether they end at a stop, and the path has all of them: more moves change nothing of what is planned.
    [[nodiscard]] virtual bool closed() const noexcept = 0;
    /// Of who wants segments as early as they are certain. Who says `flows` all the same has less ahead, and stops
    /// sooner when asked.
    [[nodiscard]] Supply early(Supply supply) const noexcept {
        return supply == Supply::flows && closed() ? Supply::late : supply;
    }
    /// Where they end.
    [[nodiscard]] virtual const PerAxis<Position>& end() const noexcept = 0;

    // ---- out

    /// The next segment.
    /// @param work  bound of the work of this call: Trajectory::next()
    virtual Pull next(FeedSegment& out, Supply supply, unsigned work) noexcept = 0;
    /// Plans ahead what the path has, so that it takes more moves. Returns whether it does so now, and did not before.
    virtual bool look_ahead(unsigned work) noexcept = 0;
    /// Whether the motion has come to the end of so many moves, or beyond.
    [[nodiscard]] virtual bool passed(std::uint32_t moves) const noexcept = 0;
    /// Whether all that is known has been delivered, to standstill.
    [[nodiscard]] virtual bool exhausted() const noexcept = 0;
    /// Whether the last segment ended at rest.
    [[nodiscard]] virtual bool at_rest() const noexcept = 0;
    /// Whether it ended where stop() asked for.
    [[nodiscard]] virtual bool stands() const noexcept = 0;
    /// A segment of standstill; false: the motion has not begun.
    virtual bool stand(FeedSegment& out) noexcept = 0;
    /// The answer of the last next().
    [[nodiscard]] virtual Pull state() const noexcept = 0;
    /// Why the motion ended before the end of the moves: Trajectory::status(), or what the path was not given.
    [[nodiscard]] virtual bool has_failed() const noexcept = 0;
    [[nodiscard]] virtual Status status() const noexcept = 0;

    // ---- steering

    virtual void hold() noexcept = 0;
    virtual void resume() noexcept = 0;
    virtual void abort() noexcept = 0;
    [[nodiscard]] virtual Activity activity() const noexcept = 0;
    virtual void override_feed(Fixed ratio) noexcept = 0;
    virtual void override_rapids(Fixed ratio) noexcept = 0;
    virtual void limit_feed(Fixed mm_s) noexcept = 0;

protected:
    MoveStream() = default;
    MoveStream(const MoveStream&) = default;
    MoveStream& operator=(const MoveStream&) = default;
    ~MoveStream() = default;
};

} // namespace splinefeed
