// SPDX-License-Identifier: MIT
// ThinnedPath: a polyline in bounded memory that stays near the points it is made of.
#pragma once

#include "splinefeed/base/capacity.hpp"

#include <cstdint>
#include <vector>

namespace splinefeed::host {

/// Each axis as a function of the path's length: lines that are no farther than a tolerance from every point. A point
/// is left out as long as one line serves (a swinging door: two slopes an axis, no search). When there are too many
/// points, the tolerance doubles and the points are thinned once more. Memory: `most` points. Cost of add(): a division
/// and two comparisons an axis.
class ThinnedPath {
public:
    /// What belongs to a point, and to the piece that ends there.
    struct Point {
        double time_s = 0.0;
        double length_mm = 0.0; ///< along the path; not below that of the point before
        PerAxis<double> position{};
        std::uint64_t line = 0;
        std::uint64_t row = 0;
        std::uint8_t kind = 0;
        std::uint8_t code = 0;     ///< of a piece: the one that held longest
        float weight = 0.0F;       ///< of that code [s]
        float way = 0.0F;          ///< of a piece: the integral of the speed; the same below
        float wanted = 0.0F;       ///< of the programmed feed
        float acceleration = 0.0F; ///< of a piece: the largest share of a limit; the same below
        float jerk = 0.0F;
        bool keep = false; ///< it is never left out
        bool edge = false; ///< it is kept as long as there is room for all points of this kind
    };

    ThinnedPath(int axes, std::size_t most) : axes_(static_cast<unsigned>(axes)), most_(most) {}

    void add(const Point& point);
    /// No more points. The path becomes as coarse as `tolerance`, if it was finer and has more than `enough` points.
    void finish(double tolerance, std::size_t enough);

    [[nodiscard]] const std::vector<Point>& points() const noexcept { return points_; }
    /// No point that was left out is farther from the lines, in any axis. [mm, degrees]
    [[nodiscard]] double tolerance() const noexcept { return strayed_; }
    /// Whether even points that are to be kept were too many.
    [[nodiscard]] bool left_out() const noexcept { return !keeps_; }

private:
    void take(const Point& point);
    void settle(const Point& point);
    void thin();

    unsigned axes_;
    std::size_t most_;
    std::vector<Point> points_;
    Point last_{}; // that the door is open for
    bool open_ = false;
    PerAxis<double> low_{}; // slopes
    PerAxis<double> high_{};
    double tolerance_ = 1e-4;
    double strayed_ = 1e-4; // the sum over all rounds
    bool edges_ = true;
    bool keeps_ = true;
};

} // namespace splinefeed::host
