// SPDX-License-Identifier: MIT
// TpMotion: queued moves to the position of every servo period, by the motion core.
//
//   add() ──► queue ──► MoveStream: 64 moves, 512 cells ──► ring of segments ──► position
//             2048                                          `ahead`             one a period
//
// In each period planning goes on until its share of the period is over, so the next pass of the plan begins as many
// periods before its result is needed as segments are ready. Where the ring is empty all the same, the motion goes on
// by the plan that there is, which ends at standstill (UnderrunPolicy::urgent).
#pragma once

#include "kept_curve.hpp"
#include "spindle_sync.hpp"
#include "tp_core.h"
#include "tp_paced.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/jerk_planner.hpp"
#include "splinefeed/move_stream/scalar_stream.hpp"

#include <array>

#ifndef SPLINEFEED_TP_WINDOW
#define SPLINEFEED_TP_WINDOW 512 // cells of look-ahead; a quarter with a jerk limit
#endif

namespace splinefeed::linuxcnc {

using Mm = PerAxis<double>; ///< mm and degrees, in the order of the planned axes

/// A move in the queue.
struct QueuedMove {
    PathElement<double> element{};
    Mm to{};
    Mm in{}; ///< unit directions at its ends
    Mm out{};
    double length_mm = 0.0;
    double pitch_mm = 0.0; ///< of a move that follows the spindle
    Mm bottom{};           ///< of a tap
    bool taps = false;
    bool stands_before = false;
    bool probes = false;
};

class TpMotion {
public:
    void create(const tpc_settings& settings, const tpc_machine& machine) noexcept;
    void set(const double* position) noexcept;
    [[nodiscard]] bool begins() const noexcept { return state_ < State::path && first_ != last_; }
    void begin(const tpc_machine& machine) noexcept;
    [[nodiscard]] int add(const tpc_move& move) noexcept;
    void spindle(double turns, double per_s) noexcept {
        turns_ = turns;
        turns_per_s_ = per_s;
    }
    void run(const tpc_input& input, tpc_output& output) noexcept;
    [[nodiscard]] const tpc_figures& figures() const noexcept { return figures_; }

private:
    enum class State : std::uint8_t {
        no_path,
        leads,   ///< the same, and the next path begins with a line to `lead_to_`
        between, ///< the same, before move `pushed_`, which follows the spindle
        path,
        path_waits, ///< at standstill before move `pushed_`
        backs,      ///< on its way back
        back_over,  ///< at standstill at the end of it
        sync_waits, ///< likewise, before a move that follows the spindle
        sync,       ///< it follows the spindle
        tap_back,   ///< and back
        tap_stops,
        tap_returns ///< to where it began, without the spindle
    };

    static constexpr std::size_t window_cells = SPLINEFEED_TP_WINDOW;
    static constexpr std::size_t jerk_cells = window_cells / 4;
    static constexpr std::size_t all_jerk_cells = jerk_cells + jerk_cells / 3;
    static constexpr int most_ahead = 64;                  // periods
    static constexpr unsigned ring_size = 8U * most_ahead; // a period has up to 8 segments (MachineTiming)
    static_assert(KeptCurve::capacity >= 2U * (window_cells + all_jerk_cells), "the plan knows as many segments ahead");

