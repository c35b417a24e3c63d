// SPDX-License-Identifier: MIT
//
// Tool paths on surfaces whose shape is known: ridges are measured on the swept balls, offsets as distances.
#include "host_sim/surface/raster.hpp"

#include "host_sim/surface/spine.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

using namespace splinefeed;
using namespace splinefeed::host;
using nlohmann::json;

namespace {

/// z(x, y) over a square of 60 mm, x along u.
DescribedSurface height_field(double (*z)(double, double), int count = 17) {
    json grid = json::array();
    for (int i = 0; i < count; ++i) {
        json row = json::array();
        for (int j = 0; j < count; ++j) {
            const double x = -30.0 + 60.0 * i / (count - 1);
            const double y = -30.0 + 60.0 * j / (count - 1);
            row.push_back({x, y, z(x, y)});
        }
        grid.push_back(row);
    }
    return describe_surface("bspline_surface", {{"grid", grid}});
}

double flat(double, double) {
    return 0.0;
}
double hill(double, double y) { // a cylinder of radius 50, its axis along x
    return std::sqrt(2500.0 - y * y) - 50.0;
}
double valley(double x, double y) {
    return -hill(x, y);
}

double apart(const Point<double>& a, const Point<double>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Height of the ridge between the places from and to that balls touch, from the balls alone: where the lower envelope
/// of the circles in the plane across the lines is farthest from the true profile, at right angles to it.
double measured_ridge(std::span<const Point<double>> centres, double from, double to, double r,
                      double (*z)(double, double)) {
    double most = 0.0;
    for (int i = 0; i <= 400; ++i) {
        const double y = from + (to - from) * i / 400.0;
        double lowest = std::numeric_limits<double>::infinity();
        for (const Point<double>& c : centres) {
            const double inside = r * r - (y - c[1]) * (y - c[1]);
            lowest = inside > 0.0 ? std::min(lowest, c[2] - std::sqrt(inside)) : lowest;
        }
        const double slope = (z(0.0, y + 1e-5) - z(0.0, y - 1e-5)) / 2e-5;
        most = std::max(most, (lowest - z(0.0, y)) / std::sqrt(1.0 + slope * slope));
    }
    return most;
}

} // namespace

TEST_CASE("raster: the ridges have the height asked for, on flat, bulging and hollow ground", "[surface]") {
    struct Ground {
        double (*z)(double, double);
        double curvature; ///< positive: bulges towards the tool
    };
    for (const Ground ground : {Ground{flat, 0.0}, Ground{hill, 0.02}, Ground{valley, -0.02}}) {
        const DescribedSurface surface = height_field(ground.z);
        for (const double h : {0.005, 0.05}) {
            RasterOptions options;
            options.scallop_mm = h;
            options.ball_radius_mm = 6.0;
            const ToolSurface tool(surface, options);
            const std::vector<double> lines = line_parameters(tool);
            REQUIRE(lines.size() > 3);
            CHECK(lines.front() == tool.first_across());
            CHECK(lines.back() == tool.last_across());
            const double middle = 0.5 * (tool.first_along() + tool.last_along());
            std::vector<Point<double>> centres;
            for (const double line : lines) {
                centres.push_back(tool.centre(middle, line));
            }
            for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
                const double from = tool.jet(middle, lines[i]).position[1];
                const double to = tool.jet(middle, lines[i + 1]).position[1];
                const std::size_t first = i < 3 ? 0 : i - 3; // farther circles do not reach below these
                const auto near = std::span(centres).subspan(first, std::min(lines.size() - first, std::size_t{8}));
                const double ridge = measured_ridge(near, from, to, 6.0, ground.z);
                CAPTURE(ground.curvature, h, i, ridge);
                CHECK(ridge < 1.03 * h);
                if (i + 2 < lines.size()) { // the last line is where the surface ends
                    CHECK(ridge > 0.9 * h);
                    // w^2 / 8 (1/r + kappa), to first order
                    const double w =
                        apart(tool.jet(middle, lines[i]).position, tool.jet(middle, lines[i + 1]).position);
                    CHECK(w * w / 8.0 * (1.0 / 6.0 + ground.curvature) == Approx(h).epsilon(0.04));
                }
            }
        }
    }
}

