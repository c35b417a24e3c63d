// SPDX-License-Identifier: MIT
//
// The distance of points from strands against that from thousands of their places: never more than to the nearest.
#include "host_sim/analysis/path_strand.hpp"

#include "support/bezier_paths.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr int axes = 4;
constexpr AxisSet all{axes, {0, 1, 2, 3}};

PerAxis<Position> place_of(const std::array<double, axes>& mm) {
    PerAxis<Position> place{};
    for (unsigned k = 0; k < axes; ++k) {
        place[k] = position_from_mm(mm[k]);
    }
    return place;
}

/// @param beside  how far the points are from the strand at most [mm]
void compare(Random& random, const PathStrand& strand, int places, double beside) {
    std::vector<PerAxis<double>> dense;
    for (int i = 0; i <= places; ++i) {
        dense.push_back(strand.at(i / static_cast<double>(places)));
    }
    for (int n = 0; n < 30; ++n) {
        PerAxis<double> point = dense[static_cast<std::size_t>(random.integer(0, places))];
        for (unsigned k = 0; k < axes; ++k) {
            point[k] += beside * random.between(-1.0, 1.0);
        }
        double nearest = 1e300;
        for (const PerAxis<double>& place : dense) {
            double sum = 0.0;
            for (unsigned k = 0; k < axes; ++k) {
                sum += (place[k] - point[k]) * (place[k] - point[k]);
            }
            nearest = std::min(nearest, sum);
        }
        CAPTURE(n, beside, std::sqrt(nearest));
        REQUIRE(strand.distance(point, all) <= std::sqrt(nearest) + 2e-7);
    }
}

} // namespace

TEST_CASE("The distance from a Bezier segment, also beside cusps and where it comes back") {
    constexpr std::uint64_t seed = 3502;
    for (int round = 0; round < rounds(200); ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        CAPTURE(seed, round);
        PathElement<double> move;
        move.shape = MoveShape::bezier;
        move.bezier.degree = random.integer(2, 5);
        const bool hairpin = random.chance(0.5); // its points lie almost on a line, to and fro
        const double size = random.decades(0.1, 20.0);
        std::array<double, axes> end{};
        for (int i = 1; i <= move.bezier.degree; ++i) {
            const double along = size * random.between(-1.0, 1.0);
            for (unsigned k = 0; k < axes; ++k) {
                const double across = size * random.between(-1.0, 1.0) * (hairpin ? 1e-3 : 1.0);
                end[k] = across + (hairpin && k < 2 ? along : 0.0);
                move.bezier.points[k][static_cast<unsigned>(i)] = end[k] * 4096.0;
            }
        }
        move.to = place_of(end);
        compare(random, PathStrand({}, move, axes), 4000, size * random.decades(1e-4, 0.1));
    }
}

TEST_CASE("The distance from an arc of many turns, whatever tells the turns apart") {
    constexpr std::uint64_t seed = 3503;
    for (int round = 0; round < rounds(200); ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        CAPTURE(seed, round);
        const auto some = [&](double most) { // nothing, what rounding leaves, or as much as that
            return random.chance(0.3) ? 0.0 : random.chance(0.3) ? 1e-13 : most * random.between(0.2, 1.0);
        };
        const double radius = random.decades(0.1, 20.0);
        const double growth = some(radius / 20.0);
        const double rise = some(radius);
        const double other = some(radius);
        const double angle = random.between(1.0, 40.0) * (random.chance(0.5) ? 1.0 : -1.0);
        PathElement<double> move;
        move.shape = MoveShape::arc;
        move.arc.normal = {0.0, 0.0, 1.0};
        move.arc.sweep_rad = angle;
        move.to = place_of({(radius + growth) * std::cos(angle), (radius + growth) * std::sin(angle), rise, other});
        const PathStrand strand(place_of({radius, 0.0, 0.0, 0.0}), move, axes);
        const double between = (std::fabs(growth) + std::fabs(rise) + std::fabs(other)) / std::fabs(angle);
        compare(random, strand, 40'000, std::min(radius / 20.0, between * random.decades(1e-3, 1.0)));
    }
}
