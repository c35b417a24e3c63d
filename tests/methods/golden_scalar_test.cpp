// SPDX-License-Identifier: MIT
//
// Every case of the reference vectors of curves in float and in Fixed: control points within the bounds of
// docs/explanation/numbers.md, everything else there and of the right shape. The bounds of 000 and 002 have their own
// tests: beta_chain_test, bspline_interpolation_test.
#include "support/golden.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace splinefeed::host;
using namespace splinefeed_test;
using nlohmann::json;

namespace {

/// Of a case in a scalar. u: half an ulp of 1; `grid`: what the coordinates of Fixed are rounded by, relative to the
/// largest of them; 0 in floating point.
struct Roundings {
    double u = 0.0;
    double grid = 0.0;
};
constexpr Roundings single{0x1p-24, 0.0};

double largest_of(const json& value) {
    if (!value.is_array()) {
        return std::fabs(number_of(value, "a reference number"));
    }
    double most = 0.0;
    for (const json& item : value) {
        most = std::max(most, largest_of(item));
    }
    return most;
}

double row_sum(const json& matrix) {
    double most = 0.0;
    for (const json& row : matrix) {
        double sum = 0.0;
        for (const json& entry : row) {
            sum += std::fabs(number_of(entry, "an entry"));
        }
        most = std::max(most, sum);
    }
    return most;
}

// 8 roundings of (2 m + 1) M; in Fixed they are of the grid, and m is rounded, too, in a tangent's third.
double catmull_rom(const json& item, const DescribedCurve& /*curve*/, const Roundings& r) {
    const double size = largest_of(item["input"]["points"]);
    const double m = number_in(item["input"], "tension");
    const double points = 8.0 * (2.0 * m + 1.0) * size * (r.grid > 0.0 ? (2.0 * m + 1.0) * r.grid : r.u);
    return points + (r.grid > 0.0 ? 2.0 / 3.0 * size * r.u : 0.0);
}

// A slope is off by 24 u, and the factor, rounded by u, meets slopes of up to 3; then 8 roundings of coordinates.
double catmull_rom_modified(const json& item, const DescribedCurve& /*curve*/, const Roundings& r) {
    const json& input = item["input"];
    const double longest = input["mode"] == "chord" ? largest_of(item["expected"]["chords"]) : 1.0;
    const double reach = number_in(input, "factor") * longest / 3.0;
    const double size = largest_of(input["points"]) + reach;
    return 24.0 * r.u * reach + r.u * longest + 8.0 * (r.grid > 0.0 ? 128.0 * r.grid : r.u) * size;
}

// Four roundings of numbers below twice the range.
double boehm(const json& item, const DescribedCurve& /*curve*/, const Roundings& r) {
    return 8.0 * (r.grid > 0.0 ? r.grid : r.u) * largest_of(item["input"]["vertices"]);
}

// Entries are off by 4 u and elimination by 12 of its own, right sides by 5 roundings of 6 (1 + lambda^2) coordinates;
// a Bezier point is a third of the outgoing tangent away from its point, and rounded 4 times.
double ferguson(const json& item, const DescribedCurve& curve, const Roundings& r) {
    const json& input = item["input"];
    const double lambda = std::max(1.0, largest_of(input["lambda"]));
    const double size = largest_of(input["points"]);
    const double tangent = std::max(largest_of(item["expected"]["tangent_in"]), size);
    const double condition = curve.results["condition"].get<double>();
    const double sides = 30.0 * (1.0 + lambda * lambda) * size / row_sum(item["expected"]["matrix"]);
    return condition * r.u * (16.0 * tangent + sides) * lambda / 3.0 +
           4.0 * (r.grid > 0.0 ? 128.0 * r.grid : r.u) * (size + tangent);
}

struct File {
    const char* name;
    double (*bound)(const json&, const DescribedCurve&, const Roundings&); ///< of a coordinate; null: in another test
};
constexpr std::array files{File{"000_beta.json", nullptr},
                           File{"001_hermite_delta_lambda_mu.json", ferguson},
                           File{"002_bspline_curve.json", nullptr},
                           File{"003_boehm.json", boehm},
                           File{"004_catmull_rom.json", catmull_rom},
                           File{"004_catmull_rom_modified.json", catmull_rom_modified}};

/// Where chords are a thousandth or a tangent nothing of the size of the curve: the jump at a joint is less than what
/// rounding is allowed to make of it, and the class better or worse than that of exact numbers.
struct BelowRounding {
    const char* id;
    ScalarKind scalar;
};
constexpr std::array below_rounding{
    BelowRounding{"beta-p5", ScalarKind::float32}, BelowRounding{"kk-p3", ScalarKind::fixed},
    BelowRounding{"bsi-p5", ScalarKind::float32},  BelowRounding{"cr-p6", ScalarKind::float32},
    BelowRounding{"cr-p6", ScalarKind::fixed},     BelowRounding{"crm-p5", ScalarKind::float32}};

bool is_below_rounding(const std::string& id, ScalarKind scalar) {
    return std::any_of(below_rounding.begin(), below_rounding.end(),
                       [&](const BelowRounding& one) { return one.id == id && one.scalar == scalar; });
}

bool of_smoothness(const std::string& difference) {
    return difference.rfind("joint", 0) == 0 || difference.find("curvature") != std::string::npos;
}

DescribedCurve curve_of(const json& item, ScalarKind scalar) {
    return describe_curve(item["method"].get<std::string>(), item["input"], scalar);
}

} // namespace

