// SPDX-License-Identifier: MIT
// ToolFile: the tool table of a machine, in the format of LinuxCNC's tool.tbl.
#pragma once

#include "splinefeed/s0_program/dialects/program_settings.hpp"

#include <map>
#include <string>
#include <vector>

namespace splinefeed::host {

/// A line of the file.
struct ToolRow {
    static constexpr std::string_view letters = "XYZABCUVW";
    std::array<Decimal, letters.size()> offset{}; ///< by letter [mm or degrees]
    Decimal diameter{};                           ///< [mm]
    std::int32_t orientation = 0;                 ///< 0 to 9
};
using ToolRows = std::map<std::int32_t, ToolRow>;

/// Reads `T1 P1 Z12.5 D6 ;remark`, a tool a line: T its number, D its diameter, Q the orientation of its tip, an offset
/// for each letter of an axis; P, I and J are not used. Throws InputError with the line.
[[nodiscard]] ToolRows read_tool_file(const std::string& path);

/// The tools for a machine with these axes. Both arguments must outlive it.
class MachineTools final : public ToolTable {
public:
    MachineTools(const ToolRows& rows, const std::vector<std::string>& axes) : rows_(&rows), axes_(&axes) {}
    [[nodiscard]] bool find(std::int32_t tool, ToolOffset& out) const noexcept override;

private:
    const ToolRows* rows_;
    const std::vector<std::string>* axes_;
};

} // namespace splinefeed::host