TEST_CASE("raster: ridges are judged in every knot span, across and along the lines", "[surface]") {
    const auto lines_on = [](int rows, double dx, int columns, double dy, double radius, double h, auto z) {
        json grid = json::array();
        for (int i = 0; i < rows; ++i) {
            json row = json::array();
            for (int j = 0; j < columns; ++j) {
                row.push_back({dx * i, dy * j, z(dx * i, dy * j)});
            }
            grid.push_back(row);
        }
        const DescribedSurface surface = describe_surface("bspline_surface", {{"grid", grid}});
        RasterOptions options;
        options.scallop_mm = h;
        options.ball_radius_mm = radius;
        const ToolSurface tool(surface, options);
        std::vector<Point<double>> touched;
        std::vector<Point<double>> centres;
        const double along = tool.first_along() + 14.5 / 60.0 * (tool.last_along() - tool.first_along());
        for (const double line : line_parameters(tool)) {
            touched.push_back(tool.jet(along, line).position);
            centres.push_back(tool.centre(along, line));
        }
        return std::pair{touched, centres};
    };
    // A whole wave between the first line and the last, level at both and in the middle.
    const auto wave = [](double, double y) {
        return 0.5 * std::sin(y / 3.0 * 6.283185307179586);
    };
    CHECK(lines_on(11, 1.0, 21, 0.15, 6.0, 0.3, wave).first.size() > 3);
    // Ripples on a stretch of half a millimetre of a line of 60, between evenly spread looks.
    const auto ripples = [](double x, double y) {
        return 0.012 * std::exp(-(x - 14.5) * (x - 14.5) / 0.09) * std::cos(y / 1.26 * 6.283185307179586);
    };
    const auto [touched, centres] = lines_on(121, 0.5, 21, 0.126, 3.0, 0.005, ripples);
    for (std::size_t i = 0; i + 1 < touched.size(); ++i) {
        const double ridge = measured_ridge(centres, touched[i][1], touched[i + 1][1], 3.0, [](double, double y) {
            return 0.012 * std::cos(y / 1.26 * 6.283185307179586);
        });
        CAPTURE(i, ridge);
        CHECK(ridge < 1.03 * 0.005);
    }
}

TEST_CASE("raster: the ball touches the surface, its tip is a radius lower", "[surface]") {
    const DescribedSurface surface = height_field(hill);
    RasterOptions options;
    options.lines = 7;
    options.ball_radius_mm = 4.0;
    options.along = SurfaceDirection::v;
    RasterOptions tip = options;
    tip.tip = true;
    const ToolSurface tool(surface, options);
    const ToolSurface lower(surface, tip);
    for (const splinefeed::host::CellInterval& stretch : raster(tool)) {
        for (const double t : stretch_parameters(tool, stretch)) {
            const bool along = stretch.kind == splinefeed::host::CellInterval::Kind::along;
            const double a = along ? t : stretch.constant;
            const double b = along ? stretch.constant : t;
            const Point<double> centre = tool.tool(a, b);
            // the distance from the cylinder's axis, which lies 50 mm below its top
            CHECK(std::hypot(centre[1], centre[2] + 50.0) == Approx(54.0).margin(2e-3));
            CHECK(apart(centre, tool.jet(a, b).position) == Approx(4.0).epsilon(1e-12));
            CHECK(lower.tool(a, b)[2] == Approx(centre[2] - 4.0).epsilon(1e-12));
        }
    }
    // A ball of 50 mm fills the valley, a larger one does not fit.
    const DescribedSurface hollow = height_field(valley);
    options.ball_radius_mm = 45.0;
    CHECK_FALSE(raster(ToolSurface(hollow, options)).empty());
    options.ball_radius_mm = 60.0;
    CHECK_THROWS_AS(raster(ToolSurface(hollow, options)), DescriptionError);
    CHECK_FALSE(raster(ToolSurface(surface, options)).empty());
}

