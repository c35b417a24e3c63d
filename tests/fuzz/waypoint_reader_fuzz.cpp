// SPDX-License-Identifier: MIT
// Any bytes as a waypoint file: rows that keep what the reader promises, or one line that says what is wrong.
#include "fuzz/require.hpp"
#include "host_sim/program/waypoint_reader.hpp"

#include <sstream>
#include <string_view>

using namespace splinefeed;
using namespace splinefeed::host;
using splinefeed_test::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) {
        return 0;
    }
    const bool six = (data[0] & 1U) != 0;
    const bool drop = (data[0] & 2U) != 0;
    std::istringstream input(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    try {
        WaypointReader reader(input, "fuzz.csv",
                              six ? std::vector<std::string>{"x", "y", "z", "a", "b", "c"}
                                  : std::vector<std::string>{"x", "y", "z"},
                              drop);
        WaypointRow row;
        std::uint64_t rows = 0;
        std::uint64_t line = 0;
        while (reader.next(row)) {
            ++rows;
            require(row.line > line);
            line = row.line;
            for (const double mm : row.position) {
                require(position_representable(mm));
            }
            require(row.feed_mm_s == 0.0 || (row.feed_mm_s >= 0.001 && row.feed_mm_s <= 10000.0));
        }
        require(rows >= 2 && rows == reader.rows());
    } catch (const InputError& error) {
        const std::string_view told = error.what();
        require(told.substr(0, 8) == "fuzz.csv" && told.find('\n') == std::string_view::npos);
    }
    return 0;
}
