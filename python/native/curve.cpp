// SPDX-License-Identifier: MIT
// A curve as Bezier segments: what `splinefeed curve` draws.
#include "python/native/binding.hpp"

#include "host_sim/base/memory_file.hpp"
#include "host_sim/planning/planned_path.hpp"

namespace splinefeed::python {

namespace {

/// Control points of all segments, and how many each has.
struct Pieces {
    std::vector<double> numbers; ///< [mm], `axes` numbers each point
    std::vector<std::int64_t> degrees;
    std::size_t axes = 0;
    std::vector<std::string> warnings;
};

/// Keeps each segment.
class Keeper final : public host::CurveWatch {
public:
    explicit Keeper(Pieces& out) : out_(&out) {}

    void segment(const CurveSegment<double>& segment, std::uint32_t /*row*/,
                 const host::PathFeeder& /*feeder*/) override {
        for (int i = 0; i <= segment.degree; ++i) {
            for (int k = 0; k < static_cast<int>(out_->axes); ++k) {
                out_->numbers.push_back(segment.control_mm(k, i));
            }
        }
        out_->degrees.push_back(segment.degree);
    }

private:
    Pieces* out_;
};

Pieces pieces_of(const host::PathArguments& arguments) {
    host::PathInput input(arguments, host::PathUse::drawn, {});
    Pieces out;
    out.axes = input.axes().size();
    out.warnings = host::path_notes(input);
    if (const host::CurveFile* const curve = input.segments(); curve != nullptr && !input.choice().smooth) {
        out.numbers = curve->numbers;
        out.axes = static_cast<std::size_t>(curve->axes);
        for (const host::CurveFile::Segment& segment : curve->segments) {
            out.degrees.push_back(segment.degree);
        }
        return out;
    }
    Keeper keeper(out);
    static_cast<void>(host::look_through(input, keeper));
    return out;
}

/// (control points (n, axes), degrees of the segments, warnings)
py::tuple as_arrays(const Pieces& pieces) {
    const std::size_t points = pieces.axes > 0 ? pieces.numbers.size() / pieces.axes : 0;
    return py::make_tuple(
        py::array_t<double>({points, pieces.axes}, pieces.numbers.data()),
        py::array_t<std::int64_t>(static_cast<py::ssize_t>(pieces.degrees.size()), pieces.degrees.data()),
        pieces.warnings);
}

py::tuple curve_of_points(const Column& points, const py::dict& options) {
    host::PathArguments arguments = read_options(options, OptionsOf::curve).path;
    arguments.name = "points";
    arguments.rows.emplace();
    arguments.rows->open = [table = std::make_shared<const host::WaypointTable>(make_table(points, {}, {}, {}, {}))](
                               const std::string& name, const std::vector<std::string>& axes) {
        return host::open_table(table, name, axes);
    };
    return as_arrays(computed([&] { return pieces_of(arguments); }));
}

py::tuple curve_of_description(const std::string& curve, bool is_text, const py::dict& options) {
    host::PathArguments arguments = read_options(options, OptionsOf::curve).path;
    arguments.format = host::input_format("json");
    std::optional<host::MemoryFile> text;
    if (is_text) {
        text.emplace(curve);
        arguments.name = "curve";
    } else {
        require_path("the curve", curve);
    }
    arguments.input = is_text ? text->path() : curve;
    return as_arrays(computed([&] { return pieces_of(arguments); }));
}

} // namespace

void bind_curve(py::module_& module) {
    module.def("curve_of_points", curve_of_points);
    module.def("curve_of_description", curve_of_description);
}

} // namespace splinefeed::python
