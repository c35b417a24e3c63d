// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/parameter_memory.hpp"

#include "splinefeed/s0_program/text/text_cursor.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

// Names differ neither by case nor by spaces.
std::string normalized(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c != ' ' && c != '\t') {
            out += lower_case(c);
        }
    }
    return out;
}

bool is_global(std::string_view key) {
    return !key.empty() && key.front() == '_';
}

} // namespace

bool ParameterMemory::read(std::string_view name, Decimal& out) const noexcept {
    try {
        const std::string key = normalized(name);
        const Names& names = is_global(key) ? global_ : named_;
        const auto found = names.find(key);
        if (found == names.end()) {
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
        Names& names = is_global(key) ? global_ : named_;
        const auto found = names.find(key);
        if (found != names.end()) {
            found->second = value;
        } else if (names.size() < most_names) {
            names.emplace(std::move(key), value);
        } else {
            return false;
        }
        return true;
    } catch (...) {
        return false;
    }
}

void ParameterMemory::forget(std::string_view name) noexcept {
    try {
        const std::string key = normalized(name);
        (is_global(key) ? global_ : named_).erase(key);
    } catch (...) { // out of memory: the name stays
    }
}

void ParameterMemory::save(std::size_t numbers) {
    const auto begin = values_.begin();
    callers_.push_back({{begin, begin + static_cast<std::ptrdiff_t>(numbers)}, std::move(named_)});
    named_.clear();
}

void ParameterMemory::enter(const std::vector<Decimal>& arguments) {
    save(local_numbers);
    std::fill_n(values_.begin(), local_numbers, Decimal{});
    std::copy_n(arguments.begin(), std::min(arguments.size(), local_numbers), values_.begin());
}

void ParameterMemory::enter_macro(const MacroLocals& arguments) {
    save(arguments.size());
    std::copy(arguments.begin(), arguments.end(), values_.begin());
}

MacroLocals ParameterMemory::locals() const noexcept {
    MacroLocals out{};
    std::copy_n(values_.begin(), out.size(), out.begin());
    return out;
}

void ParameterMemory::leave() {
    std::copy(callers_.back().numbered.begin(), callers_.back().numbered.end(), values_.begin());
    named_ = std::move(callers_.back().named);
    callers_.pop_back();
}

} // namespace splinefeed::host
