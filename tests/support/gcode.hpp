// SPDX-License-Identifier: MIT
// Runs G-code through an interpreter, for tests.
#pragma once

#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/expression.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

#include "support/catch.hpp"

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace splinefeed_test {

using namespace splinefeed;

/// Parameters in a map; it has no room for #<full>.
class MapTable final : public ParameterTable {
public:
    [[nodiscard]] bool read(std::int32_t number, Decimal& out) const noexcept override {
        const auto found = numbers_.find(number);
        out = found != numbers_.end() ? found->second : Decimal{};
        return found != numbers_.end();
    }
    bool write(std::int32_t number, Decimal value) noexcept override {
        numbers_[number] = value;
        return true;
    }
    [[nodiscard]] bool read(std::string_view name, Decimal& out) const noexcept override {
        const auto found = names_.find(plain(name));
        out = found != names_.end() ? found->second : Decimal{};
        return found != names_.end();
    }
    bool write(std::string_view name, Decimal value) noexcept override {
        const std::string key = plain(name);
        if (key == "full") {
            return false;
        }
        names_[key] = value;
        return true;
    }
    void forget(std::int32_t number) noexcept override { numbers_.erase(number); }
    void forget(std::string_view name) noexcept override { names_.erase(plain(name)); }

    friend bool operator==(const MapTable& a, const MapTable& b) {
        return a.numbers_ == b.numbers_ && a.names_ == b.names_;
    }

private:
    static std::string plain(std::string_view name) {
        std::string out;
        for (const char c : name) {
            if (c != ' ' && c != '\t') {
                out += lower_case(c);
            }
        }
        return out;
    }

    std::map<std::int32_t, Decimal> numbers_;
    std::map<std::string, Decimal> names_;
};

/// Tools 1 to 20, 10 mm longer and 1 mm thicker each, 1 mm aside.
class TenTools final : public ToolTable {
public:
    [[nodiscard]] bool find(std::int32_t tool, ToolOffset& out) const noexcept override {
        out = {};
        out.offset[0] = Decimal::from_integer(1);
        out.offset[2] = Decimal::from_integer(10 * tool);
        out.diameter = Decimal::from_integer(tool);
        return tool >= 1 && tool <= 20;
    }
};

inline ProgramSettings six_axes() {
    ProgramSettings settings;
    settings.axes = 6;
    settings.letters = {'X', 'Y', 'Z', 'A', 'B', 'C'};
    return settings;
}

inline double number(Decimal value) {
    return static_cast<double>(value.raw) / 1e9;
}

/// An item as text: "G1 1.5 0 0 F100", "rapid ...", "arc ... c ... s ...", "dwell 0.5", "event 3 1".
/// @param line  that it came from
template <Scalar S>
std::string text_of(const ProgramItem<S>& item, int axes = 3, std::string_view line = {}) {
    const auto put = [](std::string& out, double value) {
        char text[40];
        std::snprintf(text, sizeof text, " %.7g", value == 0.0 ? 0.0 : value);
        out += text;
    };
    std::string out;
    if (item.kind == ItemKind::dwell) {
        out = "dwell";
        put(out, number(item.dwell_s));
        return out;
    }
    if (item.kind == ItemKind::event) {
        out = "event " + std::to_string(static_cast<int>(item.event.kind)) + (item.stops_before ? " stop" : "");
        put(out, item.event.number);
        put(out, number(item.event.value));
        return out.append(item.event.text.empty() ? "" : " ").append(item.event.text.of(line));
    }
    const char* const moves[] = {"feed", "rapid", "probe", "turning", "home"};
    const char* const shapes[] = {"", " arc", " bezier"};
    out = std::string(moves[static_cast<int>(item.move)]) + shapes[static_cast<int>(item.element.shape)];
    for (const unsigned k : indices(axes)) {
        put(out, to_mm(item.element.to[k]));
    }
    if (item.element.shape == MoveShape::arc) {
        out += " about";
        for (unsigned k = 0; k < 3; ++k) {
            put(out, to_mm(item.element.arc.centre[k]));
        }
        out += " by";
        put(out, to_double(item.element.arc.sweep_rad) * 180.0 / 3.14159265358979323846);
    }
    if (item.element.shape == MoveShape::bezier) {
        out += " degree";
        put(out, item.element.bezier.degree);
    }
    return out;
}

/// An interpreter with its tables.
template <Scalar S>
class GcodeRun {
public:
    explicit GcodeRun(ProgramSettings settings = six_axes())
        : expression_(table_), interpreter_((settings.tools = &tools_, settings), &expression_, &points_) {
        interpreter_.start({});
    }

    BlockStatus push(const std::string& line) {
        lines_.push_back(line);
        std::vector<char> text(line.begin(), line.end()); // freed behind the call: nothing may refer to it then
        const BlockStatus status =
            interpreter_.push({text.data(), text.size()}, static_cast<std::uint32_t>(lines_.size()));
        text = {};
        ProgramItem<S> item;
        while (status.ok() && interpreter_.next(item) == Pull::item) {
            items_.push_back(item);
        }
        return status;
    }
    /// All lines; they must be right.
    std::vector<ProgramItem<S>> run(const std::string& text) {
        items_.clear();
        std::size_t begin = 0;
        while (begin <= text.size()) {
            std::size_t end = text.find('\n', begin);
            end = end == std::string::npos ? text.size() : end;
            const std::string line = text.substr(begin, end - begin);
            const BlockStatus status = push(line);
            CAPTURE(line, status.column);
            if (!status.ok()) {
                FAIL(describe(status.error));
            }
            begin = end + 1;
        }
        return items_;
    }
    /// The moves, dwells and events, one a line.
    std::string text(const std::string& program, int axes = 3) {
        std::string out;
        run(program);
        for (std::size_t i = 0; i < items_.size(); ++i) {
            out += (out.empty() ? "" : "\n") + item_text(i, axes);
        }
        return out;
    }
    [[nodiscard]] std::string item_text(std::size_t i, int axes = 3) const {
        return text_of(items_[i], axes, lines_[items_[i].line - 1]);
    }
    /// The last item of a program.
    std::string last(const std::string& program, int axes = 3) {
        const std::size_t count = run(program).size();
        return count == 0 ? "" : item_text(count - 1, axes);
    }

    Interpreter<S>& interpreter() { return interpreter_; }
    MapTable& table() { return table_; }
    std::vector<ProgramItem<S>>& items() { return items_; }

private:
    MapTable table_;
    TenTools tools_;
    Expression expression_;
    SplinePoints<S> points_;
    Interpreter<S> interpreter_;
    std::vector<std::string> lines_;
    std::vector<ProgramItem<S>> items_;
};

} // namespace splinefeed_test
