// SPDX-License-Identifier: MIT
// Job: what one call of the tool is to do.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/curve/curve_choice.hpp"
#include "host_sim/diagnose/link_report.hpp"
#include "host_sim/drive/drive_command.hpp"
#include "host_sim/surface/surface_arguments.hpp"
#include "host_sim/target/run_target.hpp"

#include <cstddef>
#include <string>

namespace splinefeed::host {

enum class Command { run, plan, curve, surface, drive, link };
enum class InputFormat { csv, json };
enum class SummaryKind { none, text, json };

struct Job {
    Command command = Command::run;
    std::string input; ///< a path, or "-"
    InputFormat format = InputFormat::csv;
    std::string machine; ///< empty: the default machine
    RunWishes wishes;
    std::string target = "sim"; ///< or "modbus", or the address of a drive
    std::string events;         ///< empty: nobody steers
    CurveArguments curve;
    SurfaceArguments surface;
    DriveArguments drive;
    LinkArguments link;
    ScalarKind scalar = ScalarKind::fixed;
    std::size_t window_cells = 1024;
    std::string trace; ///< empty: no such output; "-": standard output
    std::string segments;
    std::string edges;
    std::string curve_out;
    SummaryKind summary = SummaryKind::text;
    bool quiet = false;
};

} // namespace splinefeed::host
