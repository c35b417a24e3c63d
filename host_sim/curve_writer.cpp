// SPDX-License-Identifier: MIT
#include "curve_writer.hpp"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace splinefeed::host {

CurveWriter::CurveWriter(OutputFile& file, std::string_view method, bool closed) : file_(&file) {
    file.format("{{\"curve\": {}, \"closed\": {}, \"segments\": [", nlohmann::json(method).dump(), closed);
}

template <Scalar S>
void CurveWriter::segment(const CurveSegment<S>& segment) {
    file_->format("{}\n{{\"degree\": {}, \"control_points\": [", first_ ? "" : ",", segment.degree);
    first_ = false;
    for (int i = 0; i <= segment.degree; ++i) {
        for (int axis = 0; axis < segment.axes; ++axis) {
            const char* before = axis > 0 ? ", " : i > 0 ? ", [" : "[";
            file_->format("{}{:.17g}", before, segment.control_mm(axis, i));
        }
        file_->append("]");
    }
    file_->append("]}");
}

void CurveWriter::finish() {
    file_->append("\n]}\n");
}

void CurveWriter::finish(const nlohmann::json& results) {
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

template void CurveWriter::segment(const CurveSegment<double>& segment);
template void CurveWriter::segment(const CurveSegment<float>& segment);
template void CurveWriter::segment(const CurveSegment<Fixed>& segment);

} // namespace splinefeed::host
