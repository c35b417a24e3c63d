// SPDX-License-Identifier: MIT
// Steering: the requests of an operator to a running motion: overrides of feed and rapids, hold, resume, abort.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <atomic>
#include <cstdint>

namespace splinefeed {

/// How far a motion has followed its steering.
enum class Activity : std::uint8_t {
    running,  ///< moving, or ready to move, or at its end
    holding,  ///< braking for a hold or an override of 0
    held,     ///< standing, until resume() or a larger override
    aborting, ///< braking for an abort
    aborted,  ///< standing; only a new program moves the machine
};

/// Factors of the speeds that are wanted.
template <Scalar S>
struct SpeedRatios {
    S feed = from_integer<S>(1);   ///< of the programmed feed, 0 to 2
    S rapids = from_integer<S>(1); ///< of the largest speed of rapids, up to 1
};

/// The requests to a motion, and the part of them that the plan has taken over. Requests may come from another thread
/// or an interrupt, but only from one at a time. Each is a single store; poll() takes it over.
template <Scalar S>
class Steering {
public:
    /// Factor of the programmed feed, 0 to 2 (other values are limited to that range), with a resolution of 2^-30. 0
    /// stops the motion, independently of hold(); so does NaN.
    void override_feed(S ratio) noexcept {
        const S positive = ratio > S{} ? ratio : S{};
        asked_ratio_q30_.store(to_q30(smaller(positive, from_integer<S>(2))), std::memory_order_relaxed);
    }
    /// Factor of the largest speed of moves with rapid_feed, 1/128 to 1 (other values are limited to that range). They
    /// do not follow override_feed(), but for 0.
    void override_rapids(S ratio) noexcept {
        const S least = literal<S>(1.0 / 128.0);
        asked_rapids_q30_.store(to_q30(ratio > least ? smaller(ratio, from_integer<S>(1)) : least),
                                std::memory_order_relaxed);
    }
    void hold() noexcept { asked_hold_.store(true, std::memory_order_relaxed); }
    void resume() noexcept { asked_hold_.store(false, std::memory_order_relaxed); }
    void abort() noexcept { asked_abort_.store(true, std::memory_order_relaxed); }

    /// Takes over the requests. Only the planning side calls this and the functions below. Between two calls nothing
    /// changes.
    void poll() noexcept {
        const std::uint32_t ratio_q30 = asked_ratio_q30_.load(std::memory_order_relaxed);
        const std::uint32_t rapids_q30 = asked_rapids_q30_.load(std::memory_order_relaxed);
        const bool hold = asked_hold_.load(std::memory_order_relaxed);
        const bool abort = asked_abort_.load(std::memory_order_relaxed);
        pending_ = pending_ || ratio_q30 != ratio_q30_ || rapids_q30 != rapids_q30_ || hold != hold_ || abort != abort_;
        ratio_q30_ = ratio_q30;
        rapids_q30_ = rapids_q30;
        hold_ = hold;
        abort_ = abort;
    }
    /// For a new program: ends an abort. The overrides stay, and so does a hold: only resume() ends it.
    void start() noexcept {
        asked_abort_.store(false, std::memory_order_relaxed);
        poll();
        pending_ = false;
    }

    [[nodiscard]] SpeedRatios<S> ratios() const noexcept { return {from_q30(ratio_q30_), from_q30(rapids_q30_)}; }
    /// Whether the motion has to come to standstill, or to stay there.
    [[nodiscard]] bool stops() const noexcept { return hold_ || abort_ || ratio_q30_ == 0; }
    [[nodiscard]] bool aborts() const noexcept { return abort_; }
    /// Whether a request was taken over that the plan does not know of yet.
    [[nodiscard]] bool pending() const noexcept { return pending_; }
    void acknowledge() noexcept { pending_ = false; }

private:
    static constexpr std::uint32_t one_q30 = 1U << 30U;

    [[nodiscard]] static std::uint32_t to_q30(S ratio) noexcept {
        if constexpr (std::same_as<S, Fixed>) {
            return static_cast<std::uint32_t>(ratio.raw() >> (detail::fixed_fraction_bits - 30));
        } else {
            return static_cast<std::uint32_t>(ratio * static_cast<S>(one_q30));
        }
    }
    [[nodiscard]] static S from_q30(std::uint32_t ratio) noexcept {
        if constexpr (std::same_as<S, Fixed>) {
            return Fixed::from_raw(std::int64_t{ratio} << (detail::fixed_fraction_bits - 30));
        } else {
            return static_cast<S>(ratio) / static_cast<S>(one_q30);
        }
    }

    std::uint32_t ratio_q30_ = one_q30;
    std::uint32_t rapids_q30_ = one_q30;
    std::atomic<std::uint32_t> asked_ratio_q30_{one_q30};
    std::atomic<std::uint32_t> asked_rapids_q30_{one_q30};
    std::atomic<bool> asked_hold_{false};
    std::atomic<bool> asked_abort_{false};
    bool hold_ = false;
    bool abort_ = false;
    bool pending_ = false;
};

} // namespace splinefeed
