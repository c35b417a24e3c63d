// SPDX-License-Identifier: MIT
#include "host_sim/program/row_moves.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

RowMoves::RowMoves(PathInput& input) : input_(&input), rows_(input.rows()), lines_(remembered) {}

bool RowMoves::read(WaypointRow& row, PerAxis<Position>& position) {
    if (!rows_->next(row)) {
        return false;
    }
    lines_[rows_read_++ % remembered] = row.line;
    for (unsigned k = 0; k < input_->axes().size(); ++k) {
        position[k] = position_from_mm(row.position[k]);
    }
    return true;
}

bool RowMoves::start(PerAxis<Position>& position) {
    WaypointRow row;
    return read(row, position);
}

bool RowMoves::next(SourceStep& out) {
    WaypointRow row;
    out = {};
    PathElement<double>& move = out.move;
    if (!read(row, move.to)) {
        return false;
    }
    out.line = row.line;
    move.stop_at_end = row.corner == Corner::forced;
    move.tolerance_mm = row.tolerance_mm.value_or(input_->choice().tolerance_mm);
    move.feed_mm_s = row.feed_mm_s;
    move.max_feed_mm_s = row.max_feed_mm_s;
    return true;
}

std::uint64_t RowMoves::line_of_row(std::uint64_t row) const noexcept {
    const bool known = row < rows_read_ && row + remembered >= rows_read_;
    return known ? lines_[row % remembered] : 0;
}

std::string RowMoves::name_of_move(std::uint64_t move, std::uint64_t line) const {
    return fmt::format("the move to point {} (line {})", number_of_move(move), line);
}

std::string RowMoves::name_of_row(std::uint32_t row) const {
    return fmt::format("point {}", row + 1);
}

InputError RowMoves::refusal(const SourceStep& step, std::string_view text) const {
    return {input_->name(), step.line, text};
}

} // namespace splinefeed::host
