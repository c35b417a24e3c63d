// SPDX-License-Identifier: MIT
// Description: reads the "input" of a curve description, field by field, and holds the curve that a method computes
// from it.
#pragma once

#include "host_sim/base/input_error.hpp"
#include "host_sim/curve/methods/parameter_interval.hpp"

#include "splinefeed/splines/bezier_piece.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::host {

inline constexpr double longest_mm = 65536.0; ///< of a segment that a file describes

/// What is wrong with a description and what would be right; the code that reads the file adds the file's name.
struct DescriptionError : TextError {
    using TextError::TextError;
};

/// A curve that was computed from a description, in mm.
struct DescribedCurve {
    int axes = 0;
    bool closed = false;
    std::vector<BezierPiece<double>> pieces;
    std::vector<ParameterInterval> intervals;                          ///< empty: [0, 1] each; or one per piece
    nlohmann::ordered_json results = nlohmann::ordered_json::object(); ///< keys as in docs/reference/files.md
    std::vector<std::string> warnings; ///< sentences about valid input whose curve is probably not what was meant
};

/// Throws DescriptionError, with the nearest name, if an object has an unknown key: otherwise a misspelt key would
/// silently leave its default. `what` names the object.
void require_known(const nlohmann::json& object, std::initializer_list<std::string_view> known,
                   std::string_view what = "\"input\"");

/// A finite number, or a text that is one: exact data is written as text. Throws DescriptionError with `what`.
[[nodiscard]] double number_of(const nlohmann::json& value, std::string_view what);

/// input[key]. The second form returns `otherwise` if there is no such key or it is null. Throws DescriptionError.
[[nodiscard]] double number_in(const nlohmann::json& input, const char* key);
[[nodiscard]] double number_in(const nlohmann::json& input, const char* key, double otherwise);
[[nodiscard]] int integer_in(const nlohmann::json& input, const char* key, int low, int high);
[[nodiscard]] int integer_in(const nlohmann::json& input, const char* key, int low, int high, int otherwise);
[[nodiscard]] bool flag_in(const nlohmann::json& input, const char* key, bool otherwise);
/// One of `names`, as its index.
[[nodiscard]] std::size_t choice_in(const nlohmann::json& input, const char* key,
                                    std::initializer_list<std::string_view> names, std::size_t otherwise);
/// One number per joint: an array of `count`, or one number for all, or `otherwise` for all.
[[nodiscard]] std::vector<double> numbers_in(const nlohmann::json& input, const char* key, std::size_t count,
                                             double otherwise);

/// Points of equal dimension.
struct PointList {
    int axes = 0;
    std::vector<PerAxis<double>> points; ///< [mm]

    /// The largest |coordinate|.
    [[nodiscard]] double largest() const noexcept;
};

/// input[key], or a part of it that `what` names: an array of at least `fewest` points, 1 to max_axes numbers each, all
/// of equal dimension. Throws DescriptionError with the point.
[[nodiscard]] PointList points_in(const nlohmann::json& input, const char* key, std::size_t fewest);
[[nodiscard]] PointList points_of(const nlohmann::json& array, std::string_view what, std::size_t fewest);
/// For a closed curve: drops the last point if it repeats the first, within 1e-12 of the largest coordinate.
void drop_repeated_end(PointList& list);
/// input[key] as a vector of `axes` numbers; false if there is no such key or it is null.
[[nodiscard]] bool vector_in(const nlohmann::json& input, const char* key, int axes, PerAxis<double>& out);

/// The unit in which a method computes, and the conversions. double and float use mm. Fixed uses 2^exponent mm, so that
/// `largest_mm` times `growth` becomes 2^24 to 2^25: 2^6 of headroom for sums, 57 bits in all.
template <Scalar S>
class Unit {
public:
    /// @param growth  largest factor by which the method's results may exceed its input
    Unit(double largest_mm, double growth);

    [[nodiscard]] int exponent() const noexcept { return exponent_; }
    /// mm to units. Throws DescriptionError if the number is beyond the range of S.
    [[nodiscard]] S in(double mm) const;
    /// Units to mm.
    [[nodiscard]] double out(S value) const noexcept;

    [[nodiscard]] Point<S> in(const PerAxis<double>& mm) const;
    [[nodiscard]] PerAxis<double> out(const Point<S>& point) const noexcept;
    [[nodiscard]] std::vector<Point<S>> in(const PointList& list) const;
    [[nodiscard]] std::vector<PerAxis<double>> out(const std::vector<Point<S>>& points) const;
    [[nodiscard]] BezierPiece<double> out(const BezierPiece<S>& piece) const noexcept;
    [[nodiscard]] std::vector<BezierPiece<double>> out(const std::vector<BezierPiece<S>>& pieces) const;

private:
    int exponent_ = 0;
};

/// Throws a refusal of the core as a DescriptionError.
void require(Status status);

/// How far control points overshoot the input is only known after the computation: in Fixed it is repeated with a
/// larger unit until they fit. compute(const Unit<S>&, Error&) returns the result, or sets the error. Throws
/// DescriptionError.
template <Scalar S, class Compute>
[[nodiscard]] auto in_fitting_unit(double largest_mm, Compute&& compute) {
    Error error = Error::none;
    for (const double growth : {0x1p2, 0x1p8, 0x1p14, 0x1p20}) {
        error = Error::none;
        auto made = compute(Unit<S>(largest_mm, growth), error);
        if (error == Error::none) {
            return made;
        }
    }
    require(error);
    return decltype(compute(Unit<S>(largest_mm, 1.0), error)){};
}

/// The unit of a curve's own parameter. In Fixed the domain is 2^16, whatever the description states, so that
/// differences of parameters keep their digits.
template <Scalar S>
[[nodiscard]] constexpr double parameter_unit(double domain) noexcept {
    return std::same_as<S, Fixed> ? domain / 65536.0 : 1.0;
}

/// Converts parameters to the description's unit.
template <Scalar S>
[[nodiscard]] std::vector<double> out_of_units(const std::vector<S>& values, double unit) {
    std::vector<double> out;
    out.reserve(values.size());
    for (const S value : values) {
        out.push_back(to_double(value) * unit);
    }
    return out;
}

/// The first `axes` numbers as a JSON array; below, a list of points.
[[nodiscard]] nlohmann::ordered_json to_json(const PerAxis<double>& point, int axes);
template <Scalar S>
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<Point<S>>& points, int axes, const Unit<S>& unit);

} // namespace splinefeed::host
