// SPDX-License-Identifier: MIT
#include "host_sim/program/program_parameters.hpp"

namespace splinefeed::host {

namespace {

/// Names differ neither by case nor by spaces.
std::string plain_name(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c != ' ' && c != '\t') {
            out += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
        }
    }
    return out;
}

template <class Map, class Key>
bool find_in(const Map& map, const Key& key, Decimal& out) {
    const auto found = map.find(key);
    out = found != map.end() ? found->second : Decimal{};
    return found != map.end();
}

} // namespace

const ProgramParameters::Scope& ProgramParameters::scope_of(std::int32_t number) const noexcept {
    return number <= local_numbers ? calls_.back() : program_;
}

const ProgramParameters::Scope& ProgramParameters::scope_of(const std::string& name) const noexcept {
    return !name.empty() && name.front() == '_' ? program_ : calls_.back();
}

bool ProgramParameters::read(std::int32_t number, Decimal& out) const noexcept {
    return find_in(scope_of(number).numbers, number, out);
}

bool ProgramParameters::write(std::int32_t number, Decimal value) noexcept {
    const_cast<Scope&>(scope_of(number)).numbers[number] = value;
    return true;
}

bool ProgramParameters::read(std::string_view name, Decimal& out) const noexcept {
    const std::string plain = plain_name(name);
    return find_in(scope_of(plain).names, plain, out);
}

bool ProgramParameters::write(std::string_view name, Decimal value) noexcept {
    const std::string plain = plain_name(name);
    const_cast<Scope&>(scope_of(plain)).names[plain] = value;
    return true;
}

void ProgramParameters::enter(const std::vector<Decimal>& arguments) {
    calls_.emplace_back();
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        calls_.back().numbers[static_cast<std::int32_t>(i + 1)] = arguments[i];
    }
}

void ProgramParameters::leave() {
    if (calls_.size() > 1) {
        calls_.pop_back();
    }
}

} // namespace splinefeed::host
