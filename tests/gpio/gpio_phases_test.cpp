// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/gpio_phases.hpp"

#include "support/catch.hpp"
#include "support/places.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <string>

using namespace splinefeed::hal::gpio;

TEST_CASE("docs/reference/port_states.md has the phases of a GPIO port as the code has them") {
    constexpr std::array names{"fresh", "searching", "resting", "ready", "moving", "whole", "left"};
    static_assert(names.size() == GpioPhases::phases);
    std::ifstream file(splinefeed::test::source_folder() + "/docs/reference/port_states.md");
    std::stringstream page;
    page << file.rdbuf();
    const std::string text = page.str().substr(page.str().find("(`GpioPort`)"));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto next = [&](GpioEvent event) {
            GpioPhases phases(gpio_phase_table, static_cast<GpioPhase>(i));
            return std::string(phases.take(event, 0) ? names[static_cast<std::size_t>(phases.phase())] : "");
        };
        CAPTURE(names[i]);
        const std::size_t row = text.find("\n| " + std::string(names[i]) + " |");
        REQUIRE(row != std::string::npos);
        const std::string line = text.substr(row + 1, text.find('\n', row + 1) - row - 1);
        CHECK(line.ends_with("| " + next(GpioEvent::give_up) + " | " + next(GpioEvent::segment) + " | " +
                             next(GpioEvent::complete) + " |"));
        CHECK(next(GpioEvent::search) == (i == 1 ? "" : "searching"));
        CHECK(next(GpioEvent::prepared) == (i == 3 ? "" : "ready"));
        CHECK(next(GpioEvent::leave) == (i == 6 ? "" : "left"));
    }
}
