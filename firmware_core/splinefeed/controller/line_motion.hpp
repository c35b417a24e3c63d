// SPDX-License-Identifier: MIT
// LineMotion: the lines of a controller into a motion without end.
#pragma once

#include "splinefeed/controller/block_conditions.hpp"
#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/controller/line_numbers.hpp"
#include "splinefeed/move_stream/move_stream.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

namespace splinefeed {

/// What became of the items of a line.
enum class BlockProgress : std::uint8_t {
    done,  ///< all of them are passed on
    full,  ///< the path has no room: take segments first
    waits, ///< the first one is for the controller: waiting() says what it is, and whether the machine has to stand
};

/// Memory: that of Interpreter, and 1.5 KB.
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

    /// All that it refers to must outlive it.
    /// @param points  for curves through points, G5.5; null: they are refused
    /// @param values  of words that are no plain numbers, and of conditions; null: they are refused
    LineMotion(const ControllerSettings& settings, MoveStream& stream, PointCurve<ProgramScalar>* points = nullptr,
               WordEvaluator* values = nullptr) noexcept
        : settings_(&settings), stream_(&stream), values_(values), interpreter_(settings.program, values, points) {}

    /// The next line; then pass_on(). Errors: BlockInterpreter::push(), BlockConditions::take().
    BlockStatus push(std::string_view text, std::uint32_t line) noexcept;
    /// Forgets conditions that are open: a program begins.
    void begin_program() noexcept { conditions_.clear(); }
    [[nodiscard]] BlockInterpreter& interpreter() noexcept { return interpreter_; }
    /// Where the motion is steered.
    [[nodiscard]] MoveStream& stream() noexcept { return *stream_; }

    /// Passes the items of the line on.
    BlockProgress pass_on() noexcept;
    /// The same where nothing shall move.
    void leave_out() noexcept;
    /// @pre pass_on() has said `waits`
    [[nodiscard]] const Waiting& waiting() const noexcept { return waiting_; }
    /// It is carried out, or left out; pass_on() goes on behind it.
    void carried_out() noexcept;
    /// Its move begins. @pre it is a probe move
    void begin_waiting() noexcept;
    /// Passes a jog on, cut where it would leave the travel. @pre push_jog() was ok
    BlockProgress pass_jog() noexcept;
    /// The oldest event whose place the motion has come to. false: there is none
    bool take_event(ProgramEvent& out) noexcept;

    /// The next segment.
    Pull next(FeedSegment& out, Supply supply) noexcept;
    /// MoveStream::look_ahead(), for the work of a call.
    bool look_ahead() noexcept { return stream_->look_ahead(settings_->work_a_call); }
    /// Whether all that is known has been delivered, to standstill.
    [[nodiscard]] bool exhausted() const noexcept { return stream_->exhausted() && !interpreter_.has_curve(); }
    /// The line of the program that a segment of that waypoint belongs to, as the interpreter was told; 0: unknown.
    [[nodiscard]] std::uint32_t line_of(std::uint32_t waypoint) const noexcept { return line_numbers_.find(waypoint); }
    /// Why the path ended before its end: a move leaves the travel, or what the counters hold.
    [[nodiscard]] bool left_travel() const noexcept { return refused_ || stream_->has_failed(); }

    /// Goes on from where the motion stands: forgets what is left of it, also of a line, and what was asked of it. @pre
    /// the stream is at rest
    void restart() noexcept;
    /// The machine stands elsewhere: the motion begins anew there.
    void place(const PerAxis<Position>& position) noexcept;

private:
    static constexpr std::size_t most_events = 8;
    struct Event {
        ProgramEvent event{};
        std::uint32_t behind = 0; // so many moves
    };

    void forget() noexcept;
    [[nodiscard]] bool needs_rest() const noexcept;
    [[nodiscard]] bool is_due_at_once() const noexcept;
    BlockProgress pass_item() noexcept;
    BlockProgress pass_move() noexcept;
    [[nodiscard]] PathElement<ProgramScalar> element_of_item() const noexcept;
    void let_go() noexcept;
    [[nodiscard]] bool leaves_travel(const PerAxis<Position>& place) const noexcept;
    void cut(PathElement<ProgramScalar>& element) const noexcept;

    const ControllerSettings* settings_;
    MoveStream* stream_;
    WordEvaluator* values_;
    BlockConditions conditions_;
    Interpreter<ProgramScalar> interpreter_;
    ProgramItem<ProgramScalar> item_;
    LineNumbers line_numbers_; // of the moves in the path
    Waiting waiting_;
    std::array<Event, most_events> events_{};
    std::size_t event_count_ = 0;
    bool item_pending_ = false; // item_ is still to be passed on
    bool waits_ = false;
    bool refused_ = false; // the path took no move
};

} // namespace splinefeed
