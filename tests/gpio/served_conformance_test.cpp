// SPDX-License-Identifier: MIT
//
// The list of the controller, on a machine whose axes are lines, and what the lines have counted at the end of each
// case.
#include "served_lines.hpp"
#include "support/catch.hpp"
#include "support/conformance_list.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

class ListedLines final : public test::ListedMachine {
public:
    void finish() override {
        for (int ms = 0; ms < 5000 && !lines_.served->stands(); ++ms) {
            lines_.tick();
        }
        for (const host::RunTarget::AxisPlace& at : lines_.served->places()) {
            const std::int64_t told = std::llround(at.mm.value_or(0.0) * 320.0);
            INFO("axis " << at.axis << ", told " << at.mm.value_or(0.0) * 320.0 << ", counted "
                         << lines_.counts()[at.axis]);
            CHECK((!at.mm || told == lines_.counts()[at.axis]));
        }
    }

    void send(std::string_view bytes) override { lines_.send(bytes); }
    void tick() override { lines_.tick(); }
    [[nodiscard]] Controller& controller() override { return *lines_.controller; }
    [[nodiscard]] std::string& text() override { return lines_.text; }
    void obey(const std::string& /*command*/, const std::string& rest) override { // machine
        const double value = std::stod(rest.substr(rest.find(' ')));
        if (rest.rfind("plate", 0) == 0) {
            lines_.plate_mm = value;
            lines_.carriage();
            for (int ms = 0; ms < 5; ++ms) {
                lines_.tick();
            }
        } else if (rest.rfind("homes", 0) == 0) {
            lines_.settings.homes = static_cast<std::uint32_t>(value);
        } else {
            lines_.settings.probes = value != 0.0;
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
    ServedLines lines_;
};

} // namespace

TEST_CASE("a machine on lines answers as the controller's list says, and no step is lost", "[serve]") {
    const int cases = test::run_conformance_list([] { return std::make_unique<ListedLines>(); }, &ListedLines::takes);
    CHECK(cases > 70);
}
