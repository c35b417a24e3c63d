// SPDX-License-Identifier: MIT
//
// Random stories of a served machine on lines: whatever people and switches do, behind homing it is where it says.
#include "operated_lines.hpp"
#include "support/catch.hpp"
#include "support/random_path.hpp"
#include "support/rounds.hpp"

#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

class ServedStory {
public:
    explicit ServedStory(std::uint64_t seed) : random_(seed) {}

    void tell() {
        recover();
        for (int n = 0; n < 12; ++n) {
            act();
            machine_.wait(static_cast<int>(random_.below(400)));
        }
        machine_.press(ServedLines::e_stop, false);
        machine_.press(ServedLines::drive_fault, false);
        machine_.place_switch(0, -2.0);
        recover();
        machine_.send("G90 G0 X5 Y7 Z-3\n");
        REQUIRE(rests());
        check(true);
        CHECK(machine_.served->places()[0].mm.value() == 5.0);
    }

private:
    [[nodiscard]] bool rests() {
        machine_.wait(120);
        return machine_.comes([this] { return machine_.rests(); });
    }
    /// Unlocked and homed.
    void recover() {
        machine_.send("\x18");
        REQUIRE(rests());
        machine_.send("\x18");
        machine_.wait(50);
        machine_.send("$X\n");
        machine_.text.clear();
        machine_.send("$H\n");
        REQUIRE(rests());
        INFO(machine_.text);
        REQUIRE(machine_.served->read().known);
        check(true);
    }
    // A switch's edge is a step.
    void check(bool known) {
        for (const host::RunTarget::AxisPlace& at : machine_.served->places()) {
            CAPTURE(at.axis, machine_.mm(at.axis), known);
            CHECK((at.mm.has_value() || !known));
            CHECK((!at.mm || std::fabs(*at.mm - machine_.mm(at.axis)) < 2.6 / 320.0));
        }
    }
    void act() {
        switch (random_.below(14)) {
        case 0:
        case 1:
        case 2:
            machine_.send(fmt::format("G90 G1 X{:.4f} Y{:.4f} Z{:.4f} F6000\n", random_.between(0.0, 50.0),
                                      random_.between(0.0, 50.0), random_.between(-30.0, 0.0)));
            break;
        case 3: machine_.send(fmt::format("$J=G91 X{:.4f} F3000\n", random_.between(-10.0, 10.0))); break;
        case 4: machine_.send("!"); break;
        case 5: machine_.send("~"); break;
        case 6: machine_.send("\x18"); break;
        case 7: machine_.send("\x18\x18"); break;
        case 8: machine_.send("\x85"); break;
        case 9: machine_.send("\x84"); break;
        case 10:
            machine_.clock.sleep_us(1000 * static_cast<std::uint64_t>(random_.below(300)));
            break; // the server does nothing
        case 11: machine_.place_switch(0, machine_.switch_mm[0] < 0.0 ? 1000.0 : -2.0); break;
        case 12: machine_.press(ServedLines::drive_fault, random_.below(2) == 0); break;
        case 13: machine_.send("$X\n"); break;
        }
    }

    RandomPath random_;
    OperatedLines machine_{served_map, 0};
};

} // namespace

TEST_CASE("random stories of a served machine on lines lose no step", "[serve]") {
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(30, 500)); ++round) {
        CAPTURE(round);
        ServedStory(9000 + round).tell();
    }
}