    [[nodiscard]] QueuedMove& move(unsigned n) noexcept { return queue_[n % tpc_capacity]; }
    [[nodiscard]] double scale(unsigned k) const noexcept {
        return machine_.axis[k] < 3 || machine_.axis[k] > 5 ? machine_.mm_per_unit : 1.0;
    }
    [[nodiscard]] Mm mm_of(const double* position) const noexcept;
    [[nodiscard]] std::array<double, 3> ways_sq(const Mm& from, const Mm& to) const noexcept;
    [[nodiscard]] double feed_mm(const QueuedMove& move) const noexcept;
    [[nodiscard]] double told_way(const Mm& from, const Mm& to) const noexcept;
    [[nodiscard]] int measure(const Mm& from, QueuedMove& out) noexcept;
    void leave_path() noexcept;
    void forget() noexcept;
    void fail(const char* reason) noexcept;
    void steer(const tpc_input& input) noexcept;
    [[nodiscard]] bool plan(bool may_begin) noexcept;
    [[nodiscard]] const char* begin_path() noexcept;
    bool push_one(bool may_begin) noexcept;
    bool push_moves(bool may_begin) noexcept;
    [[nodiscard]] bool pauses() const noexcept;
    [[nodiscard]] bool knows_enough() noexcept;
    [[nodiscard]] bool rests() const noexcept;
    [[nodiscard]] bool stands() const noexcept { return ring_count_ == 0 && rests(); }
    [[nodiscard]] bool at_known_end() const noexcept { return !backs() && stands() && stream_->exhausted(); }
    void follow(bool planned) noexcept;
    [[nodiscard]] SpindleSync::Leg leg(unsigned n, const Mm& from) noexcept;
    [[nodiscard]] bool goes_on(unsigned n) noexcept;
    [[nodiscard]] bool overlaps(unsigned n) noexcept;
    [[nodiscard]] double left_to_join() noexcept;
    void run_synced(const tpc_input& input, tpc_output& output) noexcept;
    void follow_spindle() noexcept;
    void tap(tpc_output& output) noexcept;
    [[nodiscard]] Mm place() const noexcept;
    [[nodiscard]] bool is_before_end(unsigned n, const Mm& at) noexcept;
    void come_to(unsigned n, const Mm& at) noexcept;
    [[nodiscard]] bool backs() const noexcept { return state_ == State::backs || state_ == State::back_over; }
    [[nodiscard]] bool turns_round(bool backward) noexcept;
    void come_back_to(std::uint32_t piece, const Mm& at) noexcept;
    [[nodiscard]] double turned_to_end(const Mm& at) noexcept;
    void turn(const Mm& at) noexcept;
    void take_apart() noexcept;
    [[nodiscard]] Status lead() noexcept;
    [[nodiscard]] bool step(bool steps) noexcept;
    void tell(const Mm& before, tpc_output& output) noexcept;

    tpc_settings settings_{};
    long long share_ns_ = 0;
    unsigned ahead_ = 0;      // segments that are ready now
    unsigned per_period_ = 1; // segments
    tpc_machine machine_{};
    tpc_figures figures_{};
    const char* error_ = nullptr; // of this period

    std::array<PlannedCell<double>, window_cells> window_;
    std::array<Cell<double>, all_jerk_cells> cells_;
    std::array<JerkNode<double>, all_jerk_cells + 1> nodes_;
    std::array<LegNode<double>, all_jerk_cells + 1> scratch_;
    AccelerationPlanner<double> acceleration_{window_};
    JerkPlanner<double> jerk_{window_, {cells_, nodes_, scratch_}};
    Slot<ScalarStream<double>> stream_;
    MotionLimits<double> limits_;
    PathRules<double> rules_;
    SpindleSync sync_; // for moves that follow the spindle, in place of the trajectory
    KeptCurve curve_;  // between the path and the plan

    // Sequence numbers of moves count up and wrap around.
    std::array<QueuedMove, tpc_capacity> queue_;
    unsigned first_ = 0;     // under way
    unsigned pushed_ = 0;    // the next one for the path
    unsigned last_ = 0;      // one behind the newest
    unsigned base_ = 0;      // move 0 of the path
    unsigned begun_ = 0;     // the first move of the path
    unsigned front_ = 0;     // the farthest one that was under way
    unsigned floor_ = 0;     // everything before it is over
    unsigned piece_ = 0;     // the move at the end of the piece of path that the machine is on
    unsigned neared_ = 0;    // the move whose end was seen ahead
    unsigned idle_ = 0;      // periods since the last new move
    unsigned turning_ = ~0U; // the arc that `turns_left_rad_` is of
    double turns_left_rad_ = 0.0;
    Mm lead_to_{};
    Mm begun_at_{}; // the path

    std::array<FeedSegment, ring_size> ring_;
    unsigned ring_head_ = 0;
    unsigned ring_count_ = 0;
    FeedSegment now_{}; // the segment that the machine is on
    double in_now_s_ = 0.0;
    Mm at_{};            // where the machine is
    Mm end_{};           // where the last queued move ends
    double turns_ = 0.0; // of the spindle
    double turns_per_s_ = 0.0;
    Mm sync_from_{};        // where the followed move under way begins
    PacedValue ratio_{1.0}; // 0: held, too
    PacedValue rapids_{1.0};
    PacedValue most_{0.0}; // feed, mm/s
    State state_ = State::no_path;
    bool sent_abort_ = false;
    bool failed_ = false;  // what is queued is not travelled
    bool stepped_ = false; // the path is one move, because of single step
    bool brakes_ = false;  // to turn round
    bool has_now_ = false;
    bool refills_ = false; // the ring, by the old plan
};

} // namespace splinefeed::linuxcnc
