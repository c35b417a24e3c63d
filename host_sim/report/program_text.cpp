// SPDX-License-Identifier: MIT
#include "host_sim/report/program_text.hpp"

#include "host_sim/report/extrusion.hpp"

#include <fstream>
#include <set>

namespace splinefeed::host {

ProgramText read_program_text(const std::string& path, const std::vector<std::uint64_t>& picked, std::size_t lines) {
    constexpr std::size_t longest = 400; // characters of a line
    const std::set<std::uint64_t> wanted(picked.begin(), picked.end());
    ProgramText text;
    std::ifstream file(path, std::ios::binary);
    bool room = true;
    Extrusion extrusion;
    for (std::string line; std::getline(file, line);) {
        ++text.lines;
        const double extruded = text.lines < lines ? extrusion.line(line) : 0.0;
        if (extruded > 0.0) {
            text.extruded.resize(text.lines + 1);
            text.extruded.back() = static_cast<float>(extruded);
        }
        line.resize(std::min(line.size(), longest));
        room = room && text.head.size() + line.size() < ProgramText::most_bytes;
        if (room) {
            text.head += line + '\n';
            ++text.head_lines;
        } else if (wanted.contains(text.lines)) {
            text.picked[text.lines] = line;
        }
    }
    return text;
}

} // namespace splinefeed::host
