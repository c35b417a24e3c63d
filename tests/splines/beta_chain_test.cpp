// SPDX-License-Identifier: MIT
//
// Chains of polygons: the class of every joint as measured, the order of free points, the degenerate inputs.
#include "splinefeed/splines/beta_chain.hpp"

#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Storage and description of a random chain.
template <Scalar S>
struct RandomChain {
    std::vector<Point<S>> first;
    std::vector<Point<S>> free;
    std::vector<Beta<S>> betas;
    BetaChain<S> chain;

    RandomChain(RandomPath& random, int degree, int order, bool closed, int joints, int axes = 3) {
        const auto point = [&] {
            Point<S> out{};
            for (const unsigned k : indices(axes)) {
                out[k] = scale2(from_integer<S>(random.below(1 << 15)), -10);
            }
            return out;
        };
        for (int i = 0; !closed && i <= degree; ++i) {
            first.push_back(point());
        }
        for (int j = 0; j < joints; ++j) {
            for (int i = order; i < degree; ++i) {
                free.push_back(point());
            }
            betas.push_back({scale2(from_integer<S>(48 + random.below(48)), -6),
                             scale2(from_integer<S>(random.below(129) - 64), -6)});
        }
        chain = {degree, order, closed, first, free, betas};
    }
};

} // namespace

TEMPLATE_TEST_CASE("beta chain: joints are what was asked, open and closed", "[splines][beta]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 6);
    CAPTURE(path_seed);
    for (int order = 1; order <= 2; ++order) {
        for (const bool closed : {false, true}) {
            for (int degree = closed ? 2 * order + 1 : order; degree <= 9; ++degree) {
                for (int joints = closed ? 1 : 0; joints <= 6; ++joints) {
                    // Order 2 and degree 2: nothing is free, and each joint bends on what the one before left.
                    const RandomChain<S> random_chain(random, degree, order, closed, joints, 2);
                    const BetaChain<S>& chain = random_chain.chain;
                    std::vector<BezierPiece<S>> pieces(chain.piece_count());
                    std::vector<BetaJoint<S>> points(chain.joint_count());
                    CAPTURE(order, closed, degree, joints);
                    REQUIRE(beta_chain<S>(chain, pieces, points).ok());
                    for (std::size_t j = 0; j < chain.joint_count(); ++j) {
                        const BezierPiece<S>& before = pieces[j];
                        const BezierPiece<S>& after = pieces[(j + 1) % pieces.size()];
                        REQUIRE(after.degree == degree);
                        REQUIRE(after.point(0) == points[j].w0);
                        REQUIRE(after.point(1) == points[j].w1);
                        REQUIRE(before.point(degree) == points[j].w0);
                        const auto free = static_cast<std::size_t>(degree - order);
                        for (std::size_t i = 0; i < free; ++i) { // polygon j of a closed chain has the free points j
                            const std::size_t owner = closed ? (j + 1) % pieces.size() : j;
                            REQUIRE(after.point(order + 1 + static_cast<int>(i)) ==
                                    random_chain.free[owner * free + i]);
                        }
                        const auto measured = measure_joint(before, after);
                        REQUIRE(measured.has_value());
                        const double fine = std::same_as<S, float> ? 2e-2 : 1e-5;
                        CHECK(to_double(measured->tangent_jump) < fine);
                        CHECK(to_double(measured->beta.beta1) == Approx(to_double(chain.betas[j].beta1)).epsilon(fine));
                        if (order == 2) {
                            REQUIRE(after.point(2) == points[j].w2);
                            CHECK(to_double(measured->curvature_jump) < 8.0 * fine);
                            CHECK(to_double(measured->beta.beta2) ==
                                  Approx(to_double(chain.betas[j].beta2)).epsilon(fine).margin(8.0 * fine));
                        }
                    }
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("beta chain: what is refused", "[splines][beta]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 7);
    std::vector<BezierPiece<S>> pieces(8);
    std::vector<BetaJoint<S>> joints(8);
    const auto refuse = [&](const BetaChain<S>& chain, Error error) {
        CHECK(beta_chain<S>(chain, pieces, joints).error() == error);
    };
    for (int order = 1; order <= 2; ++order) {
        for (int degree = order; degree <= 2 * order; ++degree) {
            refuse(RandomChain<S>(random, degree, order, true, 3).chain, Error::closed_chain_overlaps);
        }
        refuse(RandomChain<S>(random, order - 1, order, false, 3).chain, Error::degree_out_of_range);
        refuse(RandomChain<S>(random, 10, order, false, 3).chain, Error::degree_out_of_range);
    }
    const RandomChain<S> good(random, 5, 2, false, 3);
    const RandomChain<S> round(random, 5, 2, true, 3);
    auto chain = good.chain;
    chain.order = 3;
    refuse(chain, Error::degree_out_of_range);
    chain = good.chain;
    chain.free_points = chain.free_points.first(8);
    refuse(chain, Error::too_few_points);
    chain = good.chain;
    chain.first_polygon = chain.first_polygon.first(5);
    refuse(chain, Error::too_few_points);
    chain = round.chain;
    chain.first_polygon = good.chain.first_polygon;
    refuse(chain, Error::too_few_points);
    chain = round.chain;
    chain.free_points = {};
    chain.betas = {};
    refuse(chain, Error::too_few_points);
    const auto few_pieces = beta_chain<S>(good.chain, std::span(pieces).first(3), joints);
    CHECK(few_pieces.error() == Error::storage_too_small);
    const auto few_joints = beta_chain<S>(good.chain, pieces, std::span(joints).first(2));
    CHECK(few_joints.error() == Error::storage_too_small);

    std::size_t where = 99;
    RandomChain<S> bad(random, 5, 2, false, 3);
    bad.betas[1].beta1 = S{};
    CHECK(beta_chain<S>(bad.chain, pieces, joints, &where).error() == Error::beta1_not_positive);
    CHECK(where == 1);
    RandomChain<S> still(random, 5, 2, false, 3);
    still.free[4] = still.free[5]; // the second polygon ends in a double point
    CHECK(beta_chain<S>(still.chain, pieces, joints, &where).error() == Error::tangent_vanishes);
    CHECK(where == 2);
}

TEMPLATE_TEST_CASE("beta chain: growth is refused before it overflows", "[splines][beta]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 8);
    RandomChain<S> wild(random, 2, 2, false, 60); // nothing free: every joint bends further, growth 25 each
    for (auto& beta : wild.betas) {
        beta = {from_integer<S>(8), from_integer<S>(8)};
    }
    std::vector<BezierPiece<S>> pieces(61);
    std::vector<BetaJoint<S>> joints(60);
    std::size_t where = 0;
    const Status status = beta_chain<S>(wild.chain, pieces, joints, &where);
    CHECK((std::same_as<S, double> ? status.ok() : status.error() == Error::result_out_of_range));
    CHECK((std::same_as<S, double> || where > 1));
}
