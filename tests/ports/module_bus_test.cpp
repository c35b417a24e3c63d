// SPDX-License-Identifier: MIT
// ModuleBus on a virtual clock, with two modules on its line.
#include "splinefeed/hal/modbus/module/module_bus.hpp"

#include "ports/simulated_module.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

/// Unit 1 has the coils 0 (safe: off) and 1 (safe: on), unit 2 the input 5.
struct Bench {
    Bench() {
        modules[1].coils = {{0, true}, {1, false}};
        modules[2].inputs = {{5, false}};
        off = bus->add_coil({1, BitTable::coils, 0, "output 0"}, false);
        on = bus->add_coil({1, BitTable::coils, 1, "output 1"}, true);
        input = bus->add_input({2, BitTable::inputs, 5, "input 5"});
    }

    void pass_ms(std::uint64_t duration_ms) { clock.sleep_us(1000 * duration_ms); }
    [[nodiscard]] bool coil(int address) { return modules[1].coils.at(address); }

    VirtualClock clock;
    std::map<int, SimulatedModule> modules;
    std::unique_ptr<ModuleBus> bus = std::make_unique<ModuleBus>(
        LinkAddress{}, ModuleBusSettings{},
        [this](const auto& address, const auto& timing, auto& by) {
            return std::make_unique<ModuleLink>(modules, address, timing, by);
        },
        clock);
    std::size_t off = 0;
    std::size_t on = 0;
    std::size_t input = 0;
};

} // namespace

TEST_CASE("Modules: coils are safe at the beginning, as they are set, and safe at the end for good", "[modules]") {
    Bench bench;
    REQUIRE(bench.bus->open().empty());
    CHECK_FALSE(bench.coil(0));
    CHECK(bench.coil(1));
    bench.bus->set(bench.off, true);
    CHECK_FALSE(bench.bus->unconfirmed().empty());
    bench.pass_ms(10);
    CHECK(bench.coil(0));
    CHECK(bench.coil(1));
    CHECK(bench.bus->unconfirmed().empty());
    bench.bus->set(bench.on, false);
    bench.pass_ms(10);
    CHECK_FALSE(bench.coil(1));
    const int writes = bench.modules[1].writes;
    bench.pass_ms(2000);
    CHECK(bench.modules[1].writes == writes);
    bench.bus->end();
    bench.bus->set(bench.off, true);
    bench.pass_ms(10);
    CHECK_FALSE(bench.coil(0));
    CHECK(bench.coil(1));
    bench.pass_ms(2000);
    CHECK_FALSE(bench.coil(0));
    CHECK(bench.bus->unconfirmed().empty());
    CHECK(bench.bus->trouble().empty());
}

TEST_CASE("Modules: the end of the object makes the coils safe", "[modules]") {
    Bench bench;
    REQUIRE(bench.bus->open().empty());
    bench.bus->set(bench.off, true);
    bench.pass_ms(10);
    REQUIRE(bench.coil(0));
    bench.bus.reset();
    CHECK_FALSE(bench.coil(0));
}

TEST_CASE("Modules: an address that a module lacks is found before anything is written", "[modules]") {
    Bench bench;
    SECTION("a coil") {
        static_cast<void>(bench.bus->add_coil({1, BitTable::coils, 8, "output 8"}, true));
        CHECK(bench.bus->open() == "output 8: exception illegal address");
    }
    SECTION("an input") {
        static_cast<void>(bench.bus->add_input({2, BitTable::inputs, 6, "input 6"}));
        CHECK(bench.bus->open() == "input 6: exception illegal address");
    }
    SECTION("a module") {
        static_cast<void>(bench.bus->add_input({3, BitTable::inputs, 0, "input 7"}));
        CHECK(bench.bus->open().rfind("input 7: no answer in time", 0) == 0);
    }
    CHECK(bench.modules[1].writes == 0);
}

TEST_CASE("Modules: a watched input is read all the time, and a reading is not older than the watch", "[modules]") {
    Bench bench;
    REQUIRE(bench.bus->open().empty());
    CHECK_FALSE(bench.bus->take());
    bench.modules[2].inputs[5] = true;
    bench.pass_ms(500);
    CHECK_FALSE(bench.bus->take()); // nobody watches
    const std::uint64_t began_us = bench.clock.now_us();
    bench.bus->watch(bench.input);
    bench.pass_ms(10);
    const auto high = bench.bus->take();
    REQUIRE(high);
    CHECK(high->on);
    CHECK(high->asked_us >= began_us);
    bench.modules[2].inputs[5] = false;
    bench.pass_ms(10);
    const auto low = bench.bus->take();
    REQUIRE(low);
    CHECK_FALSE(low->on);
    bench.bus->unwatch();
    bench.pass_ms(10);
    CHECK_FALSE(bench.bus->take());
}

