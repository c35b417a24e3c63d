// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/parameter_memory.hpp"

namespace splinefeed::host {

namespace {

// Names differ neither by case nor by spaces.
std::string normalized(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c != ' ' && c != '\t') {
            out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
    }
    return out;
}

} // namespace

bool ParameterMemory::read(std::int32_t number, Decimal& out) const noexcept {
    if (number < 0 || number > largest_number || !numbered_[static_cast<std::size_t>(number)].set) {
        return false;
    }
    out = numbered_[static_cast<std::size_t>(number)].value;
    return true;
}

bool ParameterMemory::write(std::int32_t number, Decimal value) noexcept {
    if (number < 0 || number > largest_number) {
        return false;
    }
    numbered_[static_cast<std::size_t>(number)] = {value, true};
    return true;
}

bool ParameterMemory::read(std::string_view name, Decimal& out) const noexcept {
    try {
        const auto found = named_.find(normalized(name));
        if (found == named_.end()) {
            return false;
        }
        out = found->second;
        return true;
    } catch (...) { // out of memory
        return false;
    }
}

bool ParameterMemory::write(std::string_view name, Decimal value) noexcept {
    try {
        std::string key = normalized(name);
        const auto found = named_.find(key);
        if (found != named_.end()) {
            found->second = value;
        } else if (named_.size() < most_names) {
            named_.emplace(std::move(key), value);
        } else {
            return false;
        }
        return true;
    } catch (...) {
        return false;
    }
}

} // namespace splinefeed::host
