// SPDX-License-Identifier: MIT
#include "host_sim/base/option_word.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace splinefeed::host {

void require_word(std::string_view option, std::string_view value, std::initializer_list<std::string_view> words) {
    if (std::find(words.begin(), words.end(), value) != words.end()) {
        return;
    }
    const std::span known(words.begin(), words.size());
    const std::string_view near = nearest_name(value, known);
    throw UsageError(fmt::format("{} {}: it must be one of {}{}", option, in_quotes(value), listed(known),
                                 near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

} // namespace splinefeed::host
