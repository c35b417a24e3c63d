// SPDX-License-Identifier: MIT
// runner: input -> curve -> trajectory -> machine, with the outputs on the way.
#pragma once

#include "host_sim/output/outputs.hpp"
#include "host_sim/program/path_input.hpp"
#include "host_sim/run/motion.hpp"
#include "host_sim/target/run_target.hpp"

#include <string>

namespace splinefeed::host {

enum class SummaryKind { none, text, json };

struct RunArguments {
    PathArguments path;
    MotionArguments motion;
    std::string machine;        ///< empty: the default machine
    std::string target = "sim"; ///< the simulated machine alone; or "modbus", or an address
    RunOptions options;
    OutputNames outputs;
    SummaryKind summary = SummaryKind::text;
};

/// Plans a path and executes it. Returns the exit status: 0 done, 1 the machine did not finish (told on standard
/// error). Throws InputError, UsageError and OutputError where there is nothing to be done (exit status 2); then no
/// output is left behind.
///
/// A file is checked whole, limits included, before anything moves. A pipe moves the machine while it is read, in
/// constant memory: what is wrong in it after the first move ends the run in a controlled stop.
[[nodiscard]] int run(const RunArguments& arguments);

/// Writes the curve through the points as Bezier segments; nothing moves. Returns 0. Throws as run().
[[nodiscard]] int draw(const RunArguments& arguments);

} // namespace splinefeed::host