TEST_CASE("Reference vectors: float and Fixed within the bound of each method", "[golden]") {
    for (const File& file : files) {
        const json set = golden_set(file.name);
        REQUIRE_FALSE(set["cases"].empty());
        double worst_double = 0.0;
        double worst_single = 0.0;
        double worst_fixed = 0.0;
        double bound_single = 0.0;
        double bound_fixed = 0.0;
        for (const json& item : set["cases"]) {
            const std::string id = item["id"];
            CAPTURE(file.name, id);
            const DescribedCurve exact = curve_of(item, ScalarKind::float64);
            const double in_float = control_error(item, curve_of(item, ScalarKind::float32));
            const double in_fixed = control_error(item, curve_of(item, ScalarKind::fixed));
            worst_double = std::max(worst_double, control_error(item, exact));
            worst_single = std::max(worst_single, in_float);
            worst_fixed = std::max(worst_fixed, in_fixed);
            if (file.bound != nullptr) {
                const double scale = number_in(item, "scale");
                // Fixed makes the largest coordinate 2^24 units at least; what is read is rounded to double.
                const Roundings fixed{0x1p-33, 0x1p-57};
                const double allowed_single = file.bound(item, exact, single) / scale;
                const double allowed_fixed = file.bound(item, exact, fixed) / scale + 0x1p-51;
                CHECK(in_float <= allowed_single);
                CHECK(in_fixed <= allowed_fixed);
                bound_single = std::max(bound_single, allowed_single);
                bound_fixed = std::max(bound_fixed, allowed_fixed);
            }
        }
        if (std::getenv("SPLINEFEED_FIGURES") != nullptr) { // the table of docs/explanation/numbers.md
            WARN(file.name << ": double " << worst_double << ", float " << worst_single << " of " << bound_single
                           << ", Fixed " << worst_fixed << " of " << bound_fixed);
        }
    }
}

TEST_CASE("Reference vectors: float and Fixed give every result in its shape", "[golden]") {
    for (const File& file : files) {
        const json set = golden_set(file.name);
        for (const json& item : set["cases"]) {
            for (const ScalarKind scalar : {ScalarKind::float32, ScalarKind::fixed}) {
                const std::string id = item["id"];
                CAPTURE(file.name, id, scalar == ScalarKind::float32);
                std::vector<std::string> found = differences(item, curve_of(item, scalar), 1e30);
                if (is_below_rounding(id, scalar)) {
                    CHECK_FALSE(found.empty()); // or the list above is too long
                    found.erase(std::remove_if(found.begin(), found.end(), of_smoothness), found.end());
                }
                CHECK(found == std::vector<std::string>{});
            }
        }
    }
}