TEST_CASE("Modules: one that does not answer for a second is trouble, and its coils become safe later", "[modules]") {
    Bench bench;
    REQUIRE(bench.bus->open().empty());
    bench.bus->set(bench.off, true);
    bench.pass_ms(10);
    SECTION("for a moment") {
        bench.modules[1].unplugged = true;
        bench.pass_ms(600);
        bench.modules[1].unplugged = false;
        bench.pass_ms(2000);
        CHECK(bench.bus->trouble().empty());
        CHECK(bench.coil(0));
    }
    SECTION("for long") {
        bench.modules[1].unplugged = true;
        bench.pass_ms(2000);
        CHECK(bench.bus->trouble().rfind("output ", 0) == 0);
        CHECK(bench.bus->trouble().find("its module does not answer") != std::string::npos);
        CHECK(bench.coil(0)); // nobody can tell it
        CHECK_FALSE(bench.bus->unconfirmed().empty());
        bench.modules[1].unplugged = false;
        bench.pass_ms(500);
        CHECK_FALSE(bench.coil(0));
        CHECK(bench.bus->unconfirmed().empty());
    }
    SECTION("the other module, where nothing is read") {
        bench.modules[2].mute = true;
        bench.pass_ms(3000);
        CHECK(bench.bus->trouble().rfind("input 5: its module does not answer", 0) == 0);
        CHECK_FALSE(bench.coil(0));
    }
}

TEST_CASE("Modules: a coil that is not as it was set is trouble", "[modules]") {
    Bench bench;
    REQUIRE(bench.bus->open().empty());
    bench.bus->set(bench.off, true);
    bench.pass_ms(10);
    bench.modules[1].coils[0] = false; // the module was off and on again
    bench.pass_ms(400);
    CHECK(bench.bus->trouble().rfind("output 0: it is off, as it was not set", 0) == 0);
    CHECK_FALSE(bench.coil(0));
    CHECK(bench.coil(1));
}

TEST_CASE("Modules: what was not confirmed is written again", "[modules]") {
    Bench bench;
    REQUIRE(bench.bus->open().empty());
    bench.modules[1].mute = true;
    bench.bus->set(bench.off, true);
    bench.pass_ms(50);
    CHECK(bench.coil(0));
    CHECK(bench.bus->unconfirmed() == "output 0");
    bench.bus->set(bench.off, false);
    bench.pass_ms(400);
    CHECK_FALSE(bench.coil(0));
    bench.modules[1].mute = false;
    bench.pass_ms(300);
    CHECK(bench.bus->unconfirmed().empty());
    CHECK_FALSE(bench.coil(0));
    CHECK(bench.bus->trouble().empty());
}

TEST_CASE("Modules: one that does not answer keeps the others waiting for one time-out, however many coils it has",
          "[modules]") {
    constexpr int coils = 8;
    VirtualClock clock;
    std::map<int, SimulatedModule> modules;
    ModuleBus bus(
        LinkAddress{}, ModuleBusSettings{},
        [&](const auto& address, const auto& timing, auto& by) {
            return std::make_unique<ModuleLink>(modules, address, timing, by);
        },
        clock);
    std::vector<std::size_t> all;
    for (int i = 0; i < coils; ++i) {
        modules[1].coils[i] = false;
        all.push_back(bus.add_coil({1, BitTable::coils, i, "output " + std::to_string(i)}, false));
    }
    modules[2].coils[0] = false;
    all.push_back(bus.add_coil({2, BitTable::coils, 0, "flood"}, false));
    REQUIRE(bus.open().empty());
    for (const std::size_t coil : all) {
        bus.set(coil, true);
    }
    clock.sleep_us(100'000);
    REQUIRE(modules[2].coils[0]);
    modules[1].mute = true;
    bus.end();
    clock.sleep_us(150'000); // one time-out is 100 ms
    CHECK_FALSE(modules[2].coils[0]);
    modules[1].mute = false;
    clock.sleep_us(300'000);
    CHECK(bus.unconfirmed().empty());
    CHECK_FALSE(modules[1].coils[coils - 1]);
}
