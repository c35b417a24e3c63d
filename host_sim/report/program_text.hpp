// SPDX-License-Identifier: MIT
// ProgramText: the text of a program, as much of it as a page has room for.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace splinefeed::host {

struct ProgramText {
    static constexpr std::size_t most_bytes = 1'500'000;

    std::string head;                            ///< the first lines
    std::uint64_t head_lines = 0;                ///< so many
    std::uint64_t lines = 0;                     ///< of the whole file
    std::map<std::uint64_t, std::string> picked; ///< lines behind them that were asked for
    std::vector<float> extruded;                 ///< [mm of filament] by the number of the line; none: nothing is
};

/// Reads the file once more. A file that cannot be read gives an empty text. @param picked  numbers of lines, from 1
/// @param lines  that may extrude: those below this number
[[nodiscard]] ProgramText read_program_text(const std::string& path, const std::vector<std::uint64_t>& picked,
                                            std::size_t lines = 0);

} // namespace splinefeed::host
