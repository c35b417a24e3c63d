// SPDX-License-Identifier: MIT
#include "host_sim/curve/curve_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/json_text.hpp"

#include "host_sim/curve/methods/method_table.hpp"

#include "splinefeed/number/position.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

namespace {

using nlohmann::json;

/// Reads one document into one CurveFile.
class Parser {
public:
    Parser(const json& root, const std::string& file, ScalarKind scalar) : root_(root), file_(file), scalar_(scalar) {}

    [[nodiscard]] CurveFile parse() {
        if (!root_.is_object()) {
            throw InputError(
                file_, 0,
                "the document must be an object, like {\"segments\": [{\"control_points\": [[0, 0], [10, 5]]}]}");
        }
        if (root_.contains("method")) {
            description();
        } else if (root_.contains("segments")) {
            segments(root_);
        } else {
            throw InputError(
                file_, 0,
                "there is neither \"elements\" (a program) nor \"segments\" (a curve) nor \"method\" with \"input\" (a "
                "description of one)");
        }
        return std::move(curve_);
    }

private:
    void description() {
        const json& method = root_["method"];
        if (!method.is_string()) {
            throw InputError(file_, 0, "\"method\" must be the name of a method, in quotes");
        }
        const auto input = root_.find("input");
        if (input == root_.end() || !input->is_object()) {
            throw InputError(file_, 0, "there must be an object \"input\" beside \"method\"");
        }
        const auto& name = method.get_ref<const std::string&>();
        if (name == "bspline_surface" || name == "bspline_skin") {
            throw InputError(file_, 0,
                             "this is a surface; splinefeed surface makes a tool path of it, which can be run");
        }
        if (name == "bezier") {
            require_known_keys(*input);
            segments(*input);
        } else {
            curve_ = compute_curve(name, *input, scalar_, file_);
        }
    }

    void require_known_keys(const json& input) const {
        try {
            require_known(input, {"segments", "closed"});
        } catch (const DescriptionError& error) {
            throw InputError(file_, 0, error.what());
        }
    }

    void read_closed(const json& object) {
        const auto closed = object.find("closed");
        if (closed != object.end()) {
            if (!closed->is_boolean()) {
                throw InputError(file_, 0, "\"closed\" must be true or false");
            }
            curve_.closed = closed->get<bool>();
        }
    }

    void segments(const json& object) {
        read_closed(object);
        const auto list = object.find("segments");
        if (list == object.end() || !list->is_array() || list->empty()) {
            throw InputError(file_, 0, "\"segments\" must be an array of at least one segment");
        }
        for (const json& segment : *list) {
            add_segment(segment, fmt::format("segment {}", curve_.segments.size() + 1));
        }
        if (curve_.closed) {
            require_joint(curve_.points() - 1, 0, "the curve is closed, but its first segment");
        }
        const auto first = curve_.numbers.begin();
        bool moves = false;
        for (std::size_t i = 1; i < curve_.points() && !moves; ++i) {
            moves = !std::equal(first, first + curve_.axes, first + static_cast<std::ptrdiff_t>(i) * curve_.axes);
        }
        if (!moves) {
            throw InputError(file_, 0, "all control points are the same; a path needs a move");
        }
    }

    void add_segment(const json& segment, const std::string& name) {
        const auto points = segment.is_object() ? segment.find("control_points") : segment.end();
        if (!segment.is_object() || points == segment.end() || !points->is_array()) {
            throw InputError(file_, 0, "{} must be an object with an array \"control_points\"", name);
        }
        const std::size_t count = points->size();
        if (count < 2 || count > static_cast<std::size_t>(max_degree) + 1) {
            throw InputError(file_, 0, "{} has {} control points; it must have 2 to {} (degree 1 to {})", name, count,
                             max_degree + 1, max_degree);
        }
        if (const auto degree = segment.find("degree"); degree != segment.end()) {
            if (!degree->is_number_integer() || degree->get<std::int64_t>() != static_cast<std::int64_t>(count) - 1) {
                throw InputError(file_, 0, "{} has \"degree\" {}; with {} control points it must be {}", name,
                                 printable(degree->dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 40)),
                                 count, count - 1);
            }
        }
        const CurveFile::Segment added{curve_.segments.empty() ? 0 : curve_.points(), static_cast<int>(count) - 1};
        for (std::size_t i = 0; i < count; ++i) {
            add_point((*points)[i], fmt::format("{}, control point {}", name, i + 1));
            require_near(added.first_point, added.first_point + i, name);
        }
        if (added.first_point > 0) {
            require_joint(added.first_point - 1, added.first_point, name);
        }
        curve_.segments.push_back(added);
    }

