// SPDX-License-Identifier: MIT
#include "host_sim/program/element_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/program/element_curves.hpp"
#include "host_sim/program/input_format.hpp"

#include "host_sim/curve/methods/description.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;

constexpr std::size_t most_elements = 10'000'000;
constexpr double largest_gap_mm = 1e-6;
constexpr double slowest_feed = 0.001;
constexpr double fastest_feed = 10000.0;
constexpr double longest_dwell_s = 86400.0;

/// What an element may say; others are passed over unless they look like a misprint of these.
constexpr std::array<std::string_view, 16> known_keys{
    "type",           "from",         "to",          "feed_mm_s", "rapid", "chain_tolerance_mm",
    "mode",           "tolerance_mm", "line_number", "centre",    "axis",  "angle",
    "control_points", "weights",      "knots",       "order"};

class Reader {
public:
    Reader(const json& document, const std::string& file, const std::vector<std::string>& axes,
           const PathTolerances& tolerances)
        : document_(document), file_(file), tolerances_(tolerances), curves_(program_, axes) {}

    [[nodiscard]] ElementProgram program() {
        const auto elements = document_.find("elements");
        if (!elements->is_array() || elements->empty()) {
            throw InputError(file_, 0, "\"elements\" must be an array of at least one element");
        }
        if (elements->size() > most_elements) {
            throw InputError(file_, 0, "there are {} elements; a file has at most {}", elements->size(), most_elements);
        }
        for (const json& element : *elements) {
            try {
                add(element);
            } catch (const DescriptionError& error) {
                throw InputError(file_, 0, "{}: {}", name_, error.what());
            }
        }
        try {
            stops("dwells");
            stops("events");
        } catch (const DescriptionError& error) {
            throw InputError(file_, 0, error.what());
        }
        return std::move(program_);
    }

private:
    void add(const json& element) {
        const auto index = static_cast<std::uint32_t>(program_.elements());
        name_ = element_name(index, 0);
        if (!element.is_object()) {
            throw DescriptionError(
                R"(it must be an object, like {"type": "line", "from": [0, 0, 0], "to": [10, 5, 0]})");
        }
        const std::uint32_t line = line_number(element);
        name_ = element_name(index, line);
        program_.add_element_line(line);
        require_no_misprint(element);
        const AxisPoint from = point(element, "from");
        const AxisPoint to = point(element, "to");
        if (index == 0) {
            curves_.start(from);
        }
        curves_.require_connected(from, largest_gap_mm);
        ElementProgram::Move move;
        move.element = index;
        move.mode = mode(element);
        const bool rapid = flag_in(element, "rapid", false);
        move.feed_mm_s = rapid ? 0.0 : feed(element);
        move.tolerance_mm = tolerance(element, rapid);
        move.chain_tolerance_mm =
            rapid ? move.tolerance_mm : stated_tolerance(element, "chain_tolerance_mm", move.tolerance_mm);
        const json type = element.value("type", json("line"));
        const std::string shape = type.is_string() ? type.get<std::string>() : "";
        if (shape == "line") {
            curves_.add_line(move, to);
        } else if (shape == "arc") {
            curves_.add_arc(move, to, vector(element, "centre"), vector(element, "axis"), number_in(element, "angle"));
        } else if (shape == "bezier") {
            curves_.add_bezier(move, to, vectors(element));
        } else if (shape == "nurbs") {
            curves_.add_nurbs(move, to, nurbs(element));
        } else {
            throw DescriptionError(R"("type" must be "line", "arc", "bezier" or "nurbs")");
        }
    }

    static std::uint32_t line_number(const json& element) {
        const auto line = element.find("line_number");
        return line != element.end() && line->is_number_integer() && line->get<std::int64_t>() > 0 &&
                       line->get<std::int64_t>() < (std::int64_t{1} << 31U)
                   ? line->get<std::uint32_t>()
                   : 0;
    }

    static void require_no_misprint(const json& element) {
        for (const auto& [key, value] : element.items()) {
            if (std::ranges::find(known_keys, key) != known_keys.end()) {
                continue;
            }
            if (const std::string_view near = nearest_name(key, known_keys); !near.empty()) {
                throw DescriptionError("there is no key {}; did you mean '{}'?", in_quotes(key), near);
            }
        }
    }

    [[nodiscard]] static double coordinate(const json& value, std::string_view what) {
        const double mm = number_of(value, what);
        if (!position_representable(mm)) {
            throw DescriptionError("{} has the coordinate {}; a position must lie within +-1048576 mm", what, mm);
        }
        return mm;
    }

    [[nodiscard]] static AxisPoint point(const json& element, const char* key) {
        const auto found = element.find(key);
        if (found == element.end() || !found->is_array() || found->size() < 3 || found->size() > 6) {
            throw DescriptionError("\"{}\" must be an array of three to six numbers: x, y, z, a, b, c", key);
        }
        AxisPoint out{};
        for (std::size_t k = 0; k < found->size(); ++k) {
            out[k] = coordinate((*found)[k], fmt::format("\"{}\"", key));
        }
        return out;
    }

