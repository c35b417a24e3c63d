// SPDX-License-Identifier: MIT
#include "host_sim/planning/element_feeder.hpp"

#include "host_sim/base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace splinefeed::host {

namespace {

bool turns_rotary_axis(const PathElement<double>& move, const PerAxis<Position>& from, const PerAxis<bool>& rotary) {
    for (unsigned k = 0; k < max_axes; ++k) {
        const auto& points = move.bezier.points[k];
        const bool bends = move.shape == MoveShape::bezier &&
                           std::any_of(points.begin(), points.end(), [](double offset) { return offset != 0.0; });
        if (rotary[k] && (move.to[k] != from[k] || bends)) {
            return true;
        }
    }
    return false;
}

} // namespace

template <Scalar S>
ElementFeeder<S>::ElementFeeder(PathInput& input, std::unique_ptr<WaypointRows> rows)
    : input_(&input), program_(input.elements()), rows_(std::move(rows)),
      path_(static_cast<int>(input.axes().size()), from_double<S>(input.tolerances().joint_mm),
            {from_double<S>(input.tolerances().sharpest.curvature_1_mm),
             from_double<S>(input.tolerances().sharpest.fading)}) {
    if (program_ == nullptr) {
        lines_.resize(remembered);
    }
}

template <Scalar S>
void ElementFeeder<S>::refuse(Error error, std::uint64_t line) const {
    if (program_ != nullptr && moves_ < program_->moves()) {
        const std::uint32_t element = program_->element_of(moves_);
        throw InputError(input_->name(), 0,
                         fmt::format("{}: {}", element_name(element, program_->line_of(element)), describe(error)));
    }
    throw InputError(input_->name(), line, describe(error));
}

// The start, or the next move.
template <Scalar S>
bool ElementFeeder<S>::next(Pushed& pushed) {
    pushed = {};
    std::uint64_t line = 0;
    if (program_ != nullptr) {
        if (started_ && moves_ == program_->moves()) {
            return false;
        }
        pushed.position = program_->start();
        if (started_) {
            move_ = program_->element(moves_);
            pushed.position = move_.to;
            const std::uint32_t element = program_->element_of(moves_);
            rows_read_ = element + std::uint64_t{1};
            pushed.line = program_->line_of(element);
        }
    } else {
        WaypointRow row;
        if (!rows_->next(row)) {
            return false;
        }
        pushed.line = line = lines_[rows_read_++ % remembered] = row.line;
        for (unsigned k = 0; k < input_->axes().size(); ++k) {
            pushed.position[k] = position_from_mm(row.position[k]);
        }
        move_ = {};
        move_.to = pushed.position;
        move_.stop_at_end = row.corner == Corner::forced;
        move_.tolerance_mm = row.tolerance_mm.value_or(input_->choice().tolerance_mm);
        move_.feed_mm_s = row.feed_mm_s;
        move_.max_feed_mm_s = row.max_feed_mm_s;
    }
    if (started_ && turns_rotary_axis(move_, at_, input_->tolerances().rotary)) {
        // Then the path is nowhere farther off than the smaller number, in mm and in degrees.
        move_.tolerance_mm = std::min(move_.tolerance_mm, input_->tolerances().rotary_deg);
    }
    at_ = pushed.position;
    const Status status = started_ ? path_.push(element_in<S>(move_)) : path_.start(pushed.position);
    if (!status.ok()) {
        refuse(status.error(), line);
    }
    pushed.start = !started_;
    pushed.move = started_ ? &move_ : nullptr;
    moves_ += started_ ? 1U : 0U;
    started_ = true;
    return true;
}

template <Scalar S>
void ElementFeeder<S>::finish() {
    finished_ = true;
    if (const Status status = path_.finish(); !status.ok()) {
        throw InputError(input_->name(), 0,
                         program_ != nullptr ? "no element moves; a program needs a move" : describe(status.error()));
    }
}

template <Scalar S>
bool ElementFeeder<S>::more(Pushed& pushed) {
    if (finished_) {
        return false;
    }
    try {
        if (next(pushed)) {
            return true;
        }
        finish();
        return false;
    } catch (...) {
        if (!finished_) {
            finished_ = true;
            static_cast<void>(path_.finish());
        }
        throw;
    }
}

template <Scalar S>
std::uint64_t ElementFeeder<S>::line_of_row(std::uint64_t row) const noexcept {
    if (program_ != nullptr) {
        return 0;
    }
    const bool known = row < rows_read_ && row + remembered >= rows_read_;
    return known ? lines_[row % remembered] : 0;
}

template class ElementFeeder<double>;
template class ElementFeeder<float>;
template class ElementFeeder<Fixed>;

} // namespace splinefeed::host
