// SPDX-License-Identifier: MIT
#include "splinefeed/splines/cyclic_system.hpp"

#include "splinefeed/number/exponent.hpp"
#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// Largest entry of the eliminated matrix, and of the right side and the unknowns. In Fixed four products of entries and
// unknowns plus a right side stay below 2^31: 4 * 2^4 * 2^24 + 2^29.
template <Scalar S>
constexpr S most_entry() noexcept {
    return std::same_as<S, Fixed> ? literal<S>(0x1p4) : literal<S>(0x1p20);
}
template <Scalar S>
constexpr S most_right() noexcept {
    return std::same_as<S, Fixed> ? literal<S>(0x1p29) : literal<S>(0x1p30) * literal<S>(0x1p30);
}
template <Scalar S>
constexpr S most_unknown() noexcept {
    return std::same_as<S, Fixed> ? literal<S>(0x1p24) : literal<S>(0x1p30) * literal<S>(0x1p30);
}

template <Scalar S>
bool small(S x, S limit) noexcept {
    return x >= -limit && x <= limit; // false for NaN
}

// Signs for the estimate of the norm of the inverse: none of the three patterns is orthogonal to a smooth, an
// alternating and an irregular worst case at the same time.
template <Scalar S>
S sign_of(std::size_t i, unsigned pattern) noexcept {
    const bool minus = pattern == 0 ? false : pattern == 1 ? i % 2 == 1 : ((i * 2654435761U) >> 7U) % 2 == 1;
    return from_integer<S>(minus ? -1 : 1);
}

/// Brings the matrix entries to their columns as step k sees them, with the row scaled by a power of two to a largest
/// entry in [1, 2): exact in floating point.
template <Scalar S>
bool place(CyclicRow<S>& row, std::size_t i, std::size_t n, std::size_t k) noexcept {
    const S largest_entry = larger(absolute(row.on), larger(absolute(row.below), absolute(row.above)));
    if (!(largest_entry > S{})) {
        return false;
    }
    const int down = -exponent_of(largest_entry);
    row.window = {};
    row.border = {};
    const auto put = [&](S entry, std::size_t column) {
        if (column + 2 >= n) {
            row.border[column + 2 - n] += scale2(entry, down);
        } else {
            row.window[column - k] += scale2(entry, down);
        }
    };
    if (row.below != S{}) {
        put(row.below, (i + n - 1) % n);
    }
    put(row.on, i);
    if (row.above != S{}) {
        put(row.above, (i + 1) % n);
    }
    for (S& x : row.right) {
        x = scale2(x, down);
    }
    for (unsigned p = 0; p < row.probe.size(); ++p) {
        row.probe[p] = scale2(sign_of<S>(i, p), down);
    }
    return true;
}

/// row -= f * pivot with |f| <= 1, and the window moves on by one column. false if a number exceeds its bound.
template <Scalar S>
bool subtract_multiple(CyclicRow<S>& row, const CyclicRow<S>& pivot) noexcept {
    const S f = row.window[0] / pivot.window[0];
    bool fits = true;
    const auto reduce = [&](S& x, S by, S limit) {
        x -= f * by;
        fits = fits && small(x, limit);
    };
    reduce(row.window[1], pivot.window[1], most_entry<S>());
    reduce(row.window[2], pivot.window[2], most_entry<S>());
    for (unsigned p = 0; p < row.border.size(); ++p) {
        reduce(row.border[p], pivot.border[p], most_entry<S>());
    }
    row.window = {row.window[1], row.window[2], S{}};
    for (unsigned k = 0; k < all_axes && fits; ++k) {
        reduce(row.right[k], pivot.right[k], most_right<S>());
    }
    for (unsigned p = 0; p < row.probe.size() && fits; ++p) {
        reduce(row.probe[p], pivot.probe[p], most_right<S>());
    }
    return fits;
}

/// Writes top / pivot to x; false if it exceeds its bound.
template <Scalar S>
bool divided(S top, S pivot, S& x) noexcept {
    if (!(absolute(top) <= absolute(pivot) * most_unknown<S>())) {
        return false;
    }
    x = top / pivot;
    return true;
}

/// Pivots p_i = on_i - below_i above_{i-1} / p_{i-1} of elimination without exchanges, compared with the size of their
/// rows.
template <Scalar S>
bool regular_without_pivoting(std::span<const CyclicRow<S>> rows) noexcept {
    S pivot{};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const CyclicRow<S>& row = rows[i];
        const S size = larger(absolute(row.on), larger(absolute(row.below), absolute(row.above)));
        pivot = i == 0 ? row.on : row.on - row.below * (rows[i - 1].above / pivot);
        if (!(absolute(pivot) > size * negligible_pivot<S>())) {
            return false;
        }
        // |above / pivot| < 2^20 from here on: fits in Fixed with |below| < 2^11
    }
    return true;
}

template <Scalar S>
S row_sum(const CyclicRow<S>& row) noexcept {
    return absolute(row.below) + absolute(row.on) + absolute(row.above);
}

