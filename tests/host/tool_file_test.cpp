// SPDX-License-Identifier: MIT
#include "host_sim/program/tool_file.hpp"

#include "support/catch.hpp"
#include "temporary_folder.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

class Table {
public:
    explicit Table(const std::string& text) { std::ofstream(path_) << text; }

    [[nodiscard]] ToolRows rows() const { return read_tool_file(path_); }

private:
    TemporaryFolder folder_;
    std::string path_ = folder_.file("tool.tbl");
};

} // namespace

TEST_CASE("A table of tools is read as LinuxCNC writes it") {
    const Table table("; tools\n\nT1 P1 D0.125 Z+12.511 ;1/8 end mill\r\nt99999 p2 x-0.5 A10 z0\nT3 P7 I10 J20 Q2");
    const ToolRows rows = table.rows();
    REQUIRE(rows.size() == 3);
    CHECK(rows.at(1).diameter == Decimal{125'000'000});
    CHECK(rows.at(3).orientation == 2);
    const std::vector<std::string> axes{"x", "z", "a"};
    const MachineTools tools(rows, axes);
    ToolOffset found;
    REQUIRE(tools.find(1, found));
    CHECK(found.offset[0] == Decimal{});
    CHECK(found.offset[1] == Decimal{12'511'000'000});
    REQUIRE(tools.find(99999, found));
    CHECK(found.offset[0] == Decimal{-500'000'000});
    CHECK(found.offset[2] == Decimal{10'000'000'000});
    CHECK_FALSE(tools.find(2, found));
}
