// SPDX-License-Identifier: MIT
#include "host_sim/base/signal_watch.hpp"

#include "support/catch.hpp"

#include <chrono>
#include <pthread.h>
#include <unistd.h>

using namespace splinefeed::host;

namespace {

/// Sends a signal to the process, and waits until the watch has taken so many.
void request(int signal, int count) {
    REQUIRE(kill(getpid(), signal) == 0);
    for (int i = 0; i < 5000 && SignalWatch::interrupts() < count; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(SignalWatch::interrupts() == count);
}

bool blocked(int signal) {
    sigset_t mask;
    return pthread_sigmask(SIG_BLOCK, nullptr, &mask) == 0 && sigismember(&mask, signal) == 1;
}

} // namespace

TEST_CASE("every request of an end counts, whichever signal it is") {
    int at_once = 0;
    SignalWatch watch([&] { ++at_once; });
    CHECK_FALSE(SignalWatch::interrupted());
    int count = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGINT}) {
        request(signal, ++count);
    }
    watch.supervise();
    CHECK(at_once == 4);
    request(SIGINT, 5);
    CHECK(at_once == 4);
}

TEST_CASE("a watch counts from its beginning") {
    const bool before = blocked(SIGUSR1);
    {
        SignalWatch watch({});
        CHECK(blocked(SIGUSR1));
        request(SIGHUP, 1);
    }
    CHECK(blocked(SIGUSR1) == before);
    const SignalWatch watch({});
    CHECK(SignalWatch::interrupts() == 0);
}

TEST_CASE("a request that comes behind the end of a watch does not end the process") {
    { const SignalWatch watch({}); }
    REQUIRE(kill(getpid(), SIGINT) == 0); // would be the end of this test
    sigset_t pending;
    REQUIRE(sigpending(&pending) == 0);
    CHECK(sigismember(&pending, SIGINT) == 1);
    SignalWatch watch({});
    request(SIGTERM, 2); // it takes what is pending
}

TEST_CASE("the last of hold and resume is what is taken, once") {
    SignalWatch watch({});
    CHECK(watch.take_steering() == UserSteering::none);
    const auto taken = [&] {
        UserSteering asked = UserSteering::none;
        for (int i = 0; i < 5000 && asked == UserSteering::none; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            asked = watch.take_steering();
        }
        return asked;
    };
    REQUIRE(kill(getpid(), SIGUSR1) == 0);
    CHECK(taken() == UserSteering::hold);
    REQUIRE(kill(getpid(), SIGUSR2) == 0);
    CHECK(taken() == UserSteering::resume);
    CHECK(watch.take_steering() == UserSteering::none);
    CHECK(SignalWatch::interrupts() == 0);
}

TEST_CASE("a signal that was ignored before stays ignored") {
    sigset_t hup;
    sigemptyset(&hup);
    sigaddset(&hup, SIGHUP);
    REQUIRE(pthread_sigmask(SIG_UNBLOCK, &hup, nullptr) == 0); // an earlier watch left it blocked
    const auto before = std::signal(SIGHUP, SIG_IGN);
    {
        SignalWatch watch({});
        REQUIRE(kill(getpid(), SIGHUP) == 0);
        request(SIGTERM, 1); // taken after it, if it were not ignored
        CHECK_FALSE(blocked(SIGHUP));
    }
    static_cast<void>(std::signal(SIGHUP, before));
}
