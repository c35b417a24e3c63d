// SPDX-License-Identifier: MIT
//
// A short motion through the port and its buses against simulated drives in processes of their own: nothing is
// allocated once the drives are prepared.
#include "drive/drive_process.hpp"
#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"
#include "splinefeed/hal/rt/clock.hpp"
#include "support/allocations.hpp"
#include "support/catch.hpp"

#include <thread>

using namespace splinefeed;
using namespace splinefeed::hal::modbus;
using namespace splinefeed_test;
using splinefeed::test::DriveProcess;
using splinefeed::test::Tool;

namespace {

LinkAddress address(const DriveProcess& drive) {
    return {.port = drive.port()};
}

/// From rest to rest over so many segments of 1 ms: each axis travels 1000 counts.
FeedSegment smooth_segment(int index, int of) {
    constexpr double counts = 1000.0;
    const auto position = [&](int i) {
        const double u = static_cast<double>(i) / of;
        return static_cast<std::int64_t>(counts * u * u * (3.0 - 2.0 * u)) * units_per_count;
    };
    const auto velocity = [&](int i) {
        const double u = static_cast<double>(i) / of;
        return static_cast<std::int64_t>(counts * 6.0 * u * (1.0 - u) / of * static_cast<double>(units_per_count));
    };
    FeedSegment out;
    out.index = static_cast<std::uint64_t>(index);
    out.duration_ticks = 8000;
    out.start.fill(position(index));
    out.end.fill(position(index + 1));
    out.start_velocity.fill(velocity(index));
    out.end_velocity.fill(velocity(index + 1));
    return out;
}

} // namespace

TEST_CASE("Port: no allocation after prepare, in any of its threads", "[modbus]") {
    const Tool tool;
    const DriveProcess first(tool, "--listen tcp://127.0.0.1:0 --axes 2");
    const DriveProcess second(tool, "--listen tcp://127.0.0.1:0 --axes 1");
    ModbusPort port({{address(first), {0, 1}}, {address(second), {2}}}, {});
    REQUIRE_FALSE(port.open());
    constexpr int segments = 700; // more than a ring, so that it is refilled on the way
    REQUIRE_FALSE(port.prepare(smooth_segment(0, segments)));
    const std::size_t before = allocations();
    const std::uint64_t until_us = hal::system_clock().now_us() + 5'000'000;
    bool taken = true;
    for (int i = 0; i < segments && taken;) {
        while (i < segments && taken && port.room() > 0) {
            taken = port.submit(smooth_segment(i++, segments));
        }
        port.poll();
        taken = taken && hal::system_clock().now_us() < until_us;
        hal::system_clock().sleep_until_us(hal::system_clock().now_us() + 500);
    }
    port.complete();
    while (port.phase() != ModbusPhase::done && port.phase() != ModbusPhase::fault &&
           hal::system_clock().now_us() < until_us) {
        port.poll();
        hal::system_clock().sleep_until_us(hal::system_clock().now_us() + 500);
    }
    const std::size_t after = allocations();
    CHECK(port.phase() == ModbusPhase::done);
    CHECK(port.report(0).counts.segments == segments);
    CHECK(port.report(1).counts.segments == segments);
    CHECK(port.report(0).status.position[0] == 1000);
    CHECK(port.report(0).status.position[1] == 1000);
    CHECK(port.report(1).status.position[0] == 1000);
    port.close();
    CHECK(after - before == 0);
}

TEST_CASE("Allocations of other threads are counted", "[modbus]") {
    std::size_t grown = 0;
    std::thread([&] {
        const std::size_t before = allocations();
        const std::vector<int> some(static_cast<std::size_t>(std::rand() % 2) + 1000); // not to be optimised away
        grown = allocations() - before + (some.empty() ? 1 : 0);
    }).join();
    CHECK(grown > 0);
}
