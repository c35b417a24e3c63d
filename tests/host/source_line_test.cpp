// SPDX-License-Identifier: MIT
#include "host_sim/program/source_line.hpp"

#include "refusal.hpp"
#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <chrono>
#include <fstream>
#include <thread>

#include <sys/stat.h>

using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

std::vector<std::string> read_lines(const std::string& text) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("p.ngc"), std::ios::binary) << text;
    LineReader reader(folder.file("p.ngc"), "p.ngc");
    std::vector<std::string> lines;
    for (SourceLine line; reader.next(line);) {
        CHECK(line.number == lines.size() + 1);
        lines.push_back(line.text);
    }
    return lines;
}

} // namespace

TEST_CASE("Lines end with either kind of line end, or with the file") {
    CHECK(read_lines("").empty());
    CHECK(read_lines("a\nb") == std::vector<std::string>{"a", "b"});
    CHECK(read_lines("a\r\n\r\nb\r\n") == std::vector<std::string>{"a", "", "b"});
}

TEST_CASE("Lines are whole where the blocks of the file end within them") {
    std::string text;
    std::vector<std::string> expected;
    for (int i = 0; i < 500; ++i) {
        expected.emplace_back(static_cast<std::size_t>(i * 7 % 997), static_cast<char>('a' + i % 26));
        text += expected.back() + "\n";
    }
    CHECK(read_lines(text) == expected);
}

TEST_CASE("A line that does not end is refused, in bounded memory") {
    CHECK(read_lines(std::string(LineReader::longest_line, 'x')).size() == 1);
    CHECK(refusal_of([] { static_cast<void>(read_lines("a\n" + std::string(1'000'000, 'x'))); }) ==
          "p.ngc:2: the line is longer than 65536 bytes; is it a text file?");
}

TEST_CASE("A mark of the encoding is left out, or refused") {
    CHECK(read_lines("\xef\xbb\xbfG21\n\xef\xbb\xbf\n") == std::vector<std::string>{"G21", "\xef\xbb\xbf"});
    for (const std::string mark : {"\xff\xfe", "\xfe\xff"}) {
        CHECK(refusal_of([&] { static_cast<void>(read_lines(mark + "G21\n")); }) ==
              "p.ngc:1: the text is UTF-16; save it as UTF-8 or ASCII");
    }
}

TEST_CASE("The last line of a pipe is whole only with its line end") {
    const TemporaryFolder folder;
    for (const bool ended : {false, true}) {
        const std::string pipe = folder.file(ended ? "ended" : "cut");
        REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
        std::thread sender([&] { std::ofstream(pipe) << "G1 X1\nG1 X2" << (ended ? "\n" : ""); });
        LineReader reader(pipe, "p.ngc");
        SourceLine line;
        CHECK((reader.next(line) && line.whole));
        CHECK((reader.next(line) && line.text == "G1 X2" && line.whole == ended));
        CHECK(!reader.next(line));
        CHECK(line.whole); // behind the last line there is none that is cut
        sender.join();
    }
}

TEST_CASE("A reader that is stopped within a line has no line") {
    const TemporaryFolder folder;
    const std::string pipe = folder.file("open");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::ofstream sender;
    std::thread opens([&] { sender.open(pipe); });
    LineReader reader(pipe, "p.ngc");
    opens.join();
    sender << "G1 X2" << std::flush;
    std::thread stops([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        reader.stop();
    });
    SourceLine line;
    CHECK(!reader.next(line));
    stops.join();
}
