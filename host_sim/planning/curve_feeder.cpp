// SPDX-License-Identifier: MIT
#include "host_sim/planning/curve_feeder.hpp"

#include "host_sim/base/input_error.hpp"

#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr double same_point_mm = 1e-4; // as the core merges waypoints

template <Scalar S>
void take_tangent(const std::optional<Tangent>& given, int axes, bool& has, PerAxis<S>& out) {
    if (!given) {
        return;
    }
    if (given->components > axes) {
        throw UsageError(
            fmt::format("an end tangent has {} components, but the path has {} axes; give one for each axis",
                        given->components, axes));
    }
    has = true;
    for (const unsigned k : indices(given->components)) {
        out[k] = from_double<S>(given->value[k]);
    }
}

bool same_point(const WaypointRow& a, const WaypointRow& b) {
    for (const unsigned k : indices(max_axes)) {
        if (!(std::fabs(a.position[k] - b.position[k]) < same_point_mm)) {
            return false;
        }
    }
    return true;
}

} // namespace

template <Scalar S>
CurveFeeder<S>::CurveFeeder(PathInput& input) : input_(&input) {
    const CurveChoice& choice = input.choice();
    CurveOptions<S> options;
    options.axes = static_cast<int>(input.axes().size());
    options.parameterization = choice.parameterization;
    options.corner_cosine = from_double<S>(corner_cosine(choice.corner_angle_deg));
    options.seam_segments = choice.smooth && choice.closed;
    EndTangents<S> tangents;
    take_tangent(choice.start_tangent, options.axes, tangents.has_start, tangents.start);
    take_tangent(choice.end_tangent, options.axes, tangents.has_end, tangents.end);
    if (input.within_tolerance()) {
        source_ = &elements_.emplace(input).source();
        return;
    }
    if (input.segments() != nullptr) {
        source_ = &segments_.emplace(*input.segments(), options.axes, choice.smooth);
        if (choice.smooth) {
            for (const CurveFile::Segment& segment : input.segments()->segments) {
                if (segment.degree > 5) {
                    throw UsageError(fmt::format("--smooth takes segments up to degree 5; there is one of degree {}",
                                                 segment.degree));
                }
            }
            source_ = &smoothed_.emplace(*source_, segments_->repeats_seam() ? Seam::repeated : Seam::open);
        }
        rows_read_ = input.points_read();
        finished_ = true;
        return;
    }
    streamed_ = streamed_curve(choice, options, tangents);
    source_ = waypoints_ = streamed_.curve.get();
    if (choice.smooth) {
        source_ = &smoothed_.emplace(*source_, choice.closed ? Seam::repeated : Seam::open);
    }
    input_rows_ = input.rows();
    lines_.resize(remembered);
}

template <Scalar S>
void CurveFeeder<S>::read_all() {
    WaypointRow row;
    while (input_rows_->next(row)) {
        if (all_.size() == most_closed) {
            throw InputError(input_->name(), row.line,
                             fmt::format("a closed curve is kept in memory as a whole, and has at most {} waypoints; "
                                         "leave --closed out, or take fewer",
                                         most_closed));
        }
        all_.push_back(row);
        ++rows_read_;
    }
    if (all_.size() > 1 && same_point(all_.front(), all_.back())) { // the seam, written twice
        // The move that closes the path ends at the last row; nothing leads to the first one.
        WaypointRow& seam = all_.front();
        seam.feed_mm_s = all_.back().feed_mm_s;
        seam.max_feed_mm_s = all_.back().max_feed_mm_s;
        seam.corner = all_.back().corner != Corner::automatic ? all_.back().corner : seam.corner;
        all_.pop_back();
    }
    std::size_t different = 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        different += same_point(all_[i], all_[(i + 1) % all_.size()]) ? 0U : 1U;
    }
    if (different < 3) {
        throw InputError(input_->name(), all_.back().line, "a closed path needs three different waypoints");
    }
}

