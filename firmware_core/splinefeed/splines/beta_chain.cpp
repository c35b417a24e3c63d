// SPDX-License-Identifier: MIT
#include "splinefeed/splines/beta_chain.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
Status check(const BetaChain<S>& chain, std::size_t pieces, std::size_t joints) noexcept {
    if (chain.order < 1 || chain.order > 2 || chain.degree < chain.order || chain.degree > max_degree) {
        return Error::degree_out_of_range;
    }
    if (chain.closed && chain.degree < 2 * chain.order + 1) {
        return Error::closed_chain_overlaps;
    }
    const auto free = static_cast<std::size_t>(chain.degree - chain.order);
    const std::size_t given = chain.closed ? 0U : static_cast<std::size_t>(chain.degree) + 1U;
    if (chain.piece_count() == 0 || chain.first_polygon.size() != given ||
        chain.free_points.size() != free * chain.joint_count()) {
        return Error::too_few_points;
    }
    if (pieces < chain.piece_count() || joints < chain.joint_count()) {
        return Error::storage_too_small;
    }
    return {};
}

} // namespace

template <Scalar S>
Status beta_chain(const BetaChain<S>& chain, std::span<BezierPiece<S>> pieces, std::span<BetaJoint<S>> joints,
                  std::size_t* failed_joint) noexcept {
    if (const Status status = check(chain, pieces.size(), joints.size()); !status.ok()) {
        return status;
    }
    const int free = chain.degree - chain.order;
    const std::size_t count = chain.piece_count();
    const auto behind = [count](std::size_t j) {
        return j + 1 < count ? j + 1 : 0;
    };
    for (std::size_t p = 0; p < count; ++p) {
        pieces[p] = BezierPiece<S>{};
        pieces[p].degree = chain.degree;
    }
    for (int i = 0; !chain.closed && i <= chain.degree; ++i) {
        pieces[0].set_point(i, chain.first_polygon[static_cast<std::size_t>(i)]);
    }
    // All free points first: a joint of a closed chain reads those of the polygon before it.
    for (std::size_t j = 0; j < chain.joint_count(); ++j) {
        for (int i = 0; i < free; ++i) {
            pieces[behind(j)].set_point(chain.order + 1 + i,
                                        chain.free_points[((j + (chain.closed ? 1U : 0U)) % chain.joint_count()) *
                                                              static_cast<std::size_t>(free) +
                                                          static_cast<std::size_t>(i)]);
        }
    }
    for (std::size_t j = 0; j < chain.joint_count(); ++j) {
        const Result<BetaJoint<S>> joint = beta_joint(pieces[j], chain.betas[j], chain.order);
        if (!joint.has_value()) {
            if (failed_joint != nullptr) {
                *failed_joint = j;
            }
            return joint.error();
        }
        joints[j] = *joint;
        BezierPiece<S>& after = pieces[behind(j)];
        after.set_point(0, joint->w0);
        after.set_point(1, joint->w1);
        if (chain.order == 2) {
            after.set_point(2, joint->w2);
        }
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status beta_chain(const BetaChain<S>&, std::span<BezierPiece<S>>, std::span<BetaJoint<S>>,                \
                               std::size_t*) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
