// SPDX-License-Identifier: MIT
#include "waypoints/line_parser.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace firmware {

using namespace std::string_view_literals;
using splinefeed::Corner;
using splinefeed::Decimal;
using splinefeed::TextCursor;

namespace {

Command refused(const char* error) {
    Command command;
    command.verb = Verb::invalid;
    command.error = error;
    return command;
}

int digit(char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// Takes "*hh" off the line's end: the exclusive or of all characters before it. false: it is there, and wrong.
bool take_checksum(std::string_view& line) {
    const TextCursor text(line);
    const std::size_t star = text.find('*', 0);
    if (star == line.size()) {
        return true;
    }
    unsigned sum = 0;
    for (std::size_t i = 0; i < star; ++i) {
        sum ^= static_cast<unsigned char>(line[i]);
    }
    TextCursor sign = text;
    sign.go_to(star + 1);
    const int high = digit(sign.peek());
    const int low = digit(sign.peek_second());
    line = text.part(0, star);
    return star + 3 == text.text().size() && high >= 0 && low >= 0 && static_cast<unsigned>(16 * high + low) == sum;
}

bool read_position(TextCursor& text, unsigned axes, Command& out) {
    constexpr std::int64_t most = Decimal::one << 20;
    for (unsigned k = 0; k < axes; ++k) {
        Decimal value;
        if ((k > 0 && !text.take(',')) || !read_decimal(text, value).ok() || value.raw > most || value.raw < -most) {
            return false;
        }
        out.position[k] = to_position(value);
    }
    return true;
}

Command waypoint(TextCursor text, unsigned axes) {
    Command command;
    command.verb = Verb::waypoint;
    if (!read_position(text, axes, command)) {
        return refused("a waypoint is x,y,z[,feed[,corner]] in mm and mm/s, within +-1048576 mm");
    }
    if (text.take(',') && text.peek() != ',' && !text.at_end() &&
        (!read_decimal(text, command.number).ok() || command.number.raw < 0)) {
        return refused("the feed is a number of mm/s, or empty");
    }
    if (text.take(',') && !text.at_end()) {
        command.corner = text.take('1') ? Corner::forced : text.take('0') ? Corner::forbidden : Corner::automatic;
    }
    return text.at_end() ? command : refused("the corner is 0, 1 or empty, and nothing follows it");
}

Command with(Verb verb, const TextCursor& text) {
    Command command;
    command.verb = verb;
    return text.at_end() ? command : refused("nothing may follow this word");
}

} // namespace

Command parse_line(std::string_view line, unsigned axes) noexcept {
    if (!take_checksum(line)) {
        return refused("the checksum is wrong: send the line again after an abort");
    }
    TextCursor text(line);
    const char first = text.peek();
    if (text.at_end() || first == '#' || text.take("x,y,z"sv)) {
        return {};
    }
    if ((first >= '0' && first <= '9') || first == '+' || first == '-' || first == '.') {
        return waypoint(text, axes);
    }
    if (text.take("at"sv)) {
        Command command;
        command.verb = Verb::at;
        return read_position(text, axes, command) && text.at_end() ? command : refused("at x,y,z: a position in mm");
    }
    if (text.take("feed"sv)) {
        Command command;
        command.verb = Verb::feed;
        constexpr std::int64_t most = 200 * Decimal::one;
        return read_decimal(text, command.number).ok() && command.number.raw >= 0 && command.number.raw <= most &&
                       text.at_end()
                   ? command
                   : refused("feed PERCENT: 0 to 200 of the programmed feed");
    }
    return text.take("end"sv)      ? with(Verb::end, text)
           : text.take("reset"sv)  ? with(Verb::reset, text)
           : text.take("memory"sv) ? with(Verb::memory, text)
           : text.take("stall"sv)  ? with(Verb::stall, text)
                                   : refused("known are: x,y,z[,feed[,corner]], end, at, feed, reset, memory, stall");
}

} // namespace firmware