// The next waypoint in the order of pushing.
template <Scalar S>
bool CurveFeeder<S>::next_row(WaypointRow& row, Role& role) {
    role = Role::path;
    if (!input_->choice().closed) {
        if (!input_rows_->next(row)) {
            return false;
        }
        lines_[rows_read_ % remembered] = row.line;
        ++rows_read_;
        return true;
    }
    if (all_.empty()) {
        read_all();
    }
    const std::size_t count = all_.size();
    if (pushed_ == lead + count + 1 + lead) {
        return false;
    }
    role = pushed_ < lead ? Role::lead_in : pushed_ <= lead + count ? Role::path : Role::lead_out;
    row = all_[row_of(static_cast<std::uint32_t>(pushed_))];
    return true;
}

template <Scalar S>
bool CurveFeeder<S>::more(Pushed& pushed) {
    if (elements_) {
        pushed = {};
        return elements_->more(pushed.program);
    }
    if (finished_) {
        return false;
    }
    WaypointRow row;
    Role role{};
    try {
        if (!next_row(row, role)) {
            finish();
            return false;
        }
        Waypoint<S> waypoint;
        for (unsigned k = 0; k < input_->axes().size(); ++k) {
            waypoint.position[k] = position_from_mm(row.position[k]);
        }
        waypoint.feed_mm_s = from_double<S>(row.feed_mm_s);
        waypoint.max_feed_mm_s = from_double<S>(row.max_feed_mm_s);
        waypoint.corner = row.corner;
        if (const Status status = waypoints_->push(waypoint, role); !status.ok()) {
            throw InputError(input_->name(), row.line, describe(status.error()));
        }
        pushed = {static_cast<std::uint32_t>(pushed_++), waypoint.position, role == Role::path, {}};
        return true;
    } catch (...) {
        if (!finished_) {
            finished_ = true;
            static_cast<void>(waypoints_->finish());
        }
        throw;
    }
}

template <Scalar S>
void CurveFeeder<S>::finish() {
    finished_ = true;
    if (const Status status = waypoints_->finish(); !status.ok()) {
        throw InputError(input_->name(), 0, describe(status.error()));
    }
}

template <Scalar S>
std::uint32_t CurveFeeder<S>::row_of(std::uint32_t index) const noexcept {
    if (elements_) {
        return elements_->program().row_of(index);
    }
    if (all_.empty()) {
        return index;
    }
    const auto count = static_cast<std::int64_t>(all_.size());
    const std::int64_t behind = (static_cast<std::int64_t>(index) - static_cast<std::int64_t>(lead)) % count;
    return static_cast<std::uint32_t>(behind < 0 ? behind + count : behind);
}

template <Scalar S>
std::uint64_t CurveFeeder<S>::line_of_row(std::uint32_t row) const noexcept {
    if (elements_) {
        return elements_->program().line_of_row(whole_row(row));
    }
    if (!all_.empty()) {
        return row < all_.size() ? all_[row].line : 0;
    }
    const std::uint64_t whole = whole_row(row);
    const bool known = !lines_.empty() && whole < rows_read_ && whole + remembered >= rows_read_; // segments have none
    return known ? lines_[whole % remembered] : 0;
}

template <Scalar S>
std::uint64_t CurveFeeder<S>::whole_row(std::uint32_t row) const noexcept {
    const auto ago = static_cast<std::uint32_t>(static_cast<std::uint32_t>(rows()) - row);
    return rows() >= ago ? rows() - ago : row;
}

template <Scalar S>
std::string CurveFeeder<S>::name_of_row(std::uint32_t row) const {
    return elements_ ? elements_->program().name_of_row(row) : fmt::format("point {}", row + 1);
}

template <Scalar S>
std::uint64_t CurveFeeder<S>::number_of_move(std::uint64_t move) const noexcept {
    return elements_->program().number_of_move(move);
}

template <Scalar S>
std::string CurveFeeder<S>::name_of_move(std::uint64_t move, std::uint64_t line) const {
    return elements_->program().name_of_move(move, line);
}

template class CurveFeeder<double>;
template class CurveFeeder<float>;
template class CurveFeeder<Fixed>;

} // namespace splinefeed::host
