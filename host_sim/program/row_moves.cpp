// SPDX-License-Identifier: MIT
#include "host_sim/program/row_moves.hpp"

#include "host_sim/program/element_cast.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

template <Scalar S>
RowMoves<S>::RowMoves(PathInput& input) : input_(&input), rows_(input.rows()), lines_(remembered) {}

template <Scalar S>
bool RowMoves<S>::read(WaypointRow& row, PerAxis<Position>& position) {
    if (!rows_->next(row)) {
        return false;
    }
    lines_[rows_read_++ % remembered] = row.line;
    for (unsigned k = 0; k < input_->axes().size(); ++k) {
        position[k] = position_from_mm(row.position[k]);
    }
    return true;
}

template <Scalar S>
bool RowMoves<S>::start(PerAxis<Position>& position) {
    WaypointRow row;
    return read(row, position);
}

template <Scalar S>
bool RowMoves<S>::next(SourceStep<S>& out) {
    WaypointRow row;
    out = {};
    PathElement<double>& move = out.programmed;
    if (!read(row, move.to)) {
        return false;
    }
    out.line = row.line;
    move.stop_at_end = row.corner == Corner::forced;
    move.tolerance_mm = row.tolerance_mm.value_or(input_->choice().tolerance_mm);
    move.feed_mm_s = row.feed_mm_s;
    move.max_feed_mm_s = row.max_feed_mm_s;
    out.element = element_cast<S>(move);
    return true;
}

template <Scalar S>
std::uint64_t RowMoves<S>::line_of_row(std::uint64_t row) const noexcept {
    const bool known = row < rows_read_ && row + remembered >= rows_read_;
    return known ? lines_[row % remembered] : 0;
}

template <Scalar S>
std::string RowMoves<S>::name_of_move(std::uint64_t move, std::uint64_t line) const {
    return fmt::format("the move to point {} (line {})", number_of_move(move), line);
}

template <Scalar S>
std::string RowMoves<S>::name_of_row(std::uint32_t row) const {
    return fmt::format("point {}", row + 1);
}

template <Scalar S>
InputError RowMoves<S>::refusal(const SourceStep<S>& step, std::string_view text) const {
    return {input_->name(), step.line, text};
}

template class RowMoves<double>;
template class RowMoves<float>;
template class RowMoves<Fixed>;

} // namespace splinefeed::host
