// SPDX-License-Identifier: MIT
// BlockInterpreter: the part of the interpreter that does not depend on the scalar: modes, offsets, what a block means.
#pragma once

#include "splinefeed/s0_program/cycles/canned_cycle.hpp"
#include "splinefeed/s0_program/cycles/cutter_path.hpp"
#include "splinefeed/s0_program/cycles/nurbs_curve.hpp"
#include "splinefeed/s0_program/cycles/program_arc.hpp"
#include "splinefeed/s0_program/cycles/surface_path.hpp"
#include "splinefeed/s0_program/cycles/thread_cycle.hpp"
#include "splinefeed/s0_program/words/block_reader.hpp"
#include "splinefeed/s0_program/words/output_list.hpp"
#include "splinefeed/s0_program/words/program_step.hpp"
#include "splinefeed/s0_program/words/word_use.hpp"

#include <variant>

namespace splinefeed {

/// Use it as `Interpreter<S>`.
class BlockInterpreter {
public:
    /// Longest line, without its end.
    static constexpr std::size_t longest_line = BlockReader::longest_line;

    /// @param evaluator  for # and [: an Expression; none: they are refused. What it refers to must outlive this.
    explicit BlockInterpreter(const ProgramSettings& settings, WordEvaluator* evaluator = nullptr) noexcept;
    // Words refer to the settings of this object.
    BlockInterpreter(const BlockInterpreter&) = delete;
    BlockInterpreter& operator=(const BlockInterpreter&) = delete;

    /// Where the machine stands, in machine coordinates. Before the first push(), and after an abort: then the rest of
    /// the block is dropped.
    void start(const PerAxis<Position>& position) noexcept;
    /// Words for outputs that it does not have are refused from now on: output_missing. It must outlive this.
    void set_outputs(const OutputList& outputs) noexcept { outputs_ = &outputs; }
    /// For another program: modes as at the start, offsets and position as they are.
    void restart() noexcept;
    /// For the next program behind has_ended(): modes as the end has left them.
    void begin_next() noexcept;
    /// The offsets of a state file.
    void restore(const WorkOffsets& offsets) noexcept;
    [[nodiscard]] const WorkOffsets& offsets() const noexcept { return frame_.offsets(); }
    [[nodiscard]] const ModalState& modal() const noexcept { return modal_; }
    [[nodiscard]] const DialectRules& rules() const noexcept { return rules_of(settings_.dialect); }

    /// Executes a line. After an error nothing of the line has happened, and the next line may follow. Nothing
    /// refers to the text after the call; an event says which part of it is its own. @pre next() has returned starved,
    /// else: block_pending
    /// @param line_number  of the source, for the items: ProgramSettings::numbered
    /// Cost, with the items: about 0.25 us on x86-64 for a line, 0.5 us for an arc (bench/gcode_bench). On a Cortex-M4F
    /// 5,000 to 6,000 instructions for a line, 14,000 for an arc (tests/arm/gcode_proof.sh).
    BlockStatus push(std::string_view text, std::uint32_t line_number) noexcept;
    /// Executes a jog: a line with axis words and F, and of G words G20, G21, G53, G90 and G91. It is a straight move
    /// in PathMode::exact_path, and leaves no modes behind. Errors: as push(), and jog_word_unsuited.
    BlockStatus push_jog(std::string_view text, std::uint32_t line_number) noexcept;
    /// The input has ended without M2: next() gives what cutter compensation and a curve hold back. Error:
    /// cutter_gouge.
    BlockStatus end_of_input() noexcept;
    /// The input pauses: the curve through points ends in its last point, and next() gives the rest of it. The next
    /// point begins another one there. @pre next() has returned starved
    void end_curve() noexcept { curve_ = curve_ == CurveState::open ? CurveState::ends : curve_; }
    /// Whether a curve through points goes on, or has moves that next() gives.
    [[nodiscard]] bool has_curve() const noexcept { return curve_ != CurveState::none; }
    /// After an error of push(), for whoever looks for further ones: the words that were understood take effect, and a
    /// feed stands in for one that is wrong or missing. The program goes on at the end of the line's move, which is not
    /// given. The text of the line must still be there.
    void obey_refused() noexcept;
    /// Whether M2, M30 or the closing % has been executed: of M2 and M30, when next() has given the motion of the
    /// block.
    [[nodiscard]] bool has_ended() const noexcept { return progress_ == Progress::ended; }

