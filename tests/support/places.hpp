// SPDX-License-Identifier: MIT
//
// Where the sources and the built tool are. Only places.cpp knows the paths: all other tests compile alike in every
// folder.
#pragma once

#include <string>

namespace splinefeed::test {

/// The repository's root, without a slash at its end.
[[nodiscard]] std::string source_folder();
/// The program `splinefeed`: what the environment names as SPLINEFEED_TOOL, or that of this build.
[[nodiscard]] std::string tool_path();

} // namespace splinefeed::test
