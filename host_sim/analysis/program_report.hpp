// SPDX-License-Identifier: MIT
// ProgramReport: what a program does, and how long its lines take: for `splinefeed check`.
#pragma once

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/analysis/move_extent.hpp"
#include "host_sim/config/machine_description.hpp"

#include <map>
#include <vector>

namespace splinefeed::host {

/// Length and time of moves.
struct MoveTotal {
    double length_mm = 0.0;
    double seconds = 0.0;
    std::uint64_t moves = 0;
};

/// Moves are announced in their order, and then travelled. Memory: 16 bytes a move, and 40 a line.
class ProgramReport {
public:
    struct Line {
        std::uint64_t line = 0;
        double seconds = 0.0;
        double feed_s = 0.0; ///< of these, the time in which the programmed feed bound; the same below
        double velocity_s = 0.0;
        double acceleration_s = 0.0; ///< acceleration, jerk or turning
    };

    explicit ProgramReport(const MachineDescription& machine);

    void start(const PerAxis<Position>& position) noexcept { here_ = position; }
    void move(const PathElement<double>& move, bool rapid, std::uint64_t line);
    /// From here on the moves are this tool's.
    void tool(std::int32_t number) noexcept { tool_ = number; }
    /// The machine moved for a segment of a move, counted from 0.
    void moved(std::uint32_t move, double seconds, BoundLimits bound);
    void stood(std::uint64_t line, double seconds);

    [[nodiscard]] const AxisBox& feed_box() const noexcept { return boxes_[0]; }
    [[nodiscard]] const AxisBox& rapid_box() const noexcept { return boxes_[1]; }
    [[nodiscard]] const MoveTotal& feeds() const noexcept { return totals_[0]; }
    [[nodiscard]] const MoveTotal& rapids() const noexcept { return totals_[1]; }
    [[nodiscard]] double dwell_s() const noexcept { return dwell_s_; }
    /// By the number of the tool; 0: before the first one.
    [[nodiscard]] const std::map<std::int32_t, MoveTotal>& tools() const noexcept { return tools_; }
    /// Those that take most time, the longest first.
    [[nodiscard]] std::vector<Line> slowest(std::size_t most) const;

private:
    struct Move {
        std::uint64_t line = 0;
        std::int32_t tool = 0;
        bool rapid = false;
    };

    int axes_;
    PerAxis<bool> counts_{}; // axes that lengths are of
    PerAxis<Position> here_{};
    std::vector<Move> moves_;
    AxisBox boxes_[2];
    MoveTotal totals_[2];
    std::map<std::int32_t, MoveTotal> tools_;
    std::map<std::uint64_t, Line> lines_;
    Line* line_ = nullptr; // of the last segment: most have one with the next
    std::int32_t tool_ = 0;
    double dwell_s_ = 0.0;
};

} // namespace splinefeed::host
