// SPDX-License-Identifier: MIT
#include "splinefeed/surfaces/surface_interpolation.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
Status check(const PointGrid<S>& grid, const SurfaceKind& kind, const SurfaceStorage<S>& storage) noexcept {
    if (grid.axes < 1 || grid.axes > max_axes) {
        return Error::axes_out_of_range;
    }
    if (kind.degree_u < 1 || kind.degree_u > max_degree || kind.degree_v < 1 || kind.degree_v > max_degree) {
        return Error::degree_out_of_range;
    }
    const auto order_u = static_cast<std::size_t>(kind.degree_u) + 1U;
    const auto order_v = static_cast<std::size_t>(kind.degree_v) + 1U;
    if (grid.rows < order_u || grid.columns < order_v) {
        return Error::too_few_points;
    }
    const std::size_t longest = grid.rows < grid.columns ? grid.columns : grid.rows;
    if (grid.points.size() < grid.rows * grid.columns || storage.parameters_u.size() < grid.rows ||
        storage.parameters_v.size() < grid.columns || storage.knots_u.size() < grid.rows + order_u ||
        storage.knots_v.size() < grid.columns + order_v || storage.net.size() < grid.rows * grid.columns ||
        storage.row.size() < longest || storage.row_parameters.size() < longest ||
        storage.entries.size() < kind.entries(grid.rows, grid.columns)) {
        return Error::storage_too_small;
    }
    for (std::size_t i = 0; i < grid.rows * grid.columns; ++i) {
        for (const unsigned k : indices(grid.axes)) {
            if (!within(grid.points[i][k], largest<S>())) {
                return Error::position_out_of_range;
            }
        }
    }
    return {};
}

} // namespace

template <Scalar S>
Status grid_parameters(const PointGrid<S>& grid, SurfaceDirection along, Parameterization how, S domain_length,
                       const SurfaceStorage<S>& storage, std::span<S> parameters) noexcept {
    const bool along_u = along == SurfaceDirection::u;
    const std::size_t count = along_u ? grid.rows : grid.columns;
    const std::size_t lines = along_u ? grid.columns : grid.rows;
    const std::span<Point<S>> row = storage.row.first(count);
    const std::span<S> of_row = storage.row_parameters.first(count);
    for (std::size_t i = 0; i < count; ++i) {
        parameters[i] = S{};
    }
    std::int32_t regular = 0;
    for (std::size_t line = 0; line < lines; ++line) {
        for (std::size_t i = 0; i < count; ++i) {
            row[i] = grid.points[along_u ? i * grid.columns + line : line * grid.columns + i];
        }
        const Status status = spline_parameters<S>(row, grid.axes, how, false, domain_length, of_row);
        if (status.error() == Error::coincident_points) {
            continue;
        }
        if (!status.ok()) {
            return status;
        }
        // The mean so far, moved towards this row: a sum of the rows might not fit.
        ++regular;
        const S share = from_integer<S>(regular);
        for (std::size_t i = 0; i < count; ++i) {
            parameters[i] += (of_row[i] - parameters[i]) / share;
        }
    }
    if (regular == 0) {
        return Error::coincident_points;
    }
    parameters[0] = S{};
    parameters[count - 1U] = domain_length;
    return {};
}

template <Scalar S>
Status interpolate_net(const PointGrid<S>& grid, const SurfaceKind& kind, const SurfaceStorage<S>& storage) noexcept {
    const std::size_t size = grid.rows * grid.columns;
    const std::span<Point<S>> net = storage.net.first(size);
    for (std::size_t i = 0; i < size; ++i) {
        net[i] = grid.points[i];
    }
    BsplineInterpolation<S> system;
    const std::span<const S> knots_v = storage.knots_v.first(open_knot_count(grid.columns, kind.degree_v));
    const std::span<const S> parameters_v = storage.parameters_v.first(grid.columns);
    if (const Status status = system.prepare({kind.degree_v}, parameters_v, knots_v, storage.entries, {});
        !status.ok()) {
        return status;
    }
    for (std::size_t i = 0; i < grid.rows; ++i) { // C_il = sum_j d_ij N_j(v_l)
        if (const Status status = system.solve(net, grid.axes, i * grid.columns, 1); !status.ok()) {
            return status;
        }
    }
    const std::span<const S> knots_u = storage.knots_u.first(open_knot_count(grid.rows, kind.degree_u));
    const std::span<const S> parameters_u = storage.parameters_u.first(grid.rows);
    if (const Status status = system.prepare({kind.degree_u}, parameters_u, knots_u, storage.entries, {});
        !status.ok()) {
        return status;
    }
    for (std::size_t j = 0; j < grid.columns; ++j) {
        if (const Status status = system.solve(net, grid.axes, j, grid.columns); !status.ok()) {
            return status;
        }
    }
    return {};
}

template <Scalar S>
Result<BSplineSurface<S>> interpolate_surface(const PointGrid<S>& grid, const SurfaceKind& kind, S length_u, S length_v,
                                              const SurfaceStorage<S>& storage) noexcept {
    Status status = check(grid, kind, storage);
    const auto then = [&status](auto&& step) {
        if (status.ok()) {
            status = step();
        }
    };
    const std::span<S> parameters_u = storage.parameters_u.first(status.ok() ? grid.rows : 0);
    const std::span<S> parameters_v = storage.parameters_v.first(status.ok() ? grid.columns : 0);
    then([&] { return grid_parameters(grid, SurfaceDirection::u, kind.parameters, length_u, storage, parameters_u); });
    then([&] { return grid_parameters(grid, SurfaceDirection::v, kind.parameters, length_v, storage, parameters_v); });
    then([&] { return open_knots<S>(kind.knots, parameters_u, kind.degree_u, false, storage.knots_u); });
    then([&] { return open_knots<S>(kind.knots, parameters_v, kind.degree_v, false, storage.knots_v); });
    then([&] { return interpolate_net(grid, kind, storage); });
    if (!status.ok()) {
        return status.error();
    }
    BSplineSurface<S> surface;
    surface.axes = grid.axes;
    surface.degree_u = kind.degree_u;
    surface.degree_v = kind.degree_v;
    surface.knots_u = storage.knots_u.first(open_knot_count(grid.rows, kind.degree_u));
    surface.knots_v = storage.knots_v.first(open_knot_count(grid.columns, kind.degree_v));
    surface.net = storage.net.first(grid.rows * grid.columns);
    return surface;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status grid_parameters(const PointGrid<S>&, SurfaceDirection, Parameterization, S,                        \
                                    const SurfaceStorage<S>&, std::span<S>) noexcept;                                  \
    template Status interpolate_net(const PointGrid<S>&, const SurfaceKind&, const SurfaceStorage<S>&) noexcept;       \
    template Result<BSplineSurface<S>> interpolate_surface(const PointGrid<S>&, const SurfaceKind&, S, S,              \
                                                           const SurfaceStorage<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
