// SPDX-License-Identifier: MIT
#include "splinefeed/hal/rt/real_time.hpp"

#include "splinefeed/hal/rt/clock.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

namespace splinefeed::hal {

namespace {

std::string reason(int error) {
    return std::strerror(error); // NOLINT(concurrency-mt-unsafe): before threads run
}

} // namespace

std::uint64_t wait_until_ns(std::uint64_t instant_ns, std::uint32_t spin_ns) noexcept {
    Clock& clock = system_clock();
    clock.sleep_until_ns(instant_ns - std::min<std::uint64_t>(spin_ns, instant_ns));
    std::uint64_t now = clock.now_ns();
    while (now < instant_ns) {
        now = clock.now_ns();
    }
    return now;
}

AwakeHost::AwakeHost() {
    if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) {
        locked_ = true;
    } else {
        missing_ +=
            "the process cannot lock its memory (" + reason(errno) + "): grant CAP_IPC_LOCK, or raise `ulimit -l`; ";
    }
    constexpr std::int32_t longest_us = 0;
    latency_ = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
    if (latency_ < 0 || write(latency_, &longest_us, sizeof longest_us) != sizeof longest_us) {
        missing_ += "the processors may enter sleep states (/dev/cpu_dma_latency: " + reason(errno) +
                    "): give your user write permission, or run as root; ";
    }
}

AwakeHost::~AwakeHost() {
    if (latency_ >= 0) {
        close(latency_);
    }
    if (locked_) {
        munlockall();
    }
}

std::string claim_real_time(const RealTimeSettings& settings) {
    std::string missing;
    const sched_param param{.sched_priority = settings.priority};
    if (const int error = settings.priority > 0 ? pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) : 0;
        error != 0) {
        missing += "its thread cannot get real-time priority (SCHED_FIFO: " + reason(error) +
                   "): grant CAP_SYS_NICE, or rtprio in /etc/security/limits.conf; ";
    }
    if (settings.cpu) {
        cpu_set_t set;
        CPU_ZERO(&set);
        CPU_SET(*settings.cpu, &set);
        if (const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set); error != 0) {
            missing += "its thread cannot be bound to processor " + std::to_string(*settings.cpu) + " (" +
                       reason(error) + "); ";
        }
    }
    return missing;
}

} // namespace splinefeed::hal
