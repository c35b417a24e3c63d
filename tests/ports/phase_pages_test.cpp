// SPDX-License-Identifier: MIT
// docs/reference/port_states.md has the phases of both ports as the code has them, and a phase that awaits something
// has a bound and a sentence.
#include "splinefeed/hal/modbus/pvt/modbus_phases.hpp"
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

/// The two last cells of the row of each phase and event, in the port's section of the page.
std::map<std::string, std::string> rows_of_page(const std::string& port) {
    std::ifstream page(splinefeed::test::source_folder() + "/docs/reference/port_states.md");
    std::map<std::string, std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("## ", 0) == 0) {
            inside = line.find("`" + port + "`") != std::string::npos;
        }
        std::istringstream row(line);
        std::array<std::string, 5> cell; // nothing, phase, what happens, events, longest; or nothing, event, when
        for (std::string& text : cell) {
            std::getline(row, text, '|');
        }
        if (inside && cell[1].rfind(" `", 0) == 0) {
            rows[cell[1].substr(2, cell[1].size() - 4)] = cell[3] + "|" + cell[4];
        }
    }
    return rows;
}

/// @param stop     the event of a stop, which in any phase leads to `stopping`
/// @param callers  phases that wait for the caller alone
template <class Phase, class Event>
void check_page(const std::string& port, const typename PhaseMachine<Phase, Event>::Table& table,
                const typename PhaseMachine<Phase, Event>::Bounds& bounds, Event stop, Phase stopping,
                std::initializer_list<Phase> callers) {
    const auto rows = rows_of_page(port);
    CHECK(rows.size() == table.size() + table[0].size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        const auto phase = static_cast<Phase>(i);
        std::string events;
        for (std::size_t j = 0; j < table[i].size(); ++j) {
            const std::string cell = std::string("`") + name(static_cast<Event>(j)) + "` " + name(table[i][j]);
            events += table[i][j] == phase ? "" : (events.empty() ? "" : ", ") + cell;
        }
        std::array<char, 16> longest{"-"};
        const bool bounded = bounds[i].most_us != PhaseBound::final_us;
        if (bounded) {
            std::snprintf(longest.data(), longest.size(), "%.1f s", static_cast<double>(bounds[i].most_us) * 1e-6);
        }
        INFO(port << ", " << name(phase));
        REQUIRE(rows.count(name(phase)) == 1);
        CHECK(rows.at(name(phase)) == " " + events + " | " + longest.data() + " ");
        const bool caller = std::find(callers.begin(), callers.end(), phase) != callers.end();
        CHECK(bounded == (!caller && phase < Phase::halted));
        CHECK((bounds[i].sentence[0] != '\0') == bounded);
        CHECK(table[i][static_cast<std::size_t>(stop)] == stopping); // whatever is awaited, a stop ends it
    }
    for (std::size_t j = 0; j < table[0].size(); ++j) {
        CHECK(rows.count(name(static_cast<Event>(j))) == 1);
    }
}

} // namespace

TEST_CASE("ports: the page of the phases is the table, and a phase that awaits has a bound and a sentence", "[ports]") {
    check_page("ModbusPort", modbus_phase_table(),
               modbus_phase_bounds({.port = {.segment_us = 1000.0,
                                             .reserve_us = 100'000.0,
                                             .silent_us = 100'000,
                                             .away_us = 5'000'000,
                                             .settling_us = 40'000},
                                    .ring_us = 512'000,
                                    .command_us = 460'000,
                                    .start_us = 200'000,
                                    .stop_us = 62'430'000}),
               ModbusEvent::stop, ModbusPhase::halting, {});
    check_page("SetpointPort", setpoint_table(), setpoint_bounds({100'000, 5'000'000, 0}), SetpointEvent::stop,
               SetpointPhase::ending, {SetpointPhase::filling, SetpointPhase::starved});
}
