// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/short_line.hpp"

#include "splinefeed/s0_program/words/program_comment.hpp"

#include <algorithm>

namespace splinefeed::host {

// The characters behind those that were taken are left out.
void ShortLine::drop(std::size_t size) {
    const std::size_t before = dropped_.empty() ? 0 : dropped_.back().second;
    dropped_.emplace_back(short_.size(), before + size);
}

void ShortLine::take(std::string_view line, bool open_comments, std::size_t longest) {
    line_ = line;
    is_short_ = line.size() > longest;
    short_.clear();
    dropped_.clear();
    std::size_t at = 0;
    while (is_short_ && at < line.size() && line[at] != ';') { // what is behind it is a comment
        if (line[at] != '(') {
            short_ += line[at++];
            continue;
        }
        TextCursor cursor(line);
        cursor.go_to(at);
        ProgramComment comment;
        const ProgramStatus status = read_comment(cursor, open_comments, comment);
        const std::size_t end = std::min(line.find(')', at), line.size());
        const bool aborts = status.error() == ProgramError::program_aborted;
        if (!status.ok() && !aborts) { // it is wrong in the same way
            short_ += end < line.size() ? "(()" : "(";
            break;
        }
        const std::size_t text = aborts                              ? cursor.at()
                                 : comment.kind != CommentKind::none ? std::size_t{comment.text.begin}
                                                                     : at + 1;
        short_.append(line, at, text - at);
        drop(end - text);
        at = end;
    }
}

std::size_t ShortLine::place(std::size_t at) const noexcept {
    std::size_t before = 0;
    for (const auto& [from, count] : dropped_) {
        before = from <= at ? count : before;
    }
    return std::min(at + before, line_.size());
}

std::string_view ShortLine::comment(std::size_t at) const noexcept {
    const std::string_view rest = line_.substr(std::min(comment_place(at), line_.size()));
    return rest.substr(0, rest.find(')'));
}

} // namespace splinefeed::host