    /// After the machine has executed a probe move: where the contact was, and where the machine stands now. Without
    /// it the contact counts as found at the end of the move.
    void report_probe(bool contact, const PerAxis<Position>& contact_at, const PerAxis<Position>& stands_at) noexcept;
    /// After the machine has executed M66: the input's value, -1 after the time-out.
    void report_input(Decimal value) noexcept { results_.input = value; }
    /// Where the last move ends, in machine coordinates.
    [[nodiscard]] PerAxis<Position> position() const noexcept;

protected:
    /// Whether the block has steps left, or may have.
    [[nodiscard]] bool has_steps() const noexcept {
        return stage_ != all_done || cutter_.gives() || surface_.gives() || gives_curve();
    }
    [[nodiscard]] bool gives_curve() const noexcept {
        return curve_ == CurveState::gives || curve_ == CurveState::ends;
    }
    /// Whether the block ends or pauses the program behind its motion.
    [[nodiscard]] bool stops_behind() const noexcept { return block_.has(CodeGroup::stop); }
    [[nodiscard]] Pull next_step(ProgramStep& out, ProgramEvent& event) noexcept;
    [[nodiscard]] const AxisLetters& letters() const noexcept { return letters_; }
    [[nodiscard]] const MoveManner& manner() const noexcept { return *manner_; }
    [[nodiscard]] const WorkFrame& frame() const noexcept { return frame_; }
    [[nodiscard]] bool plan_counts(int axis) const noexcept {
        return (settings_.rotary_axes >> static_cast<unsigned>(axis) & 1U) == 0;
    }
    [[nodiscard]] Decimal rapid_tolerance() const noexcept { return settings_.rapid_tolerance_mm; }
    [[nodiscard]] std::uint32_t line() const noexcept { return item_line_; }

private:
    friend class SystemParameters;

    static constexpr std::uint8_t all_done = 255; // a stage behind the last

    // What a block may change and an error puts back; beside these the modes, the cycle, the NURBS and the frame.
    struct Place {
        AxisPoint program{}; // the master: moves do not accumulate errors of rotations
        AxisPoint machine{};
    };
    /// What motion has left for later blocks.
    struct Results {
        PlanePoint spline_out{}; // how G5 left its last end: P and Q
        AxisPoint probe_at{};    // in the units that the program had then, as in LinuxCNC
        Decimal input{};         // of M66
        bool probe_contact = false;
    };

    BlockStatus execute() noexcept;
    BlockStatus execute_words(const BlockUse& use) noexcept;
    BlockStatus read_block(std::string_view text, std::uint32_t line_number, LineKind& kind) noexcept;
    [[nodiscard]] BlockStatus check_jog() const noexcept; // jog_words.cpp
    void obey_modes() noexcept;
    BlockStatus execute_percent() noexcept;
    void plan_homing(std::uint32_t axes) noexcept;
    void end_shift(std::uint32_t axes) noexcept;

    // Offsets: offset_words.cpp.
    BlockStatus set_tool_length() noexcept;
    BlockStatus set_offsets() noexcept;
    BlockStatus check_offsets(CodeGroup group) noexcept;
    BlockStatus plan_reference_move() noexcept;
    void frame_changed() noexcept;

    // Cutter compensation: cutter_words.cpp.
    BlockStatus keep_cutter_number() noexcept;
    BlockStatus set_cutter() noexcept;
    BlockStatus find_tool(CutterOffset& out) const noexcept;
    BlockStatus check_cutter() const noexcept;
    BlockStatus plan_contour(const AxisPoint& from) noexcept;
    BlockStatus check_room() noexcept;
    void count_by_length(const ContourElement& element, const AxisPoint& from) noexcept;
    [[nodiscard]] bool ends_program() const noexcept;
    [[nodiscard]] std::array<unsigned, 3> plane_axes(Plane plane) const noexcept;
    // And: cutter_steps.cpp.
    void set_tool(AxisPoint& point, PlanePoint to) const noexcept;
    void give_held(ProgramStep& out, ProgramEvent& event) noexcept;
    void fill_tool_arc(ProgramStep& out, PlanePoint centre, Decimal sweep_deg) noexcept;
    void fill_corner(ProgramStep& out) noexcept;
    [[nodiscard]] bool hold_back(const ProgramStep& step, const ProgramEvent& event) noexcept;

    // Constant surface speed: surface_steps.cpp.
    [[nodiscard]] bool follow_radius(const ProgramStep& step, ProgramEvent& event) noexcept;
    void give_piece(ProgramStep& out, ProgramEvent& event) noexcept;

