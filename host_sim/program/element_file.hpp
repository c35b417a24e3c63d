// SPDX-License-Identifier: MIT
// element_file: reads a program of elements: lines, arcs, Bezier segments and NURBS.
#pragma once

#include "host_sim/config/path_tolerances.hpp"
#include "host_sim/program/element_program.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace splinefeed::host {

/// Whether the document is a program of elements, not a curve.
[[nodiscard]] bool has_elements(const nlohmann::json& document);

/// The elements as moves of the machine. Every number is checked, that elements meet, and that axes that the machine
/// lacks do not move. Throws InputError with the element.
/// @param axes  the machine's, each one of x, y, z, a, b, c
[[nodiscard]] ElementProgram read_elements(const nlohmann::json& document, const std::string& file,
                                           const std::vector<std::string>& axes, const PathTolerances& tolerances);

/// The axes that the document's points have: x, y, z and as many of a, b, c as the longest one.
[[nodiscard]] std::vector<std::string> axes_of_elements(const nlohmann::json& document);

} // namespace splinefeed::host
