// SPDX-License-Identifier: MIT
// element_cast: a move in another scalar.
#pragma once

#include "splinefeed/s1_blended_path/path_element.hpp"

namespace splinefeed {

/// Points of a Bezier segment in Fixed may lose digits that double does not have.
template <Scalar To, Scalar From>
[[nodiscard]] PathElement<To> element_cast(const PathElement<From>& element) noexcept {
    if constexpr (std::same_as<To, From>) {
        return element;
    } else {
        const auto number = [](From value) {
            if constexpr (std::same_as<To, Fixed>) {
                return Fixed::from_double(to_double(value));
            } else {
                return to_floating<To>(value); // from Fixed to float without double, which a chip has not
            }
        };
        PathElement<To> out;
        out.shape = element.shape;
        out.mode = element.mode;
        out.stop_at_end = element.stop_at_end;
        out.joined = element.joined;
        out.to = element.to;
        if (element.shape == MoveShape::arc) {
            out.arc.centre = element.arc.centre;
            for (unsigned k = 0; k < 3; ++k) {
                out.arc.normal[k] = number(element.arc.normal[k]);
            }
            out.arc.sweep_rad = number(element.arc.sweep_rad);
        }
        if (element.shape == MoveShape::bezier) {
            out.bezier.degree = element.bezier.degree;
            for (const unsigned k : indices(max_axes)) {
                for (unsigned i = 0; i <= static_cast<unsigned>(element.bezier.degree); ++i) {
                    out.bezier.points[k][i] = number(element.bezier.points[k][i]);
                }
            }
        }
        out.tolerance_mm = number(element.tolerance_mm);
        out.chain_tolerance_mm = number(element.chain_tolerance_mm);
        out.feed_mm_s = number(element.feed_mm_s);
        out.max_feed_mm_s = number(element.max_feed_mm_s);
        return out;
    }
}

} // namespace splinefeed
