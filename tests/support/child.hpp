// SPDX-License-Identifier: MIT
// child_status, exit_of: how a process of its own ends.
#pragma once

#include "support/catch.hpp"

#include <sys/wait.h>
#include <unistd.h>

namespace splinefeed_test {

/// As of waitpid(). @param body  runs there; an exception is a 1
template <class Body>
int child_status(Body&& body) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        try {
            body();
        } catch (...) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    return status;
}

template <class Body>
int exit_of(Body&& body) {
    const int status = child_status(body);
    REQUIRE(WIFEXITED(status));
    return WEXITSTATUS(status);
}

} // namespace splinefeed_test
