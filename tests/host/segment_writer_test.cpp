// SPDX-License-Identifier: MIT
#include "host_sim/output/segment_output.hpp"

#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

TEST_CASE("segments are written as integers under their units") {
    const TemporaryFolder folder;
    MachineDescription machine;
    machine.settings.axes = 2;
    machine.axis_name = {"x", "b"};
    machine.settings.axis[0].steps_per_mm = 320.0;
    machine.settings.axis[1].steps_per_mm = 0.1;
    FeedSegment segment;
    segment.index = std::numeric_limits<std::uint64_t>::max();
    segment.duration_ticks = std::numeric_limits<std::uint32_t>::max();
    segment.start = {std::numeric_limits<std::int64_t>::min(), 1};
    segment.end = {std::numeric_limits<std::int64_t>::max(), -2};
    segment.start_velocity = {0, 3};
    segment.end_velocity = {-4, 5};
    OutputFile file(folder.file("s.csv"));
    const auto writer = segment_output_kinds()[0].make(file, machine);
    writer->segment(segment);
    writer->segment(FeedSegment{});
    file.commit();

    const std::vector<std::string> lines = lines_of(folder.file("s.csv"));
    std::size_t head = 0;
    while (head < lines.size() && lines[head].rfind("# ", 0) == 0) {
        ++head;
    }
    REQUIRE(lines.size() == head + 3);
    CHECK(head == 6);
    CHECK(lines[1] == "# duration_ticks: 1 tick = 1/8 us = 1.25e-07 s.");
    CHECK(lines[2].find("# x_start, x_end: position in units of 1/3221225472 count; 320 counts per mm; 1 unit = ") ==
          0);
    CHECK(lines[4].find("# b_start, b_end: ") == 0);
    CHECK(lines[head] == "index,duration_ticks,x_start,x_end,x_v_start,x_v_end,b_start,b_end,b_v_start,b_v_end");
    CHECK(lines[head + 1] == "18446744073709551615,4294967295,-9223372036854775808,9223372036854775807,0,-4,1,-2,3,5");
    CHECK(lines[head + 2] == "0,0,0,0,0,0,0,0,0,0");

    // The numbers in the comments convert: one count of x is 1/320 mm, and a count in 1 ms is 3.125 mm/s.
    const double mm_per_unit = std::stod(lines[2].substr(lines[2].rfind("= ") + 2));
    CHECK(mm_per_unit * static_cast<double>(units_per_count) == Approx(1.0 / 320.0).epsilon(1e-15));
    const double factor = std::stod(lines[3].substr(lines[3].rfind("* ") + 2));
    CHECK(static_cast<double>(units_per_count) * factor / 8000.0 == Approx(3.125).epsilon(1e-15));
}
