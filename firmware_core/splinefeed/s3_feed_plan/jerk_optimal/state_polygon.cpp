// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk_optimal/state_polygon.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

namespace {

constexpr double flat = 1e-10; // of the area of the box around a polygon

double twice_area(const SpeedState& a, const SpeedState& b, const SpeedState& c) noexcept {
    return absolute((b.b - a.b) * (c.slope - a.slope) - (b.slope - a.slope) * (c.b - a.b));
}

} // namespace

StatePolygon::StatePolygon(std::span<const SpeedState> corners) noexcept {
    for (const SpeedState& corner : corners) {
        append(corner);
    }
}

StatePolygon::StatePolygon(double largest_b, double max_path_acceleration) noexcept {
    append({0.0, -max_path_acceleration});
    append({largest_b, -max_path_acceleration});
    append({largest_b, max_path_acceleration});
    append({0.0, max_path_acceleration});
}

std::size_t StatePolygon::cut(const StateBound& bound) noexcept {
    if (full()) {
        simplify(); // the result is a part of it, too
    }
    std::array<double, capacity> excess;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < size_; ++i) {
        excess[i] = bound.excess(corner_[i]);
        beyond += excess[i] > 0.0 ? 1U : 0U;
    }
    if (beyond == 0) {
        return size_;
    }
    std::size_t first = 0;
    while (excess[first] <= 0.0) {
        ++first;
    }
    // Those before `first` stay where they are.
    const std::size_t start = first > 0 ? first - 1 : 0;
    std::array<SpeedState, capacity> left;
    std::size_t n = 0;
    for (std::size_t i = start; i < size_; ++i) {
        const std::size_t next = i + 1 < size_ ? i + 1 : 0;
        if (excess[i] <= 0.0) {
            left[n++] = corner_[i];
        }
        if ((excess[i] <= 0.0) != (excess[next] <= 0.0) && start + n < capacity) {
            const double share = excess[i] / (excess[i] - excess[next]);
            const SpeedState& from = corner_[i];
            const SpeedState& to = corner_[next];
            left[n++] = {from.b + share * (to.b - from.b), from.slope + share * (to.slope - from.slope)};
        }
    }
    SPLINEFEED_ASSERT(start + n < capacity);
    if (size_ == 2 && n > 2) { // a line is crossed once, but was seen from both sides
        n = 2;
    }
    for (std::size_t i = 0; i < n; ++i) {
        corner_[start + i] = left[i];
    }
    size_ = start + n;
    return first;
}

void StatePolygon::simplify() noexcept {
    if (size_ < 3) {
        return;
    }
    SpeedState least_state = corner_[0];
    SpeedState most_state = corner_[0];
    for (const SpeedState& corner : corners()) {
        least_state = {smaller(least_state.b, corner.b), smaller(least_state.slope, corner.slope)};
        most_state = {larger(most_state.b, corner.b), larger(most_state.slope, corner.slope)};
    }
    // Corners that almost coincide would be sides of any direction.
    const double nothing = flat * (most_state.b - least_state.b) * (most_state.slope - least_state.slope);
    const auto before = [&](std::size_t i) {
        return i > 0 ? i - 1 : size_ - 1;
    };
    const auto after = [&](std::size_t i) {
        return i + 1 < size_ ? i + 1 : 0;
    };
    const auto area_at = [&](std::size_t i) {
        return twice_area(corner_[before(i)], corner_[i], corner_[after(i)]);
    };
    std::array<double, capacity> area;
    for (std::size_t i = 0; i < size_; ++i) {
        area[i] = area_at(i);
    }
    for (;;) {
        std::size_t least = 0;
        double smallest = area[0];
        for (std::size_t i = 1; i < size_; ++i) {
            least = area[i] < smallest ? i : least;
            smallest = smaller(area[i], smallest);
        }
        if (size_ <= 3 || (size_ <= kept && smallest > nothing)) {
            return;
        }
        --size_;
        for (std::size_t i = least; i < size_; ++i) {
            corner_[i] = corner_[i + 1];
            area[i] = area[i + 1];
        }
        const std::size_t next = least < size_ ? least : 0;
        area[next] = area_at(next);
        area[before(next)] = area_at(before(next));
    }
}

void StatePolygon::include(const SpeedState& state) noexcept {
    const auto after = [&](std::size_t i) {
        return i + 1 < size_ ? i + 1 : 0;
    };
    const auto sees = [&](std::size_t i) { // whether the side after corner i is visible from outside
        const SpeedState& from = corner_[i];
        const SpeedState& to = corner_[after(i)];
        return (to.b - from.b) * (state.slope - from.slope) - (to.slope - from.slope) * (state.b - from.b) < 0.0;
    };
    std::size_t first = 0; // a visible side after one that is not
    while (first < size_ && (!sees(first) || sees(first > 0 ? first - 1 : size_ - 1))) {
        ++first;
    }
    if (first == size_) {
        return;
    }
    // The remaining corners are those from the end of the last visible side around to the start of the first.
    std::array<SpeedState, capacity> left;
    std::size_t n = 0;
    std::size_t last = first;
    while (sees(after(last)) && after(last) != first) {
        last = after(last);
    }
    for (std::size_t i = after(last); i != first; i = after(i)) {
        left[n++] = corner_[i];
    }
    left[n++] = corner_[first];
    left[n++] = state;
    for (std::size_t i = 0; i < n; ++i) {
        corner_[i] = left[i];
    }
    size_ = n;
}

std::size_t StatePolygon::bounds(std::span<StateBound> out) const noexcept {
    std::size_t n = 0;
    const auto side = [&](const SpeedState& from, const SpeedState& to) {
        const double of_b = to.slope - from.slope;
        const double of_slope = from.b - to.b;
        out[n++] = {of_b, of_slope, of_b * from.b + of_slope * from.slope};
    };
    for (std::size_t i = 0; i < size_; ++i) {
        side(corner_[i], corner_[i + 1 < size_ ? i + 1 : 0]);
    }
    if (size_ == 1) {
        const SpeedState& only = corner_[0];
        n = 0;
        out[n++] = {1.0, 0.0, only.b};
        out[n++] = {-1.0, 0.0, -only.b};
        out[n++] = {0.0, 1.0, only.slope};
        out[n++] = {0.0, -1.0, -only.slope};
    } else if (size_ == 2) {
        const auto end = [&](const SpeedState& from, const SpeedState& to) {
            const double of_b = to.b - from.b;
            const double of_slope = to.slope - from.slope;
            out[n++] = {of_b, of_slope, of_b * to.b + of_slope * to.slope};
        };
        end(corner_[0], corner_[1]);
        end(corner_[1], corner_[0]);
    }
    return n;
}

} // namespace splinefeed
