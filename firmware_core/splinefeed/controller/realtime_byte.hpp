// SPDX-License-Identifier: MIT
// RealtimeByte: the bytes of a sender that act at once, wherever they stand.
#pragma once

#include <cstdint>

namespace splinefeed {

enum class RealtimeKind : std::uint8_t {
    none,          ///< a byte of a line
    nothing,       ///< no byte of a line, and it does not act
    report,        ///< the status
    full_report,   ///< the status with all that is otherwise sent now and then
    parser_report, ///< the modes
    hold,
    resume,
    reset,
    stop, ///< as reset, without a new greeting
    door,
    jog_cancel,
    single_block,     ///< switches it
    feed_override,    ///< `value`: steps in per cent; 0: back to 100
    rapids_override,  ///< `value`: per cent
    spindle_override, ///< as feed_override
    spindle_stop,     ///< stops it and starts it again, in a hold only
    flood,            ///< switches it
    mist,
};

struct RealtimeByte {
    RealtimeKind kind = RealtimeKind::none;
    std::int16_t value = 0;
};

/// What a byte means: grbl 1.1's. From 0x80 on a byte is never part of a line: 0xc0 to 0xff do nothing, so those that
/// come as UTF-8 (0xc2 0x85) act as well.
[[nodiscard]] RealtimeByte realtime_byte(std::uint8_t byte) noexcept;

} // namespace splinefeed
