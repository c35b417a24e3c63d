// SPDX-License-Identifier: MIT
#include "splinefeed/controller/status_report.hpp"

#include "splinefeed/s0_program/words/axis_letters.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

namespace {

constexpr std::string_view columns = "xyzabc";
constexpr int offsets_at_rest = 10;
constexpr int offsets_in_motion = 30;
constexpr int overrides_at_rest = 10;
constexpr int overrides_in_motion = 20;

struct InputLetter {
    std::uint32_t bit;
    char letter;
};
constexpr InputLetter input_letters[] = {{InputBits::probe, 'P'},
                                         {InputBits::door, 'D'},
                                         {InputBits::hold, 'H'},
                                         {InputBits::reset, 'R'},
                                         {InputBits::emergency_stop, 'E'}};

} // namespace

void write_axes(const PerAxis<Decimal>& values, const ProgramSettings& program, bool inches, AnswerText& out) noexcept {
    const AxisLetters letters(program);
    std::size_t count = 3;
    for (std::size_t c = 3; c < columns.size(); ++c) {
        count = letters.index(columns[c]) >= 0 ? c + 1 : count;
    }
    for (std::size_t c = 0; c < count; ++c) {
        const int axis = letters.index(columns[c]);
        const Decimal value = axis >= 0 ? values[static_cast<unsigned>(axis)] : Decimal{};
        const bool converts = inches && c < 3;
        if (c > 0) {
            out.put(',');
        }
        out.decimal(converts ? Decimal{product_quotient(value.raw, 10, 254).raw} : value, converts ? 4 : 3);
    }
}

PerAxis<Decimal> offset_of(const WorkOffsets& offsets) noexcept {
    PerAxis<Decimal> out{};
    for (const unsigned k : indices(max_axes)) {
        out[k] = offsets.systems[static_cast<unsigned>(offsets.active)].origin[k] + offsets.tool[k] +
                 (offsets.g92_applies ? offsets.g92[k] : Decimal{});
    }
    return out;
}

void StatusReport::write_inputs(std::uint32_t inputs, const ControllerSettings& settings, AnswerText& out) noexcept {
    if (inputs == 0) {
        return;
    }
    out.put("|Pn:");
    for (const unsigned k : indices(settings.program.axes)) {
        if ((inputs >> k & 1U) != 0) {
            out.put(upper_case(settings.program.letters[k]));
        }
    }
    for (const InputLetter& input : input_letters) {
        if ((inputs & input.bit) != 0) {
            out.put(input.letter);
        }
    }
}

void StatusReport::write(const Content& content, const ControllerSettings& settings, bool all,
                         AnswerText& out) noexcept {
    const MachineReading& reading = *content.reading;
    const PerAxis<Decimal> offset = offset_of(*content.offsets);
    PerAxis<Decimal> position{};
    const std::int32_t mask = content.sender.report_mask;
    const bool inches = content.sender.inches;
    const bool of_machine = (mask & 1) != 0;
    for (const unsigned k : indices(settings.program.axes)) {
        position[k] = to_decimal(reading.position[k]) - (of_machine ? Decimal{} : offset[k]);
    }
    out.put('<').put(state_name(content.state));
    if (content.state == ControllerState::hold || content.state == ControllerState::door) {
        out.put(':').integer(content.part);
    }
    out.put(of_machine ? "|MPos:"sv : "|WPos:"sv);
    write_axes(position, settings.program, inches, out);
    if ((mask & 2) != 0) {
        out.put("|Bf:").integer(content.free_moves).put(',').integer(static_cast<std::int64_t>(content.free_bytes));
    }
    if ((mask & 4) != 0 && content.line > 0) {
        out.put("|Ln:").integer(content.line);
    }
    const Decimal feed = inches ? Decimal{product_quotient(reading.feed_mm_min.raw, 10, 254).raw} : reading.feed_mm_min;
    out.put("|FS:").decimal(feed, 0).put(',').decimal(content.spindle->told_rpm(), 0);
    write_inputs(reading.inputs, settings, out);
    const bool moves = content.state == ControllerState::run || content.state == ControllerState::jog ||
                       content.state == ControllerState::home;
    const Overrides& now = content.overrides;
    const bool overridden = now.feed != last_overrides_.feed || now.rapids != last_overrides_.rapids ||
                            now.spindle != last_overrides_.spindle;
    const bool offsets_due = all || until_offsets_-- <= 0 || offset != last_offset_;
    const bool overrides_due = all || (--until_overrides_ <= 0 && !offsets_due) || overridden;
    if (offsets_due) {
        out.put("|WCO:");
        write_axes(offset, settings.program, inches, out);
        until_offsets_ = (moves ? offsets_in_motion : offsets_at_rest) - 1;
        last_offset_ = offset;
    }
    if (overrides_due) {
        out.put("|Ov:").integer(now.feed).put(',').integer(now.rapids).put(',').integer(now.spindle);
        until_overrides_ = moves ? overrides_in_motion : overrides_at_rest;
        last_overrides_ = now;
        const bool turns = content.spindle->told_rpm().raw > 0;
        if (turns || content.spindle->flood() || content.spindle->mist()) {
            out.put("|A:");
            if (turns) {
                out.put(content.spindle->state() == SpindleState::clockwise ? 'S' : 'C');
            }
            out.put(content.spindle->flood() ? "F"sv : ""sv).put(content.spindle->mist() ? "M"sv : ""sv);
        }
    }
    out.put('>').end_line();
}

} // namespace splinefeed
