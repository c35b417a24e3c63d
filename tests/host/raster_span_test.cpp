// SPDX-License-Identifier: MIT
//
// Tool paths on surfaces with many knot spans, and features narrower than evenly spread looks would see.
#include "host_sim/surface/raster.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace splinefeed;
using namespace splinefeed::host;
using nlohmann::json;

namespace {

double apart(const Point<double>& a, const Point<double>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

} // namespace

TEST_CASE("raster: the way back is above every peak, however narrow", "[surface]") {
    // 120 spans along a line and a peak 2 mm wide: looks at evenly spread places pass it by.
    json grid = json::array();
    for (int i = 0; i <= 120; ++i) {
        const double x = 0.5 * i;
        const double z = 20.0 * std::exp(-(x - 25.6) * (x - 25.6));
        grid.push_back({{x, 0.0, z}, {x, 5.0, z}, {x, 10.0, z}, {x, 15.0, z}});
    }
    const DescribedSurface surface = describe_surface("bspline_surface", {{"grid", grid}});
    for (const double radius : {0.0, 0.02}) {
        for (const bool tip : {false, true}) {
            RasterOptions options;
            options.lines = 3;
            options.zigzag = false;
            options.lift_mm = 1.0;
            options.step_mm = 0.1;
            options.ball_radius_mm = radius;
            options.tip = tip;
            const ToolSurface tool(surface, options);
            double highest = -std::numeric_limits<double>::infinity();
            double way_back = highest;
            for (const splinefeed::host::CellInterval& stretch : raster(tool)) {
                if (stretch.kind == splinefeed::host::CellInterval::Kind::straight) {
                    way_back = std::max(way_back, stretch.end[2]);
                    continue;
                }
                for (int i = 0; i <= 6000; ++i) {
                    const double t = stretch.from + (stretch.to - stretch.from) * i / 6000.0;
                    highest = std::max(highest, tool.tool(t, stretch.constant)[2]);
                }
            }
            CAPTURE(radius, tip, highest);
            CHECK(way_back >= highest + 1.0);
            CHECK(way_back < highest + 6.0); // the net goes out beyond a narrow peak
        }
    }
}

TEST_CASE("raster: hollows are seen in every knot span, along the lines and at the edge", "[surface]") {
    // A notch of radius 0.06 mm at its bottom, between places evenly spread over the 120 mm of a line.
    const auto notched = [](double place) {
        json grid = json::array();
        for (int i = 0; i <= 240; ++i) {
            const double x = 0.5 * i;
            const double z = -2.0 * std::exp(-4.0 * (x - place) * (x - place));
            grid.push_back({{x, 0.0, z}, {x, 5.0, z}, {x, 10.0, z}, {x, 15.0, z}});
        }
        return describe_surface("bspline_surface", {{"grid", grid}});
    };
    RasterOptions options;
    options.lines = 2;
    options.ball_radius_mm = 6.0;
    options.step_mm = 5.0;
    for (const double place : {51.2, 50.0, 61.3}) {
        const DescribedSurface surface = notched(place);
        CAPTURE(place);
        options.along = SurfaceDirection::u;
        CHECK_THROWS_AS(raster(ToolSurface(surface, options)), DescriptionError);
        // Lines beside the notch pass it only where a zigzag goes over to the next one.
        options.along = SurfaceDirection::v;
        options.zigzag = true;
        CHECK_THROWS_AS(raster(ToolSurface(surface, options)), DescriptionError);
        options.zigzag = false;
        CHECK_FALSE(raster(ToolSurface(surface, options)).empty());
        options.zigzag = true;
    }
}

TEST_CASE("raster: waypoints keep their distance whatever the number of knot spans", "[surface]") {
    json grid = json::array();
    for (int i = 0; i <= 400; ++i) {
        const double z = i % 2 == 0 ? 0.0 : 0.2;
        grid.push_back({{0.5 * i, 0.0, z}, {0.5 * i, 5.0, z}});
    }
    const DescribedSurface surface = describe_surface("bspline_surface", {{"grid", grid}});
    RasterOptions options;
    options.lines = 2;
    options.step_mm = 0.25;
    const ToolSurface tool(surface, options);
    const auto points = waypoints(tool, raster(tool));
    double most = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        most = std::max(most, apart(points[i].position, points[i + 1].position));
    }
    CHECK(most <= 0.25);
}
