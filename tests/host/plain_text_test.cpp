// SPDX-License-Identifier: MIT
#include "host_sim/base/plain_text.hpp"

#include "refusal.hpp"
#include "support/catch.hpp"

using namespace splinefeed::host;
using namespace splinefeed_test;
using namespace std::string_literals;

TEST_CASE("A line of text has no mark, no line end, and at the end of the input no Ctrl-Z") {
    CHECK(plain_line("\xef\xbb\xbfG0", "p", 1, false) == "G0");
    CHECK(plain_line("\xef\xbb\xbfG0", "p", 2, false) == "\xef\xbb\xbfG0");
    CHECK(plain_line("G0\r\r", "p", 2, false) == "G0");
    CHECK(plain_line("G0\r\x1a\x1a", "p", 2, true) == "G0");
    CHECK(plain_line("\x1a", "p", 2, true).empty());
    CHECK(plain_line("\x1a", "p", 2, false) == "\x1a");
    CHECK(plain_line("caf\xc3\xa9\t\x0c", "p", 2, true) == "caf\xc3\xa9\t\x0c");
}

TEST_CASE("A whole text follows the rules of lines, and keeps its line ends") {
    CHECK(plain_text("\xef\xbb\xbf"
                     "a\r\nb\r\r\n\nc\r\n\x1a\x1a",
                     "p") == "a\r\nb\r\r\n\nc\r\n");
    CHECK(plain_text("a\r", "p") == "a\r");
    CHECK(plain_text("", "p").empty());
}

TEST_CASE("What is no text is refused with its line") {
    const auto refused = [](const std::string& text, const std::string& why) {
        CAPTURE(why);
        CHECK(refusal_of([&] { static_cast<void>(plain_text(text, "p")); }) == "p:" + why);
    };
    const std::string nul = ": the line holds a NUL byte; a text is ASCII or UTF-8, not UTF-16";
    const std::string alone = ": the line holds a CR alone; lines end with \\n or \\r\\n: save the file with these";
    refused("a\nb\0c\n"s, "2" + nul);
    refused("a\rb\rc\r", "1" + alone);
    refused("a\r\nb\rc\n", "2" + alone);
    for (const std::string mark : {"\xff\xfe", "\xfe\xff"}) {
        refused(mark + "a", "1: the text is UTF-16; save it as UTF-8 or ASCII");
    }
    CHECK(refusal_of([] { static_cast<void>(plain_line("a\rb", "p", 7, true)); }) == "p:7" + alone);
    CHECK(refusal_of([] { static_cast<void>(plain_line("a\0"s, "p", 7, false)); }) == "p:7" + nul);
}
