// SPDX-License-Identifier: MIT
// grbl_settings: a machine file as lines like $110=8000, which a controller of the grbl family takes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

struct GrblSettings {
    std::string lines;
    std::vector<std::string> left_out; ///< what no line says, a sentence each
};

/// Of what is read back by grbl_sketch() nothing is lost but decimals behind the sixth. Throws InputError where the
/// text is no machine file.
[[nodiscard]] GrblSettings grbl_settings(std::string_view machine, const std::string& file);

} // namespace splinefeed::host
