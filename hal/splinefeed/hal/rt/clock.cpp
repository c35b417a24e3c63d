// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/clock.hpp"

#include "splinefeed/base/units.hpp"

#include <cerrno>
#include <ctime>
#include <thread>

namespace splinefeed::hal {

namespace {

std::uint64_t ns_of(clockid_t id) noexcept {
    timespec now{};
    clock_gettime(id, &now);
    return static_cast<std::uint64_t>(now.tv_sec) * ns_per_s + static_cast<std::uint64_t>(now.tv_nsec);
}

class SystemThread final : public ClockThread {
public:
    explicit SystemThread(std::function<void()> work) : thread_(std::move(work)) {}
    SystemThread(const SystemThread&) = delete;
    SystemThread& operator=(const SystemThread&) = delete;
    ~SystemThread() override { join_once(); }
    void join() noexcept override { join_once(); }

private:
    void join_once() noexcept {
        if (thread_.joinable()) {
            thread_.join();
        }
    }

    std::thread thread_;
};

class SystemClock final : public Clock {
public:
    [[nodiscard]] std::uint64_t now_ns() const noexcept override { return ns_of(CLOCK_MONOTONIC); }
    void sleep_until_ns(std::uint64_t instant_ns) noexcept override {
        const timespec until{static_cast<time_t>(instant_ns / ns_per_s), static_cast<long>(instant_ns % ns_per_s)};
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
        }
    }
    [[nodiscard]] std::unique_ptr<ClockThread> start(std::function<void()> work) override {
        return std::make_unique<SystemThread>(std::move(work));
    }
};

} // namespace

Clock& system_clock() noexcept {
    static SystemClock clock;
    return clock;
}

std::uint64_t thread_us() noexcept {
    return ns_of(CLOCK_THREAD_CPUTIME_ID) / ns_per_us;
}

} // namespace splinefeed::hal
