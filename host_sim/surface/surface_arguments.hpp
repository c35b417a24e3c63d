// SPDX-License-Identifier: MIT
// SurfaceArguments: the options of `splinefeed surface` as typed, and their meaning.
#pragma once

#include "host_sim/base/scalar_kind.hpp"
#include "host_sim/surface/raster.hpp"

#include <optional>
#include <string>

namespace splinefeed::host {

/// No value: not given.
struct SurfaceArguments {
    std::optional<std::string> along;
    std::optional<std::string> lines;
    std::optional<std::string> scallop;
    std::optional<std::string> ball_radius;
    std::optional<std::string> tool;
    std::optional<std::string> pattern;
    std::optional<std::string> lift;
    std::optional<std::string> step;
    std::string output; ///< empty: standard output
};

/// Checks the options. Returns nothing if no tool path is wanted. Throws UsageError.
[[nodiscard]] std::optional<RasterOptions> choose_raster(const SurfaceArguments& arguments);

/// Executes the command. Throws InputError, OutputError. Returns the exit status.
int run_surface(const std::string& input, const SurfaceArguments& arguments, ScalarKind scalar);

} // namespace splinefeed::host
