// SPDX-License-Identifier: MIT
// ProblemList: what is wrong with a program, each problem once.
#pragma once

#include "host_sim/base/input_error.hpp"

#include <set>
#include <string>
#include <vector>

namespace splinefeed::host {

class ProblemList {
public:
    /// @param into  null: the first problem ends the reading; else it gets all of them, and must outlive this
    explicit ProblemList(std::vector<std::string>* into) noexcept : into_(into) {}

    /// Throws the error, or adds it. False: it is known, of a line that runs more than once.
    bool add(const InputError& error);

private:
    std::vector<std::string>* into_;
    std::set<std::string, std::less<>> known_;
};

} // namespace splinefeed::host
