// SPDX-License-Identifier: MIT
// ProgramObserver: shows the steps of a program to those who write or count them.
#pragma once

#include "host_sim/analysis/program_report.hpp"
#include "host_sim/output/element_writer.hpp"
#include "host_sim/planning/path_feeder.hpp"
#include "host_sim/report/motion_record.hpp"

namespace splinefeed::host {

class ProgramObserver {
public:
    /// Null: not used. All must outlive it.
    ProgramObserver(ElementWriter* writer, ProgramReport* report, MotionRecord* record)
        : writer_(writer), report_(report), record_(record) {}

    /// What the feeder has read. Throws OutputError.
    void see(const PathFeeder::Pushed& pushed);

private:
    static void write(const PathFeeder::Pushed& pushed, ElementWriter& writer);
    static void tell(const PathFeeder::Pushed& pushed, ProgramReport& report);

    ElementWriter* writer_;
    ProgramReport* report_;
    MotionRecord* record_;
};

} // namespace splinefeed::host
