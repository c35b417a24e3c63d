// SPDX-License-Identifier: MIT
// Controller: operates a machine by the protocol of grbl 1.1: bytes in, bytes and feed segments out.
#pragma once

#include "splinefeed/controller/answer_text.hpp"
#include "splinefeed/controller/controlled_machine.hpp"
#include "splinefeed/controller/controller_state.hpp"
#include "splinefeed/controller/line_error.hpp"
#include "splinefeed/controller/line_motion.hpp"
#include "splinefeed/controller/line_store.hpp"
#include "splinefeed/controller/overrides.hpp"
#include "splinefeed/controller/query_answers.hpp"
#include "splinefeed/controller/setting_keeper.hpp"
#include "splinefeed/controller/spindle_orders.hpp"
#include "splinefeed/controller/status_report.hpp"

#include <utility>

namespace splinefeed {

/// No I/O, no heap, no clock of its own. Call it from one thread:
///
///     controller.connect();
///     for (;;) {
///         controller.receive(bytes, now_ms);           // what has come; a stop acts at once
///         while (port_has_room && controller.next(segment, runs_dry, now_ms) == Pull::item) port.submit(segment);
///         transport.write(controller.take_answers(buffer));
///     }
///
/// Each line gets exactly one "ok" or "error:n", in order; a reset forgets those that are due. All else that it says is
/// in [ ] or < >, or is an alarm. A line is answered when the interpreter has taken it; what needs the machine at rest,
/// when that is done. Behind a refused line those that had come already are refused, too, and the motion is held. Times
/// are milliseconds of any clock, and wrap.
class Controller {
public:
    /// Behind so long without a block and without motion, lines are counted anew: another program begins.
    static constexpr std::uint32_t recount_ms = 1000;
    static constexpr std::uint32_t pause_ms = 100;    ///< a motion begins if the input pauses for so long
    static constexpr std::uint32_t jog_pause_ms = 20; ///< the same for a jog

    struct Memory {
        std::span<char> lines;   ///< at least ControllerSettings::receive_bytes
        std::span<char> answers; ///< at least least_answers
    };
    static constexpr std::size_t least_answers = 4096;

    /// All arguments must outlive it.
    /// @param keeper  keeps settings, offsets and start-up lines; null: nothing changes settings from here
    Controller(const ControllerSettings& settings, LineMotion& motion, ControlledMachine& machine, Memory memory,
               SettingKeeper* keeper = nullptr) noexcept;

    /// A sender connects: what was still to be said is forgotten, and it is greeted.
    void connect() noexcept;
    /// It has gone: a jog ends, and a program is held on the path.
    void disconnect() noexcept;
    /// What it has sent. Lines wait until next() executes them.
    void receive(std::string_view bytes, std::uint32_t now_ms) noexcept;
    /// A byte that acts at once, from whoever may stop the machine.
    void act(RealtimeByte byte) noexcept;
    /// Moves what is to be said out; returns how many characters.
    std::size_t take_answers(std::span<char> out) noexcept { return answers_.take(out); }

    /// Executes lines as far as that is possible without a segment: for a machine that has no room for one.
    void execute(std::uint32_t now_ms) noexcept;
    /// The same, and writes the next segment. `starved`: there is none now; `busy`: the work of this call is spent.
    /// @param dry  the machine moves and has hardly any segment left
    Pull next(FeedSegment& out, bool dry, std::uint32_t now_ms) noexcept;

    [[nodiscard]] ControllerState state() const noexcept;
    [[nodiscard]] Alarm alarm() const noexcept { return alarm_; }

private:
    friend struct DollarCommands;

    static constexpr std::size_t answer_room = 2048; // of the longest answer
    static constexpr std::size_t report_room = 256;
    static constexpr std::size_t all_lines = SIZE_MAX; // that come until '~'

    using Mode = ControllerMode;
    using Task = ControllerTask;
    /// Block by block; `step`: the next one may begin.
    enum class Pace : std::uint8_t { flows, single, step };
    /// Of the line that is executed: `kept`: the sender's, to be kept as a start-up line.
    enum class LineOrigin : std::uint8_t { sender, kept, start_up };

    // controller.cpp
    void greet() noexcept;
    void stop_waiting() noexcept;
    void hold() noexcept;
    void resume() noexcept;
    void open_door() noexcept;
    void toggle(EventKind coolant) noexcept;
    void set_overrides() noexcept;
    void write_status(bool all) noexcept;
    [[nodiscard]] ControllerState activity() const noexcept;
    [[nodiscard]] MoveStream& stream() const noexcept { return motion_->stream(); }
    [[nodiscard]] bool stands() const noexcept { return stream().at_rest() && reading_.stands; }
    [[nodiscard]] bool is_locked() const noexcept { return alarm_ != Alarm::none || locked_; }
    [[nodiscard]] SettingList setting_list() const noexcept { return {*settings_, sender_, keeper_ != nullptr}; }
    bool take(ModeEvent event) noexcept {
        const Mode before = std::exchange(mode_, mode_behind(mode_, event));
        return mode_ != before;
    }
    [[nodiscard]] bool in_door() const noexcept { return mode_ == Mode::door || mode_ == Mode::closing; }
    [[nodiscard]] bool holds() const noexcept { return mode_ == Mode::held || in_door(); }
    // However many are asked for, reports leave room for answers: without it no line is executed.
    [[nodiscard]] bool may_report() const noexcept { return answers_.room() >= answer_room + report_room; }
    void say(std::string_view text) noexcept { answers_.put("[MSG:").put(text).put(']').end_line(); }
    template <std::size_t size>
    void say(const char (&literal)[size]) noexcept {
        say(std::string_view(literal, size - 1));
    }