TEST_CASE("raster: waypoints, pieces and patterns", "[surface]") {
    const DescribedSurface surface = height_field(hill, 9);
    RasterOptions options;
    options.lines = 5;
    options.step_mm = 2.0;
    const ToolSurface tool(surface, options);
    const auto path = raster(tool);
    CHECK(path.size() == 9);
    const auto points = waypoints(tool, path);
    CHECK(std::count_if(points.begin(), points.end(), [](const ToolPoint& p) { return p.corner; }) == 10);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        CHECK(apart(points[i].position, points[i + 1].position) <= 2.0);
    }
    // Without a ball the pieces are the surface's own lines: equal to it everywhere, and they join.
    const auto exact = pieces(tool, path);
    std::size_t n = 0;
    for (const splinefeed::host::CellInterval& stretch : path) {
        if (stretch.kind != splinefeed::host::CellInterval::Kind::along) {
            while (std::fabs(exact[n].control[1][0] - exact[n].control[1][3]) > 1e-9) { // along y until the next line
                ++n;
            }
            continue;
        }
        for (int s = 0; s < 6; ++s, ++n) {
            REQUIRE(n < exact.size());
            CHECK(exact[n].degree == 3);
            const Point<double> end = exact[n].point(3);
            CHECK(end[1] == Approx(exact[n].point(0)[1]).margin(1e-12));
            if (s == 5) {
                CHECK(apart(end, tool.tool(stretch.to, stretch.constant)) < 1e-12);
            }
        }
    }
    for (std::size_t i = 0; i + 1 < exact.size(); ++i) {
        CHECK(exact[i].point(3) == exact[i + 1].point(0));
    }
    options.zigzag = false;
    options.lift_mm = 7.0;
    const auto lifted = raster(tool);
    CHECK(lifted.size() == 5 + 3 * 4);
    double highest = -std::numeric_limits<double>::infinity();
    for (const auto& piece : pieces(tool, lifted)) {
        highest = std::max(highest, piece.control[2][0]);
    }
    CHECK(highest >= 7.0); // the top is at 0, the highest control point a little above
    CHECK(highest < 7.5);
    // Offset pieces pass the waypoints and stay near the true offset between them.
    options.ball_radius_mm = 3.0;
    const ToolSurface ball(surface, options);
    for (const auto& piece : pieces(ball, raster(ball))) {
        if (piece.degree == 3) {
            const auto at = [&piece](std::size_t k) {
                const auto& c = piece.control[k];
                return (c[0] + 3.0 * c[1] + 3.0 * c[2] + c[3]) / 8.0;
            };
            CHECK(std::hypot(at(1), at(2) + 50.0) == Approx(53.0).margin(5e-3));
        }
    }
}

TEST_CASE("skin: frames turn least", "[surface]") {
    // Along a circle in a plane the frame keeps its angle to the plane, exactly.
    std::vector<Frame> frames;
    for (int i = 0; i <= 200; ++i) {
        const double a = 0.02 * i;
        Frame frame;
        frame.origin = {10.0 * std::cos(a), 10.0 * std::sin(a), 0.0};
        frame.tangent = {-std::sin(a), std::cos(a), 0.0};
        frames.push_back(frame);
    }
    frames[0].normal = {0.8, 0.0, 0.6};
    turn_least(frames);
    const double a = 4.0;
    CHECK(frames.back().normal[0] == Approx(0.8 * std::cos(a)).margin(1e-9));
    CHECK(frames.back().normal[1] == Approx(0.8 * std::sin(a)).margin(1e-9));
    CHECK(frames.back().normal[2] == Approx(0.6).margin(1e-9));
    // A helix: the frame lags behind Frenet's by the torsion, tau s = c s / (r^2 + c^2).
    const double r = 3.0;
    const double c = 2.0;
    const double speed = std::sqrt(r * r + c * c);
    frames.clear();
    for (int i = 0; i <= 2000; ++i) {
        const double t = 0.003 * i;
        Frame frame;
        frame.origin = {r * std::cos(t), r * std::sin(t), c * t};
        frame.tangent = {-r * std::sin(t) / speed, r * std::cos(t) / speed, c / speed};
        frames.push_back(frame);
    }
    frames[0].normal = {-1.0, 0.0, 0.0};
    turn_least(frames);
    const double t = 6.0;
    const double angle = c * t * speed / (speed * speed); // torsion times length
    const PerAxis<double> frenet{-std::cos(t), -std::sin(t), 0.0};
    const auto& last = frames.back();
    const double cosine = last.normal[0] * frenet[0] + last.normal[1] * frenet[1] + last.normal[2] * frenet[2];
    CHECK(cosine == Approx(std::cos(angle)).margin(1e-6));

    // Knots nearer than the tolerance are one; the sections still pass their points.
    const DescribedSurface near = describe_surface(
        "bspline_skin", json::parse(R"({"degree_u": 2, "degree_v": 1, "sections": [[[0,0,0],[1,0,0],[2,0,0],[3,0,0]],
                                       [[0,0,1],[1,0,1],[2,0,1],[3.000001,0,1]]]})"));
    CHECK(near.knots_u.size() == 7);
    CHECK(evaluate(near.view(), 1.0, 1.0).position[0] == 3.000001);
    // A straight spine with the sections as drawn is the skin of the sections themselves.
    const DescribedSurface on_spine =
        describe_surface("bspline_skin", json::parse(R"({"sections": [[[0,0],[1,1],[2,0]], [[0,0],[1,2],[2,0]]],
                        "spine": {"points": [[0,0,0],[0,0,5],[0,0,10]], "normal": [1,0,0]}})"));
    CHECK(evaluate(on_spine.view(), 1.0, 1.0).position[2] == Approx(10.0));
    CHECK(evaluate(on_spine.view(), 0.5, 1.0).position[1] == Approx(2.0));
}
