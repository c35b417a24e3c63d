// SPDX-License-Identifier: MIT
#include "host_sim/output/curve_writer.hpp"

#include "host_sim/curve/methods/joint_report.hpp"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace splinefeed::host {

CurveWriter::CurveWriter(OutputFile& file, std::string_view method, bool closed) : file_(&file) {
    file.format("{{\"curve\": {}, \"closed\": {}, \"segments\": [", nlohmann::json(method).dump(), closed);
}

void CurveWriter::open_segment(int degree) {
    file_->format("{}\n{{\"degree\": {}, \"control_points\": [", first_ ? "" : ",", degree);
    first_ = false;
}

void CurveWriter::number(double value, int axis, int point) {
    const char* before = axis > 0 ? ", " : point > 0 ? ", [" : "[";
    file_->format("{}{:.17g}", before, value);
}

void CurveWriter::segment(const CurveSegment<double>& segment) {
    open_segment(segment.degree);
    for (int i = 0; i <= segment.degree; ++i) {
        for (int axis = 0; axis < segment.axes; ++axis) {
            number(segment.control_mm(axis, i), axis, i);
        }
        file_->append("]");
    }
    file_->append("]}");
}

void CurveWriter::segments(const CurveFile& curve) {
    for (std::size_t s = 0; s < curve.segments.size(); ++s) {
        const CurveFile::Segment& segment = curve.segments[s];
        BezierPiece<double> piece;
        piece.degree = segment.degree;
        open_segment(segment.degree);
        for (int i = 0; i <= segment.degree; ++i) {
            for (int axis = 0; axis < curve.axes; ++axis) {
                const double value =
                    curve.at(segment.first_point + static_cast<std::size_t>(i), static_cast<std::size_t>(axis));
                piece.control[static_cast<unsigned>(axis)][static_cast<unsigned>(i)] = value;
                number(value, axis, i);
            }
            file_->append("]");
        }
        file_->append("]");
        if (!curve.intervals.empty()) {
            file_->format(", \"interval\": [{:.17g}, {:.17g}]", curve.intervals[s].from, curve.intervals[s].to);
        }
        if (curve.described) {
            file_->format(", \"samples\": {}", sample_report(piece, curve.axes).dump());
        }
        file_->append("}");
    }
}

void CurveWriter::finish() {
    file_->append("\n]}\n");
}

void CurveWriter::finish(const nlohmann::ordered_json& results) {
    if (!results.is_object()) {
        throw std::invalid_argument("the results of a curve must be a JSON object");
    }
    for (const char* key : {"curve", "closed", "segments"}) {
        if (results.contains(key)) {
            throw std::invalid_argument(fmt::format("the results of a curve must not have the key \"{}\"", key));
        }
    }
    file_->append("\n]");
    for (const auto& [key, value] : results.items()) {
        file_->format(",\n{}: {}", nlohmann::json(key).dump(), value.dump());
    }
    file_->append("}\n");
}

} // namespace splinefeed::host
