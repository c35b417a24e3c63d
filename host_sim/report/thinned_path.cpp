// SPDX-License-Identifier: MIT
#include "host_sim/report/thinned_path.hpp"

#include <algorithm>
#include <utility>

namespace splinefeed::host {

namespace {

// The piece to `to` goes on from where `piece` ended.
void join(const ThinnedPath::Point& piece, ThinnedPath::Point& to) {
    to.way += piece.way;
    to.wanted += piece.wanted;
    to.acceleration = std::max(to.acceleration, piece.acceleration);
    to.jerk = std::max(to.jerk, piece.jerk);
    if (piece.code == to.code) {
        to.weight += piece.weight;
    } else if ((to.weight -= piece.weight) < 0.0F) {
        to.code = piece.code;
        to.weight = -to.weight;
    }
}

} // namespace

void ThinnedPath::add(const Point& point) {
    take(point);
    if (points_.size() >= most_) {
        do {
            thin();
        } while (points_.size() > most_ / 4 * 3);
    }
}

void ThinnedPath::settle(const Point& point) {
    points_.push_back(point);
    open_ = false;
    low_.fill(-1e300);
    high_.fill(1e300);
}

void ThinnedPath::take(const Point& point) {
    if (points_.empty()) {
        settle(point);
        return;
    }
    const Point* from = &points_.back();
    double way = point.length_mm - from->length_mm;
    bool fits = way > 0.0;
    for (unsigned k = 0; fits && k < axes_; ++k) {
        const double slope = (point.position[k] - from->position[k]) / way;
        fits = slope >= low_[k] && slope <= high_[k];
    }
    if (!fits && open_) {
        settle(last_);
        from = &points_.back();
        way = point.length_mm - from->length_mm;
    }
    Point next = point;
    if (open_) {
        join(last_, next);
    }
    if ((point.keep && keeps_) || (point.edge && edges_)) {
        settle(next);
        return;
    }
    for (unsigned k = 0; way > 0.0 && k < axes_; ++k) {
        const double slope = (point.position[k] - from->position[k]) / way;
        low_[k] = std::max(low_[k], slope - tolerance_ / way);
        high_[k] = std::min(high_[k], slope + tolerance_ / way);
    }
    last_ = next;
    open_ = true;
}

void ThinnedPath::thin() {
    const auto kept = std::ranges::count_if(points_, [](const Point& point) { return point.keep; });
    keeps_ = keeps_ && static_cast<std::size_t>(kept) < most_ / 4 * 3;
    edges_ = false;
    tolerance_ *= 2.0;
    strayed_ += tolerance_;
    std::vector<Point> all;
    std::swap(all, points_);
    points_.reserve(most_);
    const bool was_open = std::exchange(open_, false);
    const Point last = last_;
    for (const Point& point : all) {
        take(point);
    }
    if (was_open) {
        take(last);
    }
}

void ThinnedPath::finish(double tolerance, std::size_t enough) {
    if (open_) {
        settle(last_);
    }
    while (tolerance_ < tolerance && points_.size() > enough) {
        thin();
        if (open_) {
            settle(last_);
        }
    }
}

} // namespace splinefeed::host
