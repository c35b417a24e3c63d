// SPDX-License-Identifier: MIT
// docs/reference/command.md has each option that the help of a command lists, and no other.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <fstream>
#include <iterator>
#include <set>
#include <string>

using splinefeed::test::Tool;

namespace {

// "--name" wherever it stands behind one of `before`.
std::set<std::string> options_in(const std::string& text, const std::string& before) {
    std::set<std::string> found;
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
        const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-", at);
        const std::string name = text.substr(at, end - at);
        if (at > 0 && before.find(text[at - 1]) != std::string::npos && name.size() > 2 && name[2] != '-') {
            found.insert(name);
        }
    }
    return found;
}

} // namespace

TEST_CASE("serve offers the targets that it has") {
    const std::string help = Tool()("serve --help").output;
    for (const char* const target : {"sim", "modbus-tcp://", "gpio://"}) {
        CAPTURE(target);
        CHECK(help.find(target) != std::string::npos);
    }
}

TEST_CASE("the page of the command has every option of its help, and no other") {
    const Tool tool;
    std::ifstream file(splinefeed::test::source_folder() + "/docs/reference/command.md");
    const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const std::set<std::string> on_page = options_in(page, "`[| ");
    std::set<std::string> known;
    for (const char* command :
         {"", "run", "plan", "check", "curve", "surface", "machine", "schema", "link", "drive", "serve"}) {
        const auto help = tool(std::string(command) + " --help");
        REQUIRE(help.status == 0);
        const std::set<std::string> options = options_in(help.output, " ,");
        CHECK(options.size() > (std::string(command) == "schema" ? 0 : 1)); // --help, and one at least
        for (const std::string& option : options) {
            CAPTURE(command, option);
            CHECK(on_page.count(option) == 1);
        }
        known.insert(options.begin(), options.end());
    }
    for (const std::string& option : on_page) {
        CAPTURE(option);
        CHECK(known.count(option) == 1);
    }
}
