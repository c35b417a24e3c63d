// SPDX-License-Identifier: MIT
#include "host_sim/output/segment_output.hpp"

#include "support/catch.hpp"
#include "temporary_folder.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

MachineDescription machine_of(double steps_per_mm) {
    MachineDescription machine;
    machine.file = "m.toml";
    machine.settings.axes = 2;
    machine.axis_name = {"x", "b"};
    for (unsigned k = 0; k < 2; ++k) {
        machine.settings.axis[k].max_velocity_mm_s = 100.0;
        machine.settings.axis[k].steps_per_mm = steps_per_mm;
    }
    return machine;
}

/// x goes two counts up and one back, at constant velocity, 1 ms each; b one down in the first.
std::vector<FeedSegment> there_and_back() {
    std::vector<FeedSegment> segments(2);
    for (FeedSegment& s : segments) {
        s.duration_ticks = 8000;
    }
    segments[0].end[0] = segments[0].start_velocity[0] = segments[0].end_velocity[0] = 2 * units_per_count;
    segments[0].end[1] = segments[0].start_velocity[1] = segments[0].end_velocity[1] = -units_per_count;
    segments[1].start[0] = 2 * units_per_count;
    segments[1].start[1] = segments[1].end[1] = -units_per_count;
    segments[1].end[0] = units_per_count;
    segments[1].start_velocity[0] = segments[1].end_velocity[0] = -units_per_count;
    return segments;
}

std::vector<std::string> written(const MachineDescription& machine) {
    const TemporaryFolder folder;
    OutputFile file(folder.file("e.csv"));
    const auto writer = segment_output_kinds()[1].make(file, machine);
    for (const FeedSegment& segment : there_and_back()) {
        writer->segment(segment);
    }
    writer->finish();
    file.commit();
    return lines_of(folder.file("e.csv"));
}

} // namespace

TEST_CASE("Edges are written in order of time, a row a line") {
    const std::vector<std::string> expected{"t_ns,axis,line,value", "245000,x,dir,1",  "250000,x,step,1",
                                            "252000,x,step,0",      "500000,b,step,1", "502000,b,step,0",
                                            "750000,x,step,1",      "752000,x,step,0", "1495000,x,dir,0",
                                            "1500000,x,step,1",     "1502000,x,step,0"};
    CHECK(written(machine_of(320.0)) == expected);
}

TEST_CASE("Motors and polarities are those of the machine file, and edges may be steps") {
    MachineDescription machine = machine_of(320.0);
    machine.motors[0] = {2, true, {false, true}};
    machine.step.step_on_edge = true;
    machine.step.direction_setup_us = 1.0;
    const std::vector<std::string> expected{"t_ns,axis,line,value", "249000,x,dir,1",   "249000,x2,dir,0",
                                            "250000,x,step,0",      "250000,x2,step,0", "500000,b,step,1",
                                            "750000,x,step,1",      "750000,x2,step,1", "1499000,x,dir,0",
                                            "1499000,x2,dir,1",     "1500000,x,step,0", "1500000,x2,step,0"};
    CHECK(written(machine) == expected);
}

TEST_CASE("At a fixed rate every edge is at a tick") {
    MachineDescription machine = machine_of(100.0);
    machine.step.tick_us = 20.0;
    // 250 and 750 us lie in the middle between two ticks; the sample there finds the count reached: the earlier one.
    const std::vector<std::string> expected{"t_ns,axis,line,value", "220000,x,dir,1",  "240000,x,step,1",
                                            "260000,x,step,0",      "500000,b,step,1", "520000,b,step,0",
                                            "740000,x,step,1",      "760000,x,step,0", "1480000,x,dir,0",
                                            "1500000,x,step,1",     "1520000,x,step,0"};
    CHECK(written(machine) == expected);
}
