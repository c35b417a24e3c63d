// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/method_table.hpp"
#include "host_sim/curve/methods/points_input.hpp"

#include "splinefeed/splines/beta_chain.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

using nlohmann::json;

/// The input, in mm; a BetaChain refers to it.
struct Chain {
    int axes = 0;
    int degree = 3;
    int order = 2;
    bool closed = false;
    std::vector<PerAxis<double>> first_polygon;
    std::vector<PerAxis<double>> free_points;
    std::vector<Beta<double>> betas;
};

const json& array_in(const json& input, const char* key, std::size_t count, std::string_view kind) {
    const auto found = input.find(key);
    if (found == input.end() || !found->is_array() || (count > 0 && found->size() != count)) {
        throw DescriptionError(count > 0 ? fmt::format("\"{}\" must be an array of {} {}", key, count, kind)
                                         : fmt::format("\"{}\" must be an array of {}", key, kind));
    }
    return *found;
}

// Takes the points of one polygon, `count` of them and of the dimension of those before.
void take(Chain& chain, std::vector<PerAxis<double>>& out, const json& array, const std::string& what,
          std::size_t count) {
    const PointList list = points_of(array, what, count);
    if (list.points.size() != count) {
        throw DescriptionError("{} has {} points; with degree {} and order {} it must have {}", what,
                               list.points.size(), chain.degree, chain.order, count);
    }
    if (count > 0 && chain.axes != 0 && list.axes != chain.axes) {
        throw DescriptionError("{} has points of {} numbers; they must have {}, like those before", what, list.axes,
                               chain.axes);
    }
    chain.axes = count > 0 ? list.axes : chain.axes;
    out.insert(out.end(), list.points.begin(), list.points.end());
}

Chain read(const json& input) {
    require_known(input, {"degree", "order", "first_polygon", "free_points", "betas", "closed"});
    Chain chain;
    chain.degree = integer_in(input, "degree", 1, max_degree);
    chain.order = integer_in(input, "order", 1, 2, 2);
    chain.closed = flag_in(input, "closed", false);
    const auto degree = static_cast<std::size_t>(chain.degree);
    const auto order = static_cast<std::size_t>(chain.order);
    if (chain.degree < chain.order) {
        throw DescriptionError("\"degree\" is {}; order {} takes at least {}", degree, order, order);
    }
    if (chain.closed && degree < 2 * order + 1) {
        require(Error::closed_chain_overlaps);
    }
    if (!chain.closed) {
        take(chain, chain.first_polygon, array_in(input, "first_polygon", 0, "points"), "\"first_polygon\"",
             degree + 1);
    }
    const json& betas = array_in(input, "betas", 0, "objects with \"beta1\" and \"beta2\"");
    const json& free = array_in(input, "free_points", 0, "polygons");
    if (free.size() != betas.size() || (chain.closed && betas.empty())) {
        throw DescriptionError("there are {} polygons of \"free_points\" and {} \"betas\"; each joint takes "
                               "one of either, and a closed chain has a joint",
                               free.size(), betas.size());
    }
    for (std::size_t j = 0; j < betas.size(); ++j) {
        take(chain, chain.free_points, free[j], fmt::format("\"free_points\", polygon {}", j + 1), degree - order);
        if (!betas[j].is_object()) {
            throw DescriptionError("\"betas\", joint {} must be an object with \"beta1\" and \"beta2\"", j + 1);
        }
        require_known(betas[j], {"beta1", "beta2"}, fmt::format("\"betas\", joint {}", j + 1));
        chain.betas.push_back({number_in(betas[j], "beta1"), number_in(betas[j], "beta2", 0.0)});
    }
    return chain;
}

template <Scalar S>
struct Built {
    std::vector<BezierPiece<S>> pieces;
    std::vector<BetaJoint<S>> joints;
};

template <Scalar S>
Built<S> build(const Chain& chain, const Unit<S>& unit) {
    std::vector<Point<S>> first;
    std::vector<Point<S>> free;
    std::vector<Beta<S>> betas;
    for (const auto& point : chain.first_polygon) {
        first.push_back(unit.in(point));
    }
    for (const auto& point : chain.free_points) {
        free.push_back(unit.in(point));
    }
    for (std::size_t j = 0; j < chain.betas.size(); ++j) { // pure numbers: they do not take the unit of length
        const auto [beta1, beta2] = chain.betas[j];
        if (std::same_as<S, Fixed> && (std::fabs(beta1) > 8192.0 || std::fabs(beta2) > 0x1p29)) {
            throw DescriptionError("joint {}: fixed-point numbers take beta1 up to 8192 and beta2 within "
                                   "+-2^29; use --scalar double",
                                   j + 1);
        }
        betas.push_back({from_double<S>(beta1), from_double<S>(beta2)});
        if (beta1 > 0.0 && !(betas.back().beta1 > S{})) {
            throw DescriptionError("joint {}: beta1 is {:g}, which is 0 in these numbers; use --scalar double", j + 1,
                                   beta1);
        }
    }
    const BetaChain<S> described{chain.degree, chain.order, chain.closed, first, free, betas};
    Built<S> built;
    built.pieces.resize(described.piece_count());
    built.joints.resize(described.joint_count());
    std::size_t failed = described.joint_count();
    const Status status = beta_chain<S>(described, built.pieces, built.joints, &failed);
    if (!status.ok() && failed < described.joint_count()) {
        throw DescriptionError("joint {}: {}", failed + 1, describe(status.error()));
    }
    require(status);
    return built;
}

