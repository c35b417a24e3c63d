// SPDX-License-Identifier: MIT
#include "host_sim/output/outputs.hpp"

#include "host_sim/base/file_claims.hpp"

namespace splinefeed::host {

Outputs::Outputs(const OutputNames& names, std::string_view method, bool closed) {
    if (!names.curve.empty()) {
        curve_.emplace(curve_file_.emplace(names.curve), method, closed);
    }
}

Outputs::Outputs(const OutputNames& names, std::string_view method, bool closed, const MachineDescription& machine)
    : Outputs(names, method, closed) {
    if (names.prints_summary) {
        FileClaims::writes("-");
    }
    if (!names.trace.empty()) {
        trace_.emplace(trace_file_.emplace(names.trace), machine);
    }
    if (!names.segments.empty()) {
        segments_.emplace(segments_file_.emplace(names.segments), machine);
    }
    if (!names.edges.empty()) {
        edges_.emplace(edges_file_.emplace(names.edges), machine);
    }
}

void Outputs::commit(const nlohmann::ordered_json* results) {
    if (curve_ && results != nullptr) {
        curve_->finish(*results);
    } else if (curve_) {
        curve_->finish();
    }
    if (edges_) {
        edges_->finish();
    }
    for (std::optional<OutputFile>* file : {&curve_file_, &trace_file_, &segments_file_, &edges_file_}) {
        if (*file) {
            (*file)->commit();
        }
    }
}

} // namespace splinefeed::host
