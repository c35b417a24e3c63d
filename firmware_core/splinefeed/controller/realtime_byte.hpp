// SPDX-License-Identifier: MIT
// RealtimeByte: the bytes of a sender that act at once.
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
    bool stops = false; ///< it acts within a comment, too
};

/// What a byte that stands alone means: grbl 1.1's. From 0x80 on none is ever part of a line.
[[nodiscard]] RealtimeByte realtime_byte(std::uint8_t byte) noexcept;

/// Tells the bytes that act from text, as they come. Text is UTF-8: what follows a lead byte from 0xc3 on belongs to
/// its character and does nothing. Alone, or behind 0xc2 (0xc2 0x85), such a byte acts.
class RealtimeBytes {
public:
    /// What the next byte means. @param in_comment  it stands in a comment
    [[nodiscard]] RealtimeByte take(std::uint8_t byte, bool in_comment) noexcept;
    /// Another sender begins.
    void restart() noexcept { follow_ = 0; }

private:
    int follow_ = 0; // bytes of the present character that may come
};

} // namespace splinefeed