/// Triangular form, row k with the pivot of column k; exchanges rows as needed. The last two rows keep two columns.
template <Scalar S>
Status eliminate(std::span<CyclicRow<S>> rows, CyclicReport<S>& report) noexcept {
    const std::size_t n = rows.size();
    S weakest = largest<S>();
    const auto note = [&](S pivot, std::size_t column) {
        if (absolute(pivot) < weakest) {
            weakest = absolute(pivot);
            report.weakest = column;
        }
        return weakest > negligible_pivot<S>();
    };
    CyclicRow<S> carried = rows[0];
    CyclicRow<S> closing = rows[n - 1];
    if (!place(carried, 0, n, 0) || !place(closing, n - 1, n, 0)) {
        report.weakest = carried.on == S{} ? 0 : n - 1;
        return Error::system_singular;
    }
    for (std::size_t k = 0; k + 2 < n; ++k) {
        CyclicRow<S> fresh = rows[k + 1];
        if (!place(fresh, k + 1, n, k)) {
            report.weakest = k + 1;
            return Error::system_singular;
        }
        if (absolute(fresh.window[0]) > absolute(carried.window[0])) {
            std::swap(carried, fresh);
        }
        if (absolute(closing.window[0]) > absolute(carried.window[0])) {
            std::swap(carried, closing);
        }
        if (!note(carried.window[0], k)) {
            return Error::system_singular;
        }
        if (!subtract_multiple(fresh, carried) || !subtract_multiple(closing, carried)) {
            return Error::result_out_of_range;
        }
        rows[k] = carried;
        carried = fresh;
    }
    // Two rows in the last two columns: one more step of the same kind.
    carried.window = {carried.border[0], carried.border[1], S{}};
    closing.window = {closing.border[0], closing.border[1], S{}};
    if (absolute(closing.window[0]) > absolute(carried.window[0])) {
        std::swap(carried, closing);
    }
    if (!note(carried.window[0], n - 2)) {
        return Error::system_singular;
    }
    rows[n - 2] = carried;
    if (!subtract_multiple(closing, carried)) {
        return Error::result_out_of_range;
    }
    if (!note(closing.window[0], n - 1)) {
        return Error::system_singular;
    }
    rows[n - 1] = closing;
    return {};
}

/// Back-substitution for one right side; `at(k)` is both the right side of row k and, afterwards, unknown k.
template <Scalar S, class At>
bool substitute(std::span<const CyclicRow<S>> rows, const At& at) noexcept {
    const std::size_t n = rows.size();
    for (std::size_t k = n; k-- > 0;) {
        const CyclicRow<S>& row = rows[k];
        S top = at(k);
        if (k + 1 < n) {
            top -= row.window[1] * at(k + 1);
        }
        if (k + 2 < n) {
            if (k + 4 < n) {
                top -= row.window[2] * at(k + 2);
            }
            top -= row.border[0] * at(n - 2);
            top -= row.border[1] * at(n - 1);
        }
        if (!divided(top, row.window[0], at(k))) {
            return false;
        }
    }
    return true;
}

} // namespace

template <Scalar S>
bool diagonally_dominant(std::span<const CyclicRow<S>> rows) noexcept {
    for (const CyclicRow<S>& row : rows) {
        if (row.on == S{} || absolute(row.on) < absolute(row.below) + absolute(row.above)) {
            return false;
        }
    }
    return true;
}

template <Scalar S>
Status solve_cyclic(std::span<CyclicRow<S>> rows, bool ring, std::span<Point<S>> out,
                    CyclicReport<S>& report) noexcept {
    const std::size_t n = rows.size();
    SPLINEFEED_ASSERT(n >= (ring ? 3U : 1U) && out.size() >= n);
    report = {largest<S>(), 0, !ring && regular_without_pivoting<S>(rows)};
    S norm{};
    for (const CyclicRow<S>& row : rows) {
        norm = larger(norm, row_sum(row));
    }
    if (n == 1) {
        if (!(absolute(rows[0].on) > negligible_pivot<S>()) || !place(rows[0], 0, 1, 0)) {
            return Error::system_singular;
        }
        report.condition = from_integer<S>(1);
        for (unsigned k = 0; k < all_axes; ++k) {
            if (!divided(rows[0].right[k], rows[0].border[1], out[0][k])) {
                return Error::result_out_of_range;
            }
        }
        return {};
    }
    if (const Status status = eliminate(rows, report); !status.ok()) {
        return status;
    }
    // The largest unknown for a right side of signs is a lower bound of the inverse's norm.
    S inverse{};
    for (unsigned p = 0; p < rows[0].probe.size(); ++p) {
        if (!substitute<S>(rows, [&](std::size_t k) -> S& { return rows[k].probe[p]; })) {
            return Error::system_singular;
        }
        for (const CyclicRow<S>& row : rows) {
            inverse = larger(inverse, absolute(row.probe[p]));
        }
    }
    report.condition =
        inverse < quotient_or_max(largest<S>(), norm + from_integer<S>(1)) ? inverse * norm : largest<S>();
    if (!(report.condition * negligible_pivot<S>() < literal<S>(0.25))) {
        return Error::system_singular;
    }
    for (unsigned k = 0; k < all_axes; ++k) {
        if (!substitute<S>(rows, [&](std::size_t i) -> S& { return rows[i].right[k]; })) {
            return Error::result_out_of_range;
        }
        for (std::size_t i = 0; i < n; ++i) {
            out[i][k] = rows[i].right[k];
        }
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template bool diagonally_dominant<S>(std::span<const CyclicRow<S>>) noexcept;                                      \
    template Status solve_cyclic<S>(std::span<CyclicRow<S>>, bool, std::span<Point<S>>, CyclicReport<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
