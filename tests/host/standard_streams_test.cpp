// SPDX-License-Identifier: MIT
#include "host_sim/base/standard_streams.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <unistd.h>

using namespace splinefeed::host;

namespace {

/// Standard error is a pipe, and nobody reads it.
class UnreadErrors {
public:
    UnreadErrors() : before_(dup(STDERR_FILENO)) {
        std::signal(SIGPIPE, SIG_IGN); // as the tool has it
        REQUIRE(pipe2(ends_.data(), O_CLOEXEC) == 0);
        static_cast<void>(dup2(ends_[1], STDERR_FILENO));
        close(ends_[1]);
    }
    UnreadErrors(const UnreadErrors&) = delete;
    UnreadErrors& operator=(const UnreadErrors&) = delete;
    ~UnreadErrors() {
        static_cast<void>(dup2(before_, STDERR_FILENO));
        close(before_);
        close(ends_[0]);
    }

    /// Until that has come.
    std::string read_to(const std::string& end) {
        std::string text;
        std::array<char, 4096> part{};
        while (text.find(end) == std::string::npos) {
            const ssize_t size = read(ends_[0], part.data(), part.size());
            if (size <= 0) {
                break;
            }
            text.append(part.data(), static_cast<std::size_t>(size));
        }
        return text;
    }

private:
    std::array<int, 2> ends_{};
    int before_;
};

} // namespace

TEST_CASE("Who tells something does not wait for who reads, and hears later what was dropped") {
    constexpr int texts = 5000;
    UnreadErrors errors;
    const BackgroundTelling telling;
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 0; i < texts; ++i) {
        tell("{:100}\n", i);
    }
    await_told(std::chrono::milliseconds(10));
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(20)); // else it would be for ever
    const std::string read = errors.read_to("4999\n");
    const std::string words = " messages were dropped here: nobody read them\n";
    int dropped = 0;
    int told_so = 0;
    for (std::size_t at = read.find(words); at != std::string::npos; at = read.find(words, at + 1)) {
        const std::size_t begin = read.rfind(' ', at - 1) + 1;
        dropped += std::stoi(read.substr(begin, at - begin));
        ++told_so;
    }
    CHECK(dropped > 0);
    CHECK(std::count(read.begin(), read.end(), '\n') == texts - dropped + told_so);
}

TEST_CASE("What was told is written before the object has gone, and where nobody reads nothing keeps the process") {
    UnreadErrors errors;
    { // the first texts go into the pipe
        const BackgroundTelling telling;
        tell("one\n");
        tell("two\n");
    }
    CHECK(errors.read_to("two\n") == "one\ntwo\n");
    {
        const BackgroundTelling telling;
        for (int i = 0; i < 1000; ++i) {
            tell("{:100}\n", i);
        }
    }
    tell("nobody waits for this\n");
    static_cast<void>(errors.read_to("   100\n")); // lets the thread end
}
