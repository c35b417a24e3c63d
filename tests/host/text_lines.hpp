// SPDX-License-Identifier: MIT
// TextLines: a program in memory, line by line.
#pragma once

#include "host_sim/program/source_line.hpp"

#include <cstdint>
#include <sstream>
#include <string>

namespace splinefeed_test {

class TextLines final : public splinefeed::host::SourceLines {
public:
    explicit TextLines(const std::string& text) : text_(text) {}
    bool next(splinefeed::host::SourceLine& out) override {
        out.number = ++lines_;
        return static_cast<bool>(std::getline(text_, out.text));
    }

private:
    std::istringstream text_;
    std::uint64_t lines_ = 0;
};

} // namespace splinefeed_test
