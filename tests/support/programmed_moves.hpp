// SPDX-License-Identifier: MIT
//
// Programmed moves in mm, and how far a path is from them and they from it: by sampling and by search, without a line
// of what blends them.
#pragma once

#include "bezier_paths.hpp"
#include "catch.hpp"
#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace splinefeed_test {

using PlaceMm = PerAxis<Real>;

inline Real real_between(Random& random, double low, double high) {
    return static_cast<Real>(random.between(low, high));
}
inline Real real_decades(Random& random, double low, double high) {
    return static_cast<Real>(random.decades(low, high));
}

inline Real apart(const PlaceMm& a, const PlaceMm& b, int axes) {
    Real sum = 0.0L;
    for (const unsigned k : splinefeed::indices(axes)) {
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return std::sqrt(sum);
}

/// A line, an arc about an axis (the other axes follow evenly), or a Bezier segment.
struct ProgrammedMove {
    splinefeed::MoveShape shape = splinefeed::MoveShape::line;
    splinefeed::PathMode mode = splinefeed::PathMode::continuous;
    bool stop_at_end = false;
    double tolerance_mm = 0.01;
    double chain_tolerance_mm = 100.0;
    double feed_mm_s = 0.0;
    PlaceMm from{};
    PlaceMm to{};
    std::array<Real, 3> centre{};
    std::array<Real, 3> normal{0.0L, 0.0L, 1.0L};
    Real sweep = 0.0L;
    std::vector<PlaceMm> points; ///< of a Bezier segment

    [[nodiscard]] PlaceMm at(Real t, int axes) const {
        PlaceMm out{};
        for (const unsigned k : splinefeed::indices(axes)) {
            out[k] = from[k] + t * (to[k] - from[k]);
        }
        if (shape == splinefeed::MoveShape::bezier) {
            std::vector<PlaceMm> row = points;
            for (std::size_t n = row.size() - 1; n > 0; --n) {
                for (std::size_t i = 0; i < n; ++i) {
                    for (const unsigned k : splinefeed::indices(axes)) {
                        row[i][k] += t * (row[i + 1][k] - row[i][k]);
                    }
                }
            }
            return row[0];
        }
        if (shape == splinefeed::MoveShape::arc) {
            turn(t, axes, out);
        }
        return out;
    }

    /// Distance of a place. @param along  t of the nearest place
    Real distance(const PlaceMm& place, int axes, Real* along = nullptr) const {
        const auto away = [&](Real t) {
            return apart(at(t, axes), place, axes);
        };
        int count = 1;
        if (shape == splinefeed::MoveShape::line) {
            Real dot = 0.0L;
            Real square = 0.0L;
            for (const unsigned k : splinefeed::indices(axes)) {
                dot += (place[k] - from[k]) * (to[k] - from[k]);
                square += (to[k] - from[k]) * (to[k] - from[k]);
            }
            const Real t = square > 0.0L ? std::clamp(dot / square, 0.0L, 1.0L) : 0.0L;
            if (along != nullptr) {
                *along = t;
            }
            return away(t);
        }
        count = shape == splinefeed::MoveShape::arc ? 8 + static_cast<int>(std::fabs(sweep) * 8.0L) : 64;
        std::vector<Real> sampled(static_cast<std::size_t>(count) + 1);
        Real longest = 0.0L;
        for (int i = 0; i <= count; ++i) {
            sampled[static_cast<std::size_t>(i)] = away(static_cast<Real>(i) / static_cast<Real>(count));
            longest = i == 0 ? 0.0L
                             : std::max(longest, std::fabs(sampled[static_cast<std::size_t>(i)] -
                                                           sampled[static_cast<std::size_t>(i) - 1]));
        }
        Real least = *std::min_element(sampled.begin(), sampled.end());
        const Real near = least + 2.0L * longest; // an arc may come near more than once
        for (int i = 0; i <= count; ++i) {
            const Real here = sampled[static_cast<std::size_t>(i)];
            if (here > near || (i > 0 && sampled[static_cast<std::size_t>(i) - 1] < here) ||
                (i < count && sampled[static_cast<std::size_t>(i) + 1] < here)) {
                continue;
            }
            Real low = std::max(0.0L, static_cast<Real>(i - 1) / static_cast<Real>(count));
            Real high = std::min(1.0L, static_cast<Real>(i + 1) / static_cast<Real>(count));
            for (int step = 0; step < 8; ++step) {
                const Real x = low + (high - low) / 3.0L;
                const Real y = high - (high - low) / 3.0L;
                const bool left = away(x) < away(y);
                (left ? high : low) = left ? y : x;
            }
            Real t = (low + high) / 2.0L;
            for (int step = 0; step < 4; ++step) { // Newton's, with differences for derivatives
                constexpr Real h = 1e-7L;
                const PlaceMm place_at = at(t, axes);
                const PlaceMm ahead = at(t + h, axes);
                Real dot = 0.0L;
                Real square = 1e-30L;
                for (const unsigned k : splinefeed::indices(axes)) {
                    const Real first = (ahead[k] - place_at[k]) / h;
                    dot += (place[k] - place_at[k]) * first;
                    square += first * first;
                }
                t = std::clamp(t + dot / square, 0.0L, 1.0L);
            }
            const Real found = away(t);
            if (along != nullptr && found <= least) {
                *along = t;
            }
            least = std::min(least, found);
        }
        return least;
    }

private:
    void turn(Real t, int axes, PlaceMm& out) const {
        std::array<Real, 3> x{};
        std::array<Real, 3> last{};
        Real height = 0.0L;
        Real rise = 0.0L;
        for (unsigned k = 0; k < 3 && k < static_cast<unsigned>(axes); ++k) {
            x[k] = from[k] - centre[k];
            last[k] = to[k] - centre[k];
        }
        for (unsigned k = 0; k < 3; ++k) {
            height += x[k] * normal[k];
            rise += (last[k] - x[k]) * normal[k];
        }
        Real radius = 0.0L;
        Real end_radius = 0.0L;
        for (unsigned k = 0; k < 3; ++k) {
            x[k] -= height * normal[k];
            last[k] -= (height + rise) * normal[k];
            radius += x[k] * x[k];
            end_radius += last[k] * last[k];
        }
        radius = std::sqrt(radius);
        end_radius = std::sqrt(end_radius);
        const Real r = radius + t * (end_radius - radius);
        for (unsigned k = 0; k < 3 && k < static_cast<unsigned>(axes); ++k) {
            const unsigned i = (k + 1) % 3;
            const unsigned j = (k + 2) % 3;
            const Real y = (normal[i] * x[j] - normal[j] * x[i]) / radius;
            out[k] = centre[k] + (height + t * rise) * normal[k] +
                     r * (std::cos(t * sweep) * x[k] / radius + std::sin(t * sweep) * y);
        }
    }
};

struct MoveProgram {
    int axes = 3;
    double joint_tolerance_mm = 0.001;
    std::vector<ProgrammedMove> moves;

    /// A line from where the last move ended.
    ProgrammedMove& line(const PlaceMm& to) {
        ProgrammedMove move;
        move.from = moves.empty() ? start : moves.back().to;
        move.to = to;
        moves.push_back(move);
        return moves.back();
    }
    /// An arc in the plane of the first two axes about a centre, rising to a height.
    ProgrammedMove& arc(Real cx, Real cy, Real sweep, Real rise = 0.0L) {
        ProgrammedMove& move = line({});
        move.shape = splinefeed::MoveShape::arc;
        move.centre = {cx, cy, 0.0L};
        move.sweep = sweep;
        const Real x = move.from[0] - cx;
        const Real y = move.from[1] - cy;
        move.to = move.from;
        move.to[0] = cx + x * std::cos(sweep) - y * std::sin(sweep);
        move.to[1] = cy + x * std::sin(sweep) + y * std::cos(sweep);
        if (axes > 2) {
            move.to[2] += rise;
        }
        return move;
    }
    /// A Bezier segment; points from its start, without the start.
    ProgrammedMove& bezier(const std::vector<PlaceMm>& offsets) {
        ProgrammedMove& move = line({});
        move.shape = splinefeed::MoveShape::bezier;
        move.points = {move.from};
        for (const PlaceMm& offset : offsets) {
            PlaceMm point = move.from;
            for (const unsigned k : splinefeed::indices(axes)) {
                point[k] += offset[k];
            }
            move.points.push_back(point);
        }
        move.to = move.points.back();
        return move;
    }
    PlaceMm start{};
};

template <Scalar S>
PerAxis<Position> position_of(const PlaceMm& place) {
    PerAxis<Position> out{};
    for (const unsigned k : splinefeed::indices(max_axes)) {
        out[k] = position_from_mm(static_cast<double>(place[k]));
    }
    return out;
}

template <Scalar S>
splinefeed::PathElement<S> element_of(const ProgrammedMove& move, int axes) {
    splinefeed::PathElement<S> element;
    element.shape = move.shape;
    element.mode = move.mode;
    element.stop_at_end = move.stop_at_end;
    element.to = position_of<S>(move.to);
    element.tolerance_mm = from_double<S>(move.tolerance_mm);
    element.chain_tolerance_mm = from_double<S>(move.chain_tolerance_mm);
    element.feed_mm_s = from_double<S>(move.feed_mm_s);
    for (unsigned k = 0; k < 3; ++k) {
        if (k < static_cast<unsigned>(max_axes)) {
            element.arc.centre[k] = position_from_mm(static_cast<double>(move.centre[k]));
        }
        element.arc.normal[k] = from_double<S>(static_cast<double>(move.normal[k]));
    }
    element.arc.sweep_rad = from_double<S>(static_cast<double>(move.sweep));
    element.bezier.degree = static_cast<int>(move.points.size()) - 1;
    for (const unsigned k : splinefeed::indices(axes)) {
        for (std::size_t i = 0; i < move.points.size(); ++i) {
            element.bezier.points[k][i] =
                from_double<S>(static_cast<double>((move.points[i][k] - move.from[k]) * 4096.0L));
        }
    }
    return element;
}

template <Scalar S>
struct BlendedRun {
    std::vector<CurveSegment<S>> segments;
    splinefeed::PathCounts counts;
};

/// Pushes and pulls in random order if there is a seed.
template <Scalar S>
BlendedRun<S> blended(const MoveProgram& program, std::uint64_t seed = 0) {
    splinefeed::TolerancePath<S> path(program.axes, {from_double<S>(program.joint_tolerance_mm)});
    REQUIRE(path.start(position_of<S>(program.start)).ok());
    Random random(seed);
    BlendedRun<S> run;
    CurveSegment<S> segment;
    std::size_t next = 0;
    const auto push = [&](std::size_t most) {
        for (; most > 0 && next < program.moves.size() && path.has_room(); --most) {
            const auto status = path.push(element_of<S>(program.moves[next++], program.axes));
            CAPTURE(next, describe(status.error()));
            REQUIRE(status.ok());
            if (next == program.moves.size()) {
                REQUIRE(path.finish().ok());
            }
        }
    };
    for (;;) {
        if (seed != 0 && random.chance(0.3)) {
            push(static_cast<std::size_t>(random.integer(0, 5)));
        }
        const Pull pull = path.next(segment);
        if (pull == Pull::finished) {
            break;
        }
        if (pull == Pull::item) {
            run.segments.push_back(segment);
            REQUIRE(run.segments.size() < 40 * program.moves.size() + 100000);
        } else {
            REQUIRE((next < program.moves.size() && path.has_room()));
            push(seed != 0 ? static_cast<std::size_t>(random.integer(0, 3)) : 1000);
        }
    }
    REQUIRE(next == program.moves.size());
    run.counts = path.counts();
    return run;
}

} // namespace splinefeed_test
