// SPDX-License-Identifier: MIT
// Overrides: the operator's percentages.
#pragma once

#include "splinefeed/controller/realtime_byte.hpp"

namespace splinefeed {

struct Overrides {
    static constexpr int least = 10;
    static constexpr int most = 200;
    int feed = 100;
    int rapids = 100;
    int spindle = 100;

    /// false: the byte is none of an override, or nothing changes
    constexpr bool obey(RealtimeByte byte) noexcept {
        const Overrides before = *this;
        switch (byte.kind) {
        case RealtimeKind::feed_override: feed = stepped(feed, byte.value); break;
        case RealtimeKind::spindle_override: spindle = stepped(spindle, byte.value); break;
        case RealtimeKind::rapids_override: rapids = byte.value; break;
        default: break;
        }
        return feed != before.feed || rapids != before.rapids || spindle != before.spindle;
    }

private:
    [[nodiscard]] static constexpr int stepped(int percent, int step) noexcept {
        const int next = step == 0 ? 100 : percent + step;
        return next < least ? least : next > most ? most : next;
    }
};

} // namespace splinefeed
