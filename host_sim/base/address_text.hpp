// SPDX-License-Identifier: MIT
// AddressText: the parts of scheme://place?key=value&key=value, as they are written.
#pragma once

#include <string_view>
#include <vector>

namespace splinefeed::host {

/// Views of the text that it was split from.
struct AddressText {
    struct Setting {
        std::string_view text;  ///< "key=value"
        std::string_view key;   ///< before the first '='
        std::string_view value; ///< behind it; empty also where there is no '='
    };

    std::string_view scheme; ///< "gpio"; empty: there is no "://", and then all is the place
    std::string_view rest;   ///< all behind "://"
    std::string_view place;  ///< of it, what is before the first '?'
    std::vector<Setting> settings;
};

/// What the parts mean, and which there must be, is the caller's.
[[nodiscard]] AddressText split_address(std::string_view text);

} // namespace splinefeed::host
