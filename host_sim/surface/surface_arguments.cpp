// SPDX-License-Identifier: MIT
#include "host_sim/surface/surface_arguments.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/option_number.hpp"

#include <array>

namespace splinefeed::host {

namespace {

// The index of the name.
std::size_t choose(std::string_view option, std::string_view text, std::array<std::string_view, 2> names) {
    if (text != names[0] && text != names[1]) {
        throw UsageError("{} {}: it must be one of {}", option, in_quotes(text), listed(names));
    }
    return text == names[0] ? 0 : 1;
}

} // namespace

std::optional<RasterOptions> choose_raster(const SurfaceArguments& arguments) {
    if (!arguments.along) {
        for (const auto& [value, name] :
             {std::pair{&arguments.lines, "--lines"}, std::pair{&arguments.scallop, "--scallop"},
              std::pair{&arguments.ball_radius, "--ball-radius"}, std::pair{&arguments.tool, "--tool"},
              std::pair{&arguments.pattern, "--pattern"}, std::pair{&arguments.lift, "--lift"},
              std::pair{&arguments.step, "--step"}}) {
            if (*value) {
                throw UsageError("{} is for a tool path; add --along u or --along v", name);
            }
        }
        return std::nullopt;
    }
    RasterOptions options;
    options.along = choose("--along", *arguments.along, {"u", "v"}) == 0 ? SurfaceDirection::u : SurfaceDirection::v;
    if (arguments.lines.has_value() == arguments.scallop.has_value()) {
        throw UsageError("a tool path needs one of --lines and --scallop");
    }
    if (arguments.ball_radius) {
        options.ball_radius_mm = read_option_number("--ball-radius", *arguments.ball_radius, 0.0, 10000.0);
    }
    const bool ball = options.ball_radius_mm > 0.0;
    if (arguments.lines) {
        options.lines = read_option_integer("--lines", *arguments.lines, 2, 100000);
    } else {
        if (!ball) {
            throw UsageError("--scallop needs --ball-radius: the ridges are left by a ball");
        }
        options.scallop_mm = read_option_number("--scallop", *arguments.scallop, 1e-6, 0.5 * options.ball_radius_mm);
    }
    if (arguments.tool && !ball) {
        throw UsageError("--tool needs --ball-radius: without a ball the path is on the surface");
    }
    options.tip = choose("--tool", arguments.tool.value_or("tip"), {"centre", "tip"}) == 1;
    options.zigzag = choose("--pattern", arguments.pattern.value_or("zigzag"), {"zigzag", "one-way"}) == 0;
    if (arguments.lift) {
        if (options.zigzag) {
            throw UsageError("--lift is for --pattern one-way; a zigzag is not lifted");
        }
        options.lift_mm = read_option_number("--lift", *arguments.lift, 0.001, 10000.0);
    }
    if (arguments.step) {
        options.step_mm = read_option_number("--step", *arguments.step, 0.001, 10000.0);
    }
    return options;
}

} // namespace splinefeed::host
