// SPDX-License-Identifier: MIT
// RunReport: the page of a run, FILE.html: its motion, its figures and its program, for a browser without a network.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/output/summary.hpp"
#include "host_sim/report/motion_record.hpp"

#include <string>

namespace splinefeed::host {

/// What a page tells besides the motion.
struct ReportFacts {
    std::string program;   ///< name of the input, for people
    std::string text_file; ///< file of its text; empty: it cannot be read twice
    std::string unit;      ///< what rows are: "line" or "segment"
    std::string stopped;   ///< why the run ended before the program; empty: it did not
    const Summary* summary = nullptr;
};

/// The page: page_template with one JSON object. Numbers that are many are columns (packed_column). Texts are data: no
/// text can end the element that holds them. Every method throws OutputError.
class RunReport {
public:
    /// `machine` must outlive it. @param segment_ticks  duration of a feed segment
    RunReport(const std::string& file, const MachineDescription& machine, std::uint32_t segment_ticks)
        : file_(file), record_(machine, segment_ticks) {}

    [[nodiscard]] MotionRecord& record() noexcept { return record_; }
    /// Writes the page and puts it in its place. Once.
    void write(const ReportFacts& facts);

private:
    OutputFile file_;
    MotionRecord record_;
};

} // namespace splinefeed::host
