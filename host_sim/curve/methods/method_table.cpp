// SPDX-License-Identifier: MIT
#include "host_sim/curve/methods/method_table.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/curve/methods/joint_report.hpp"

#include <algorithm>
#include <array>

namespace splinefeed::host {

// A method's own results and its curve, from the "input" of a description. Each is in a source of its own, and throws
// DescriptionError.
template <Scalar S>
DescribedCurve describe_beta_chain(const nlohmann::json& input);
template <Scalar S>
DescribedCurve describe_boehm(const nlohmann::json& input);
template <Scalar S>
DescribedCurve describe_bspline_interpolation(const nlohmann::json& input);
template <Scalar S>
DescribedCurve describe_catmull_rom(const nlohmann::json& input);
template <Scalar S>
DescribedCurve describe_catmull_rom_modified(const nlohmann::json& input);
template <Scalar S>
DescribedCurve describe_ferguson(const nlohmann::json& input);

// That input, from waypoints.
nlohmann::json chain_input(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes);
nlohmann::json ferguson_input(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes);
nlohmann::json interpolation_input(const CurveChoice& choice, const std::vector<PerAxis<double>>& points, int axes);

namespace {

using Describe = DescribedCurve (*)(const nlohmann::json&);

/// One row per name: a new method adds its own.
struct Row {
    std::string_view name;
    std::string_view curve; ///< the name of --curve
    Describe fixed;
    Describe single;
    Describe dual;
};

constexpr std::array table{
    Row{"bspline_interpolation", "bspline-interpolation", describe_bspline_interpolation<Fixed>,
        describe_bspline_interpolation<float>, describe_bspline_interpolation<double>},
    Row{"catmull_rom", "catmull-rom", describe_catmull_rom<Fixed>, describe_catmull_rom<float>,
        describe_catmull_rom<double>},
    Row{"beta_chain", "beta-chain", describe_beta_chain<Fixed>, describe_beta_chain<float>,
        describe_beta_chain<double>},
    Row{"boehm", "bspline", describe_boehm<Fixed>, describe_boehm<float>, describe_boehm<double>},
    Row{"bspline", "bspline", describe_boehm<Fixed>, describe_boehm<float>, describe_boehm<double>},
    Row{"catmull_rom_modified", "catmull-rom-modified", describe_catmull_rom_modified<Fixed>,
        describe_catmull_rom_modified<float>, describe_catmull_rom_modified<double>},
    Row{"ferguson", "ferguson", describe_ferguson<Fixed>, describe_ferguson<float>, describe_ferguson<double>},
    Row{"hermite_delta_lambda_mu", "ferguson", describe_ferguson<Fixed>, describe_ferguson<float>,
        describe_ferguson<double>},
};

constexpr std::array of_points{
    PointsMethod{{.name = "bspline-interpolation",
                  .takes = takes_degree | takes_parameterization | takes_knots | takes_tangents | takes_smooth,
                  .lowest_degree = 1,
                  .highest_degree = max_degree},
                 "bspline_interpolation",
                 interpolation_input},
    PointsMethod{
        {.name = "ferguson", .takes = takes_joints | takes_tangents | takes_smooth}, "ferguson", ferguson_input},
    PointsMethod{{.name = "beta-chain",
                  .takes = takes_degree | takes_betas,
                  .usual = Parameterization::uniform,
                  .lowest_beta2 = -1e3,
                  .lowest_degree = 2,
                  .highest_degree = max_degree,
                  .passes_waypoints = false},
                 "beta_chain",
                 chain_input},
};

const Row* find(std::string_view method) noexcept {
    const auto* const row = std::ranges::find(table, method, &Row::name);
    return row != table.end() ? row : nullptr;
}

} // namespace

std::span<const PointsMethod> points_methods() noexcept {
    return of_points;
}

const PointsMethod* points_method(std::string_view curve_name) noexcept {
    for (const PointsMethod& row : of_points) {
        if (row.method.name == curve_name) {
            return &row;
        }
    }
    return nullptr;
}

std::vector<std::string_view> described_methods() {
    std::vector<std::string_view> names;
    names.reserve(table.size());
    for (const Row& row : table) {
        names.push_back(row.name);
    }
    return names;
}

std::string curve_name_of(std::string_view method) {
    const Row* const row = find(method);
    return std::string(row == nullptr ? method : row->curve);
}

DescribedCurve describe_curve(std::string_view method, const nlohmann::json& input, ScalarKind scalar) {
    const Row* const row = find(method);
    if (row == nullptr) {
        const std::vector<std::string_view> names = described_methods();
        throw DescriptionError("\"method\" {} is not available{}", in_quotes(method), suggestion(method, names));
    }
    DescribedCurve curve = scalar == ScalarKind::fixed     ? row->fixed(input)
                           : scalar == ScalarKind::float32 ? row->single(input)
                                                           : row->dual(input);
    if (!curve.results.contains("joints")) {
        curve.results["joints"] = joint_report(curve, scalar == ScalarKind::fixed     ? agreement_of<Fixed>
                                                      : scalar == ScalarKind::float32 ? agreement_of<float>
                                                                                      : agreement_of<double>);
    }
    curve.results["warnings"] = curve.warnings;
    return curve;
}

} // namespace splinefeed::host
