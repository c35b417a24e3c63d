// SPDX-License-Identifier: MIT
//
// Terminal: a pseudo terminal; what is shown on it can be read, and somebody types at it.
#pragma once

#include "support/catch.hpp"

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace splinefeed_test {

class Terminal {
public:
    Terminal() : keyboard_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
        REQUIRE(keyboard_ >= 0);
        REQUIRE(grantpt(keyboard_) == 0);
        REQUIRE(unlockpt(keyboard_) == 0);
        screen_ = open(name().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        REQUIRE(screen_ >= 0);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;
    ~Terminal() {
        close(screen_);
        close(keyboard_);
    }
    [[nodiscard]] int descriptor() const { return screen_; }
    [[nodiscard]] std::string name() const { return ptsname(keyboard_); } // NOLINT(concurrency-mt-unsafe): one thread
    void type(std::string_view keys) const {
        REQUIRE(write(keyboard_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
    }
    /// All that was written; it may arrive late.
    [[nodiscard]] std::string shown() const {
        std::string text;
        pollfd readable{keyboard_, POLLIN, 0};
        while (poll(&readable, 1, 200) == 1) {
            std::array<char, 4096> part{};
            const ssize_t n = read(keyboard_, part.data(), part.size());
            if (n <= 0) {
                break;
            }
            text.append(part.data(), static_cast<std::size_t>(n));
        }
        return text;
    }

private:
    int keyboard_;
    int screen_ = -1;
};

} // namespace splinefeed_test
