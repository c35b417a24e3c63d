// SPDX-License-Identifier: MIT
#include "splinefeed/controller/realtime_byte.hpp"

namespace splinefeed {

namespace {

// In a struct: its names stay in it where sources are compiled as one.
struct RealtimeTable {
    using enum RealtimeKind;
    struct Row {
        std::uint8_t byte;
        RealtimeByte meaning;
    };
    static constexpr Row rows[] = {
        {'?', {report}},
        {'!', {hold, 0, true}},
        {'~', {resume}},
        {0x18, {reset, 0, true}},
        {0x19, {stop, 0, true}},
        {0x80, {report}},
        {0x81, {resume}},
        {0x82, {hold, 0, true}},
        {0x83, {parser_report}},
        {0x84, {door, 0, true}},
        {0x85, {jog_cancel, 0, true}},
        {0x87, {full_report}},
        {0x89, {single_block}},
        {0x90, {feed_override, 0}},
        {0x91, {feed_override, 10}},
        {0x92, {feed_override, -10}},
        {0x93, {feed_override, 1}},
        {0x94, {feed_override, -1}},
        {0x95, {rapids_override, 100}},
        {0x96, {rapids_override, 50}},
        {0x97, {rapids_override, 25}},
        {0x99, {spindle_override, 0}},
        {0x9a, {spindle_override, 10}},
        {0x9b, {spindle_override, -10}},
        {0x9c, {spindle_override, 1}},
        {0x9d, {spindle_override, -1}},
        {0x9e, {spindle_stop}},
        {0xa0, {flood}},
        {0xa1, {mist}},
    };
};

// Bytes that follow a lead byte. Those behind 0xc2 are what senders write for the bytes that act.
constexpr int following(std::uint8_t byte) noexcept {
    return byte < 0xc3 || byte > 0xf4 ? 0 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
}

} // namespace

RealtimeByte realtime_byte(std::uint8_t byte) noexcept {
    for (const RealtimeTable::Row& row : RealtimeTable::rows) {
        if (row.byte == byte) {
            return row.meaning;
        }
    }
    return {byte < 0x80 ? RealtimeKind::none : RealtimeKind::nothing};
}

RealtimeByte RealtimeBytes::take(std::uint8_t byte, bool in_comment) noexcept {
    const bool follows = follow_ > 0 && byte >= 0x80 && byte < 0xc0;
    follow_ = follows ? follow_ - 1 : following(byte);
    const RealtimeByte alone = realtime_byte(byte);
    if (follows || (in_comment && !alone.stops)) {
        return {byte < 0x80 ? RealtimeKind::none : RealtimeKind::nothing};
    }
    return alone;
}

} // namespace splinefeed
