// SPDX-License-Identifier: MIT
//
// Values are looked at, printed and given back by functions that call themselves: a document as deep as the stack would
// end the process.
#include "host_sim/base/json_text.hpp"

#include "host_sim/base/input_error.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

namespace {

std::uint64_t line_at(std::string_view text, std::size_t at) {
    return static_cast<std::uint64_t>(
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())), '\n'));
}

// Brackets outside of texts. Whether they match is the parser's.
void require_shallow(std::string_view text, const std::string& file) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            i += c == '\\' ? 1U : 0U;
            quoted = c != '"';
        } else if (c == '"') {
            quoted = true;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest_json) {
                throw InputError(file, line_at(text, i),
                                 "arrays and objects are nested more than {} deep; a curve needs six "
                                 "levels",
                                 deepest_json);
            }
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

} // namespace

nlohmann::json parse_json(std::string_view text, const std::string& file, std::string_view hint) {
    require_shallow(text, file);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        const std::uint64_t line = line_at(text, error.byte == 0 ? 0 : error.byte - 1);
        if (!hint.empty()) {
            throw InputError(file, line, "not JSON; {}", hint);
        }
        // "[json.exception.parse_error.101] parse error at line 2, column 1: syntax error while parsing value - WHY"
        std::string_view why = error.what();
        const std::size_t dash = why.find(" - ");
        why.remove_prefix(dash == std::string_view::npos ? std::min(why.find(": ") + 2, why.size()) : dash + 3);
        why = why.substr(0, why.find("; last read"));
        throw InputError(file, line, "not JSON: {}", why);
    } catch (const nlohmann::json::out_of_range&) {
        throw InputError(file, 0, "a number is out of range; coordinates must lie within +-1048576 mm");
    }
}

} // namespace splinefeed::host
