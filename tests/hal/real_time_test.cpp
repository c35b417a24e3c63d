// SPDX-License-Identifier: MIT
// What a process without privileges is told, and waiting.
#include "splinefeed/hal/rt/clock.hpp"
#include "splinefeed/hal/rt/real_time.hpp"
#include "support/child.hpp"
#include "support/rounds.hpp"

#include <sys/resource.h>

using namespace splinefeed::hal;

TEST_CASE("a process without privileges is told what it lacks and how to grant it") {
    const int code = splinefeed_test::exit_of([] {
        constexpr unsigned nobody = 65534;
        constexpr rlimit none{0, 0};
        static_cast<void>(setrlimit(RLIMIT_RTPRIO, &none));
        static_cast<void>(setrlimit(RLIMIT_MEMLOCK, &none));
        if (geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) {
            _exit(2);
        }
        const AwakeHost awake;
        const std::string missing = claim_real_time({.priority = 50, .cpu = 1000}) + awake.missing();
        const auto says = [&](const char* part) {
            return missing.find(part) != std::string::npos;
        };
        // AddressSanitizer makes mlockall() do nothing, and say that it did.
        const bool all = says("SCHED_FIFO") && says("CAP_SYS_NICE") &&
                         says("CAP_IPC_LOCK") != splinefeed_test::sanitized && says("processor 1000") &&
                         says("/dev/cpu_dma_latency");
        _exit(all ? 0 : 1);
    });
    CHECK(code == 0);
}

TEST_CASE("waiting is never over too soon, spinning or not") {
    for (const std::uint32_t spin_ns : {0U, 30'000U, 1'000'000U}) {
        for (const std::uint64_t ahead_ns : {0U, 1'000U, 200'000U, 2'000'000U}) {
            const std::uint64_t due = splinefeed::hal::system_clock().now_ns() + ahead_ns;
            CHECK(wait_until_ns(due, spin_ns) >= due);
        }
    }
}
