// SPDX-License-Identifier: MIT
#include "host_sim/base/signal_watch.hpp"

#include "support/catch.hpp"

#include <chrono>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

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
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGINT}) {
        request(signal, ++count);
    }
    watch.supervise();
    CHECK(at_once == 6);
    request(SIGINT, 7);
    CHECK(at_once == 6);
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
    SignalWatch watch({}); // nothing is called at once: it supervises
    CHECK(watch.take_steering() == UserSteering::none);
    const auto taken = [&] {
        UserSteering asked = UserSteering::none;
        for (int i = 0; i < 5000 && asked == UserSteering::none; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            asked = watch.take_steering();
        }
        return asked;
    };
    // A process that moves a machine is not stopped by any of them.
    for (const int stop : {SIGTTIN, SIGTTOU}) {
        REQUIRE(kill(getpid(), stop) == 0);
    }
    const std::pair<int, UserSteering> all[] = {{SIGUSR1, UserSteering::hold},
                                                {SIGUSR2, UserSteering::resume},
                                                {SIGTSTP, UserSteering::suspend},
                                                {SIGCONT, UserSteering::held}};
    for (const auto& [signal, asked] : all) {
        REQUIRE(kill(getpid(), signal) == 0);
        CHECK(taken() == asked);
    }
    CHECK(watch.take_steering() == UserSteering::none);
    CHECK(SignalWatch::interrupts() == 0);
    // SIGCONT came behind SIGTSTP, or the end was asked for: nobody would continue the process again.
    CHECK_FALSE(SignalWatch::suspend_now());
    REQUIRE(kill(getpid(), SIGTSTP) == 0);
    CHECK(taken() == UserSteering::suspend);
    REQUIRE(kill(getpid(), SIGTERM) == 0); // pending or counted
    CHECK_FALSE(SignalWatch::suspend_now());
}

TEST_CASE("as long as nothing moves, Ctrl-Z stops the process at once") {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        alarm(20);
        SignalWatch watch([] {});
        static_cast<void>(kill(getpid(), SIGTSTP));
        for (int i = 0; i < 5000 && watch.take_steering() == UserSteering::none; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        _exit(1);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, WUNTRACED) == child);
    CHECK(WIFSTOPPED(status));
    static_cast<void>(kill(child, SIGKILL));
    REQUIRE(waitpid(child, &status, 0) == child);
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
