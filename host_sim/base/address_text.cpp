// SPDX-License-Identifier: MIT
#include "host_sim/base/address_text.hpp"

#include <algorithm>

namespace splinefeed::host {

AddressText split_address(std::string_view text) {
    constexpr std::string_view mark = "://";
    AddressText out;
    const std::size_t colon = text.find(mark);
    if (colon != std::string_view::npos) {
        out.scheme = text.substr(0, colon);
        text.remove_prefix(colon + mark.size());
    }
    out.rest = text;
    out.place = text.substr(0, text.find('?'));
    text.remove_prefix(std::min(text.size(), out.place.size() + 1));
    while (!text.empty()) {
        const std::string_view pair = text.substr(0, text.find('&'));
        text.remove_prefix(std::min(text.size(), pair.size() + 1));
        const std::string_view key = pair.substr(0, pair.find('='));
        out.settings.push_back({pair, key, pair.substr(std::min(pair.size(), key.size() + 1))});
    }
    return out;
}

} // namespace splinefeed::host
