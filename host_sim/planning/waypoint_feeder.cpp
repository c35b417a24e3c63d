// SPDX-License-Identifier: MIT
#include "host_sim/planning/waypoint_feeder.hpp"

#include "host_sim/base/input_error.hpp"

#include "splinefeed/number/vector.hpp"

#include <cmath>
#include <utility>

namespace splinefeed::host {

namespace {

constexpr double same_point_mm = 1e-4; // as the core merges waypoints

bool same_point(const WaypointRow& a, const WaypointRow& b) {
    return for_all(max_axes, [&](unsigned k) { return std::fabs(a.position[k] - b.position[k]) < same_point_mm; });
}

} // namespace

WaypointFeeder::WaypointFeeder(PathInput& input, WaypointSink sink)
    : input_(&input), sink_(std::move(sink)), input_rows_(input.rows()), lines_(remembered) {}

void WaypointFeeder::read_all() {
    WaypointRow row;
    while (input_rows_->next(row)) {
        if (all_.size() == most_closed) {
            throw InputError(input_->name(), row.line,
                             "a closed curve is kept in memory as a whole, and has at most {} waypoints; "
                             "leave --closed out, or take fewer",
                             most_closed);
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
bool WaypointFeeder::next_row(WaypointRow& row, Role& role) {
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

bool WaypointFeeder::more(Pushed& pushed) {
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
        Waypoint<double> waypoint;
        for (unsigned k = 0; k < input_->axes().size(); ++k) {
            waypoint.position[k] = position_from_mm(row.position[k]);
        }
        waypoint.feed_mm_s = row.feed_mm_s;
        waypoint.max_feed_mm_s = row.max_feed_mm_s;
        waypoint.corner = row.corner;
        if (const Status status = sink_.push(waypoint, role); !status.ok()) {
            throw InputError(input_->name(), row.line, describe(status.error()));
        }
        pushed = {};
        pushed.index = static_cast<std::uint32_t>(pushed_++);
        pushed.on_path = role == Role::path;
        pushed.position = waypoint.position;
        return true;
    } catch (...) {
        if (!finished_) {
            finished_ = true;
            static_cast<void>(sink_.finish());
        }
        throw;
    }
}

void WaypointFeeder::finish() {
    finished_ = true;
    if (const Status status = sink_.finish(); !status.ok()) {
        throw InputError(input_->name(), 0, describe(status.error()));
    }
}

std::uint32_t WaypointFeeder::row_of(std::uint32_t index) const noexcept {
    if (all_.empty()) {
        return index;
    }
    const auto count = static_cast<std::int64_t>(all_.size());
    const std::int64_t behind = (static_cast<std::int64_t>(index) - static_cast<std::int64_t>(lead)) % count;
    return static_cast<std::uint32_t>(behind < 0 ? behind + count : behind);
}

std::uint64_t WaypointFeeder::line_of_row(std::uint32_t row) const noexcept {
    if (!all_.empty()) {
        return row < all_.size() ? all_[row].line : 0;
    }
    const std::uint64_t whole = whole_row(row);
    const bool known = whole < rows_read_ && whole + remembered >= rows_read_;
    return known ? lines_[whole % remembered] : 0;
}

} // namespace splinefeed::host
