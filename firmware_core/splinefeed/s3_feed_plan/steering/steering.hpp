// SPDX-License-Identifier: MIT
// Steering: the requests of an operator to a running motion: overrides of feed and rapids, an upper limit of the feed,
// hold, resume, abort.
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

/// What an operator wants of the feed, on top of what the program says.
template <Scalar S>
struct FeedWish {
    S ratio = from_integer<S>(1);  ///< factor of the programmed feed
    S most_mm_s = largest<S>();    ///< upper limit of the feed, whatever the program and the factor say
    S rapids = from_integer<S>(1); ///< factor of the largest speed of rapids, up to 1
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
    /// Upper limit of the feed, with a resolution of 2^-16 mm/s; from 65,535 mm/s on there is none. 0 stops the motion,
    /// and so does NaN.
    void limit_feed(S mm_s) noexcept {
        const S positive = mm_s > S{} ? mm_s : S{};
        asked_most_q16_.store(positive < from_integer<S>(unlimited_mm_s) ? to_q16(positive) : unlimited_q16,
                              std::memory_order_relaxed);
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
        const std::uint32_t most_q16 = asked_most_q16_.load(std::memory_order_relaxed);
        const std::uint32_t rapids_q30 = asked_rapids_q30_.load(std::memory_order_relaxed);
        const bool hold = asked_hold_.load(std::memory_order_relaxed);
        const bool abort = asked_abort_.load(std::memory_order_relaxed);
        pending_ = pending_ || ratio_q30 != ratio_q30_ || most_q16 != most_q16_ || rapids_q30 != rapids_q30_ ||
                   hold != hold_ || abort != abort_;
        ratio_q30_ = ratio_q30;
        most_q16_ = most_q16;
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

    [[nodiscard]] FeedWish<S> wish() const noexcept {
        return {from_q30(ratio_q30_), most_q16_ == unlimited_q16 ? largest<S>() : from_q16(most_q16_),
                from_q30(rapids_q30_)};
    }
    /// Whether the motion has to come to standstill, or to stay there.
    [[nodiscard]] bool stops() const noexcept { return hold_ || abort_ || ratio_q30_ == 0 || most_q16_ == 0; }
    [[nodiscard]] bool aborts() const noexcept { return abort_; }
    /// Whether a request was taken over that the plan does not know of yet.
    [[nodiscard]] bool pending() const noexcept { return pending_; }
    void acknowledge() noexcept { pending_ = false; }

private:
    static constexpr std::uint32_t one_q30 = 1U << 30U;
    static constexpr std::int32_t unlimited_mm_s = 65535;
    static constexpr std::uint32_t unlimited_q16 = 0xFFFFFFFFU;

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

    [[nodiscard]] static std::uint32_t to_q16(S mm_s) noexcept {
        if constexpr (std::same_as<S, Fixed>) {
            return static_cast<std::uint32_t>(mm_s.raw() >> (detail::fixed_fraction_bits - 16));
        } else {
            return static_cast<std::uint32_t>(mm_s * static_cast<S>(1U << 16U));
        }
    }
    [[nodiscard]] static S from_q16(std::uint32_t mm_s) noexcept {
        if constexpr (std::same_as<S, Fixed>) {
            return Fixed::from_raw(std::int64_t{mm_s} << (detail::fixed_fraction_bits - 16));
        } else {
            return static_cast<S>(mm_s) / static_cast<S>(1U << 16U);
        }
    }

    std::uint32_t ratio_q30_ = one_q30;
    std::uint32_t most_q16_ = unlimited_q16;
    std::uint32_t rapids_q30_ = one_q30;
    std::atomic<std::uint32_t> asked_ratio_q30_{one_q30};
    std::atomic<std::uint32_t> asked_most_q16_{unlimited_q16};
    std::atomic<std::uint32_t> asked_rapids_q30_{one_q30};
    std::atomic<bool> asked_hold_{false};
    std::atomic<bool> asked_abort_{false};
    bool hold_ = false;
    bool abort_ = false;
    bool pending_ = false;
};

} // namespace splinefeed
