// SPDX-License-Identifier: MIT
//
// Reproducible paths of waypoints: even and uneven spacing, micrometre-short moves, straight lines, zigzags, helices.
#pragma once

#include "splinefeed/number/position.hpp"
#include "splinefeed/s1_curve/waypoint.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace splinefeed_test {

using splinefeed::PerAxis;
using splinefeed::Position;

/// Print it with CAPTURE(path_seed): with it every random path can be made again.
inline constexpr std::uint64_t path_seed = 20240917;

struct Path {
    int axes = 3;
    std::vector<PerAxis<Position>> points;
};

enum class Shape : std::uint8_t { even, uneven, very_uneven, short_moves, collinear, zigzag, helix };

inline constexpr Shape all_shapes[] = {Shape::even,      Shape::uneven, Shape::very_uneven, Shape::short_moves,
                                       Shape::collinear, Shape::zigzag, Shape::helix};

class RandomPath {
public:
    explicit RandomPath(std::uint64_t seed = path_seed) : generator_(seed) {}

    /// The same numbers with every standard library, which std::uniform_real_distribution does not promise.
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(generator_() >> 11U) * 0x1p-53;
    }
    int below(int end) { return static_cast<int>(generator_() % static_cast<std::uint64_t>(end)); }

    /// Chords turn by at most about 50 degrees (the automatic corner is at 60), except in zigzags.
    Path make(Shape shape, int axes, int count) {
        std::vector<double> at(6, 0.0);
        std::vector<double> direction = unit(axes);
        const std::vector<double> fixed_direction = direction;
        Path path{axes, {}};
        for (int i = 0; i < count; ++i) {
            PerAxis<Position> point{};
            for (int k = 0; k < axes; ++k) {
                point[static_cast<unsigned>(k)] = splinefeed::position_from_mm(at[static_cast<unsigned>(k)]);
            }
            path.points.push_back(point);
            const double length = step(shape);
            if (shape == Shape::helix) {
                const double angle = 0.2 * (i + 1);
                const double helix[6] = {10.0 * std::cos(angle) - 10.0,
                                         10.0 * std::sin(angle),
                                         0.3 * angle,
                                         5.0 * std::cos(angle) - 5.0,
                                         0.1 * angle,
                                         3.0 * std::sin(angle)};
                at.assign(helix, helix + 6);
                continue;
            }
            if (shape != Shape::collinear && axes > 1) {
                const std::vector<double> turn = unit(axes);
                const double much = shape == Shape::zigzag ? 3.0 : 0.6;
                double size = 0.0;
                for (const unsigned k : splinefeed::indices(axes)) {
                    direction[k] += much * turn[k];
                    size += direction[k] * direction[k];
                }
                for (double& d : direction) {
                    d /= std::sqrt(size);
                }
            } else if (shape == Shape::zigzag) {
                direction[0] = -direction[0];
            }
            for (const unsigned k : splinefeed::indices(axes)) {
                at[k] += length * (shape == Shape::collinear ? fixed_direction[k] : direction[k]);
            }
        }
        return path;
    }

private:
    double step(Shape shape) {
        switch (shape) {
        case Shape::uneven: return between(0.2, 4.0);
        case Shape::very_uneven: return 0.005 * std::pow(1000.0, between(0.0, 1.0)); // 1000:1, 5 um to 5 mm
        case Shape::short_moves: return below(4) == 0 ? 0.001 : between(0.5, 1.0);
        case Shape::zigzag:
        case Shape::collinear: return between(0.5, 2.0);
        default: return 1.0;
        }
    }
    std::vector<double> unit(int axes) {
        std::vector<double> v(static_cast<unsigned>(axes));
        double size = 0.0;
        while (size < 0.01 || size > 1.0) {
            size = 0.0;
            for (double& x : v) {
                x = between(-1.0, 1.0);
                size += x * x;
            }
        }
        for (double& x : v) {
            x /= std::sqrt(size);
        }
        return v;
    }

    std::mt19937_64 generator_;
};

/// x, y, ... in mm, one after another.
inline Path path_of(int axes, const std::vector<double>& mm) {
    Path path{axes, {}};
    for (std::size_t i = 0; i + static_cast<std::size_t>(axes) <= mm.size(); i += static_cast<std::size_t>(axes)) {
        PerAxis<Position> point{};
        for (const unsigned k : splinefeed::indices(axes)) {
            point[k] = splinefeed::position_from_mm(mm[i + k]);
        }
        path.points.push_back(point);
    }
    return path;
}

} // namespace splinefeed_test
