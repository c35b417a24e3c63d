// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/curve/methods/points_input.hpp"

#include "splinefeed/splines/ferguson.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;

constexpr std::size_t largest_printed_matrix = 64;

bool is_auto(const json& input, const char* key) {
    const auto found = input.find(key);
    return found != input.end() && *found == "auto";
}

/// lambda, mu and delta of every joint in double; what is left to the program is chosen here, the same for every
/// scalar.
std::vector<FergusonJoint<double>> joints_in(const json& input, const PointList& list, bool closed) {
    const std::size_t n = list.points.size();
    const std::size_t count = closed ? n : n - 2;
    const std::vector<double> lambda = numbers_in(input, "lambda", count, 1.0);
    const std::vector<double> mu =
        is_auto(input, "mu") ? std::vector<double>(count, 0.0) : numbers_in(input, "mu", count, 0.0);
    const std::vector<double> delta =
        is_auto(input, "delta") ? std::vector<double>(count, 1.0) : numbers_in(input, "delta", count, 1.0);
    std::vector<FergusonJoint<double>> joints(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (delta[i] != 1.0 && delta[i] != -1.0) {
            throw DescriptionError("\"delta\", number {}: it must be 1, -1, or \"auto\" for all", i + 1);
        }
        if (!(lambda[i] > 0.0)) {
            throw DescriptionError("\"lambda\", number {}: it must be positive", i + 1);
        }
        // What is out of the range of every scalar stays so, and the end tangents that follow from it within theirs.
        joints[i] = {std::clamp(lambda[i], 0x1p-21, 0x1p21), mu[i], delta[i] > 0.0 ? 1 : -1};
        if (is_auto(input, "delta")) {
            joints[i].delta = automatic_sign<double>(list.points, closed ? i : i + 1, closed);
        }
    }
    for (std::size_t i = 0; is_auto(input, "mu") && i < count; ++i) {
        const double before = i > 0 || closed ? joints[(i + count - 1) % count].lambda : 1.0;
        joints[i].mu = stable_mu(0.0, joints[i].delta, joints[i].lambda, before);
    }
    return joints;
}

json matrix_of(const std::vector<FergusonJoint<double>>& joints, bool closed) {
    const std::size_t n = joints.size();
    json matrix = json::array();
    for (std::size_t i = 0; i < n; ++i) {
        const double before = i > 0 || closed ? joints[(i + n - 1) % n].lambda : 1.0;
        const CyclicRow<double> row = ferguson_row(joints[i], before);
        std::vector<double> entries(n, 0.0);
        entries[i] = row.on;
        if (i > 0 || closed) {
            entries[(i + n - 1) % n] += row.below;
        }
        if (i + 1 < n || closed) {
            entries[(i + 1) % n] += row.above;
        }
        matrix.push_back(entries);
    }
    return matrix;
}

/// Valid input whose curve is hardly what was meant.
std::vector<std::string> warnings_of(const std::vector<FergusonJoint<double>>& joints, const PointList& list) {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i + 1 < list.points.size(); ++i) {
        if (list.points[i] == list.points[i + 1]) {
            warnings.push_back(
                fmt::format("points {} and {} are the same: the curve makes a small loop there", i + 1, i + 2));
        }
    }
    const auto flips = std::ranges::count_if(joints, [](const auto& joint) { return joint.delta < 0; });
    if (flips > 0) {
        warnings.push_back(fmt::format("the curvature flips at {} point{}: |kappa| is continuous, the curve is not G2",
                                       flips, flips == 1 ? "" : "s"));
    }
    return warnings;
}

const char* name_of(FergusonClass found) {
    switch (found) {
    case FergusonClass::c2: return "C2";
    case FergusonClass::c1_g2: return "C1+G2";
    case FergusonClass::g2: return "G2";
    case FergusonClass::c1_abs_kappa: return "C1+|k|";
    case FergusonClass::g1_abs_kappa: return "G1+|k|";
    case FergusonClass::undefined: break;
    }
    return "undefined";
}

template <Scalar S>
json classes_of(const std::vector<FergusonJoint<S>>& joints, const std::vector<Point<S>>& tangents, bool closed,
                S noise) {
    json classes = json::array();
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Point<S>& tangent = tangents[closed ? i : i + 1];
        const bool zero = std::ranges::all_of(tangent, [noise](S x) { return absolute(x) <= noise; });
        classes.push_back(name_of(ferguson_class(joints[i], zero)));
    }
    return classes;
}

/// The points that the curve joins.
PointList joined_points(const json& input, bool closed) {
    PointList list = points_in(input, "points", 2);
    if (closed) {
        drop_repeated_end(list);
        while (list.points.size() > 1 && list.points.front() == list.points.back()) { // so does the core
            list.points.pop_back();
        }
        require(list.points.size() < 3 ? Status(Error::too_few_points) : Status());
    }
    return list;
}

