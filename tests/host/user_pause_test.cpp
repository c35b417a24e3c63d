// SPDX-License-Identifier: MIT
#include "host_sim/run/user_pause.hpp"

#include "support/terminal.hpp"

#include <chrono>
#include <fcntl.h>
#include <thread>
#include <unistd.h>

using namespace splinefeed::host;
using splinefeed_test::Terminal;

namespace {

bool answers(UserPause& pause) {
    for (int i = 0; i < 200 && !pause.answered(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return pause.answered();
}

} // namespace

TEST_CASE("Enter on the terminal goes on, and what was typed before does not") {
    const Terminal terminal;
    UserPause pause(terminal.descriptor());
    terminal.type("before\n");
    pause.ask("line 1: M0");
    CHECK_FALSE(answers(pause));
    terminal.type("y"); // no whole line
    CHECK_FALSE(answers(pause));
    terminal.type("\n");
    CHECK(answers(pause));
    pause.ask("line 2: M0");
    CHECK_FALSE(answers(pause));
}

TEST_CASE("A signal goes on, with a terminal and without one, and one from before does not") {
    const Terminal terminal;
    for (const int from : {-1, terminal.descriptor()}) {
        UserPause pause(from);
        pause.go_on();
        pause.ask("line 1: M6, tool 3");
        CHECK_FALSE(pause.answered());
        pause.go_on();
        CHECK(pause.answered());
    }
}

TEST_CASE("A file or a pipe is no terminal: what stands in it is not read") {
    const int file = open("/dev/zero", O_RDONLY);
    UserPause pause(file);
    pause.ask("line 1: M0");
    CHECK_FALSE(pause.answered());
    close(file);
}
