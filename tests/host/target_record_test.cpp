// SPDX-License-Identifier: MIT
#include "host_sim/report/target_record.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

constexpr std::uint32_t millisecond = 8000; // ticks

/// A target that executes a segment of a millisecond in each millisecond.
struct Bench {
    TargetRecord record;
    std::uint64_t now_us = 5'000'000;
    std::uint64_t executed = 0;

    void handed(int segments) {
        for (int i = 0; i < segments; ++i) {
            record.handed(millisecond);
        }
    }
    void pass(int ms, bool moves = true) {
        for (int i = 0; i < ms; ++i) {
            now_us += 1000;
            executed += moves ? 1 : 0;
            record.looked(now_us, executed);
        }
    }
    [[nodiscard]] TimeStrips::Range at(double s, TargetRecord::Channel channel) const {
        return record.strips().range(static_cast<std::size_t>(s / 0.01), channel);
    }
};

} // namespace

TEST_CASE("what is buffered, and no lateness where the target keeps time") {
    Bench bench;
    bench.handed(200);
    bench.pass(500, false); // the buffers are filled: nothing is late
    bench.pass(100);
    bench.handed(100);
    bench.pass(100);
    CHECK(bench.at(0.005, TargetRecord::buffered_s).high == Approx(0.199));
    CHECK(bench.at(0.095, TargetRecord::buffered_s).low == Approx(0.101));
    CHECK(bench.at(0.105, TargetRecord::buffered_s).high > 0.18F);
    CHECK(bench.at(0.195, TargetRecord::late_s).high == 0.0F);
    CHECK(bench.record.least_s() == Approx(0.1)); // what is left at the end does not count
}

TEST_CASE("a target that stands though it has motion is late, and stays so") {
    Bench bench;
    bench.handed(300);
    bench.pass(100);
    bench.pass(250, false);
    bench.executed += 50; // nobody knew of them
    bench.pass(100);
    CHECK(bench.at(0.095, TargetRecord::late_s).high == 0.0F);
    CHECK(bench.at(0.115, TargetRecord::late_s).low == Approx(0.2));
    CHECK(bench.at(0.195, TargetRecord::late_s).high == Approx(0.2));
}

TEST_CASE("a target that has nothing to execute is not late") {
    Bench bench;
    bench.handed(50);
    bench.pass(50);
    bench.pass(1000, false); // an operator is asked
    bench.handed(50);
    bench.pass(50);
    CHECK(bench.at(0.095, TargetRecord::late_s).high < 0.002F);
}