    // Motion: motion_words.cpp.
    BlockStatus plan_motion(const BlockUse& use, const ModalState& before) noexcept;
    BlockStatus plan_line() noexcept;
    BlockStatus plan_probe() noexcept;
    BlockStatus plan_turning(bool follows) noexcept;
    BlockStatus plan_thread() noexcept; // thread_words.cpp
    BlockStatus set_feed_of_turns(Decimal way) noexcept;
    BlockStatus plan_arc() noexcept;
    void plan_parabola(unsigned first, unsigned second, const ArcGeometry& arc, const Place& end) noexcept;
    BlockStatus plan_cycle(const ModalState& before) noexcept;
    BlockStatus plan_spline(const ModalState& before) noexcept;
    BlockStatus plan_nurbs() noexcept;
    BlockStatus end_nurbs() noexcept;
    BlockStatus plan_point() noexcept;
    [[nodiscard]] bool leaves_curve_open() noexcept;
    BlockStatus require_feed() const noexcept;
    [[nodiscard]] Place find_end() const noexcept;
    BlockStatus move_to(const Place& end) noexcept;
    [[nodiscard]] BlockStatus check_reach(const AxisPoint& to) const noexcept;
    [[nodiscard]] Decimal axis_value(int axis) const noexcept;
    [[nodiscard]] bool has_axis(int axis) const noexcept { return block_.has(letters_.letter(axis)); }
    [[nodiscard]] SpacePoint space(const AxisPoint& point) const noexcept;
    void drop_block() noexcept;
    void discard_assignments() noexcept;
    [[nodiscard]] bool assigns() const noexcept;
    void set_probe(bool contact, const AxisPoint& program) noexcept;

    // Steps: block_steps.cpp, motion_steps.cpp.
    [[nodiscard]] Pull next_of_block(ProgramStep& out, ProgramEvent& event) noexcept;
    [[nodiscard]] bool event_is_due() noexcept;
    [[nodiscard]] int count_events() noexcept;
    [[nodiscard]] BlockStatus check_outputs() noexcept;
    void fill_event(ProgramEvent& event) const noexcept;
    [[nodiscard]] bool finish_assignments() noexcept;
    [[nodiscard]] bool end_program() noexcept;
    [[nodiscard]] bool next_motion(ProgramStep& out, ProgramEvent& event) noexcept;
    void fill_move(ProgramStep& out, const AxisPoint& to) noexcept;
    [[nodiscard]] bool next_of_thread(ProgramStep& out) noexcept;                   // thread_words.cpp
    [[nodiscard]] bool next_of_tap(ProgramStep& out, ProgramEvent& event) noexcept; // and this
    void turn_spindle(CycleStep how, Decimal speed, ProgramStep& out, ProgramEvent& event) const noexcept;
    [[nodiscard]] bool next_in_cycle(ProgramStep& out, ProgramEvent& event) noexcept;

    ProgramSettings settings_;
    AxisLetters letters_;
    BlockReader reader_;
    WordEvaluator* evaluator_;
    const OutputList* outputs_ = nullptr; // none: the machine has all
    ModalState modal_;
    WorkFrame frame_;
    Place place_{};
    Block block_{};
    BlockMotion plan_{};
    AxisPoint emitted_{}; // where the moves that next() has given end
    CutterPath cutter_{};
    ArcPlan tool_arc_{};
    SurfacePath surface_{};
    Decimal told_speed_{};                     // of the spindle, by the last event
    const MoveManner* manner_ = &plan_.manner; // of the item that next() gives
    std::uint32_t item_line_ = 0;
    CycleWords cycle_words_{};
    NurbsCurve nurbs_{};
    std::variant<CannedCycle, ThreadCycle, BezierPlan> series_{}; // of plan_: a cycle, or a spline
    Results results_{};
    std::uint32_t line_ = 0;
    std::uint8_t stage_ = 0;    // of the block, in the order of execution
    std::uint8_t sub_step_ = 0; // of its motion
    bool settles_ = false;      // behind a rapid under G96 the spindle is to be waited for
    bool offsets_changed_ = false;
    enum class Progress : std::uint8_t { fresh, begun, ended } progress_ = Progress::fresh; // a first % begins it

protected:
    // The curve through the points of G5.5, which Interpreter makes.
    enum class CurveState : std::uint8_t { none, open, gives, ends };

    bool in_pieces_ = false;  // Interpreter<S> gives the last step in several items
    bool ends_chain_ = false; // the next move is joined with none before it
    bool takes_points_ = false;
    CurveState curve_ = CurveState::none;
};

} // namespace splinefeed
