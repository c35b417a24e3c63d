// SPDX-License-Identifier: MIT
#include "host_sim/convert/machine_sketch.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/short_number.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::size_t rest_column = 16;

std::string text_of(const std::vector<SketchRow>& rows) {
    std::string out;
    for (const SketchRow& row : rows) {
        const std::string line = fmt::format("{} = {}", row.key, row.value);
        out += row.source.empty() ? line + "\n" : fmt::format("{:<36} # {}\n", line, printable(row.source));
    }
    return out;
}

std::string section_text(std::string_view name, const std::vector<SketchRow>& rows) {
    return rows.empty() ? std::string() : fmt::format("\n[{}]\n{}", name, text_of(rows));
}

} // namespace

const SketchRow* SketchAxis::find(std::string_view key) const {
    const auto found = std::ranges::find_if(rows, [key](const SketchRow& row) { return row.key.ends_with(key); });
    return found != rows.end() ? &*found : nullptr;
}

void MachineSketch::limit_path_by_axes() {
    const bool any_linear = std::ranges::any_of(axes, [](const SketchAxis& axis) { return !axis.rotary; });
    const SketchRow* most = nullptr;
    for (const SketchAxis& axis : axes) {
        const SketchRow* const velocity = axis.find("max_velocity_mm_s");
        if (axis.rotary != any_linear && velocity != nullptr &&
            (most == nullptr ||
             std::strtod(velocity->value.c_str(), nullptr) > std::strtod(most->value.c_str(), nullptr))) {
            most = velocity;
        }
    }
    if (most != nullptr) {
        path.insert(path.begin(), {"max_feed_mm_s", most->value, "that of the fastest axis"});
    }
}

std::string source_of(const SourceValue& value) {
    return fmt::format("line {}: {} = {}", value.line, value.name, value.text);
}

std::string plain_name(std::string_view text) {
    std::string out = printable(text);
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c == '"' || c == '\\'; }, '_');
    return out;
}

std::string name_of_source(const std::string& file) {
    return file == "-" ? "machine" : plain_name(std::filesystem::path(file).stem().string());
}

std::string machine_text(const MachineSketch& sketch) {
    std::string out = fmt::format("# Made of {} by splinefeed machine.\nname = \"{}\"\n", sketch.made_of, sketch.name);
    out += text_of(sketch.head) + section_text("path", sketch.path) + section_text("step", sketch.step) +
           section_text("spindle", sketch.spindle);
    for (const SketchAxis& axis : sketch.axes) {
        out += fmt::format("\n[[axis]]\nname = \"{}\"\n", axis.name);
        out += axis.rotary ? text_of({{"kind", "\"rotary\"", "degrees where the keys say mm"}}) : "";
        out += text_of(axis.rows);
    }
    if (!sketch.rest.empty()) {
        out += "\n# What a machine file does not say. [home.x] and inputs are of the map file of GPIO lines.\n";
    }
    for (const auto& [source, meaning] : sketch.rest) {
        const std::string said = printable(source);
        out += said.size() > rest_column ? fmt::format("# {}: {}\n", said, meaning)
                                         : fmt::format("# {:<{}} {}\n", said, rest_column, meaning);
    }
    return out;
}

} // namespace splinefeed::host
