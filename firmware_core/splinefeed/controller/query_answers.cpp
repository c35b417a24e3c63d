// SPDX-License-Identifier: MIT
#include "splinefeed/controller/query_answers.hpp"

#include "splinefeed/controller/status_report.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // a firmware has no strlen

namespace {

constexpr std::string_view units_words[] = {" G21", " G20"};
constexpr std::string_view plane_words[] = {" G19", " G18", " G17"}; // in the order of Plane
constexpr std::string_view spindle_words[] = {" M5", " M3", " M4"};

// Ten times the number of a G word.
void write_g(std::int16_t tenths, AnswerText& out) noexcept {
    out.put('G').integer(tenths / 10);
    if (tenths % 10 != 0) {
        out.put('.').integer(tenths % 10);
    }
}

void write_system(int system, AnswerText& out) noexcept {
    out.put('G').integer(54 + (system < 5 ? system : 5));
    if (system > 5) {
        out.put('.').integer(system - 5);
    }
}

} // namespace

void write_modes(const BlockInterpreter& interpreter, const SpindleOrders& spindle, AnswerText& out) noexcept {
    const ModalState& modal = interpreter.modal();
    out.put("[GC:");
    write_g(modal.motion, out);
    out.put(' ');
    write_system(interpreter.offsets().active, out);
    out.put(plane_words[static_cast<unsigned>(modal.plane)]);
    out.put(units_words[modal.inches ? 1 : 0]);
    out.put(modal.incremental ? " G91"sv : " G90"sv);
    out.put(modal.inverse_time ? " G93"sv : " G94"sv);
    out.put(spindle_words[static_cast<unsigned>(modal.spindle)]);
    out.put(spindle.mist() ? " M7"sv : ""sv).put(spindle.flood() ? " M8"sv : ""sv);
    out.put(spindle.mist() || spindle.flood() ? ""sv : " M9"sv);
    out.put(" T").integer(modal.selected_tool);
    out.put(" F").decimal(modal.inches ? modal.in_units(modal.feed) : modal.feed, modal.inches ? 1 : 0);
    out.put(" S").decimal(modal.speed, 0).put(']').end_line();
}

void write_probe(const ProbeResult& probe, const ProgramSettings& program, bool inches, AnswerText& out) noexcept {
    out.put("[PRB:");
    write_axes(probe.at, program, inches, out);
    out.put(probe.contact ? ":1]"sv : ":0]"sv).end_line();
}

void write_offsets(const WorkOffsets& offsets, const ProbeResult& probe, const ProgramSettings& program, bool inches,
                   AnswerText& out) noexcept {
    const auto row = [&](std::string_view name, const PerAxis<Decimal>& values) {
        out.put('[').put(name).put(':');
        write_axes(values, program, inches, out);
        out.put(']').end_line();
    };
    for (int system = 0; system < work_systems; ++system) {
        out.put('[');
        write_system(system, out);
        out.put(':');
        write_axes(offsets.systems[static_cast<unsigned>(system)].origin, program, inches, out);
        out.put(']').end_line();
    }
    row("G28", offsets.g28);
    row("G30", offsets.g30);
    row("G92", offsets.g92_applies ? offsets.g92 : PerAxis<Decimal>{});
    const int z = AxisLetters(program).index('z');
    const Decimal length = z >= 0 ? offsets.tool[static_cast<unsigned>(z)] : Decimal{};
    out.put("[TLO:").decimal(inches ? Decimal{product_quotient(length.raw, 10, 254).raw} : length, inches ? 4 : 3);
    out.put(']').end_line();
    write_probe(probe, program, inches, out);
}

void write_build(const ControllerSettings& settings, bool axes, AnswerText& out) noexcept {
    out.put("[VER:1.1h.").put(settings.date).put(":splinefeed ").put(settings.version);
    if (!settings.name.empty()) {
        out.put(' ');
        for (const char c : settings.name) { // senders divide the text by these
            out.put(c == ':' || c == '[' || c == ']' || c == '.' ? '_' : c);
        }
    }
    out.put(']').end_line();
    out.put("[OPT:V").put(settings.homes != 0 ? "Z"sv : ""sv).put(",100,").integer(settings.receive_bytes);
    if (axes) {
        out.put(',').integer(settings.program.axes).put(",0]").end_line();
        out.put("[AXS:").integer(settings.program.axes).put(':');
        for (const unsigned k : indices(settings.program.axes)) {
            out.put(upper_case(settings.program.letters[k]));
        }
    }
    out.put(']').end_line();
}

} // namespace splinefeed
