// SPDX-License-Identifier: MIT
// ProgramObserver: shows the steps of a program to those who write or count them.
#pragma once

#include "host_sim/analysis/program_report.hpp"
#include "host_sim/output/element_writer.hpp"
#include "host_sim/planning/element_feeder.hpp"

namespace splinefeed::host {

template <Scalar S>
class ProgramObserver {
public:
    /// Null: not used. Both must outlive it.
    ProgramObserver(ElementWriter* writer, ProgramReport* report) : writer_(writer), report_(report) {}

    /// What the feeder has read. Throws OutputError.
    void see(const typename ElementFeeder<S>::Pushed& pushed);

private:
    static void write(const typename ElementFeeder<S>::Pushed& pushed, ElementWriter& writer);
    static void tell(const typename ElementFeeder<S>::Pushed& pushed, ProgramReport& report);

    ElementWriter* writer_;
    ProgramReport* report_;
};

} // namespace splinefeed::host