/// Tangents at the ends of an open curve: those that are given, or estimated ones.
std::array<PerAxis<double>, 2> end_tangents(const json& input, const PointList& list,
                                            const std::vector<FergusonJoint<double>>& joints) {
    std::array<PerAxis<double>, 2> estimated{};
    estimate_end_tangents<double>(list.points, joints, estimated[0], estimated[1]);
    std::array<PerAxis<double>, 2> ends{};
    ends[0] = vector_in(input, "t_start", list.axes, ends[0]) ? ends[0] : estimated[0];
    ends[1] = vector_in(input, "t_end", list.axes, ends[1]) ? ends[1] : estimated[1];
    return ends;
}

template <Scalar S>
std::vector<FergusonJoint<S>> joints_of(const std::vector<FergusonJoint<double>>& exact) {
    const double far = std::same_as<S, Fixed> ? 0x1p17 : 0x1p61; // beyond the range, and S can hold it
    std::vector<FergusonJoint<S>> joints;
    joints.reserve(exact.size());
    for (const FergusonJoint<double>& joint : exact) {
        joints.push_back({from_double<S>(joint.lambda), from_double<S>(std::clamp(joint.mu, -far, far)), joint.delta});
    }
    return joints;
}

} // namespace

template <Scalar S>
DescribedCurve describe_ferguson(const json& input) {
    DescribedCurve curve;
    require_known(input, {"points", "delta", "lambda", "mu", "t_start", "t_end", "closed"});
    curve.closed = flag_in(input, "closed", false);
    const PointList list = joined_points(input, curve.closed);
    curve.axes = list.axes;
    const std::vector<FergusonJoint<double>> exact = joints_in(input, list, curve.closed);
    const auto ends = curve.closed ? std::array<PerAxis<double>, 2>{} : end_tangents(input, list, exact);
    PointList scale = list;
    scale.points.insert(scale.points.end(), ends.begin(), ends.end());
    const Unit<S> unit(scale.largest(), 128.0); // 2^17 to 2^18 in Fixed
    const std::vector<FergusonJoint<S>> joints = joints_of<S>(exact);
    const std::vector<Point<S>> points = unit.in(list);
    const std::size_t n = points.size();
    std::vector<Point<S>> in(n);
    std::vector<Point<S>> out(n);
    std::vector<BezierPiece<S>> pieces(n);
    std::vector<CyclicRow<S>> system(joints.size());
    FergusonReport<S> report;
    const Status status = ferguson<S>({points, joints, curve.closed, unit.in(ends[0]), unit.in(ends[1])},
                                      {in, out, pieces, system}, report);
    if (status.error() == Error::system_singular) {
        throw DescriptionError("the system for the tangents is singular, or nearly so, at point {}; use {}",
                               report.weakest_knot + 1,
                               is_auto(input, "mu") ? "a \"lambda\" nearer to 1 there"
                                                    : "another \"mu\" or \"delta\" there, or \"mu\": \"auto\"");
    }
    require(status);
    pieces.resize(report.segments);
    curve.pieces = unit.out(pieces);
    curve.warnings = warnings_of(exact, list);
    auto& results = curve.results;
    results["tangent_in"] = to_json(in, list.axes, unit);
    results["tangent_out"] = to_json(out, list.axes, unit);
    if (exact.size() <= largest_printed_matrix) {
        results["matrix"] = matrix_of(exact, curve.closed);
    }
    results["diagonally_dominant"] = report.diagonally_dominant;
    results["elimination_without_pivoting_ok"] =
        curve.closed ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(report.elimination_without_pivoting_ok);
    results["condition"] = to_double(report.condition);
    results["guaranteed_class"] = classes_of(joints, in, curve.closed, report.tangent_noise);
    results["vanishing_tangents"] = report.vanishing;
    if (report.vanishing > 0) {
        results["first_vanishing_tangent"] = report.first_vanishing + 1;
    }
    return curve;
}

nlohmann::json ferguson_input(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes) {
    nlohmann::json input;
    input["closed"] = choice.closed;
    input["points"] = points_json(points, 0, points.size(), axes);
    input["lambda"] = choice.lambda;
    input["mu"] = choice.mu ? json(*choice.mu) : json("auto");
    input["delta"] = choice.curvature_sign ? json(*choice.curvature_sign) : json("auto");
    input["t_start"] = tangent_json(choice.start_tangent, axes);
    input["t_end"] = tangent_json(choice.end_tangent, axes);
    return input;
}

template DescribedCurve describe_ferguson<double>(const json&);
template DescribedCurve describe_ferguson<float>(const json&);
template DescribedCurve describe_ferguson<Fixed>(const json&);

} // namespace splinefeed::host
