// SPDX-License-Identifier: MIT
#include "host_sim/output/element_writer.hpp"

#include "host_sim/program/element_file.hpp"
#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

TEST_CASE("What is written can be read as a file of elements, to the last digit") {
    const TemporaryFolder folder;
    MachineDescription machine;
    machine.settings.axes = 3;
    machine.axis_name = {"x", "y", "z"};
    PathElement<double> line;
    line.to = {position_from_mm(0.1), position_from_mm(1.0 / 3.0), position_from_mm(-2.5)};
    line.tolerance_mm = 0.02;
    line.mode = PathMode::exact_stop;
    PathElement<double> arc;
    arc.shape = MoveShape::arc;
    arc.to = line.to;
    arc.arc = {{position_from_mm(1.1), line.to[1], line.to[2]}, {0.0, 0.0, 1.0}, -6.283185307179586};
    {
        OutputFile file(folder.file("e.json"));
        ElementWriter writer(file, machine);
        writer.start({});
        writer.event({EventKind::spindle_clockwise, 0, 1200.0, {}}, 1);
        writer.move({&line, false, 12.5, 3});
        writer.dwell(0.25, 4);
        writer.move({&arc, true, 0.0, 5});
        writer.event({EventKind::message, 0, 0.0, "a \"word\""}, 6);
        writer.finish();
        file.commit();
    }
    std::ifstream in(folder.file("e.json"));
    const auto json = nlohmann::json::parse(in);
    CHECK(json["elements"].size() == 2);
    CHECK(json["elements"][0]["feed_mm_s"] == 12.5);
    CHECK(json["elements"][1]["rapid"] == true);
    CHECK(json["events"][0]["what"] == "spindle_clockwise");
    CHECK(json["events"][0]["value"] == 1200.0);
    CHECK(json["events"][1]["text"] == "a \"word\"");
    CHECK(json["events"][1]["after_element"] == 2);
    const ElementProgram read = read_elements(json, "e.json", {"x", "y", "z"}, {});
    REQUIRE(read.moves() == 2);
    CHECK(read.element(0).to == line.to);
    CHECK(read.element(0).tolerance_mm == 0.02);
    CHECK(read.element(0).mode == PathMode::exact_stop);
    CHECK(read.element(0).stop_at_end);
    CHECK(read.line_of(1) == 5);
    CHECK(read.element(1).arc.sweep_rad == arc.arc.sweep_rad);
    REQUIRE(read.dwells().size() == 1);
    CHECK(read.dwells()[0].before == 1);
}
