// SPDX-License-Identifier: MIT
#include "host_sim/config/shipped_profiles.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/config/profile_file.hpp"

#include <fmt/format.h>
#include <vector>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

DriveProfile parsed(const ShippedProfile& shipped) {
    return parse_profile(shipped.text, fmt::format("{}.toml", shipped.name));
}

std::string_view way(StreamWay stream) {
    switch (stream) {
    case StreamWay::cyclic: return "cyclic positions";
    case StreamWay::blocks: return "blocks on the fly";
    case StreamWay::speed: return "spindle speed";
    case StreamWay::pvt: break;
    }
    return "buffered segments";
}

std::string_view wires(const LinkSettings& link) {
    return link.rtu && link.tcp ? "rtu, tcp" : link.rtu ? "rtu" : "tcp";
}

} // namespace

DriveProfile find_profile(const std::string& name_or_file) {
    constexpr std::string_view suffix = ".toml";
    if (name_or_file.size() > suffix.size() &&
        name_or_file.compare(name_or_file.size() - suffix.size(), suffix.size(), suffix) == 0) {
        return read_profile_file(name_or_file);
    }
    std::vector<std::string_view> names;
    for (const ShippedProfile& shipped : shipped_profiles()) {
        if (shipped.name == name_or_file) {
            return parsed(shipped);
        }
        names.push_back(shipped.name);
    }
    const bool file = name_or_file.find_first_of("./\\") != std::string::npos;
    throw UsageError("there is no profile {}{}{}", in_quotes(name_or_file), file ? " (a file must end in .toml)" : "",
                     suggestion(name_or_file, names));
}

std::string list_profiles() {
    std::string out = fmt::format("{:<16}{:<20}{:<10}{}\n", "profile", "streams", "wire", "drive");
    for (const ShippedProfile& shipped : shipped_profiles()) {
        const DriveProfile profile = parsed(shipped);
        out += fmt::format("{:<16}{:<20}{:<10}{}\n", profile.name, way(profile.stream), wires(profile.link),
                           profile.drive);
    }
    return out;
}

} // namespace splinefeed::host
