// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/description.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;

// null where the key is missing.
const json& field(const json& input, const char* key) {
    static const json nothing;
    const auto found = input.find(key);
    return found == input.end() ? nothing : *found;
}

void require_present(const json& value, const char* key, std::string_view kind) {
    if (value.is_null()) {
        throw DescriptionError("\"{}\" is missing; it must be {}", key, kind);
    }
}

} // namespace

void require_known(const json& object, std::initializer_list<std::string_view> known, std::string_view what) {
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(known, key) == known.end()) {
            throw DescriptionError("{} has an unknown key {}{}", what, in_quotes(key),
                                   suggestion(key, {known.begin(), known.size()}));
        }
    }
}

double number_of(const json& value, std::string_view what) {
    double result = 0.0;
    if (value.is_number()) {
        result = value.get<double>();
    } else if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        if (const NumberText read = read_number(text, result); read != NumberText::number) {
            throw DescriptionError("{}: {} {}", what, in_quotes(text), why_no_number(read));
        }
    } else {
        throw DescriptionError("{} must be a number, or one as a text in quotes", what);
    }
    if (!std::isfinite(result)) {
        throw DescriptionError("{} must be finite", what);
    }
    return result;
}

double number_in(const json& input, const char* key) {
    const json& value = field(input, key);
    require_present(value, key, "a number");
    return number_of(value, fmt::format("\"{}\"", key));
}

double number_in(const json& input, const char* key, double otherwise) {
    return field(input, key).is_null() ? otherwise : number_in(input, key);
}

int integer_in(const json& input, const char* key, int low, int high) {
    const json& value = field(input, key);
    require_present(value, key, fmt::format("a whole number from {} to {}", low, high));
    const double number = number_of(value, fmt::format("\"{}\"", key));
    if (number != std::floor(number) || number < low || number > high) {
        throw DescriptionError("\"{}\" is {:.17g}; it must be a whole number from {} to {}", key, number, low, high);
    }
    return static_cast<int>(number);
}

int integer_in(const json& input, const char* key, int low, int high, int otherwise) {
    return field(input, key).is_null() ? otherwise : integer_in(input, key, low, high);
}

bool flag_in(const json& input, const char* key, bool otherwise) {
    const json& value = field(input, key);
    if (value.is_null()) {
        return otherwise;
    }
    if (!value.is_boolean()) {
        throw DescriptionError("\"{}\" must be true or false", key);
    }
    return value.get<bool>();
}

