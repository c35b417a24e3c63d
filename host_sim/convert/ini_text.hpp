// SPDX-License-Identifier: MIT
// IniText: sections with keys, as LinuxCNC's and Klipper's files have them.
#pragma once

#include "host_sim/convert/machine_sketch.hpp"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace splinefeed::host {

/// How files of a kind are written.
struct IniRules {
    bool colons = false;    ///< a key may end with : as with =
    bool continues = false; ///< a line that begins with a blank belongs to the value before it
    bool last_wins = false; ///< of a key that is there twice; else the first does
};

/// What is no key of a machine file, and what is said of it.
struct IniRest {
    std::string_view section;
    std::string_view key;
    std::string_view text;
};

class IniText {
public:
    IniText(std::string_view text, const IniRules& rules);

    /// Null: it is not there. The value has no comment behind it.
    [[nodiscard]] const SourceValue* find(std::string_view section, std::string_view key) const;
    [[nodiscard]] bool has(std::string_view section) const;
    /// Sections with their lines, by name; files that it includes are "include NAME".
    [[nodiscard]] const std::map<std::string, std::uint64_t, std::less<>>& sections() const noexcept {
        return sections_;
    }

private:
    void add(const std::string& section, std::string_view line, std::uint64_t number, const IniRules& rules);

    std::map<std::string, std::uint64_t, std::less<>> sections_;
    std::map<std::pair<std::string, std::string>, SourceValue, std::less<>> values_;
};

/// Tells the files that it includes, which are not read.
void add_includes(const IniText& ini, MachineSketch& out);

} // namespace splinefeed::host
