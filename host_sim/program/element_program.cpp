// SPDX-License-Identifier: MIT
#include "host_sim/program/element_program.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

void ElementProgram::add(const Move& move, MoveShape shape, std::size_t detail) {
    moves_.push_back(move);
    moves_.back().shape = shape;
    moves_.back().detail = static_cast<std::uint32_t>(detail);
}

void ElementProgram::add_arc(const Move& move, const ArcShape<double>& arc) {
    add(move, MoveShape::arc, arcs_.size());
    arcs_.push_back(arc);
}

void ElementProgram::add_bezier(const Move& move, const BezierShape<double>& bezier) {
    add(move, MoveShape::bezier, beziers_.size());
    beziers_.push_back(bezier);
}

void ElementProgram::stop_before(std::uint32_t element) noexcept {
    const auto behind = std::ranges::lower_bound(moves_, element, {}, &Move::element); // in the order of their elements
    if (behind != moves_.begin()) {
        std::prev(behind)->stop_at_end = true;
    }
}

void ElementProgram::add_dwell(std::uint32_t before, double seconds) {
    dwells_.insert(std::ranges::upper_bound(dwells_, before, {}, &Dwell::before), {before, seconds});
}

PathElement<double> ElementProgram::element(std::size_t move) const noexcept {
    const Move& of = moves_[move];
    PathElement<double> out;
    out.shape = of.shape;
    out.mode = of.mode;
    out.stop_at_end = of.stop_at_end;
    out.to = of.to;
    out.tolerance_mm = of.tolerance_mm;
    out.chain_tolerance_mm = of.chain_tolerance_mm;
    out.feed_mm_s = of.feed_mm_s;
    if (of.shape == MoveShape::arc) {
        out.arc = arcs_[of.detail];
    } else if (of.shape == MoveShape::bezier) {
        out.bezier = beziers_[of.detail];
    }
    return out;
}

std::string element_name(std::uint64_t element, std::uint32_t line) {
    return line > 0 ? fmt::format("element {} (line {})", element + 1, line) : fmt::format("element {}", element + 1);
}

} // namespace splinefeed::host
