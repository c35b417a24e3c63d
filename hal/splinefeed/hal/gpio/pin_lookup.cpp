// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/pin_lookup.hpp"

#include "splinefeed/hal/base/edit_distance.hpp"

#include <algorithm>

namespace splinefeed::hal::gpio {

namespace {

std::string in_quotes(std::string_view name) {
    return std::string("'").append(name).append("'");
}

// "did you mean 'A' (line 4) or 'B' (line 6)?", at most three.
std::string nearest(std::string_view name, std::span<const std::string> names) {
    std::vector<std::pair<std::size_t, unsigned>> near; // edits, offset
    for (unsigned offset = 0; offset < names.size(); ++offset) {
        const std::size_t count = edit_distance(name, names[offset]);
        if (!names[offset].empty() && count <= std::max<std::size_t>(2, name.size() / 2) && count < name.size()) {
            near.emplace_back(count, offset);
        }
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min<std::size_t>(near.size(), 3));
    std::string text;
    for (std::size_t i = 0; i < near.size(); ++i) {
        text += i == 0 ? "did you mean " : i + 1 == near.size() ? " or " : ", ";
        text += in_quotes(names[near[i].second]) + " (line " + std::to_string(near[i].second) + ")";
    }
    return text.empty() ? text : text + "?";
}

std::vector<unsigned> lines_named(std::span<const std::string> names, const std::string& name) {
    std::vector<unsigned> found;
    for (unsigned offset = 0; offset < names.size(); ++offset) {
        if (names[offset] == name) {
            found.push_back(offset);
        }
    }
    return found;
}

unsigned by_name(const std::string& chip, std::span<const std::string> names, const std::string& name) {
    const std::vector<unsigned> found = lines_named(names, name);
    if (found.size() > 1) {
        throw GpioError(chip + " has " + std::to_string(found.size()) + " lines named " + in_quotes(name) + ", lines " +
                        std::to_string(found[0]) + " and " + std::to_string(found[1]) +
                        "; give the offset of the one that is meant");
    }
    if (!found.empty()) {
        return found[0];
    }
    std::string hint = nearest(name, names);
    if (hint.empty()) {
        const bool any = std::any_of(names.begin(), names.end(), [](const std::string& each) { return !each.empty(); });
        hint = any ? "gpioinfo lists their names" : "its lines have no names: give offsets";
    }
    throw GpioError(chip + " has no line named " + in_quotes(name) + "; " + hint);
}

unsigned by_offset(const std::string& chip, std::span<const std::string> names, const PinName& wanted) {
    const unsigned offset = *wanted.offset;
    if (offset >= names.size()) {
        throw GpioError(names.empty() ? chip + " has no lines; take another chip"
                                      : chip + " has no line " + std::to_string(offset) + "; its lines are 0 to " +
                                            std::to_string(names.size() - 1));
    }
    if (wanted.name.empty() || names[offset] == wanted.name) {
        return offset;
    }
    const std::vector<unsigned> found = lines_named(names, wanted.name);
    const std::string is = names[offset].empty() ? "has no name" : "is named " + in_quotes(names[offset]);
    throw GpioError("line " + std::to_string(offset) + " of " + chip + " " + is + ", where " + in_quotes(wanted.name) +
                    " was expected; " +
                    (found.empty() ? "correct the name, or leave it out"
                                   : "that is line " + std::to_string(found[0]) + ": correct one of both"));
}

} // namespace

std::string line_text(unsigned offset, std::string_view name) {
    const std::string number = "line " + std::to_string(offset);
    return name.empty() ? number : number + " (" + in_quotes(name) + ")";
}

std::vector<unsigned> find_lines(const std::string& chip, std::span<const std::string> names,
                                 std::span<const PinName> wanted) {
    if (wanted.empty() || wanted.size() > most_lines) {
        throw GpioError(std::to_string(wanted.size()) + " lines of " + chip + " were asked for; it must be 1 to " +
                        std::to_string(most_lines));
    }
    std::vector<unsigned> offsets;
    for (const PinName& line : wanted) {
        if (line.name.empty() && !line.offset) {
            throw GpioError("a line of " + chip + " was asked for without a name or an offset; give one of both");
        }
        const unsigned offset = line.offset ? by_offset(chip, names, line) : by_name(chip, names, line.name);
        if (std::find(offsets.begin(), offsets.end(), offset) != offsets.end()) {
            throw GpioError(line_text(offset, names[offset]) + " of " + chip +
                            " was asked for twice; each use needs a line of its own");
        }
        offsets.push_back(offset);
    }
    return offsets;
}

} // namespace splinefeed::hal::gpio
