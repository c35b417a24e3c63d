// SPDX-License-Identifier: MIT
#include "host_sim/base/input_error.hpp"
#include "host_sim/base/json_text.hpp"
#include "host_sim/base/output_file.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/output/curve_writer.hpp"
#include "host_sim/surface/surface_arguments.hpp"
#include "splinefeed/number/position.hpp"

namespace splinefeed::host {

namespace {

using nlohmann::json;

json read_json(const std::string& file) {
    constexpr std::size_t largest = std::size_t{1} << 28;
    return parse_json(read_text_file(file, largest), file,
                      "a surface is like {\"method\": \"bspline_surface\", \"input\": {\"grid\": ...}}");
}

DescribedSurface read_surface(const std::string& file, ScalarKind scalar) {
    const json description = read_json(file);
    const bool object = description.is_object();
    const auto method = object ? description.find("method") : description.end();
    const auto input = object ? description.find("input") : description.end();
    if (!object || method == description.end() || !method->is_string() || input == description.end() ||
        !input->is_object()) {
        throw DescriptionError("there must be \"method\", bspline_surface or bspline_skin, and an object \"input\"");
    }
    return describe_surface(method->get<std::string>(), *input, scalar);
}

void require_place(const Point<double>& point, std::string_view what = "the path goes to") {
    for (const double x : point) {
        if (!position_representable(x)) {
            throw DescriptionError("{} {:.6g} mm; a position must lie within +-1048576 mm", what, x);
        }
    }
}

// Before lengths and counts are made of them: the surface lies in the hull of its net.
void require_places(const std::vector<Point<double>>& net) {
    for (const Point<double>& point : net) {
        require_place(point, "a control point of the surface lies at");
    }
}

void write_waypoints(OutputFile& file, const std::vector<ToolPoint>& points) {
    file.append("x,y,z,corner\n");
    for (const ToolPoint& point : points) {
        require_place(point.position);
        file.format("{},{},{},{}\n", point.position[0], point.position[1], point.position[2], point.corner ? 1 : 0);
    }
}

void write_curve(OutputFile& file, const std::vector<BezierPiece<double>>& pieces) {
    CurveFile curve;
    curve.method = "bezier";
    curve.axes = 3;
    for (const BezierPiece<double>& piece : pieces) {
        curve.segments.push_back({curve.numbers.size() / 3, piece.degree});
        for (int i = 0; i <= piece.degree; ++i) {
            const Point<double> point = piece.point(i);
            require_place(point);
            curve.numbers.insert(curve.numbers.end(), point.begin(), point.begin() + 3);
        }
    }
    CurveWriter writer(file, curve.method, false);
    writer.segments(curve);
    writer.finish();
}

} // namespace

int run_surface(const std::string& input, const SurfaceArguments& arguments, ScalarKind scalar) {
    const std::optional<RasterOptions> options = choose_raster(arguments);
    try {
        const DescribedSurface surface = read_surface(input, scalar);
        OutputFile file(arguments.output.empty() ? "-" : arguments.output);
        if (!options) {
            file.append(surface_report(surface).dump());
            file.append("\n");
        } else {
            require_places(surface.net);
            const ToolSurface tool(surface, *options);
            const std::vector<CellInterval> path = raster(tool);
            const std::string suffix = ".json";
            const bool as_curve =
                arguments.output.size() >= suffix.size() &&
                arguments.output.compare(arguments.output.size() - suffix.size(), suffix.size(), suffix) == 0;
            if (as_curve) {
                write_curve(file, pieces(tool, path));
            } else {
                write_waypoints(file, waypoints(tool, path));
            }
        }
        file.commit();
    } catch (const DescriptionError& error) {
        throw InputError(input, 0, error.what());
    }
    return 0;
}

} // namespace splinefeed::host
