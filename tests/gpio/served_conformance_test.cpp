// SPDX-License-Identifier: MIT
//
// The list of the controller, on a machine whose axes are lines, and what the lines have counted at the end of each
// case.
#include "live/operated.hpp"
#include "pins_world.hpp"
#include "support/catch.hpp"
#include "support/conformance_list.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

class ListedPins final : public test::ListedMachine {
public:
    void finish() override {
        for (int ms = 0; ms < 5000 && !machine_.live.stands(); ++ms) {
            machine_.tick();
        }
        for (const host::RunTarget::AxisPlace& at : machine_.live.places()) {
            const std::int64_t told = std::llround(at.mm.value_or(0.0) * 320.0);
            INFO("axis " << at.axis << ", told " << at.mm.value_or(0.0) * 320.0 << ", counted "
                         << world_.counts()[at.axis]);
            CHECK((!at.mm || told == world_.counts()[at.axis]));
        }
    }

    void send(std::string_view bytes) override { machine_.send(bytes); }
    void tick() override { machine_.tick(); }
    [[nodiscard]] Controller& controller() override { return machine_.controller; }
    [[nodiscard]] std::string& text() override { return machine_.text; }
    void obey(const std::string& /*command*/, const std::string& rest) override { // machine
        const double value = std::stod(rest.substr(rest.find(' ')));
        if (rest.rfind("plate", 0) == 0) {
            world_.set("plate", rest.substr(rest.find(' ')));
            for (int ms = 0; ms < 5; ++ms) {
                machine_.tick();
            }
        } else if (rest.rfind("homes", 0) == 0) {
            machine_.settings.homes = static_cast<std::uint32_t>(value);
        } else {
            machine_.settings.probes = value != 0.0;
        }
    }

    // What it takes of the list.
    static bool takes(const std::string& command, const std::string& rest) {
        const std::string what = rest.substr(0, rest.find(' '));
        const bool machine = command == "machine" && (what == "plate" || what == "probes" || what == "homes");
        const bool lacks = command == "needs" && (rest.find("numbers") != std::string::npos || what == "outputs");
        return machine || !(lacks || command == "machine" || command == "told" || command == "way");
    }

private:
    PinsWorld world_;
    Operated machine_{world_};
};

} // namespace

TEST_CASE("a machine on lines answers as the controller's list says, and no step is lost", "[serve]") {
    const int cases = test::run_conformance_list([] { return std::make_unique<ListedPins>(); }, &ListedPins::takes);
    CHECK(cases > 70);
}
