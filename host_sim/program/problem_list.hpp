// SPDX-License-Identifier: MIT
// ProblemList: what is wrong with a program, one line for each cause.
#pragma once

#include "host_sim/base/input_error.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinefeed::host {

class ProblemList {
public:
    static constexpr std::size_t most_causes = 100; ///< that are told; of further ones the places are counted

    /// @param line  of the error; 0: none
    /// @param cause  what problems of one kind share; empty: the text of the error without its place
    /// @param file  of the line: of one that is not that of the cause's first problem the name is told, too
    /// False: it is known, of a line that runs more than once.
    bool add(const InputError& error, std::uint64_t line, std::string_view cause = {}, std::string_view file = {});

    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    /// Of all places.
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    /// A line for each cause: the first problem, and where the others are.
    [[nodiscard]] std::vector<std::string> texts() const;

private:
    static constexpr std::size_t most_places = 3;

    struct Cause {
        std::string first;
        std::string file;
        std::vector<std::string> places; // of the others, the first ones
        std::uint64_t count = 0;
    };

    std::map<std::string, std::size_t, std::less<>> numbers_; // of causes
    std::vector<Cause> causes_;
    std::set<std::pair<std::string, std::size_t>> places_; // and causes
    std::uint64_t count_ = 0;
    std::uint64_t untold_ = 0;
};

} // namespace splinefeed::host
