// SPDX-License-Identifier: MIT
// real_time: what a thread asks of Linux so that it is woken in time, and waiting for an instant.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace splinefeed::hal {

struct RealTimeSettings {
    int priority = 80;              ///< of SCHED_FIFO, 1 to 99; 0: as it is
    std::optional<unsigned> cpu{};  ///< to which the thread is bound
    std::uint32_t spin_ns = 30'000; ///< of each wait is spent spinning
};

/// By the system's clock: sleeps until so long before the instant as the thread spins, then spins. Returns when it was
/// there.
std::uint64_t wait_until_ns(std::uint64_t instant_ns, std::uint32_t spin_ns) noexcept;

/// While one lives the processors stay awake (/dev/cpu_dma_latency), and the process stays in memory.
class AwakeHost {
public:
    AwakeHost();
    AwakeHost(const AwakeHost&) = delete;
    AwakeHost& operator=(const AwakeHost&) = delete;
    ~AwakeHost();

    /// What could not be had and how to grant it, a sentence each; empty: nothing.
    [[nodiscard]] const std::string& missing() const noexcept { return missing_; }

private:
    int latency_ = -1;
    bool locked_ = false;
    std::string missing_;
};

/// For the thread that calls it: priority and processor. Returns what could not be had, as above.
[[nodiscard]] std::string claim_real_time(const RealTimeSettings& settings);

} // namespace splinefeed::hal
