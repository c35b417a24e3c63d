// SPDX-License-Identifier: MIT
// AddressText: the parts of an address scheme://place?key=value&key=value.
#pragma once

#include <string_view>
#include <vector>

namespace splinefeed::host {

/// Views of the text that was split.
struct AddressText {
    struct Setting {
        std::string_view text;  ///< "key=value"
        std::string_view key;   ///< before the first '='
        std::string_view value; ///< after it; empty also if there is no '='
    };

    std::string_view scheme; ///< "gpio"; empty: there is no "://", and the whole text is the place
    std::string_view rest;   ///< everything after "://"
    std::string_view place;  ///< the part of it before the first '?'
    std::vector<Setting> settings;
};

/// Splits an address. The caller decides which parts must be there and what they mean.
[[nodiscard]] AddressText split_address(std::string_view text);

} // namespace splinefeed::host
