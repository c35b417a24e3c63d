// SPDX-License-Identifier: MIT
// LeftOutList: what a program has that is not followed, by word, with its first line.
#pragma once

#include "splinefeed/s0_program/dialects/program_settings.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

class LeftOutList final : public LeftOutWords {
public:
    static constexpr std::size_t most = 1000; ///< different ones that are counted apart

    struct Entry {
        std::string what; ///< M104, E for every E, or the first word of a line
        std::uint64_t count = 0;
        std::uint64_t line = 0;
    };

    /// The program is read from its beginning.
    void begin() noexcept;
    void at_line(std::uint64_t line) noexcept { line_ = line; }
    void add(std::string_view word) noexcept override;
    /// A whole line. @param first_word  of it
    void add_line(std::string_view first_word) noexcept;
    /// In the order of their first lines.
    [[nodiscard]] std::vector<Entry> entries() const;

private:
    std::map<std::string, std::size_t, std::less<>> numbers_;
    std::vector<Entry> entries_;
    std::uint64_t line_ = 0;
};

} // namespace splinefeed::host
