// SPDX-License-Identifier: MIT
#include "host_sim/convert/ini_text.hpp"

#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

/// A # or ; at the begin, or behind a blank.
std::string_view without_comment(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool marks = text[at] == '#' || text[at] == ';';
        if (marks && (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t')) {
            return trimmed(text.substr(0, at));
        }
    }
    return trimmed(text);
}

} // namespace

IniText::IniText(std::string_view text, const IniRules& rules) {
    std::string section;
    std::uint64_t number = 0;
    for (const std::string_view line : split(text, '\n')) {
        ++number;
        if (line.starts_with("#INCLUDE")) { // LinuxCNC's
            sections_.emplace(fmt::format("include {}", trimmed(line.substr(8))), number);
        }
        const std::string_view content = without_comment(line);
        const bool is_rest = rules.continues && !line.empty() && (line.front() == ' ' || line.front() == '\t');
        if (content.empty() || is_rest) {
            continue;
        }
        if (content.front() == '[' && content.find(']') != std::string_view::npos) {
            section = trimmed(content.substr(1, content.find(']') - 1));
            sections_.emplace(section, number);
        } else {
            add(section, content, number, rules);
        }
    }
}

void IniText::add(const std::string& section, std::string_view line, std::uint64_t number, const IniRules& rules) {
    const std::size_t end = line.find_first_of(rules.colons ? ":=" : "=");
    if (end == std::string_view::npos) {
        return;
    }
    const std::string key(trimmed(line.substr(0, end)));
    SourceValue value{fmt::format("[{}] {}", section, key), std::string(trimmed(line.substr(end + 1))), number};
    const auto [place, is_new] = values_.emplace(std::pair(section, key), value);
    if (!is_new && rules.last_wins) {
        place->second = std::move(value);
    }
}

const SourceValue* IniText::find(std::string_view section, std::string_view key) const {
    const auto found = values_.find(std::pair(std::string(section), std::string(key)));
    return found != values_.end() ? &found->second : nullptr;
}

void add_includes(const IniText& ini, MachineSketch& out) {
    for (const auto& [section, line] : ini.sections()) {
        if (section.starts_with("include ")) {
            out.rest.emplace_back(fmt::format("line {}: {}", line, section), "what stands there is not read");
        }
    }
}

bool IniText::has(std::string_view section) const {
    return sections_.find(section) != sections_.end();
}

} // namespace splinefeed::host
