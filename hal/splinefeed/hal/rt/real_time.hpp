// SPDX-License-Identifier: MIT
// real_time: real-time settings of a thread on Linux, and waiting for an instant with little delay.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace splinefeed::hal {

struct RealTimeSettings {
    int priority = 80;              ///< SCHED_FIFO priority, 1 to 99; 0: unchanged
    std::optional<unsigned> cpu{};  ///< processor to which the thread is bound
    std::uint32_t spin_ns = 30'000; ///< last part of each wait, which the thread spends spinning
};

/// Waits for an instant of the system clock: sleeps until spin_ns before it, then spins. Returns the time at the end of
/// the wait. [ns]
std::uint64_t wait_until_ns(std::uint64_t instant_ns, std::uint32_t spin_ns) noexcept;

/// While an object exists, the processors do not enter sleep states (/dev/cpu_dma_latency) and the process is locked in
/// memory.
class AwakeHost {
public:
    AwakeHost();
    AwakeHost(const AwakeHost&) = delete;
    AwakeHost& operator=(const AwakeHost&) = delete;
    ~AwakeHost();

    /// What the system refused and how to grant it, one clause each; empty: nothing.
    [[nodiscard]] const std::string& missing() const noexcept { return missing_; }

private:
    int latency_ = -1;
    bool locked_ = false;
    std::string missing_;
};

/// Sets priority and processor of the calling thread. Returns what the system refused, as AwakeHost::missing().
[[nodiscard]] std::string claim_real_time(const RealTimeSettings& settings);

} // namespace splinefeed::hal
