// SPDX-License-Identifier: MIT
#include "host_sim/base/standard_output.hpp"

#include "host_sim/base/output_file.hpp"

#include <cstdio>
#include <fmt/format.h>

namespace splinefeed::host {

void print_whole(std::string_view text, std::string_view what) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw OutputError(
            fmt::format("standard output: {} cannot be written; keep its reader running to the end", what));
    }
}

} // namespace splinefeed::host