    // controller_lines.cpp
    void execute_line() noexcept;
    void execute_block(std::string_view text) noexcept;
    void refuse(LineError error) noexcept;
    void refuse_behind(LineError error) noexcept;
    void refuse_block(const BlockStatus& status, bool jog = false) noexcept;
    void accept() noexcept;
    [[nodiscard]] bool answers_nobody() noexcept;
    [[nodiscard]] bool waits_for_step() const noexcept;
    void switch_single_block() noexcept;
    void drop_partial() noexcept {
        bytes_.restart();
        lines_.drop_partial();
        cancelled_lines_ = cancelled_lines_ < lines_.lines() ? cancelled_lines_ : lines_.lines();
    }
    void forget_lines() noexcept {
        lines_.clear();
        refused_lines_ = cancelled_lines_ = of_another_ = 0;
        origin_ = LineOrigin::sender;
        motion_->begin_program();
    }

    // controller_keeping.cpp
    void set_number(std::int32_t number, Decimal value) noexcept;
    void forget_kept(KeptKind what) noexcept;
    void take_settings() noexcept;
    void take_start_up(unsigned line, std::string_view text) noexcept;
    void execute_start_up(unsigned line, std::string_view text, LineOrigin origin) noexcept;
    [[nodiscard]] bool begin_start_up() noexcept;
    [[nodiscard]] bool may_set() noexcept;
    [[nodiscard]] bool rests() noexcept;
    [[nodiscard]] bool keep_line() noexcept;
    void keep_offsets() noexcept;
    [[gnu::noinline]] void restore_offsets() noexcept; // its stack is for these alone
    void end_line() noexcept;
    [[nodiscard]] bool begin_answer() noexcept;

    // controller_motion.cpp
    [[nodiscard]] bool step() noexcept;
    [[nodiscard]] bool go_on() noexcept;
    [[nodiscard]] bool go_on(BlockProgress progress) noexcept;
    [[nodiscard]] bool carry_out() noexcept;
    void carry_out(const ProgramEvent& event) noexcept;
    void end_task() noexcept;
    void drop_task() noexcept;
    void pause(std::string_view sentence) noexcept;
    void begin_probe() noexcept;
    [[nodiscard]] bool finish_probe() noexcept;
    [[nodiscard]] bool go_home() noexcept;
    [[nodiscard]] bool may_begin() noexcept;
    [[nodiscard]] Supply supply(bool dry) const noexcept;
    void watch() noexcept;

    // controller_endings.cpp
    void brake() noexcept;
    void begin_ending(Task end) noexcept;
    void settle() noexcept;
    void end_reset() noexcept;
    void cancel_jog() noexcept;
    void stop_quickly(Alarm alarm) noexcept;
    void raise(Alarm alarm, std::string_view sentence = {}) noexcept;

    const ControllerSettings* settings_;
    LineMotion* motion_;
    ControlledMachine* machine_;
    SettingKeeper* keeper_;
    LineStore lines_;
    RealtimeBytes bytes_;
    AnswerText answers_;
    SpindleOrders spindle_;
    Overrides overrides_{};
    SenderSettings sender_{};
    StatusReport status_{};
    ProbeResult probe_{};
    MachineReading reading_{};
    StoredLine line_{};
    std::uint32_t now_ms_ = 0;
    std::uint32_t byte_ms_ = 0;  // when the last byte came
    std::uint32_t left_ms_ = 0;  // when the last sender has gone, or the last byte came that does something
    std::uint32_t line_ms_ = 0;  // when the last line came
    std::uint32_t block_ms_ = 0; // when the last block was executed
    std::uint32_t until_ms_ = 0; // end of a dwell
    std::uint32_t line_number_ = 0;
    std::size_t refused_lines_ = 0;                    // that had come when one was refused, or all_lines
    std::size_t cancelled_lines_ = 0;                  // that had come when jogs were cancelled
    std::size_t of_another_ = 0;                       // lines that the sender before has sent: they have no answer
    std::uint32_t home_axes_ = 0;                      // that are still to begin their homing
    std::size_t noted_ = 0;                            // length of the machine's note that was said last
    unsigned lines_left_ = 0;                          // that this call may begin
    unsigned start_up_ = SettingKeeper::startup_lines; // the next start-up line; behind the last: none is to begin
    unsigned start_up_line_ = 0;                       // the number of that which is executed
    LineError refusal_ = LineError::none;
    Mode mode_ = Mode::ready;
    Task task_ = Task::none;
    Pace pace_ = Pace::flows;
    LineOrigin origin_ = LineOrigin::sender;
    Alarm alarm_ = Alarm::none;
    bool locked_ = false; // until $H or $X, whatever alarm_ is
    bool quick_ = false;  // of an end: the machine stops by itself, and where it then stands the motion goes on
    bool jogging_ = false;
    bool alone_ = false;           // the sender has gone
    bool offsets_changed_ = false; // since they were kept
};

} // namespace splinefeed
