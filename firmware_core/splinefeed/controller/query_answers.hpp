// SPDX-License-Identifier: MIT
// query_answers: what $G, $#, $I and $$ show.
#pragma once

#include "splinefeed/controller/answer_text.hpp"
#include "splinefeed/controller/controller_settings.hpp"
#include "splinefeed/controller/spindle_orders.hpp"
#include "splinefeed/s0_program/block_interpreter.hpp"

namespace splinefeed {

/// The last probe.
struct ProbeResult {
    PerAxis<Decimal> at{}; ///< in machine coordinates
    bool contact = false;
};

/// [GC:G0 G54 ...]
void write_modes(const BlockInterpreter& interpreter, const SpindleOrders& spindle, AnswerText& out) noexcept;
/// [PRB:0.000,0.000,0.000:0]
void write_probe(const ProbeResult& probe, const ProgramSettings& program, bool inches, AnswerText& out) noexcept;
/// [G54:...] to [PRB:...]
void write_offsets(const WorkOffsets& offsets, const ProbeResult& probe, const ProgramSettings& program, bool inches,
                   AnswerText& out) noexcept;
/// [VER:...], [OPT:...]. @param axes  also [AXS:...]
void write_build(const ControllerSettings& settings, bool axes, AnswerText& out) noexcept;

} // namespace splinefeed
