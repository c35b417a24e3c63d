// SPDX-License-Identifier: MIT
// The virtual line itself: what each of its faults looks like to who asks.
#include "ports/simulated_link.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"

using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;

namespace {

/// One register that counts how often it was read.
class Counter final : public splinefeed::host::DriveModel {
public:
    void advance(std::uint64_t /*now_us*/) override {}
    splinefeed::host::ModbusException read(int /*address*/, std::span<std::uint16_t> out) override {
        out[0] = ++readings;
        return splinefeed::host::ModbusException::none;
    }
    splinefeed::host::ModbusException write(int /*address*/, std::span<const std::uint16_t> /*values*/) override {
        return splinefeed::host::ModbusException::none;
    }
    void power_cycle() override {}
    [[nodiscard]] int axes() const override { return 1; }
    [[nodiscard]] double position_counts(int /*axis*/) const override { return 0.0; }
    std::uint16_t readings = 0;
};

struct Line {
    explicit Line(Wire kind) : link(wire, {.wire = kind, .unit = 1}, {.answer_us = 50'000}, clock) {
        wire.stations[1] = &station;
        REQUIRE(link.connect());
    }
    LinkFault read() {
        const LinkAnswer answer = link.read(1, 0, in);
        took_us = answer.answered_us - answer.sent_us;
        return answer.fault;
    }
    VirtualClock clock;
    Counter counter;
    Station station{counter, 0.0};
    SimulatedWire wire;
    SimulatedLink link;
    std::array<std::uint16_t, 1> in{};
    std::uint64_t took_us = 0;
};

} // namespace

TEST_CASE("virtual line: what each fault looks like", "[ports][line]") {
    constexpr std::uint64_t longest_us = 60'000; // the time-out, and the frames at 115200 baud
    for (const Wire kind : {Wire::tcp, Wire::rtu}) {
        const bool serial = kind == Wire::rtu;
        CAPTURE(serial);
        Line line(kind);
        CHECK(line.read() == LinkFault::none);
        line.wire.faults = {.broken = 1.0};
        CHECK(line.read() == LinkFault::timeout);
        CHECK(line.took_us <= longest_us);
        line.wire.faults = {.foreign = 1.0};
        CHECK(line.read() == (serial ? LinkFault::wrong_unit : LinkFault::wrong_length));
        line.wire.faults = {};
        line.wire.flooded = {{0, UINT64_MAX}};
        CHECK(line.read() == (serial ? LinkFault::corrupt : LinkFault::disconnected));
        CHECK(line.took_us <= longest_us);
        line.wire.flooded.clear();
        REQUIRE(line.link.connect());
        line.wire.silences = {{line.wire.requests + 2, 150'000}};
        CHECK(line.read() == LinkFault::none);
        CHECK(line.read() == LinkFault::timeout);
        const std::uint64_t silent_to_us = line.wire.silent.to_us;
        while (line.read() != LinkFault::none) {
            CHECK(line.clock.now_us() < silent_to_us + longest_us);
        }
    }
}

TEST_CASE("virtual line: a late answer is on its way, and is not that of the next reading", "[ports][line]") {
    Line line(Wire::rtu);
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        line.wire.random.seed(seed);
        line.wire.faults = {.late = 0.3, .late_us = 300'000};
        if (line.read() == LinkFault::none) {
            REQUIRE(line.in[0] == line.counter.readings);
        }
    }
    CHECK(line.wire.hiccups > 100);
    // A write in between is answered behind it.
    line.wire.faults = {.late = 1.0, .late_us = 2'000'000};
    while (line.read() != LinkFault::timeout) {
    }
    CHECK(line.link.read_from_us(1) > line.clock.now_us());
    line.wire.faults = {};
    line.clock.sleep_us(2'000'000);
    CHECK(line.link.write(1, 0, line.in).ok());
    CHECK(line.link.read_from_us(1) == 0);
}
