// SPDX-License-Identifier: MIT
// Spline parameters: the parameter t at which an interpolating spline passes through each point.
#pragma once

#include "splinefeed/splines/bezier_piece.hpp"
#include "splinefeed/splines/parameterization.hpp"

#include <span>

namespace splinefeed {

/// Parameters of points. Open: parameters[0] = 0 and the last one is domain_length. Closed: parameters[0] = 0; the
/// chord that closes the curve ends at the period domain_length, which is not written; the first point must not be
/// repeated as the last one. Source: Sakude, section 2 ("comprimento da poligonal"); centripetal is an extension.
///
/// In Fixed a domain of 2^10 to 2^26 keeps the digits of the differences (2^16 is a good choice). The error of
/// a parameter is then below domain_length * 2^-45 + (2 + points / 2^14) ulp for coordinates of about 2^18.
/// Errors: too_few_points (open 2, closed 3), storage_too_small, parameters_invalid (domain_length not positive, in
/// Fixed above 2^26). Then coincident_points (a chord of length zero, unless uniform; in Fixed shorter than half an ulp
/// of the sum's unit), position_out_of_range (not finite; in Fixed a chord of 2^30). Cost: two roots and a division
/// each.
template <Scalar S>
Status spline_parameters(std::span<const Point<S>> points, int axes, Parameterization how, bool closed, S domain_length,
                         std::span<S> parameters) noexcept;

} // namespace splinefeed
