// SPDX-License-Identifier: MIT
// Outputs: the files of one run, opened together and committed together.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/output/curve_writer.hpp"
#include "host_sim/output/element_writer.hpp"
#include "host_sim/output/segment_output.hpp"
#include "host_sim/output/trace_writer.hpp"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

/// Where the outputs of a run go. Empty: there is no such output; "-": standard output.
struct OutputNames {
    std::string trace;
    std::string curve;
    std::string elements;
    std::string report; ///< of RunReport, which is none of Outputs
    std::vector<std::string> of_segments = std::vector<std::string>(segment_output_kinds().size()); ///< of each kind
    bool prints_summary = true; ///< on standard output
};

/// A writer exists if its output has a name. Without commit() nothing is left.
class Outputs {
public:
    /// Opens only the curve. Throws OutputError, as every method does.
    Outputs(const OutputNames& names, std::string_view method, bool closed);
    /// Opens every output that has a name.
    /// @param has_lines  the input is a program with lines: the trace names them
    Outputs(const OutputNames& names, std::string_view method, bool closed, const MachineDescription& machine,
            bool has_lines = false);

    [[nodiscard]] TraceWriter* trace() noexcept { return trace_ ? &*trace_ : nullptr; }
    [[nodiscard]] ElementWriter* elements() noexcept { return elements_ ? &*elements_ : nullptr; }
    [[nodiscard]] CurveWriter* curve() noexcept { return curve_ ? &*curve_ : nullptr; }

    /// The next feed segment of the run, to all outputs that are made of them.
    void segment(const FeedSegment& segment);

    /// Completes the files and puts them in place. @pre the writers have got everything
    /// @param results  of the curve's method, beside its segments; null: none
    void commit(const nlohmann::ordered_json* results = nullptr);

private:
    std::optional<OutputFile> trace_file_;
    std::deque<OutputFile> segment_files_; // where they are: the writers refer to them
    std::optional<OutputFile> curve_file_;
    std::optional<OutputFile> elements_file_;
    std::optional<TraceWriter> trace_;
    std::vector<std::unique_ptr<SegmentOutput>> of_segments_; // of each file
    std::optional<CurveWriter> curve_;
    std::optional<ElementWriter> elements_;
};

} // namespace splinefeed::host
