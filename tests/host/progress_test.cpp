// SPDX-License-Identifier: MIT
#include "host_sim/output/progress.hpp"

#include "host_sim/base/standard_streams.hpp"
#include "support/terminal.hpp"

#include <algorithm>
#include <string>

#include <unistd.h>

using namespace splinefeed::host;
using splinefeed_test::Terminal;

namespace {

const std::string erase = "\r\x1b[K";

void work(Progress& progress, std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    for (std::uint64_t i = 0; std::chrono::steady_clock::now() < end; ++i) {
        if (progress.due()) {
            progress.show({i, 0, 1.5});
        }
    }
}

} // namespace

TEST_CASE("on a terminal the line is redrawn at most ten times a second and erased at the end") {
    const Terminal terminal;
    std::string shown;
    {
        Progress progress({.descriptor = terminal.descriptor()});
        work(progress, std::chrono::milliseconds(350));
        shown = terminal.shown();
        const auto redraws = std::count(shown.begin(), shown.end(), '\r');
        CHECK(redraws >= 1);
        CHECK(redraws <= 3);
        CHECK(shown.find("/s), 1.5 s planned") != std::string::npos);
        CHECK(shown.find('\n') == std::string::npos);
    }
    CHECK(terminal.shown() == erase);
}

TEST_CASE("a run too short to draw leaves no trace") {
    const Terminal terminal;
    {
        Progress progress({.descriptor = terminal.descriptor()});
        if (progress.due()) {
            progress.show({1, 0, 1.0});
        }
    }
    CHECK(terminal.shown().empty());
}

TEST_CASE("after finish nothing is drawn") {
    const Terminal terminal;
    Progress progress({.descriptor = terminal.descriptor()});
    work(progress, std::chrono::milliseconds(150));
    progress.finish();
    static_cast<void>(terminal.shown());
    work(progress, std::chrono::milliseconds(150));
    progress.finish();
    CHECK(terminal.shown().empty());
}

TEST_CASE("quiet is quiet") {
    const Terminal terminal;
    {
        Progress progress({.quiet = true, .descriptor = terminal.descriptor()});
        work(progress, std::chrono::milliseconds(150));
    }
    CHECK(terminal.shown().empty());
}

TEST_CASE("what is no terminal gets nothing") {
    int ends[2] = {-1, -1};
    REQUIRE(pipe(ends) == 0);
    {
        Progress progress({.descriptor = ends[1]});
        work(progress, std::chrono::milliseconds(150));
    }
    close(ends[1]);
    char byte = 0;
    CHECK(read(ends[0], &byte, 1) == 0);
    close(ends[0]);
}

TEST_CASE("a message does not stand behind the line") {
    const Terminal terminal;
    Progress progress({.descriptor = terminal.descriptor()});
    work(progress, std::chrono::milliseconds(150));
    CHECK(terminal.shown().size() > erase.size());
    tell("splinefeed: a message of a test\n");
    CHECK(terminal.shown() == erase);
    tell("splinefeed: a second one\n");
    CHECK(terminal.shown().empty());
}

TEST_CASE("the line says how far it is") {
    const std::optional<std::uint64_t> endless;
    struct {
        ProgressNow now;
        std::optional<std::uint64_t> all;
        double wall_s;
        std::string text;
    } const rows[] = {
        {{50, 0, 1.25}, 200, 2.0, "[###.........]  25 %  50 of 200 waypoints (25/s), 1.2 s planned"},
        {{50, 0, 10.0}, endless, 0.0, "50 waypoints, 10.0 s planned"},
        {{0, 0, 0.0}, 0, 0.0, "0 waypoints, 0.0 s planned"},
        {{50, 1234, 1.25}, 200, 2.0, "[###.........]  25 %  line 1234, move 50 of 200 (25/s), 1.2 s planned"},
        {{50, 7, 10.0}, endless, 0.0, "line 7, move 50, 10.0 s planned"},
        {{50, 7, 10.0, true, " x=1.000 y=-2.000"},
         200,
         11.0,
         "[###.........]  25 %  line 7, move 50 of 200, 10.0 s, 30 s left x=1.000 y=-2.000"},
        {{50, 0, 10.0, true, " x=1.000"}, endless, 11.0, "50 waypoints, 10.0 s x=1.000"},
        {{0, 0, 0.0, true, ""}, 200, 0.0, "[............]   0 %  0 of 200 waypoints, 0.0 s"},
    };
    for (const auto& row : rows) {
        CHECK(Progress::text(row.now, row.all, row.wall_s) == row.text.substr(0, 79));
    }
    CHECK(Progress::text({7, 0, 0.0}, 5, 0.0).find("[############] 100 %") == 0);
    CHECK(Progress::text({1000000000000U, 0, 1e9}, 1000000000000U, 1e-3).size() <= 79);
}
