// SPDX-License-Identifier: MIT
#include "splinefeed/controller/line_store.hpp"

#include "splinefeed/base/assertion.hpp"

namespace splinefeed {

bool LineStore::put(char c) noexcept {
    lost_ = lost_ || used_ == memory_.size();
    if (!lost_) {
        memory_[(first_ + used_++) % memory_.size()] = c;
        ++partial_;
    }
    return !lost_;
}

void LineStore::note_comment(char c) noexcept {
    if (comment_ == '\0' && (c == '(' || c == ';')) {
        comment_ = c;
        cut_ = partial_ >= most_comment;
    }
}

bool LineStore::add(char c) noexcept {
    const bool second = c == '\n' && after_return_;
    after_return_ = false;
    if (second) {
        return true;
    }
    if (c == '\r' || c == '\n') {
        const bool kept = end_line();
        after_return_ = c == '\r';
        return kept;
    }
    note_comment(c);
    const bool closes = comment_ == '(' && c == ')';
    const bool spare = partial_ < most_comment;
    bool kept = true;
    if (comment_ != '\0') {
        kept = cut_ || !(spare || closes) || put(c);
    } else if (spare || (c != ' ' && c != '\t')) {
        too_long_ = too_long_ || partial_ == StoredLine::longest;
        kept = too_long_ || put(c);
    }
    comment_ = closes ? '\0' : comment_;
    return kept;
}

bool LineStore::end_line() noexcept {
    comment_ = '\0';
    if (too_long_) {
        used_ -= partial_;
        partial_ = 0;
        put(too_long_mark);
    }
    too_long_ = false;
    if (!put('\n')) {
        drop_partial();
        return false;
    }
    partial_ = 0;
    ++lines_;
    return true;
}

void LineStore::drop_partial() noexcept {
    used_ -= partial_;
    partial_ = 0;
    comment_ = '\0';
    too_long_ = lost_ = after_return_ = false;
}

void LineStore::clear() noexcept {
    used_ = partial_ = lines_ = 0;
    drop_partial();
}

bool LineStore::begins(std::string_view word) const noexcept {
    std::size_t matched = 0;
    for (std::size_t i = 0; matched < word.size() && at(i) != '\n'; ++i) {
        const char c = at(i);
        if (c == ' ' || c == '\t') {
            continue;
        }
        if ((c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c) != word[matched]) {
            return false;
        }
        ++matched;
    }
    return matched == word.size();
}

void LineStore::take(StoredLine& out) noexcept {
    SPLINEFEED_ASSERT(lines_ > 0);
    out.size = 0;
    while (at(0) != '\n') {
        out.text[out.size++] = at(0);
        first_ = (first_ + 1) % memory_.size();
        --used_;
    }
    first_ = (first_ + 1) % memory_.size();
    --used_;
    --lines_;
    out.too_long = out.size == 1 && out.text[0] == too_long_mark;
    out.size = out.too_long ? 0 : out.size;
}

} // namespace splinefeed