std::size_t choice_in(const json& input, const char* key, std::initializer_list<std::string_view> names,
                      std::size_t otherwise) {
    const json& value = field(input, key);
    if (value.is_null()) {
        return otherwise;
    }
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    const auto* const found = std::ranges::find(names, text);
    if (found == names.end()) {
        throw DescriptionError("\"{}\" must be one of {}", key, listed({names.begin(), names.size()}));
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::vector<double> numbers_in(const json& input, const char* key, std::size_t count, double otherwise) {
    const json& value = field(input, key);
    if (value.is_null()) {
        return std::vector<double>(count, otherwise);
    }
    if (!value.is_array()) {
        return std::vector<double>(count, number_of(value, fmt::format("\"{}\"", key)));
    }
    if (value.size() != count) {
        throw DescriptionError("\"{}\" has {} numbers; it must have {}, one a joint", key, value.size(), count);
    }
    std::vector<double> numbers;
    for (const json& number : value) {
        numbers.push_back(number_of(number, fmt::format("\"{}\", number {}", key, numbers.size() + 1)));
    }
    return numbers;
}

double PointList::largest() const noexcept {
    double most = 0.0;
    for (const PerAxis<double>& point : points) {
        for (const double value : point) {
            most = std::max(most, std::fabs(value));
        }
    }
    return most;
}

PointList points_in(const json& input, const char* key, std::size_t fewest) {
    const json& array = field(input, key);
    require_present(array, key, fmt::format("an array of at least {} points", fewest));
    return points_of(array, fmt::format("\"{}\"", key), fewest);
}

PointList points_of(const json& array, std::string_view what, std::size_t fewest) {
    if (!array.is_array() || array.size() < fewest) {
        throw DescriptionError("{} must be an array of at least {} points", what, fewest);
    }
    PointList list;
    for (const json& point : array) {
        const std::string name = fmt::format("{}, point {}", what, list.points.size() + 1);
        const std::size_t size = point.is_array() ? point.size() : 0;
        if (size < 1 || size > static_cast<std::size_t>(max_axes)) {
            throw DescriptionError("{} must be an array of one to {} numbers", name, max_axes);
        }
        list.axes = list.axes == 0 ? static_cast<int>(size) : list.axes;
        if (size != static_cast<std::size_t>(list.axes)) {
            throw DescriptionError("{} has {} numbers; it must have {}, like those before it", name, size, list.axes);
        }
        PerAxis<double>& added = list.points.emplace_back();
        for (std::size_t k = 0; k < size; ++k) {
            added[k] = number_of(point[k], name);
        }
    }
    return list;
}

void drop_repeated_end(PointList& list) {
    const double tolerance = 1e-12 * list.largest();
    const auto same = [tolerance](double a, double b) {
        return std::fabs(a - b) <= tolerance;
    };
    if (list.points.size() > 1 &&
        std::equal(list.points.front().begin(), list.points.front().end(), list.points.back().begin(), same)) {
        list.points.pop_back();
    }
}

bool vector_in(const json& input, const char* key, int axes, PerAxis<double>& out) {
    const json& value = field(input, key);
    if (value.is_null()) {
        return false;
    }
    if (!value.is_array() || value.size() != static_cast<std::size_t>(axes)) {
        throw DescriptionError("\"{}\" must be an array of {} numbers, one for each axis of the points", key, axes);
    }
    for (std::size_t k = 0; k < value.size(); ++k) {
        out[k] = number_of(value[k], fmt::format("\"{}\"", key));
    }
    return true;
}

template <Scalar S>
Unit<S>::Unit(double largest_mm, double growth) {
    if constexpr (std::same_as<S, Fixed>) {
        int size = 0; // largest_mm * growth < 2^size
        static_cast<void>(std::frexp(largest_mm * growth, &size));
        exponent_ = std::clamp(size - 25, -80, 40);
    }
}

template <Scalar S>
S Unit<S>::in(double mm) const {
    if constexpr (std::same_as<S, Fixed>) {
        const double value = std::ldexp(mm, -exponent_);
        if (!(std::fabs(value) < 0x1p30)) {
            throw DescriptionError("{:.6g} is beyond the range of fixed-point numbers here; use --scalar double", mm);
        }
        return from_double<S>(value);
    } else {
        if (!(std::fabs(mm) < 1e30)) {
            throw DescriptionError("{:.6g} is out of range; numbers must lie within +-1e30", mm);
        }
        return from_double<S>(mm);
    }
}

template <Scalar S>
double Unit<S>::out(S value) const noexcept {
    return std::ldexp(to_double(value), exponent_);
}

template <Scalar S>
Point<S> Unit<S>::in(const PerAxis<double>& mm) const {
    Point<S> point{};
    for (const unsigned k : indices(max_axes)) {
        point[k] = in(mm[k]);
    }
    return point;
}

template <Scalar S>
PerAxis<double> Unit<S>::out(const Point<S>& point) const noexcept {
    PerAxis<double> mm{};
    for (const unsigned k : indices(max_axes)) {
        mm[k] = out(point[k]);
    }
    return mm;
}

template <Scalar S>
std::vector<Point<S>> Unit<S>::in(const PointList& list) const {
    std::vector<Point<S>> points;
    points.reserve(list.points.size());
    for (const PerAxis<double>& point : list.points) {
        points.push_back(in(point));
    }
    return points;
}

template <Scalar S>
std::vector<PerAxis<double>> Unit<S>::out(const std::vector<Point<S>>& points) const {
    std::vector<PerAxis<double>> mm;
    mm.reserve(points.size());
    for (const Point<S>& point : points) {
        mm.push_back(out(point));
    }
    return mm;
}

template <Scalar S>
BezierPiece<double> Unit<S>::out(const BezierPiece<S>& piece) const noexcept {
    BezierPiece<double> mm;
    mm.degree = piece.degree;
    for (int i = 0; i <= piece.degree; ++i) {
        mm.set_point(i, out(piece.point(i)));
    }
    return mm;
}

template <Scalar S>
std::vector<BezierPiece<double>> Unit<S>::out(const std::vector<BezierPiece<S>>& pieces) const {
    std::vector<BezierPiece<double>> mm;
    mm.reserve(pieces.size());
    for (const BezierPiece<S>& piece : pieces) {
        mm.push_back(out(piece));
    }
    return mm;
}

void require(Status status) {
    if (!status.ok()) {
        throw DescriptionError(describe(status.error()));
    }
}

nlohmann::ordered_json to_json(const PerAxis<double>& point, int axes) {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const unsigned k : indices(axes)) {
        array.push_back(point[k]);
    }
    return array;
}

template <Scalar S>
nlohmann::ordered_json to_json(const std::vector<Point<S>>& points, int axes, const Unit<S>& unit) {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const Point<S>& point : points) {
        array.push_back(to_json(unit.out(point), axes));
    }
    return array;
}

template class Unit<double>;
template class Unit<float>;
template class Unit<Fixed>;
template nlohmann::ordered_json to_json(const std::vector<Point<double>>&, int, const Unit<double>&);
template nlohmann::ordered_json to_json(const std::vector<Point<float>>&, int, const Unit<float>&);
template nlohmann::ordered_json to_json(const std::vector<Point<Fixed>>&, int, const Unit<Fixed>&);

} // namespace splinefeed::host
