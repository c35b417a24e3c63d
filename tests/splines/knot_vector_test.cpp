// SPDX-License-Identifier: MIT
#include "splinefeed/splines/knot_vector.hpp"
#include "support/catch.hpp"

#include <limits>
#include <vector>

using namespace splinefeed;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

template <Scalar S = double>
std::vector<double> open(KnotRule rule, const std::vector<double>& t, int degree, bool ends, Error expected = {}) {
    std::vector<S> parameters;
    for (const double value : t) {
        parameters.push_back(from_double<S>(value));
    }
    std::vector<S> knots(60);
    const Status status = open_knots<S>(rule, parameters, degree, ends, knots);
    REQUIRE(status.error() == expected);
    std::vector<double> out;
    for (std::size_t i = 0; status.ok() && i < open_knot_count(open_control_count(t.size(), ends), degree); ++i) {
        out.push_back(to_double(knots[i]));
    }
    return out;
}

template <Scalar S = double>
std::vector<double> closed(KnotRule rule, const std::vector<double>& t, int degree, double period,
                           Error expected = {}) {
    std::vector<S> parameters;
    for (const double value : t) {
        parameters.push_back(from_double<S>(value));
    }
    std::vector<S> knots(60);
    const Status status = closed_knots<S>(rule, parameters, degree, from_double<S>(period), knots);
    REQUIRE(status.error() == expected);
    std::vector<double> out;
    for (std::size_t i = 0; status.ok() && i < closed_knot_count(t.size(), degree); ++i) {
        out.push_back(to_double(knots[i]));
    }
    return out;
}

using List = std::vector<double>;

} // namespace

TEMPLATE_TEST_CASE("open knots: clamped degree + 1 times", "[splines]", double, float, Fixed) {
    using S = TestType;
    // The paper's example, n = 4, k = 3: nine knots, four at each end.
    REQUIRE(open<S>(KnotRule::uniform, {0, 0.5, 1, 1.5, 2}, 3, false) == List{0, 0, 0, 0, 1, 2, 2, 2, 2});
    REQUIRE(open<S>(KnotRule::uniform, {0, 1, 2, 3}, 1, false) == List{0, 0, 1, 2, 3, 3});
    REQUIRE(open<S>(KnotRule::average, {0, 1, 2, 3}, 1, false) == List{0, 0, 1, 2, 3, 3});
    REQUIRE(open<S>(KnotRule::params, {0, 1, 2, 3}, 1, false) == List{0, 0, 1, 2, 3, 3});
    // Means of k consecutive parameters, j = 1 ... n-k.
    REQUIRE(open<S>(KnotRule::average, {0, 1, 5, 6, 10, 16}, 2, false) == List{0, 0, 0, 3, 5.5, 8, 16, 16, 16});
    REQUIRE(open<S>(KnotRule::average, {0, 1, 5, 6, 16}, 3, false) == List{0, 0, 0, 0, 4, 16, 16, 16, 16});
    REQUIRE(open<S>(KnotRule::average, {0, 1, 5, 16}, 3, false) == List{0, 0, 0, 0, 16, 16, 16, 16});
    // j = 0 ... n-k+1 with end derivatives.
    REQUIRE(open<S>(KnotRule::average_tangents, {0, 3, 6, 9}, 3, true) == List{0, 0, 0, 0, 3, 6, 9, 9, 9, 9});
    REQUIRE(open<S>(KnotRule::average_tangents, {0, 2, 6}, 2, true) == List{0, 0, 0, 1, 4, 6, 6, 6});
    REQUIRE(open<S>(KnotRule::average_tangents, {0, 6}, 3, true) == List{0, 0, 0, 0, 6, 6, 6, 6});
    REQUIRE(open<S>(KnotRule::params, {0, 1, 5, 6}, 3, true) == List{0, 0, 0, 0, 1, 5, 6, 6, 6, 6});
}

