// SPDX-License-Identifier: MIT
#include "host_sim/output/element_writer.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::string_view axis_letters = "xyzabc";

const char* mode_name(PathMode mode) {
    switch (mode) {
    case PathMode::continuous: return "continuous";
    case PathMode::exact_path: return "exact_path";
    case PathMode::exact_stop: return "exact_stop";
    }
    return "continuous";
}

std::string line_member(std::uint64_t line) {
    return line > 0 ? fmt::format(", \"line_number\": {}", line) : std::string();
}

} // namespace

ElementWriter::ElementWriter(OutputFile& file, const MachineDescription& machine) : file_(&file) {
    for (std::size_t i = 0; i < axis_letters.size(); ++i) {
        index_[i] = -1;
        for (int k = 0; k < machine.settings.axes; ++k) {
            if (machine.axis_name[static_cast<unsigned>(k)] == axis_letters.substr(i, 1)) {
                index_[i] = k;
                count_ = std::max(count_, i + 1);
            }
        }
    }
    file.append("{\"elements\": [");
}

std::string ElementWriter::point(const PerAxis<Position>& position, std::size_t count) const {
    std::string text = "[";
    for (std::size_t i = 0; i < count; ++i) {
        const double value = index_[i] < 0 ? 0.0 : to_mm(position[static_cast<unsigned>(index_[i])]);
        text += fmt::format("{}{}", i > 0 ? ", " : "", value);
    }
    return text + "]";
}

void ElementWriter::shape(const PathElement<double>& element) {
    if (element.shape == MoveShape::arc) {
        file_->format(R"("type": "arc", "centre": {}, "axis": [{}, {}, {}], "angle": {})", point(element.arc.centre, 3),
                      element.arc.normal[0], element.arc.normal[1], element.arc.normal[2], element.arc.sweep_rad);
        return;
    }
    if (element.shape == MoveShape::line) {
        file_->append(R"("type": "line")");
        return;
    }
    file_->append(R"("type": "bezier", "control_points": [)");
    const auto last = static_cast<unsigned>(element.bezier.degree);
    for (unsigned i = 0; i <= last; ++i) {
        std::string text;
        for (std::size_t j = 0; j < 3; ++j) {
            const auto k = static_cast<unsigned>(std::max(index_[j], 0));
            const double from = to_mm(here_[k]);
            const double value = index_[j] < 0 ? 0.0
                                 : i == 0      ? from
                                 : i == last   ? to_mm(element.to[k])
                                               : from + element.bezier.points[k][i] / chord_units_per_mm;
            text += fmt::format("{}{}", j > 0 ? ", " : "", value);
        }
        file_->format("{}[{}]", i > 0 ? ", " : "", text);
    }
    file_->append("]");
}

void ElementWriter::move(const Move& move) {
    const PathElement<double>& element = *move.element;
    file_->append(elements_ > 0 ? ",\n{" : "\n{");
    shape(element);
    file_->format(R"(, "from": {}, "to": {})", point(here_, count_), point(element.to, count_));
    if (move.rapid) {
        file_->append(R"(, "rapid": true)");
    } else if (move.feed_mm_s > 0.0) {
        file_->format(R"(, "feed_mm_s": {})", move.feed_mm_s);
    }
    file_->format(R"(, "mode": "{}", "tolerance_mm": {})", mode_name(element.mode), element.tolerance_mm);
    if (element.chain_tolerance_mm < element.tolerance_mm) {
        file_->format(R"(, "chain_tolerance_mm": {})", element.chain_tolerance_mm);
    }
    file_->format("{}}}", line_member(move.line));
    here_ = element.to;
    ++elements_;
}

void ElementWriter::dwell(double seconds, std::uint64_t line) {
    dwells_ += fmt::format("{}{{\"after_element\": {}, \"seconds\": {}{}}}", dwells_.empty() ? "\n" : ",\n", elements_,
                           seconds, line_member(line));
}

void ElementWriter::event(const ProgramAction& action, std::uint64_t line) {
    Json object{{"after_element", elements_}, {"what", action_name(action.kind)}};
    if (action.number != 0) {
        object["number"] = action.number;
    }
    if (action.value != 0.0) {
        object["value"] = action.value;
    }
    if (!action.text.empty()) {
        object["text"] = action.text;
    }
    if (line > 0) {
        object["line_number"] = line;
    }
    events_ += (events_.empty() ? "\n" : ",\n") + object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void ElementWriter::finish() {
    file_->format("],\n\"dwells\": [{}],\n\"events\": [{}]}}\n", dwells_, events_);
}

} // namespace splinefeed::host
