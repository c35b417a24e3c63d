// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/line_checksum.hpp"

#include "splinefeed/s0_program/text/decimal_text.hpp"

namespace splinefeed {

ProgramStatus read_checksum(TextCursor& text) noexcept {
    unsigned sum = 0;
    for (const char c : text.part(0, text.at())) {
        sum ^= static_cast<unsigned char>(c);
    }
    const TextCursor start = text;
    text.step();
    Decimal stated;
    std::int32_t number = 0;
    const ProgramStatus status = read_decimal(text, stated);
    if (!status.ok() || !to_integer(stated, number) || number != static_cast<std::int32_t>(sum)) {
        text = start;
        return ProgramError::checksum_wrong;
    }
    return text.at_end() || text.peek() == ';' ? ProgramStatus{} : ProgramStatus(ProgramError::character_invalid);
}

} // namespace splinefeed
