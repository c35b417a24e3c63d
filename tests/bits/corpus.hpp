// SPDX-License-Identifier: MIT
// The corpus: programs whose results are to be the same bits wherever they run. Each says one line, "SCALAR NAME HASH".
#pragma once

#include "hash.hpp"

namespace bits {

/// Says the hash of a program, or that the core refused a part of it.
template <splinefeed::Scalar S>
void report(const char* name, const Hash& hash, bool good);

/// Each curve that streams, and its motion.
template <splinefeed::Scalar S>
void run_curves();
/// Each curve of all points at once, and a surface.
template <splinefeed::Scalar S>
void run_splines();
/// Each planner, without steering and with random requests.
template <splinefeed::Scalar S>
void run_planners();
/// Lines of G-code, through interpreter, tolerance and plan.
template <splinefeed::Scalar S>
void run_programs();
/// Feed segments to steps and edges; integers only.
void run_pulses();

} // namespace bits
