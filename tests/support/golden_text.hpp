// SPDX-License-Identifier: MIT
//
// Texts as they are kept in files: what differs fails, and SPLINEFEED_WRITE_GOLDEN=1 writes the file anew.
#pragma once

#include "support/catch.hpp"
#include "support/places.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace splinefeed_test {

inline std::vector<std::string> split_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// The lines that `to` has not of `from`, and those that it has beyond it, in order.
inline std::string changed_lines(const std::string& from, const std::string& to) {
    const auto one_way = [](const std::string& mark, std::vector<std::string> lines, const std::string& known) {
        for (const std::string& line : split_lines(known)) {
            const auto at = std::find(lines.begin(), lines.end(), line);
            if (at != lines.end()) {
                lines.erase(at);
            }
        }
        std::string out;
        for (const std::string& line : lines) {
            out += mark + line + "\n";
        }
        return out;
    };
    return one_way("-", split_lines(from), to) + one_way("+", split_lines(to), from);
}

/// Requires that a file of tests/ has this text.
inline void require_golden(const std::string& file, const std::string& text) {
    const std::string path = splinefeed::test::source_folder() + "/tests/" + file;
    if (std::getenv("SPLINEFEED_WRITE_GOLDEN") != nullptr) {
        std::ofstream(path, std::ios::binary) << text;
    }
    std::ifstream in(path, std::ios::binary);
    const std::string kept{std::istreambuf_iterator<char>(in), {}};
    INFO(file << " (- as it is there, + now):\n" << changed_lines(kept, text));
    REQUIRE(kept == text);
}

} // namespace splinefeed_test
