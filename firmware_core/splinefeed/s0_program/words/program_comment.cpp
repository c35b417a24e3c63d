// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/program_comment.hpp"

namespace splinefeed {

using namespace std::string_view_literals; // without strlen

ProgramStatus read_comment(TextCursor& text, bool open, ProgramComment& out) noexcept {
    struct Row {
        std::string_view word;
        CommentKind kind;
    };
    constexpr Row rows[] = {
        {"msg,"sv, CommentKind::message}, {"print,"sv, CommentKind::print}, {"debug,"sv, CommentKind::debug}};
    const std::string_view line = text.text();
    const std::size_t begin = text.at() + 1;
    std::size_t end = begin;
    while (end < line.size() && line[end] != ')') {
        if (line[end] == '(' && !open) {
            text.go_to(end);
            return ProgramError::comment_nested;
        }
        ++end;
    }
    if (end == line.size() && !open) {
        return ProgramError::comment_not_closed;
    }
    TextCursor inside(text.part(begin, end));
    if (inside.take("abort,"sv)) { // it is in effect before the other words of its line
        text.go_to(begin + inside.at());
        return ProgramError::program_aborted;
    }
    for (const Row& row : rows) {
        if (inside.take(row.word)) {
            out = {row.kind, TextCursor::place(begin + inside.at(), end)};
        }
    }
    text.go_to(end + 1);
    return {};
}

} // namespace splinefeed
