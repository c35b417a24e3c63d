// SPDX-License-Identifier: MIT
// Hash over the bits of whatever the corpus makes.
#pragma once

#include "integer_hash.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"
#include "splinefeed/splines/bezier_piece.hpp"

#include <bit>
#include <cstdint>

namespace bits {

inline constexpr unsigned axes = 3;

class Hash : public IntegerHash {
public:
    using IntegerHash::add;
    template <splinefeed::Scalar S>
    void add_scalar(S value) {
        if constexpr (std::same_as<S, splinefeed::Fixed>) {
            add(static_cast<std::uint64_t>(value.raw()));
        } else if constexpr (std::same_as<S, float>) {
            add(std::bit_cast<std::uint32_t>(value));
        } else {
            add(std::bit_cast<std::uint64_t>(value));
        }
    }
    void add(splinefeed::Position position) { add(static_cast<std::uint64_t>(position.raw)); }

    template <splinefeed::Scalar S>
    void add(const splinefeed::CurveSegment<S>& segment) {
        add(static_cast<std::uint64_t>(segment.unit_log2));
        add(segment.waypoint);
        for (unsigned k = 0; k < axes; ++k) {
            add(segment.origin[k]);
            for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
                add_scalar(segment.control[k][i]);
            }
        }
    }
    template <splinefeed::Scalar S>
    void add(const splinefeed::BezierPiece<S>& piece) {
        for (unsigned k = 0; k < axes; ++k) {
            for (unsigned i = 0; i <= static_cast<unsigned>(piece.degree); ++i) {
                add_scalar(piece.control[k][i]);
            }
        }
    }
    template <splinefeed::Scalar S>
    void add_point(const splinefeed::Point<S>& point) {
        for (unsigned k = 0; k < axes; ++k) {
            add_scalar(point[k]);
        }
    }
    void add(const splinefeed::FeedSegment& segment) {
        add(segment.index);
        add(segment.duration_ticks);
        add(segment.waypoint);
        for (const auto* values : {&segment.start, &segment.end, &segment.start_velocity, &segment.end_velocity}) {
            for (unsigned k = 0; k < axes; ++k) {
                add(static_cast<std::uint64_t>((*values)[k]));
            }
        }
    }
};

} // namespace bits
