// SPDX-License-Identifier: MIT
//
// Paths of more than 2^23 mm, to their ends.
#include "support/catch.hpp"
#include "support/rounds.hpp"
#include "tool.hpp"

#include <nlohmann/json.hpp>

using splinefeed::test::Call;
using splinefeed::test::Tool;

namespace {

constexpr double move_mm = 60000.0;

/// To and fro between x = 0 and 60000 mm.
std::string to_and_fro(int points) {
    std::string rows;
    for (int i = 0; i < points; ++i) {
        rows += i % 2 == 0 ? "0,0\n" : "60000,0\n";
    }
    return rows;
}

/// A machine at 10 m/s.
std::string machine_of(int sample_period_us, bool jerk_limited) {
    std::string text = "sample_period_us = " + std::to_string(sample_period_us) + "\n[path]\nmax_feed_mm_s = 10000\n";
    for (const char* const name : {"x", "y"}) {
        text += std::string("[[axis]]\nname = \"") + name +
                "\"\nmax_velocity_mm_s = 10000\nmax_acceleration_mm_s2 = 20000\nsteps_per_mm = 10\n";
        text += jerk_limited ? "max_jerk_mm_s3 = 1000000\n" : "";
    }
    return text;
}

} // namespace

TEST_CASE("a path of more than 2^23 mm is planned to its end, and its length is true", "[endless]") {
    const bool whole = splinefeed_test::whole_sweep(); // minutes
    const int points = whole ? 400 : 145;              // 2.4e7 and 8.64e6 mm
    const Tool tool;
    tool.write("far.csv", to_and_fro(points));
    for (const bool jerk_limited : {false, true}) {
        // With a short period a segment lasts 0.5 ms.
        tool.write("m.toml", machine_of(whole ? 4000 : 100000, jerk_limited));
        for (const char* const scalar : {"fixed", "double"}) {
            if ((scalar == std::string("double")) == jerk_limited && !whole) {
                continue; // 4 s each; lengths are the scalar's, and each scalar and each plan is seen once
            }
            const Call call = tool(std::string("plan far.csv -m m.toml --curve polyline --quiet --summary json ") +
                                   "--window 4096 --scalar " + scalar); // a move's cells: in half the time
            CAPTURE(jerk_limited, scalar, call.error);
            REQUIRE(call.status == 0);
            const auto summary = nlohmann::json::parse(call.output);
            CHECK(summary["length_mm"].get<double>() == Approx((points - 1) * move_mm).epsilon(1e-12));
            CHECK(summary["cycle_time_s"].get<double>() > summary["optimum_time_s"].get<double>());
            CHECK(summary["cycle_time_s"].get<double>() <
                  (jerk_limited ? 1.1 : 1.01) * summary["optimum_time_s"].get<double>()); // that without a jerk limit
        }
    }
}

TEST_CASE("float takes moves up to 512 mm, and says so", "[endless]") {
    const Tool tool;
    tool.write("far.csv", to_and_fro(3));
    tool.write("m.toml", machine_of(100000, false));
    const Call call = tool("plan far.csv -m m.toml --curve polyline --quiet --scalar float");
    CHECK(call.status == 2);
    CHECK(call.error == "far.csv:2: two successive waypoints must be at most 65536 mm apart, in float 512 mm\n");
}
