// SPDX-License-Identifier: MIT
// PathStrand: a piece of a path in double - a programmed move or a Bezier segment - and the distance of a point from
// it.
#pragma once

#include "host_sim/program/element_shapes.hpp"

#include "splinefeed/s1_blended_path/path_element.hpp"

#include <optional>
#include <vector>

namespace splinefeed::host {

/// Axes that are measured together: indices.
struct AxisSet {
    int count = 0;
    std::array<unsigned, max_axes> axis{};
};

/// The square of the distance of two places, by these axes.
[[nodiscard]] double distance_sq(const PerAxis<double>& a, const PerAxis<double>& b, const AxisSet& set) noexcept;

/// The distance of a place from the line between two others, by these axes.
[[nodiscard]] double distance_from_line(const PerAxis<double>& point, const PerAxis<double>& from,
                                        const PerAxis<double>& to, const AxisSet& set) noexcept;

class PathStrand {
public:
    /// A programmed move from a place.
    PathStrand(const PerAxis<Position>& from, const PathElement<double>& move, int axes);
    /// @param detail  number of places per turn of the curve: more for a long segment through many moves
    PathStrand(const CurveSegment<double>& segment, int detail);

    [[nodiscard]] bool straight() const noexcept { return !arc_ && degree_ == 1; }
    /// The place at t, 0 to 1. [mm]
    [[nodiscard]] PerAxis<double> at(double t) const noexcept;
    /// Distance of the point from the strand, in some of the axes. [mm] Cost: about a microsecond, and some fifty for
    /// the search.
    /// @param enough  a distance that needs no search for a nearer place: so far it may be too large beside a cusp or
    ///     where a Bezier segment comes back
    [[nodiscard]] double distance(const PerAxis<double>& point, const AxisSet& set, double enough = 0.0) const noexcept;
    /// A distance that is not too small, and mostly right: downhill from the place t until it is `enough`, or no less
    /// is beside it. t becomes its place. Cost: a tenth of a microsecond for each of two or three steps.
    [[nodiscard]] double distance_downhill(const PerAxis<double>& point, const AxisSet& set, double enough,
                                           double& t) const noexcept;
    /// How far a part of a Bezier segment that is `part` of t long may be from its chord, at most. [mm]
    [[nodiscard]] double bow(const AxisSet& set, double part) const noexcept;
    /// The square of a distance that the strand has at least.
    [[nodiscard]] double at_least_sq(const PerAxis<double>& point, const AxisSet& set) const noexcept {
        return box_.distance_sq(point, set);
    }
    /// How many parts of it are enough to look at.
    [[nodiscard]] int parts() const noexcept { return parts_; }
    /// The radius of an arc; 0: it is none.
    [[nodiscard]] double radius() const noexcept;
    [[nodiscard]] const std::optional<ProgrammedArc>& arc() const noexcept { return arc_; }

private:
    /// Extents along the axes.
    struct Box {
        PerAxis<double> low{};
        PerAxis<double> high{};

        [[nodiscard]] double distance_sq(const PerAxis<double>& point, const AxisSet& set) const noexcept;
    };
    struct Foot {
        double t = 0.0;
        double distance_sq = 0.0;
    };

    /// A place with its derivatives by t.
    struct State {
        PerAxis<double> point{};
        PerAxis<double> first{};
        PerAxis<double> second{};
    };

    void bound();
    void look_ahead() const;
    [[nodiscard]] State state(double t) const noexcept;
    [[nodiscard]] double distance_sq(const PerAxis<double>& point, const AxisSet& set, double t) const noexcept;
    [[nodiscard]] Foot guess(const PerAxis<double>& point, const AxisSet& set) const;
    [[nodiscard]] Foot descend(Foot foot, const PerAxis<double>& point, const AxisSet& set,
                               double enough_sq) const noexcept;
    [[nodiscard]] Foot search(Foot best, const PerAxis<double>& point, const AxisSet& set) const noexcept;
    [[nodiscard]] Foot guess_on_arc(const PerAxis<double>& point, const AxisSet& set) const noexcept;

    int axes_ = 0;
    int degree_ = 1;
    int parts_ = 1;
    PerAxis<PerDegree<double>> control_{}; // of a line or a Bezier segment; of an arc the axes behind the third
    std::optional<ProgrammedArc> arc_;
    mutable std::vector<PerAxis<double>> places_; // at i / parts_; empty until a search needs them
    mutable std::vector<Box> blocks_;             // of so many places each: most need no look
    Box box_;
};

} // namespace splinefeed::host
