// SPDX-License-Identifier: MIT
//
// L U in place: multipliers are stored where the entries were that they remove. Interchanges swap only the entries to
// the right of the pivot, so they are applied to a right-hand side step by step.
//
// Error. For a totally positive A, elimination without pivoting gives L >= 0, U >= 0 and L U = A. So the solved system
// is (A + E) x = b with |E| <= c width u A entry by entry, where u is the rounding of a weight (2^-53, 2^-24, in Fixed
// 2^-47 absolutely) and c is about 3: an error of x below 3 (width + 1) u condition, in rows that sum to 1.
#include "splinefeed/splines/banded_system.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
constexpr int smallest_pivot_log2 = std::same_as<S, double>  ? -44
                                    : std::same_as<S, float> ? -18
                                                             : -32;

/// 2^-smallest_pivot_log2 as a weight.
template <Scalar S>
S smallest_pivot() noexcept {
    return scale2(weight_one<S>(), smallest_pivot_log2<S>);
}

// In Fixed, values up to 2^28 leave room for the sums; a product with a multiplier above 1 must stay below, too.
template <Scalar S>
bool in_range(S value) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return absolute(value) < from_integer<S>(1 << 28);
    } else {
        return absolute(value) <= largest<S>();
    }
}
template <Scalar S>
bool product_in_range(S weight, S value) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        const S size = scale2(absolute(weight), -weight_log2<S>);
        return size <= from_integer<S>(1) || absolute(value) < from_integer<S>(1 << 28) / size;
    } else {
        return true;
    }
}
template <Scalar S>
bool quotient_in_range(S value, S pivot) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return quotient_or_max(absolute(value), absolute(pivot)) < from_integer<S>(1 << (28 - weight_log2<S>));
    } else {
        return true;
    }
}

/// to -= weight * value; false if out of range.
template <Scalar S>
bool subtract_row(Point<S>& to, S weight, const Point<S>& value, unsigned axes) noexcept {
    if (weight == S{}) {
        return true;
    }
    for (unsigned k = 0; k < axes; ++k) {
        if (!product_in_range(weight, value[k])) {
            return false;
        }
        to[k] -= weighted(weight, value[k]);
        if (!in_range(to[k])) {
            return false;
        }
    }
    return true;
}

} // namespace

template <Scalar S>
BandedSystem<S>::BandedSystem(const BandShape& shape, std::span<S> entries,
                              std::span<std::uint8_t> interchanges) noexcept
    : shape_(shape), band_(shape.band()), row_entries_(shape.row_entries()),
      reach_(shape.elimination == Elimination::pivoting ? 2U * shape.band() : shape.band()),
      entries_(entries.first(shape.entries())), interchanges_(interchanges.first(shape.interchanges())) {
    SPLINEFEED_ASSERT(shape.size > 0 && band_ < 256);
    for (S& entry : entries_) {
        entry = S{};
    }
}

template <Scalar S>
std::size_t BandedSystem<S>::folded(std::size_t i) const noexcept {
    return !shape_.cyclic ? i : 2U * i < shape_.size ? 2U * i : 2U * (shape_.size - i) - 1U;
}

template <Scalar S>
std::size_t BandedSystem<S>::unfolded(std::size_t i) const noexcept {
    return !shape_.cyclic ? i : i % 2U == 0 ? i / 2U : shape_.size - (i + 1U) / 2U;
}

template <Scalar S>
void BandedSystem<S>::add(std::size_t row, std::size_t column, S weight) noexcept {
    const std::size_t i = folded(row);
    const std::size_t j = folded(column);
    SPLINEFEED_ASSERT(i < shape_.size && j < shape_.size && j + band_ >= i && j <= i + band_);
    at(i, j) += weight;
}

template <Scalar S>
Status BandedSystem<S>::factor() noexcept {
    const std::size_t size = shape_.size;
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t rows_end = i + band_ < size ? i + band_ + 1U : size;
        const std::size_t columns_end = i + reach_ < size ? i + reach_ + 1U : size;
        if (shape_.elimination == Elimination::pivoting) {
            std::size_t best = i;
            for (std::size_t r = i + 1U; r < rows_end; ++r) {
                if (absolute(at(r, i)) > absolute(at(best, i))) {
                    best = r;
                }
            }
            interchanges_[i] = static_cast<std::uint8_t>(best - i);
            for (std::size_t c = i; best != i && c < columns_end; ++c) {
                const S kept = at(i, c);
                at(i, c) = at(best, c);
                at(best, c) = kept;
            }
        }
        const S pivot = at(i, i);
        if (!(absolute(pivot) >= smallest_pivot<S>())) {
            return Error::system_singular;
        }
        for (std::size_t r = i + 1U; r < rows_end; ++r) {
            S& entry = at(r, i);
            if (entry == S{}) {
                continue;
            }
            if constexpr (std::same_as<S, Fixed>) {
                if (quotient_or_max(absolute(entry), absolute(pivot)) >= from_integer<S>(1 << 15)) {
                    return Error::system_singular;
                }
            }
            entry = weight_ratio(entry, pivot);
            for (std::size_t c = i + 1U; c < columns_end; ++c) {
                at(r, c) -= weight_product(entry, at(i, c));
            }
        }
    }
    return {};
}

template <Scalar S>
Status BandedSystem<S>::solve(std::span<Point<S>> values, int axes, std::size_t first,
                              std::size_t stride) const noexcept {
    const std::size_t size = shape_.size;
    const auto axes_u = static_cast<unsigned>(axes);
    const auto value = [&](std::size_t i) -> Point<S>& {
        return values[first + unfolded(i) * stride];
    };
    for (std::size_t i = 0; i < size; ++i) {
        Point<S>& here = value(i);
        for (unsigned k = 0; k < axes_u; ++k) {
            if (!in_range(here[k])) {
                return Error::result_out_of_range;
            }
        }
    }
    for (std::size_t i = 0; i < size; ++i) {
        if (shape_.elimination == Elimination::pivoting && interchanges_[i] != 0) {
            Point<S>& other = value(i + interchanges_[i]);
            const Point<S> kept = value(i);
            value(i) = other;
            other = kept;
        }
        const std::size_t rows_end = i + band_ < size ? i + band_ + 1U : size;
        for (std::size_t r = i + 1U; r < rows_end; ++r) {
            if (!subtract_row(value(r), at(r, i), value(i), axes_u)) {
                return Error::result_out_of_range;
            }
        }
    }
    for (std::size_t i = size; i-- > 0;) {
        Point<S>& here = value(i);
        const std::size_t columns_end = i + reach_ < size ? i + reach_ + 1U : size;
        for (std::size_t c = i + 1U; c < columns_end; ++c) {
            if (!subtract_row(here, at(i, c), value(c), axes_u)) {
                return Error::result_out_of_range;
            }
        }
        for (unsigned k = 0; k < axes_u; ++k) {
            if (!quotient_in_range(here[k], at(i, i))) {
                return Error::result_out_of_range;
            }
            here[k] = weight_ratio(here[k], at(i, i));
            if (!in_range(here[k])) {
                return Error::result_out_of_range;
            }
        }
    }
    return {};
}

SPLINEFEED_INSTANTIATE_CLASS(BandedSystem)

} // namespace splinefeed
