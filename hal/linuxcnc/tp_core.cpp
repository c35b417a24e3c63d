// SPDX-License-Identifier: MIT
// The C interface of TpMotion: one motion, in static memory.
#include "tp_core.h"

#include "tp_motion.hpp"

namespace {

splinefeed::linuxcnc::TpMotion motion;

} // namespace

extern "C" {

void tpc_create(const tpc_settings* settings, const tpc_machine* machine) {
    motion.create(*settings, *machine);
}

void tpc_set(const double* position) {
    motion.set(position);
}

int tpc_begins(void) {
    return motion.begins() ? 1 : 0;
}

void tpc_begin(const tpc_machine* machine) {
    motion.begin(*machine);
}

int tpc_add(const tpc_move* move) {
    return motion.add(*move);
}

const char* tpc_reason(int error) {
    return splinefeed::describe(static_cast<splinefeed::Error>(error));
}

void tpc_spindle(double turns, double turns_per_s) {
    motion.spindle(turns, turns_per_s);
}

void tpc_run(const tpc_input* input, tpc_output* output) {
    motion.run(*input, *output);
}

void tpc_tell(tpc_figures* figures) {
    *figures = motion.figures();
}

} // extern "C"
