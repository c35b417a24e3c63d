// SPDX-License-Identifier: MIT
#include "host_sim/output/trace_writer.hpp"

#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <limits>
#include <random>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

struct Rows {
    std::vector<std::string> lines;

    // One row of a machine with the axes x, y, a for each position.
    explicit Rows(const std::vector<PerAxis<double>>& positions, std::uint64_t ticks = 0, double speed_mm_s = 0.0) {
        const TemporaryFolder folder;
        MachineDescription machine;
        machine.axis_name = {"x", "y", "a"};
        OutputFile file(folder.file("t.csv"));
        TraceWriter writer(file, machine);
        for (const auto& position : positions) {
            writer.row(ticks, position, speed_mm_s);
        }
        file.commit();
        lines = lines_of(folder.file("t.csv"));
    }
};

std::string time_text(std::uint64_t ticks) {
    return cells_of(Rows(std::vector<PerAxis<double>>(1), ticks).lines.at(1)).at(0);
}
std::string position_text(double mm) {
    return cells_of(Rows({PerAxis<double>{mm}}).lines.at(1)).at(1);
}

} // namespace

TEST_CASE("a trace names its columns") {
    const Rows rows({PerAxis<double>{1.0, -2.5, 300.125}}, 2'000'000, 12.5);
    REQUIRE(rows.lines.size() == 2);
    CHECK(rows.lines[0] == "t,x,y,a,speed");
    CHECK(rows.lines[1] == "0.250000,1.000000000000,-2.500000000000,300.125000000000,12.500000000");
}

TEST_CASE("multiples of the sample period are exact decimals") {
    CHECK(time_text(0) == "0.000000");
    for (const int period_us : {50, 333, 1000, 1001, 99999}) {
        for (const std::uint64_t n : {1U, 2U, 3U, 7U, 999U, 123456U, 7654321U, 40000000U}) {
            const std::uint64_t us = n * static_cast<unsigned>(period_us);
            CHECK(time_text(us * 8U) == fmt::format("{}.{:06}", us / 1000000U, us % 1000000U));
        }
    }
    CHECK(time_text(1) == "0.000000125");
    CHECK(time_text(80000000007) == "10000.000000875");
}

TEST_CASE("a sample after a thousand years has its own time") {
    constexpr std::uint64_t years = 1000ULL * 365 * 86400 * 8'000'000; // 3.2e10 s
    CHECK(time_text(years + 8'000) == "31536000000.001000");
    CHECK(time_text(years + 8'001) == "31536000000.001000125");
    CHECK(time_text(std::numeric_limits<std::uint64_t>::max()) == "2305843009213.693951875"); // 73,000 years
}

TEST_CASE("positions are the nearest of twelve decimals") {
    std::mt19937_64 random(3);
    std::vector<PerAxis<double>> positions;
    for (const double size : {1e-12, 1e-6, 1.0, 300.0, 1e6, 1e12}) {
        std::uniform_real_distribution<double> number(-size, size);
        for (int i = 0; i < 5000; ++i) {
            positions.push_back({number(random), number(random), number(random)});
        }
    }
    const Rows rows(positions);
    REQUIRE(rows.lines.size() == positions.size() + 1);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const auto cells = cells_of(rows.lines[i + 1]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string& text = cells.at(k + 1);
            REQUIRE(text.size() - text.find('.') == 13);
            const long double off = std::stold(text) - static_cast<long double>(positions[i][k]);
            // half of the last decimal and the last bit of the text's own conversion
            REQUIRE(std::fabs(off) <= 0.5001e-12L + 2e-19L * std::fabs(static_cast<long double>(positions[i][k])));
        }
    }
}

TEST_CASE("numbers at the edges") {
    CHECK(position_text(-0.0) == "0.000000000000");
    CHECK(position_text(-1e-13) == "0.000000000000");
    CHECK(position_text(-9e-13) == "-0.000000000001");
    CHECK(position_text(0.9999999999996) == "1.000000000000");
    CHECK(position_text(-99.9999999999997) == "-100.000000000000");
    CHECK(position_text(1e300).size() == 301 + 13);
    CHECK(position_text(-std::numeric_limits<double>::max()).size() == 1 + 309 + 13);
    CHECK(position_text(std::numeric_limits<double>::infinity()) == "inf");
    CHECK(position_text(std::nan("")) == "nan");
}
