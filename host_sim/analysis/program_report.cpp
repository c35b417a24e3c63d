// SPDX-License-Identifier: MIT
#include "host_sim/analysis/program_report.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>

namespace splinefeed::host {

ProgramReport::ProgramReport(const MachineDescription& machine) : axes_(machine.settings.axes) {
    const auto& axis = machine.settings.axis;
    const bool linear = for_any(axes_, [&](unsigned k) { return !axis[k].rotary; });
    counts_ = each(axes_, [&](unsigned k) { return !linear || !axis[k].rotary; });
}

void ProgramReport::move(const PathElement<double>& move, bool rapid, std::uint64_t line) {
    add_extent(here_, move, axes_, boxes_[rapid ? 1 : 0]);
    const double length = move_length(here_, move, axes_, counts_);
    for (MoveTotal* total : {&totals_[rapid ? 1 : 0], &tools_[tool_]}) {
        total->length_mm += length;
        ++total->moves;
    }
    moves_.push_back({line, tool_, rapid});
    here_ = move.to;
}

void ProgramReport::moved(std::uint32_t move, double seconds, BoundLimits bound) {
    if (move >= moves_.size()) {
        return;
    }
    const Move& of = moves_[move];
    totals_[of.rapid ? 1 : 0].seconds += seconds;
    tools_[of.tool].seconds += seconds;
    if (line_ == nullptr || line_->line != of.line) {
        line_ = &lines_[of.line];
        line_->line = of.line;
    }
    Line& line = *line_;
    line.seconds += seconds;
    line.feed_s += bound.feed ? seconds : 0.0;
    line.velocity_s += bound.velocity ? seconds : 0.0;
    line.acceleration_s += bound.acceleration ? seconds : 0.0;
}

void ProgramReport::stood(std::uint64_t line, double seconds) {
    dwell_s_ += seconds;
    lines_[line].line = line;
    lines_[line].seconds += seconds;
}

std::vector<ProgramReport::Line> ProgramReport::slowest(std::size_t most) const {
    std::vector<Line> all;
    all.reserve(lines_.size());
    for (const auto& [number, line] : lines_) {
        all.push_back(line);
    }
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size()));
    std::partial_sort(all.begin(), end, all.end(), [](const Line& a, const Line& b) {
        return a.seconds > b.seconds || (a.seconds == b.seconds && a.line < b.line);
    });
    all.erase(end, all.end());
    return all;
}

} // namespace splinefeed::host
