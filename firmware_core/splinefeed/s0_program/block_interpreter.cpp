// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/block_interpreter.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"
#include "splinefeed/s0_program/words/adapt_words.hpp"
#include "splinefeed/s0_program/words/lathe_sign.hpp"
#include "splinefeed/s0_program/words/polar_words.hpp"

namespace splinefeed {

namespace {

// What is wrong is a word or a parameter: its letter, or #, and digits.
std::uint8_t word_length(std::string_view text, std::uint16_t column) noexcept {
    const auto is_part = [](char c) {
        return (c >= '0' && c <= '9') || c == '.' || c == ' ';
    };
    if (column == 0 || column > text.size()) {
        return 0;
    }
    const char first = text[column - 1U];
    const bool has_number = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '@' ||
                            first == '^' || first == '#';
    std::size_t end = column;
    while (has_number && end < text.size() && is_part(text[end])) {
        ++end;
    }
    while (end > column && text[end - 1] == ' ') {
        --end;
    }
    return static_cast<std::uint8_t>(end + 1 - column);
}

} // namespace

BlockInterpreter::BlockInterpreter(const ProgramSettings& settings, WordEvaluator* evaluator) noexcept
    : settings_(settings), letters_(settings_), reader_(settings_, evaluator), evaluator_(evaluator),
      modal_(ModalState::at_start(settings_)), frame_(letters_, settings_.extension), stage_(all_done) {
    block_.clear();
}

void BlockInterpreter::start(const PerAxis<Position>& position) noexcept {
    for (const unsigned k : indices(letters_.count())) {
        place_.machine[k] = to_decimal(position[k]);
    }
    emitted_ = place_.machine;
    frame_changed();
    drop_block();
}

void BlockInterpreter::restart() noexcept {
    modal_ = ModalState::at_start(settings_);
    begin_next();
}

void BlockInterpreter::begin_next() noexcept {
    cycle_words_ = {};
    drop_block();
    progress_ = Progress::fresh;
    emitted_ = place_.machine;
}

// What is left of the block, and a NURBS or a curve that has not been ended.
void BlockInterpreter::drop_block() noexcept {
    nurbs_.abandon();
    cutter_.clear();
    surface_.clear();
    plan_.clear();
    stage_ = all_done;
    in_pieces_ = ends_chain_ = false;
    curve_ = CurveState::none;
    discard_assignments();
}

bool BlockInterpreter::assigns() const noexcept {
    return evaluator_ != nullptr && evaluator_->has_assignments();
}

void BlockInterpreter::discard_assignments() noexcept {
    if (evaluator_ != nullptr) {
        evaluator_->discard();
    }
}

void BlockInterpreter::restore(const WorkOffsets& offsets) noexcept {
    frame_.offsets() = offsets;
    frame_changed();
}

// The machine stands where it stood; only its coordinates in the program change.
void BlockInterpreter::frame_changed() noexcept {
    frame_.update();
    place_.program = frame_.to_program(place_.machine);
}

PerAxis<Position> BlockInterpreter::position() const noexcept {
    PerAxis<Position> out{};
    for (const unsigned k : indices(letters_.count())) {
        out[k] = to_position(place_.machine[k]);
    }
    return out;
}

void BlockInterpreter::report_probe(bool contact, const PerAxis<Position>& contact_at,
                                    const PerAxis<Position>& stands_at) noexcept {
    AxisPoint at{};
    for (const unsigned k : indices(letters_.count())) {
        at[k] = to_decimal(contact_at[k]);
        place_.machine[k] = to_decimal(stands_at[k]);
    }
    set_probe(contact, frame_.to_program(at));
    emitted_ = place_.machine;
    frame_changed();
}

void BlockInterpreter::set_probe(bool contact, const AxisPoint& program) noexcept {
    for (int k = 0; k < letters_.count(); ++k) {
        const Decimal value = program[static_cast<unsigned>(k)];
        results_.probe_at[static_cast<unsigned>(k)] =
            letters_.kind(k) == AxisKind::rotary ? value : modal_.in_units(value);
    }
    results_.probe_contact = contact;
}

BlockStatus BlockInterpreter::read_block(std::string_view text, std::uint32_t line_number, LineKind& kind) noexcept {
    discard_assignments(); // of a line that was refused
    line_ = line_number;
    const BlockStatus status = reader_.read(text, *this, block_, kind);
    std::int32_t stated = 0;
    if (settings_.numbered && to_integer(block_.value('n'), stated) && stated > 0) {
        line_ = static_cast<std::uint32_t>(stated);
    }
    plan_.clear();
    sub_step_ = 0;
    offsets_changed_ = false;
    return status;
}

BlockStatus BlockInterpreter::push(std::string_view text, std::uint32_t line_number) noexcept {
    if (has_ended()) {
        return {};
    }
    if (has_steps() || in_pieces_) {
        return {ProgramError::block_pending, 0, 0};
    }
    cutter_.drop_plan();
    LineKind kind = LineKind::block;
    BlockStatus status = read_block(text, line_number, kind);
    if (status.ok() && kind == LineKind::percent) {
        status = execute_percent();
    } else if (status.ok() && kind == LineKind::homing) {
        progress_ = Progress::begun;
        end_curve();
        plan_.manner = {};
        plan_homing(0);
        stage_ = 0;
    } else if (kind == LineKind::block) {
        const BlockStatus milled = check_lathe(block_, modal_, rules());
        const BlockStatus adapted = adapt_words(block_, modal_, letters_, settings_);
        const SpacePoint place = space(place_.program);
        const BlockStatus polar = adapt_polar(block_, modal_, letters_, {place[0], place[1]});
        const BlockStatus placed =
            settings_.extension != nullptr
                ? settings_.extension->adapt(block_, modal_, letters_, {place_.program, frame_.offsets()})
                : BlockStatus{};
        status = !status.ok()    ? status
                 : !milled.ok()  ? milled
                 : !adapted.ok() ? adapted
                 : !polar.ok()   ? polar
                 : !placed.ok()  ? placed
                                 : execute();
    }
    if (!status.ok()) {
        status.length = word_length(text, status.column);
        plan_.clear();
        stage_ = all_done;
    }
    return status;
}

BlockStatus BlockInterpreter::execute_percent() noexcept {
    if (progress_ == Progress::fresh) {
        progress_ = Progress::begun;
        return {};
    }
    if (nurbs_.is_open()) {
        return {ProgramError::nurbs_not_ended, 1, 1};
    }
    if (const ProgramStatus status = cutter_.plan_end(); !status.ok()) {
        return {status.error(), 1, 1};
    }
    cutter_.keep_plan();
    end_curve();
    block_.clear();
    progress_ = Progress::ended;
    stage_ = 0;
    return {};
}

BlockStatus BlockInterpreter::end_of_input() noexcept {
    const ProgramStatus status = cutter_.plan_end();
    if (status.ok()) {
        cutter_.keep_plan();
        end_curve();
    }
    return {status.error(), 0, 0};
}

BlockStatus BlockInterpreter::execute() noexcept {
    BlockUse use;
    if (const BlockStatus status = find_use(block_, modal_, letters_, rules(), use); !status.ok()) {
        return status;
    }
    if (const BlockStatus status = outputs_ != nullptr ? check_outputs() : BlockStatus{}; !status.ok()) {
        return status;
    }
    const ModalState modal = modal_;
    const Place place = place_;
    const CycleWords cycle_words = cycle_words_;
    const Results results = results_;
    const NurbsCurve::Progress nurbs = nurbs_.progress();
    BlockStatus status;
    const bool changes_frame = block_.has(CodeGroup::non_modal) || block_.has(CodeGroup::tool_length) ||
                               block_.has(CodeGroup::work_system) || block_.has(CodeGroup::tool_change) ||
                               block_.has(CodeGroup::without_effect); // of an extension
    const auto run = [&] {
        status = execute_words(use);
        if (status.ok() && assigns()) {
            const ProgramStatus written = evaluator_->commit();
            status = written.ok() ? BlockStatus{} : BlockStatus{written.error(), 0, 0};
        }
    };
    if (changes_frame) {
        const WorkFrame frame = frame_;
        run();
        if (!status.ok()) {
            frame_ = frame;
        }
    } else {
        run();
    }
    if (!status.ok()) {
        modal_ = modal;
        place_ = place;
        cycle_words_ = cycle_words;
        results_ = results;
        nurbs_.go_back(nurbs);
        if (settings_.extension != nullptr) {
            settings_.extension->take_back();
        }
        return status;
    }
    cutter_.keep_plan();
    if (!leaves_curve_open()) {
        end_curve();
    }
    progress_ = Progress::begun;
    stage_ = 0;
    return {};
}

BlockStatus BlockInterpreter::execute_words(const BlockUse& use) noexcept {
    const ModalState before = modal_;
    if (nurbs_.is_open()) { // only control points until G5.3
        const bool ends = block_.code(CodeGroup::non_modal) == 53;
        for (unsigned group = 0; group < code_groups; ++group) {
            const auto code = static_cast<CodeGroup>(group);
            const bool belongs =
                code == CodeGroup::motion ? block_.code(code) == 52 : code == CodeGroup::non_modal && ends;
            if (block_.has(code) && !belongs) {
                return block_.at(ProgramError::nurbs_not_ended, code);
            }
        }
    }
    if (const BlockStatus status = modal_.apply(block_, settings_); !status.ok()) {
        return status;
    }
    if (modal_.surface.applies() && letters_.index('x') < 0) {
        return block_.at(ProgramError::axis_missing, CodeGroup::spindle_mode);
    }
    if (before.surface.applies() && !modal_.surface.applies() && !block_.has('s')) {
        modal_.speed = told_speed_; // it keeps what it has
    }
    if (block_.has(CodeGroup::tool_change)) {
        WorkOffsets& offsets = frame_.offsets();
        std::int32_t tool = modal_.selected_tool;
        if (block_.code(CodeGroup::tool_change) == 61) {
            static_cast<void>(to_integer(block_.value('q'), tool));
        }
        offsets_changed_ = offsets_changed_ || offsets.tool_number != tool;
        offsets.tool_number = tool;
    }
    if (const BlockStatus status = set_cutter(); !status.ok()) {
        return status;
    }
    if (const BlockStatus status = set_tool_length(); !status.ok()) {
        return status;
    }
    if (const std::int16_t code = block_.code(CodeGroup::work_system); code != Block::no_code) {
        const int system = code <= 590 ? (code - 540) / 10 : 5 + (code - 590);
        offsets_changed_ = offsets_changed_ || frame_.offsets().active != system;
        frame_.offsets().active = system;
        frame_changed();
    }
    if (settings_.extension != nullptr && settings_.extension->apply(frame_.offsets())) {
        offsets_changed_ = true;
        frame_changed();
    }
    if (const BlockStatus status = set_offsets(); !status.ok()) {
        return status;
    }
    const AxisPoint from = place_.machine;
    if (const BlockStatus status = plan_motion(use, before); !status.ok()) {
        return status;
    }
    if (const BlockStatus status = plan_contour(from); !status.ok()) {
        return status;
    }
    const bool ends_within = nurbs_.is_open() && block_.has(CodeGroup::stop); // G5.2 of this block
    return ends_within ? block_.at(ProgramError::nurbs_not_ended, CodeGroup::stop) : BlockStatus{};
}

} // namespace splinefeed
