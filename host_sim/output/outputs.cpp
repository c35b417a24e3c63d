// SPDX-License-Identifier: MIT
#include "host_sim/output/outputs.hpp"

#include "host_sim/base/file_claims.hpp"

namespace splinefeed::host {

Outputs::Outputs(const OutputNames& names, std::string_view method, bool closed) {
    if (!names.curve.empty()) {
        curve_.emplace(curve_file_.emplace(names.curve), method, closed);
    }
}

Outputs::Outputs(const OutputNames& names, std::string_view method, bool closed, const MachineDescription& machine,
                 bool has_lines)
    : Outputs(names, method, closed) {
    if (names.prints_summary) {
        FileClaims::writes("-");
    }
    if (!names.trace.empty()) {
        trace_.emplace(trace_file_.emplace(names.trace), machine, has_lines);
    }
    if (!names.elements.empty()) {
        elements_.emplace(elements_file_.emplace(names.elements), machine);
    }
    for (std::size_t i = 0; i < names.of_segments.size(); ++i) {
        if (!names.of_segments[i].empty()) {
            of_segments_.push_back(
                segment_output_kinds()[i].make(segment_files_.emplace_back(names.of_segments[i]), machine));
        }
    }
}

void Outputs::segment(const FeedSegment& segment) {
    for (const auto& output : of_segments_) {
        output->segment(segment);
    }
}

void Outputs::commit(const nlohmann::ordered_json* results) {
    if (curve_ && results != nullptr) {
        curve_->finish(*results);
    } else if (curve_) {
        curve_->finish();
    }
    for (const auto& output : of_segments_) {
        output->finish();
    }
    if (elements_) {
        elements_->finish();
    }
    for (std::optional<OutputFile>* file : {&curve_file_, &elements_file_, &trace_file_}) {
        if (*file) {
            (*file)->commit();
        }
    }
    for (OutputFile& file : segment_files_) {
        file.commit();
    }
}

} // namespace splinefeed::host
