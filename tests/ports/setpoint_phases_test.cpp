// SPDX-License-Identifier: MIT
// docs/reference/port_states.md has the table of SetpointPort's phases as the code has it.
#include "splinefeed/hal/modbus/setpoint/setpoint_phases.hpp"
#include "support/catch.hpp"
#include "support/places.hpp"

#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

using namespace splinefeed::hal;
using namespace splinefeed::hal::modbus;

namespace {

/// The two last cells of the row of each phase, in the port's section of the page.
std::map<std::string, std::string> rows_of_page() {
    std::ifstream page(splinefeed::test::source_folder() + "/docs/reference/port_states.md");
    std::map<std::string, std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("## ", 0) == 0) {
            inside = line.find("`SetpointPort`") != std::string::npos;
        }
        std::istringstream row(line);
        std::array<std::string, 5> cell; // nothing, phase, what happens, events, longest
        for (std::string& text : cell) {
            std::getline(row, text, '|');
        }
        if (inside && cell[1].rfind(" `", 0) == 0 && !cell[4].empty()) {
            rows[cell[1].substr(2, cell[1].size() - 4)] = cell[3] + "|" + cell[4];
        }
    }
    return rows;
}

std::string row_of_code(SetpointPhase phase, const PhaseBound& bound) {
    std::string events;
    for (std::size_t j = 0; j < SetpointPhases::events; ++j) {
        const SetpointPhase next = setpoint_table()[static_cast<std::size_t>(phase)][j];
        if (next != phase) {
            events +=
                std::string(events.empty() ? "`" : ", `") + name(static_cast<SetpointEvent>(j)) + "` " + name(next);
        }
    }
    std::array<char, 16> longest{"-"};
    if (bound.most_us != PhaseBound::final_us) {
        std::snprintf(longest.data(), longest.size(), "%.1f s", static_cast<double>(bound.most_us) * 1e-6);
    }
    return " " + events + " | " + longest.data() + " ";
}

} // namespace

TEST_CASE("Set-point port: the page of the phases is the table, and a phase that awaits has a bound and a sentence",
          "[ports]") {
    const auto rows = rows_of_page();
    CHECK(rows.size() == SetpointPhases::phases);
    const SetpointPhases::Bounds bounds = setpoint_bounds({100'000, 5'000'000, 0});
    for (std::size_t i = 0; i < SetpointPhases::phases; ++i) {
        const auto phase = static_cast<SetpointPhase>(i);
        INFO(name(phase));
        const auto row = rows.find(name(phase));
        REQUIRE(row != rows.end());
        CHECK(row->second == row_of_code(phase, bounds[i]));
        const bool caller = phase == SetpointPhase::filling || phase == SetpointPhase::starved;
        const bool over = i >= static_cast<std::size_t>(SetpointPhase::halted);
        CHECK((bounds[i].most_us == PhaseBound::final_us) == (caller || over));
        CHECK((bounds[i].sentence[0] != '\0') != (caller || over));
        // Whatever is awaited, a stop ends it.
        CHECK(setpoint_table()[i][static_cast<std::size_t>(SetpointEvent::stop)] == SetpointPhase::ending);
    }
}
