// SPDX-License-Identifier: MIT
#include "host_sim/drive/cia402_machine.hpp"

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;
using splinefeed::hal::modbus::cia402_state;
using splinefeed::hal::modbus::DriveState;

namespace {

struct Bench {
    PositioningAxis axis{PositioningAxisParameters{}};
    Cia402Machine machine;

    Cia402Orders write(std::uint16_t word) { return machine.control(word, axis); }
    [[nodiscard]] int bits() const { return machine.status() & 0x6F; }
    void wait(double duration_s) {
        for (int i = 0; i < 100; ++i) {
            axis.advance(duration_s / 100.0);
        }
        machine.update(axis);
    }
};

} // namespace

TEST_CASE("CiA 402: every control word in every state") {
    struct Row {
        std::uint16_t word;
        std::array<int, 4> next; // from: switch on disabled, ready, switched on, operation enabled
    };
    const std::array<Row, 6> rows{{{0x0006, {0x21, 0x21, 0x21, 0x21}},
                                   {0x0007, {0x40, 0x23, 0x23, 0x23}},
                                   {0x000F, {0x40, 0x27, 0x27, 0x27}},
                                   {0x0000, {0x40, 0x40, 0x40, 0x40}},
                                   {0x0002, {0x40, 0x40, 0x40, 0x07}},
                                   {0x000B, {0x40, 0x40, 0x40, 0x07}}}};
    const std::array<std::vector<std::uint16_t>, 4> ways{{{}, {0x06}, {0x06, 0x07}, {0x06, 0x07, 0x0F}}};
    const std::array<int, 4> states{0x40, 0x21, 0x23, 0x27};
    for (const Row& row : rows) {
        for (std::size_t from = 0; from < ways.size(); ++from) {
            Bench bench;
            for (const std::uint16_t word : ways[from]) {
                bench.write(word);
            }
            REQUIRE((bench.bits() & 0x6F) == states[from]);
            bench.write(row.word);
            CAPTURE(row.word, from);
            CHECK(bench.bits() == row.next[from]);
            CHECK((bench.axis.power() == AxisPower::on) == (row.next[from] == 0x27 || row.next[from] == 0x07));
        }
    }
}

TEST_CASE("CiA 402: a quick stop ends at rest without power, and only then anew") {
    Bench bench;
    bench.write(0x06);
    bench.write(0x0F);
    bench.axis.move(1e6, {1e5, 1e6, 1e6});
    bench.wait(0.2);
    bench.write(0x0B);
    CHECK(cia402_state(bench.machine.status()) == DriveState::quick_stop);
    bench.write(0x0F);
    CHECK(cia402_state(bench.machine.status()) == DriveState::quick_stop);
    bench.wait(0.2);
    CHECK_FALSE(bench.axis.moving());
    CHECK(cia402_state(bench.machine.status()) == DriveState::disabled);
    bench.write(0x06);
    bench.write(0x0F);
    CHECK(bench.machine.in_operation());
}

TEST_CASE("CiA 402: faults react, stay, and are reset by an edge alone") {
    Bench bench;
    bench.write(0x06);
    bench.write(0x8F); // bit 7 already stands
    bench.axis.move(1e6, {1e5, 1e6, 1e6});
    bench.wait(0.2);
    bench.axis.trip(AxisFault::following_error);
    bench.machine.update(bench.axis);
    CHECK(bench.bits() == 0x0F);
    bench.wait(0.2);
    CHECK(bench.bits() == 0x08);
    bench.write(0x8F);
    CHECK(bench.bits() == 0x08);
    bench.write(0x0F);
    CHECK(bench.bits() == 0x08);
    bench.write(0x80);
    CHECK(bench.bits() == 0x40);
    CHECK(bench.axis.fault() == AxisFault::none);
}

TEST_CASE("CiA 402: orders are edges of bits 4 and 8, in operation alone") {
    Bench bench;
    CHECK_FALSE(bench.write(0x1F).start);
    bench.write(0x06);
    CHECK(bench.write(0x3F).start);
    CHECK_FALSE(bench.write(0x3F).start);
    bench.write(0x0F);
    const Cia402Orders orders = bench.write(0x7F);
    CHECK(orders.start);
    CHECK(orders.immediately);
    CHECK(orders.relative);
    CHECK(bench.write(0x10F).halt);
    CHECK_FALSE(bench.write(0x10F).halt);
    CHECK(bench.write(0x0F).go_on);
    CHECK_FALSE(bench.write(0x0F).go_on);
}