// What the largest sum of a joint may come to. Fixed takes its unit from it: chains grow from joint to joint.
double largest_sum(const Chain& chain) {
    const Built<double> trial = build<double>(chain, Unit<double>(1.0, 1.0));
    double largest = 0.0;
    for (std::size_t p = 0; p < trial.pieces.size(); ++p) {
        double coordinate = 0.0;
        for (int i = 0; i <= chain.degree; ++i) {
            for (const double x : trial.pieces[p].point(i)) {
                coordinate = std::max(coordinate, std::fabs(x));
            }
        }
        const double growth = p < chain.betas.size() ? *beta_growth(chain.betas[p], chain.degree, chain.order) : 1.0;
        largest = std::max(largest, coordinate * growth);
    }
    return largest;
}

// Cubics have one free point each, and what a joint does to the next one grows about five times from one to the next.
void require_digits(const Chain& chain, double largest) {
    double given = 0.0;
    for (const auto* points : {&chain.first_polygon, &chain.free_points}) {
        for (const PerAxis<double>& point : *points) {
            for (const double x : point) {
                given = std::max(given, std::fabs(x));
            }
        }
    }
    if (largest > 0x1p30 * given) { // the points would keep less than 26 bits
        throw DescriptionError("the chain grows from joint to joint, to {:.3g} times its largest coordinate: too "
                               "far for fixed-point numbers; use a higher degree, which leaves more points "
                               "free, or fewer joints",
                               largest / given);
    }
}

template <Scalar S>
nlohmann::ordered_json joint_json(const BetaJoint<S>& joint, const Chain& chain, const Unit<S>& unit) {
    nlohmann::ordered_json out;
    out["W0"] = to_json(unit.out(joint.w0), chain.axes);
    out["W1"] = to_json(unit.out(joint.w1), chain.axes);
    if (chain.order == 2) {
        out["W2"] = to_json(unit.out(joint.w2), chain.axes);
        out["gamma"] = nullptr;
        out["T"] = nullptr;
        if (joint.gamma_known) {
            out["gamma"] = to_double(joint.gamma);
            out["T"] = to_json(unit.out(joint.apex), chain.axes);
        }
    }
    return out;
}

} // namespace

template <Scalar S>
DescribedCurve describe_beta_chain(const json& input) {
    const Chain chain = read(input);
    const double largest = largest_sum(chain);
    if constexpr (std::same_as<S, Fixed>) {
        require_digits(chain, largest);
    }
    const Unit<S> unit(largest, 1.0);
    const Built<S> built = build<S>(chain, unit);
    DescribedCurve curve;
    curve.axes = chain.axes;
    curve.closed = chain.closed;
    curve.pieces = unit.out(built.pieces);
    nlohmann::ordered_json& points = curve.results["joint_points"] = nlohmann::ordered_json::array();
    for (const BetaJoint<S>& joint : built.joints) {
        points.push_back(joint_json(joint, chain, unit));
    }
    return curve;
}

// The first polygon takes degree + 1 points, each further one the degree - 2 that G2 leaves free.
nlohmann::json chain_input(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes) {
    nlohmann::json input;
    input["closed"] = choice.closed;
    constexpr std::size_t order = 2;
    const auto degree = static_cast<std::size_t>(choice.degree);
    const std::size_t free = degree - order;
    const std::size_t first = choice.closed ? 0 : degree + 1;
    if (points.size() < first || (free > 0 && (points.size() - first) % free != 0) ||
        (free == 0 && points.size() != first)) {
        throw DescriptionError(
            "there are {} points; a chain of degree {} takes {} for its first polygon and {} for each one after it",
            points.size(), degree, first, free);
    }
    input["degree"] = choice.degree;
    input["order"] = order;
    input["first_polygon"] = choice.closed ? json(nullptr) : points_json(points, 0, first, axes);
    json polygons = json::array();
    for (std::size_t i = first; i < points.size(); i += free) {
        polygons.push_back(points_json(points, i, free, axes));
    }
    json betas = json::array();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        betas.push_back({{"beta1", choice.beta1.value_or(1.0)}, {"beta2", choice.beta2}});
    }
    input["free_points"] = polygons;
    input["betas"] = betas;
    return input;
}

template DescribedCurve describe_beta_chain<double>(const json&);
template DescribedCurve describe_beta_chain<float>(const json&);
template DescribedCurve describe_beta_chain<Fixed>(const json&);

} // namespace splinefeed::host
