// SPDX-License-Identifier: MIT
// Outputs: the files of one run, opened together and put in their places together.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/output/curve_writer.hpp"
#include "host_sim/output/edge_writer.hpp"
#include "host_sim/output/segment_writer.hpp"
#include "host_sim/output/trace_writer.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// Where the outputs of a run go. Empty: there is no such output; "-": standard output.
struct OutputNames {
    std::string trace;
    std::string segments;
    std::string edges;
    std::string curve;
    bool prints_summary = true; ///< on standard output
};

/// Each one is there where it has a name. Without commit() nothing is left behind.
class Outputs {
public:
    /// Opens the curve alone. Throws OutputError, as every method does.
    Outputs(const OutputNames& names, std::string_view method, bool closed);
    /// Opens what has a name.
    Outputs(const OutputNames& names, std::string_view method, bool closed, const MachineDescription& machine);

    [[nodiscard]] TraceWriter* trace() noexcept { return trace_ ? &*trace_ : nullptr; }
    [[nodiscard]] SegmentWriter* segments() noexcept { return segments_ ? &*segments_ : nullptr; }
    [[nodiscard]] EdgeWriter* edges() noexcept { return edges_ ? &*edges_ : nullptr; }
    [[nodiscard]] CurveWriter* curve() noexcept { return curve_ ? &*curve_ : nullptr; }

    /// Completes the files and puts them in place. @pre the writers have got everything
    /// @param results  of the curve's method, beside its segments; null: none
    void commit(const nlohmann::ordered_json* results = nullptr);

private:
    std::optional<OutputFile> trace_file_;
    std::optional<OutputFile> segments_file_;
    std::optional<OutputFile> edges_file_;
    std::optional<OutputFile> curve_file_;
    std::optional<TraceWriter> trace_;
    std::optional<SegmentWriter> segments_;
    std::optional<EdgeWriter> edges_;
    std::optional<CurveWriter> curve_;
};

} // namespace splinefeed::host
