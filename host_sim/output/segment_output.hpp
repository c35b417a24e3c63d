// SPDX-License-Identifier: MIT
// SegmentOutput: an output that is made of the feed segments of a run, as they are planned.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <memory>
#include <span>

namespace splinefeed::host {

/// Every method throws OutputError.
class SegmentOutput {
public:
    SegmentOutput() = default;
    SegmentOutput(const SegmentOutput&) = delete;
    SegmentOutput& operator=(const SegmentOutput&) = delete;
    virtual ~SegmentOutput() = default;

    virtual void segment(const FeedSegment& segment) = 0;
    /// What is left at the end of all motion. Once.
    virtual void finish() {}
};

/// An output that is made of feed segments: its option, what --help says of it, and its writer.
struct SegmentOutputKind {
    const char* option;
    const char* help;
    /// Writes the head. The caller commits the file, which must outlive the writer. Throws OutputError, and InputError
    /// where the output cannot be made for the machine.
    std::unique_ptr<SegmentOutput> (*make)(OutputFile& file, const MachineDescription& machine);
};

/// All of them. A new one is a row in segment_output.cpp.
[[nodiscard]] std::span<const SegmentOutputKind> segment_output_kinds() noexcept;

} // namespace splinefeed::host
