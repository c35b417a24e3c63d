// SPDX-License-Identifier: MIT
#include "host_sim/base/abandon.hpp"

#include "host_sim/base/output_file.hpp"
#include "support/child.hpp"
#include "temporary_folder.hpp"

#include <array>
#include <thread>

#include <fcntl.h>

using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

struct Ended {
    int code = 0;
    std::string errors;
};

/// A process that writes to a file and to a pipe that nobody reads, and gives up meanwhile.
/// @param deaf  nobody reads its standard error, either
Ended give_up(const TemporaryFolder& folder, bool deaf) {
    std::array<int, 2> errors{};
    std::array<int, 2> blocked{};
    REQUIRE(pipe2(errors.data(), O_CLOEXEC) == 0);
    REQUIRE(pipe2(blocked.data(), O_CLOEXEC) == 0);
    if (deaf) {
        const std::string much(std::size_t{1} << 16, 'm');
        REQUIRE(write(errors[1], much.data(), much.size()) == static_cast<ssize_t>(much.size()));
    }
    Ended ended;
    ended.code = exit_of([&] {
        alarm(20);
        dup2(errors[1], STDERR_FILENO);
        dup2(blocked[1], STDOUT_FILENO);
        OutputFile file(folder.file("out.csv"));
        file.append(std::string(std::size_t{1} << 20, 'm'));
        OutputFile pipe("-");
        std::thread writer([&] { pipe.append(std::string(std::size_t{1} << 20, 'm')); });
        while (OutputFile::writes() == 0) {
            std::this_thread::yield();
        }
        abandon("held\non the path", 1);
    });
    std::array<char, 200> text{};
    if (!deaf) {
        ended.errors.assign(text.data(), static_cast<std::size_t>(read(errors[0], text.data(), text.size())));
    }
    for (const int end : {errors[0], errors[1], blocked[0], blocked[1]}) {
        close(end);
    }
    return ended;
}

} // namespace

TEST_CASE("a process ends while a thread of it is blocked, with its sentence and without half a file") {
    const TemporaryFolder folder;
    const Ended ended = give_up(folder, false);
    CHECK(ended.code == 1);
    CHECK(ended.errors == "splinefeed: held\\x0aon the path\n");
    CHECK(folder.entries().empty());
}

TEST_CASE("a process ends though nobody reads its last sentence") {
    const TemporaryFolder folder;
    const Ended ended = give_up(folder, true);
    CHECK(ended.code == 1);
    CHECK(folder.entries().empty());
}

TEST_CASE("what does not end in time ends with the process, what does leaves it alone") {
    { const Deadline in_time(std::chrono::seconds(20), "never told"); }
    const int code = exit_of([] {
        alarm(20);
        const Deadline deadline(std::chrono::milliseconds(10), "a thread does not end");
        for (;;) {
            pause();
        }
    });
    CHECK(code == 1);
}
