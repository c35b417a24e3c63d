// SPDX-License-Identifier: MIT
#include "host_sim/convert/marlin_machine.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace splinefeed::host {

namespace {

constexpr std::string_view marlin_letters = "XYZABC";
constexpr std::string_view marlin_codes[] = {"M92", "M203", "M201", "M204", "M205"};

/// What is no key of a machine file.
struct MarlinRest {
    std::string_view word;
    std::string_view text;
};
constexpr std::string_view no_jump =
    "a jump of the velocity, which does not exist here; max_jerk_mm_s3 is another thing";
constexpr MarlinRest marlin_rest[] = {
    {"M203 E", "the extruder is no axis; --ignore E leaves its words out"},
    {"M204 R", "of retractions"},
    {"M204 T", "of travel moves; the axes have that of printing moves"},
    {"M205 J", "corners are rounded within default_tolerance_mm of [path], which may be the same"},
    {"M205 X", no_jump},
    {"M205 Y", no_jump},
    {"M205 Z", no_jump},
};

/// Behind the code: the words up to a comment. Nothing: it is not there.
std::optional<std::string_view> marlin_words(std::string_view line, std::string_view code) {
    for (std::size_t at = line.find(code); at != std::string_view::npos; at = line.find(code, at + 1)) {
        const bool begins = at == 0 || line[at - 1] == ' ' || line[at - 1] == ':' || line[at - 1] == '\t';
        const std::string_view behind = line.substr(at + code.size());
        if (begins && (behind.empty() || std::string_view(" \t\r;").find(behind.front()) != std::string_view::npos)) {
            return trimmed(behind.substr(0, behind.find(';')));
        }
    }
    return std::nullopt;
}

class MarlinReader {
public:
    MarlinReader(std::string_view text, const std::string& file) : file_(file) {
        std::uint64_t number = 0;
        for (const std::string_view line : split(text, '\n')) {
            ++number;
            inches_ = inches_ || marlin_words(line, "G20").has_value();
            for (const std::string_view code : marlin_codes) {
                const std::string_view words = marlin_words(line, code).value_or("");
                for (const std::string_view word : split(words, ' ')) {
                    add(code, word, number);
                }
            }
        }
    }

    [[nodiscard]] MachineSketch sketch() const {
        MachineSketch out;
        out.made_of = "an answer to M503";
        out.name = name_of_source(file_);
        for (const char letter : marlin_letters) {
            if (find("M92", letter) != nullptr || find("M203", letter) != nullptr) {
                out.axes.push_back(axis(letter));
            }
        }
        if (out.axes.empty()) {
            throw InputError(file_, 0,
                             "there is no line like M203 X300 Y300 Z5; save what the controller answers to M503");
        }
        out.limit_path_by_axes();
        for (const MarlinRest& rest : marlin_rest) {
            const auto found = words_.find(rest.word);
            if (found != words_.end()) {
                out.rest.emplace_back(source_of(found->second), rest.text);
            }
        }
        return out;
    }

private:
    void add(std::string_view code, std::string_view word, std::uint64_t line) {
        if (word.size() < 2) {
            return;
        }
        SourceValue value{fmt::format("{} {}", code, word.front()), std::string(trimmed(word.substr(1))), line};
        const auto [place, is_new] = words_.emplace(value.name, value);
        const SourceValue& known = place->second;
        if (!is_new && known.text != value.text) {
            throw InputError(file_, line, "{} is {}, and {} in line {}; leave in what is true", value.name,
                             in_quotes(value.text), in_quotes(known.text), known.line);
        }
    }

    [[nodiscard]] const SourceValue* find(std::string_view code, char letter) const {
        const auto found = words_.find(fmt::format("{} {}", code, letter));
        return found != words_.end() ? &found->second : nullptr;
    }

    [[nodiscard]] SketchAxis axis(char letter) const {
        const std::size_t place = marlin_letters.find(letter);
        SketchAxis out{std::string(1, static_cast<char>(letter - 'A' + 'a')), place >= 3, {}};
        const double unit = inches_ && !out.rotary ? 25.4 : 1.0;
        const auto add = [&](std::string_view key, const SourceValue& value, double factor) {
            const double number = in_range(file_, value, source_number(file_, value) * factor, key, axis_range(key));
            out.rows.push_back({std::string(key), short_number(number), source_of(value)});
        };
        if (const SourceValue* const steps = find("M92", letter)) {
            add("steps_per_mm", *steps, 1.0 / unit);
        }
        add("max_velocity_mm_s", needed("M203", letter), unit);
        add("max_acceleration_mm_s2", lowest_acceleration(letter), unit);
        return out;
    }

    [[nodiscard]] const SourceValue& needed(std::string_view code, char letter) const {
        const SourceValue* const value = find(code, letter);
        if (value == nullptr) {
            throw InputError(file_, 0, "there is no {} {}; save all that the controller answers to M503", code, letter);
        }
        return *value;
    }

    /// Of the axis, or of printing moves: P, in old versions S.
    [[nodiscard]] const SourceValue& lowest_acceleration(char letter) const {
        const SourceValue* lowest = find("M201", letter);
        const SourceValue* const printing = find("M204", 'P') != nullptr ? find("M204", 'P') : find("M204", 'S');
        if (printing != nullptr &&
            (lowest == nullptr || source_number(file_, *printing) < source_number(file_, *lowest))) {
            lowest = printing;
        }
        return lowest != nullptr ? *lowest : needed("M201", letter);
    }

    const std::string& file_;
    std::map<std::string, SourceValue, std::less<>> words_{};
    bool inches_ = false;
};

} // namespace

bool is_marlin_listing(std::string_view text) {
    bool steps = false;
    bool speeds = false;
    for (const std::string_view line : split(text, '\n')) {
        steps = steps || marlin_words(line, "M92").has_value();
        speeds = speeds || marlin_words(line, "M203").has_value();
    }
    return steps && speeds;
}

MachineSketch marlin_sketch(std::string_view text, const std::string& file) {
    return MarlinReader(text, file).sketch();
}

} // namespace splinefeed::host
