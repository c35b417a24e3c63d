// SPDX-License-Identifier: MIT
#include "host_sim/program/left_out_list.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

namespace splinefeed::host {

void LeftOutList::begin() noexcept {
    numbers_.clear();
    entries_.clear();
    line_ = 0;
}

void LeftOutList::add(std::string_view word) noexcept {
    std::string key;
    const char letter = word.empty() ? '\0' : upper_case(word.front());
    for (const char c : word.substr(0, letter == 'G' || letter == 'M' ? word.size() : 1)) {
        if (c != ' ' && c != '\t' && key.size() < 12) { // within the string itself
            key += upper_case(c);
        }
    }
    add_line(key);
}

void LeftOutList::add_line(std::string_view first_word) noexcept {
    try {
        auto found = numbers_.find(first_word);
        if (found == numbers_.end()) {
            if (entries_.size() == most) {
                return;
            }
            found = numbers_.emplace(first_word, entries_.size()).first;
            entries_.push_back({std::string(first_word), 0, line_});
        }
        ++entries_[found->second].count;
    } catch (...) { // out of memory: it is not counted
        return;
    }
}

std::vector<LeftOutList::Entry> LeftOutList::entries() const {
    return entries_;
}

} // namespace splinefeed::host
