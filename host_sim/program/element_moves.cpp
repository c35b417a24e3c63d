// SPDX-License-Identifier: MIT
#include "host_sim/program/element_moves.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

bool ElementMoves::start(PerAxis<Position>& position) {
    position = program_->start();
    return true;
}

bool ElementMoves::next(SourceStep& out) {
    out = {};
    const bool all = moves_ == program_->moves();
    const std::uint32_t element = all ? static_cast<std::uint32_t>(program_->elements()) : program_->element_of(moves_);
    if (dwells_ < program_->dwells().size() && program_->dwells()[dwells_].before <= element) {
        out.kind = StepKind::dwell;
        out.stops = true;
        out.dwell_s = program_->dwells()[dwells_++].seconds;
        return true;
    }
    if (all) {
        return false;
    }
    out.line = program_->line_of(element);
    out.move = program_->element(moves_);
    rows_ = element + std::uint64_t{1};
    ++moves_;
    return true;
}

std::uint64_t ElementMoves::number_of_move(std::uint64_t move) const noexcept {
    return program_->element_of(move) + std::uint64_t{1};
}

std::string ElementMoves::name_of_move(std::uint64_t move, std::uint64_t line) const {
    return element_name(number_of_move(move) - 1, static_cast<std::uint32_t>(line));
}

std::string ElementMoves::name_of_row(std::uint32_t row) const {
    return element_name(row, program_->line_of(row));
}

InputError ElementMoves::refusal(const SourceStep& /*step*/, std::string_view text) const {
    return {*file_, 0, fmt::format("{}: {}", name_of_row(static_cast<std::uint32_t>(rows_ - 1)), text)};
}

std::string ElementMoves::without_moves(Error /*error*/) const {
    return "no element moves; a program needs a move";
}

} // namespace splinefeed::host