    [[nodiscard]] static Vector3 vector_of(const json& value, const std::string& what) {
        if (!value.is_array() || value.size() != 3) {
            throw DescriptionError("{} must be an array of three numbers: x, y, z", what);
        }
        return {coordinate(value[0], what), coordinate(value[1], what), coordinate(value[2], what)};
    }

    [[nodiscard]] static Vector3 vector(const json& element, const char* key) {
        const auto found = element.find(key);
        return vector_of(found == element.end() ? json() : *found, fmt::format("\"{}\"", key));
    }

    [[nodiscard]] static std::vector<Vector3> vectors(const json& element) {
        const auto found = element.find("control_points");
        if (found == element.end() || !found->is_array()) {
            throw DescriptionError("\"control_points\" must be an array of points, each with x, y, z");
        }
        std::vector<Vector3> points;
        for (const json& value : *found) {
            points.push_back(vector_of(value, fmt::format("control point {}", points.size() + 1)));
        }
        return points;
    }

    [[nodiscard]] static std::vector<double> numbers(const json& element, const char* key) {
        const auto found = element.find(key);
        if (found == element.end() || !found->is_array()) {
            throw DescriptionError("\"{}\" must be an array of numbers", key);
        }
        std::vector<double> out;
        for (const json& value : *found) {
            out.push_back(number_of(value, fmt::format("\"{}\", number {}", key, out.size() + 1)));
        }
        return out;
    }

    [[nodiscard]] static ProgrammedNurbs nurbs(const json& element) {
        ProgrammedNurbs out;
        out.points = vectors(element);
        out.degree = integer_in(element, "order", 2, max_degree + 1) - 1;
        out.weights =
            element.contains("weights") ? numbers(element, "weights") : std::vector<double>(out.points.size(), 1.0);
        out.knots = numbers(element, "knots");
        return out;
    }

    [[nodiscard]] static PathMode mode(const json& element) {
        constexpr std::array modes{PathMode::continuous, PathMode::exact_path, PathMode::exact_stop};
        return modes[choice_in(element, "mode", {"continuous", "exact_path", "exact_stop"}, 0)];
    }

    [[nodiscard]] static double feed(const json& element) {
        const double feed = number_in(element, "feed_mm_s", 0.0);
        if (element.contains("feed_mm_s") && !(feed >= slowest_feed && feed <= fastest_feed)) {
            throw DescriptionError("\"feed_mm_s\" is {}; it must lie between {} and {}", feed, slowest_feed,
                                   fastest_feed);
        }
        return feed;
    }

    [[nodiscard]] double tolerance(const json& element, bool rapid) const {
        const double stated = stated_tolerance(element, "tolerance_mm", tolerances_.programmed_mm);
        return rapid ? tolerances_.rapid_mm : stated;
    }

    static double stated_tolerance(const json& element, const char* key, double otherwise) {
        const double stated = number_in(element, key, otherwise);
        if (!(stated >= 0.0 && stated <= largest_tolerance_mm)) {
            throw DescriptionError("\"{}\" is {}; it must lie between 0 and {}", key, stated, largest_tolerance_mm);
        }
        return stated;
    }

    // What happens between two elements: the machine stands there.
    void stops(const char* key) {
        const auto list = document_.find(key);
        if (list == document_.end()) {
            return;
        }
        if (!list->is_array()) {
            throw DescriptionError("\"{}\" must be an array", key);
        }
        for (std::size_t i = 0; i < list->size(); ++i) {
            const json& stop = (*list)[i];
            const std::string what = fmt::format("\"{}\", number {}", key, i + 1);
            const auto place = stop.is_object() ? stop.find("after_element") : stop.end();
            if (!stop.is_object() || place == stop.end() || !place->is_number_integer() ||
                place->get<std::int64_t>() < 0 || place->get<std::uint64_t>() > program_.elements()) {
                throw DescriptionError("{} must have \"after_element\": how many elements come before it, 0 to {}",
                                       what, program_.elements());
            }
            program_.stop_before(place->get<std::uint32_t>());
            if (std::string_view(key) == "dwells") {
                const double seconds = number_of(stop.value("seconds", json()), what + ", \"seconds\"");
                if (!(seconds >= 0.0 && seconds <= longest_dwell_s)) {
                    throw DescriptionError("{} lasts {} s; it must be 0 to {}", what, seconds, longest_dwell_s);
                }
                program_.add_dwell(place->get<std::uint32_t>(), seconds);
            }
        }
    }

    const json& document_;
    const std::string& file_;
    PathTolerances tolerances_;
    ElementProgram program_;
    ElementCurves curves_;
    std::string name_;
};

} // namespace

bool has_elements(const json& document) {
    return document.is_object() && document.contains("elements");
}

ElementProgram read_elements(const json& document, const std::string& file, const std::vector<std::string>& axes,
                             const PathTolerances& tolerances) {
    return Reader(document, file, axes, tolerances).program();
}

std::vector<std::string> axes_of_elements(const json& document) {
    std::size_t most = 3;
    for (const json& element : document["elements"]) {
        const auto to = element.is_object() ? element.find("to") : element.end();
        most = element.is_object() && to != element.end() && to->is_array() ? std::max(most, to->size()) : most;
    }
    return {every_axis.begin(), every_axis.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(most, 6))};
}

} // namespace splinefeed::host