    [[nodiscard]] double number(const json& value, const std::string& name) const {
        try {
            return number_of(value, name);
        } catch (const DescriptionError& error) {
            throw InputError(file_, 0, error.what());
        }
    }

    void add_point(const json& point, const std::string& name) {
        const std::size_t size = point.is_array() ? point.size() : 0;
        if (size < 1 || size > static_cast<std::size_t>(max_axes)) {
            throw InputError(file_, 0, "{} must be an array of one to {} numbers", name, max_axes);
        }
        if (curve_.axes == 0) {
            curve_.axes = static_cast<int>(size);
        }
        if (size != static_cast<std::size_t>(curve_.axes)) {
            throw InputError(file_, 0, "{} has {} numbers; it must have {}, like those before it", name, size,
                             curve_.axes);
        }
        for (const json& value : point) {
            const double mm = number(value, name);
            if (!position_representable(mm)) {
                throw InputError(file_, 0, "{} has the coordinate {}; a position must lie within +-1048576 mm", name,
                                 mm);
            }
            curve_.numbers.push_back(mm);
        }
    }

    void require_near(std::size_t from, std::size_t to, const std::string& name) const {
        for (const unsigned k : indices(curve_.axes)) {
            if (std::fabs(curve_.at(to, k) - curve_.at(from, k)) > longest_mm) {
                throw InputError(file_, 0, "{} is longer than {} mm; cut it into shorter ones", name, longest_mm);
            }
        }
    }

    void require_joint(std::size_t end, std::size_t start, std::string_view name) const {
        double gap_sq = 0.0;
        for (const unsigned k : indices(curve_.axes)) {
            const double d = curve_.at(start, k) - curve_.at(end, k);
            gap_sq += d * d;
        }
        if (gap_sq > CurveFile::largest_gap_mm * CurveFile::largest_gap_mm) {
            throw InputError(file_, 0,
                             "{} starts {:.9g} mm from the end of the one before it; they must meet within {} mm", name,
                             std::sqrt(gap_sq), CurveFile::largest_gap_mm);
        }
    }

    const json& root_;
    const std::string& file_;
    ScalarKind scalar_;
    CurveFile curve_;
};

} // namespace

CurveFile compute_curve(std::string_view method, const json& input, ScalarKind scalar, const std::string& file) {
    DescribedCurve made;
    try {
        made = describe_curve(method, input, scalar);
    } catch (const DescriptionError& error) {
        throw InputError(file, 0, error.what());
    }
    CurveFile curve;
    curve.method = curve_name_of(method);
    curve.described = true;
    curve.closed = made.closed;
    curve.axes = made.axes;
    curve.intervals = std::move(made.intervals);
    curve.results = std::make_shared<const nlohmann::ordered_json>(std::move(made.results));
    curve.warnings = std::move(made.warnings);
    for (const BezierPiece<double>& piece : made.pieces) {
        curve.segments.push_back({curve.numbers.size() / static_cast<std::size_t>(made.axes), piece.degree});
        for (unsigned i = 0; i <= static_cast<unsigned>(piece.degree); ++i) {
            for (const unsigned k : indices(made.axes)) {
                curve.numbers.push_back(piece.control[k][i]);
            }
        }
    }
    return curve;
}

void require_executable(const CurveFile& curve, const std::string& file) {
    for (std::size_t s = 0; s < curve.segments.size(); ++s) {
        const CurveFile::Segment& segment = curve.segments[s];
        for (std::size_t i = segment.first_point; i <= segment.first_point + static_cast<unsigned>(segment.degree);
             ++i) {
            for (const unsigned k : indices(curve.axes)) {
                if (!position_representable(curve.at(i, k))) {
                    throw InputError(file, 0,
                                     "segment {} of the curve reaches {:.6g}; a position must lie within "
                                     "+-1048576 mm",
                                     s + 1, curve.at(i, k));
                }
                if (std::fabs(curve.at(i, k) - curve.at(segment.first_point, k)) > longest_mm) {
                    throw InputError(file, 0, "segment {} of the curve is longer than {} mm", s + 1, longest_mm);
                }
            }
        }
    }
}

CurveFile curve_of(const json& document, const std::string& file, ScalarKind scalar) {
    return Parser(document, file, scalar).parse();
}

CurveFile parse_curve(std::string_view text, const std::string& file, ScalarKind scalar) {
    return curve_of(parse_json(text, file), file, scalar);
}

} // namespace splinefeed::host
