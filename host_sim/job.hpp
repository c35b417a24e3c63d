// SPDX-License-Identifier: MIT
// Job: what one call of the tool is to do.
#pragma once

#include "curve_choice.hpp"
#include "scalar_kind.hpp"
#include "surface/surface_arguments.hpp"

#include <cstddef>
#include <string>

namespace splinefeed::host {

enum class Command { run, plan, curve, surface };
enum class InputFormat { csv, json };
enum class SummaryKind { none, text, json };

struct Job {
    Command command = Command::run;
    std::string input; ///< a path, or "-"
    InputFormat format = InputFormat::csv;
    std::string machine; ///< empty: the default machine
    std::string events;  ///< empty: nobody steers
    CurveArguments curve;
    SurfaceArguments surface;
    ScalarKind scalar = ScalarKind::fixed;
    std::size_t window_cells = 1024;
    std::string trace; ///< empty: no such output; "-": standard output
    std::string segments;
    std::string curve_out;
    SummaryKind summary = SummaryKind::text;
    bool quiet = false;
};

} // namespace splinefeed::host
