// SPDX-License-Identifier: MIT
#include "host_sim/output/outputs.hpp"

#include "host_sim/base/file_claims.hpp"

namespace splinefeed::host {

Outputs::Outputs(const Job& job, std::string_view method, bool closed) {
    if (!job.curve_out.empty()) {
        curve_.emplace(curve_file_.emplace(job.curve_out), method, closed);
    }
}

Outputs::Outputs(const Job& job, std::string_view method, bool closed, const MachineDescription& machine)
    : Outputs(job, method, closed) {
    if (job.summary != SummaryKind::none) {
        FileClaims::writes("-");
    }
    if (!job.trace.empty()) {
        trace_.emplace(trace_file_.emplace(job.trace), machine);
    }
    if (!job.segments.empty()) {
        segments_.emplace(segments_file_.emplace(job.segments), machine);
    }
    if (!job.edges.empty()) {
        edges_.emplace(edges_file_.emplace(job.edges), machine);
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
