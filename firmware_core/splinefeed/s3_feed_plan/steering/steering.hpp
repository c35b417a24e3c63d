// SPDX-License-Identifier: MIT
// Steering: what an operator asks of a motion that runs: feed override, hold, resume, abort.
#pragma once

#include "splinefeed/number/scalar.hpp"

#include <cstdint>

namespace splinefeed {

/// What a motion does about its steering.
enum class Activity : std::uint8_t {
    running,  ///< or ready to, or at its end
    holding,  ///< braking for a hold or an override of 0
    held,     ///< standing, until resume() or a larger override
    aborting, ///< braking for an abort
    aborted,  ///< standing; nothing comes but a new program
};

/// The requests, and whether one of them is news to the plan.
template <Scalar S>
class Steering {
public:
    /// Factor of the programmed feed, 0 to 2 (taken as the nearest of these). 0 stops, like a hold of its own.
    void override_feed(S ratio) noexcept {
        ratio = smaller(larger(ratio, S{}), from_integer<S>(2));
        news_ = news_ || !(ratio == ratio_);
        ratio_ = ratio;
    }
    void hold() noexcept {
        news_ = news_ || !hold_;
        hold_ = true;
    }
    void resume() noexcept {
        news_ = news_ || hold_;
        hold_ = false;
    }
    void abort() noexcept {
        news_ = news_ || !abort_;
        abort_ = true;
    }
    /// For a new program: no longer aborted. The override stays, and so does a hold: only resume() ends it.
    void start() noexcept { abort_ = news_ = false; }

    [[nodiscard]] S ratio() const noexcept { return ratio_; }
    /// The motion is to come to rest, or to stay there.
    [[nodiscard]] bool stops() const noexcept { return hold_ || abort_ || !(ratio_ > S{}); }
    [[nodiscard]] bool aborts() const noexcept { return abort_; }
    [[nodiscard]] bool news() const noexcept { return news_; }
    void taken() noexcept { news_ = false; }

private:
    S ratio_ = from_integer<S>(1);
    bool hold_ = false;
    bool abort_ = false;
    bool news_ = false;
};

} // namespace splinefeed
