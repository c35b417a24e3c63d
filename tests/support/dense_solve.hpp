// SPDX-License-Identifier: MIT
//
// Dense elimination with row pivoting in long double, and the condition of a matrix.
#pragma once

#include "support/exact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace splinefeed_test {

using Matrix = std::vector<std::vector<Real>>;

/// Solves a x = b with row pivoting for several right-hand sides at once; the smallest pivot is returned.
inline Real dense_solve(Matrix a, Matrix& b) {
    const std::size_t n = a.size();
    Real smallest = 1.0e300L;
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t best = i;
        for (std::size_t r = i; r < n; ++r) {
            best = std::abs(a[r][i]) > std::abs(a[best][i]) ? r : best;
        }
        std::swap(a[i], a[best]);
        std::swap(b[i], b[best]);
        smallest = std::min(smallest, std::abs(a[i][i]));
        for (std::size_t r = i + 1U; r < n; ++r) {
            const Real m = a[r][i] / a[i][i];
            for (std::size_t c = i; c < n; ++c) {
                a[r][c] -= m * a[i][c];
            }
            for (std::size_t c = 0; c < b[i].size(); ++c) {
                b[r][c] -= m * b[i][c];
            }
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t c = 0; c < b[i].size(); ++c) {
            for (std::size_t j = i + 1U; j < n; ++j) {
                b[i][c] -= a[i][j] * b[j][c];
            }
            b[i][c] /= a[i][i];
        }
    }
    return smallest;
}

/// The condition of a matrix, by row sums.
inline Real condition_of(const Matrix& a) {
    Matrix inverse(a.size(), std::vector<Real>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i) {
        inverse[i][i] = 1.0L;
    }
    dense_solve(a, inverse);
    Real norm = 0.0L;
    Real own = 0.0L;
    for (std::size_t i = 0; i < a.size(); ++i) {
        Real sum = 0.0L;
        Real own_sum = 0.0L;
        for (std::size_t j = 0; j < a.size(); ++j) {
            sum += std::abs(inverse[i][j]);
            own_sum += std::abs(a[i][j]);
        }
        norm = std::max(norm, sum);
        own = std::max(own, own_sum);
    }
    return norm * own;
}

} // namespace splinefeed_test