TEMPLATE_TEST_CASE("closed knots continue periodically", "[splines]", double, float, Fixed) {
    using S = TestType;
    // The paper's example n = 4, k = 3: the last knot is 8.
    REQUIRE(closed<S>(KnotRule::params, {0, 1, 2, 3, 4}, 3, 5) == List{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8});
    REQUIRE(closed<S>(KnotRule::uniform, {0, 1, 2, 3, 4}, 3, 5) == List{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8});
    REQUIRE(closed<S>(KnotRule::midpoints, {0, 2, 3, 6}, 2, 8) == List{-3.5, -1, 1, 2.5, 4.5, 7, 9, 10.5, 12.5});
    // (0+2)/2, (2+3)/2, (3+6)/2, (6+8)/2: averages in degree 2 are the midpoints.
    REQUIRE(closed<S>(KnotRule::average, {0, 2, 3, 6}, 2, 8) == closed<S>(KnotRule::midpoints, {0, 2, 3, 6}, 2, 8));
    // (0+1+2)/3, ..., (8+9+10)/3 = 9, (9+10+11)/3 = 10 = 0 modulo 10
    REQUIRE(closed<S>(KnotRule::average, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 3, 10) ==
            closed<S>(KnotRule::params, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 3, 10));
    // Fewer points than the degree wants: the average runs around more than once.
    const List small = closed<S>(KnotRule::average, {0, 1, 2}, 9, 3);
    REQUIRE(small.size() == 22);
    REQUIRE(small[9] == 0.0);
    REQUIRE(small[12] == 3.0);
    REQUIRE(small.front() == -9.0);
}

TEST_CASE("knot rules refuse what they cannot do", "[splines]") {
    const List t{0, 1, 2, 3};
    open(KnotRule::average, t, 0, false, Error::degree_out_of_range);
    open(KnotRule::average, t, 10, false, Error::degree_out_of_range);
    open(KnotRule::average, t, 4, false, Error::too_few_points);
    open(KnotRule::average, {0}, 1, false, Error::too_few_points);
    open(KnotRule::average, t, 3, true, Error::knot_rule_unsuited);
    open(KnotRule::average_tangents, t, 3, false, Error::knot_rule_unsuited);
    open(KnotRule::average_tangents, t, 1, true, Error::knot_rule_unsuited);
    open(KnotRule::params, t, 3, false, Error::knot_rule_unsuited);
    open(KnotRule::params, t, 2, true, Error::knot_rule_unsuited);
    open(KnotRule::midpoints, t, 3, false, Error::knot_rule_unsuited);
    open(KnotRule::average, {0, 1, 1, 3}, 2, false, Error::parameters_invalid);
    open(KnotRule::average, {0, 2, 1, 3}, 2, false, Error::parameters_invalid);
    open(KnotRule::average, {1, 2, 3, 4}, 2, false, Error::parameters_invalid);
    open(KnotRule::average, {0, not_a_number, 3, 4}, 2, false, Error::parameters_invalid);
    open(KnotRule::average, {0, 1, 3, infinite}, 2, false, Error::parameters_invalid);
    closed(KnotRule::average_tangents, t, 3, 4, Error::knot_rule_unsuited);
    closed(KnotRule::params, {0, 1}, 3, 4, Error::too_few_points);
    closed(KnotRule::params, t, 3, 3, Error::parameters_invalid);
    closed(KnotRule::params, t, 3, not_a_number, Error::parameters_invalid);
    closed(KnotRule::params, t, 10, 4, Error::degree_out_of_range);
    std::vector<double> little(7);
    REQUIRE(open_knots<double>(KnotRule::average, t, 3, false, little).error() == Error::storage_too_small);
    REQUIRE(closed_knots<double>(KnotRule::params, t, 3, 4.0, little).error() == Error::storage_too_small);
}

TEST_CASE("given knots are checked", "[splines]") {
    const auto check = [](const List& knots, int degree) {
        return check_knots<double>(knots, degree).error();
    };
    REQUIRE(check({0, 0, 0, 1, 2, 2, 2}, 2) == Error::none);
    REQUIRE(check({0, 0, 0, 1, 1, 1, 2, 2, 2}, 2) == Error::none);
    REQUIRE(check({0, 0, 0, 1, 1, 1, 1, 2, 2, 2}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 0, 0, 0, 2, 2, 2}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 0, 0, 2, 1, 3, 3, 3}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 0, 0, not_a_number, 3, 3, 3}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 0, 0, 1, 3, 3, infinite}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 0, 0, 3, 3}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 1, 1, 2, 2, 3}, 2) == Error::none);
    REQUIRE(check({0, 0, 1, 1, 1, 2}, 2) == Error::knots_invalid);
    REQUIRE(check({0, 0, 0, 1, 1, 1}, 0) == Error::degree_out_of_range);
    REQUIRE(check_closed_knots<double>(List{-2, -1, 0, 1, 2, 3, 4, 5}, 2).ok());
    REQUIRE_FALSE(check_closed_knots<double>(List{-2, -1, 0, 1, 2, 3, 4, 6}, 2).ok());
}
