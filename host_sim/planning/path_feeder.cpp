// SPDX-License-Identifier: MIT
#include "host_sim/planning/path_feeder.hpp"

#include "host_sim/planning/element_feeder.hpp"
#include "host_sim/planning/waypoint_feeder.hpp"

#include <fmt/format.h>
#include <utility>

namespace splinefeed::host {

namespace {

/// Of a curve that came whole.
class NothingToFeed final : public PathFeeder {
public:
    explicit NothingToFeed(std::uint64_t points_read) noexcept : points_read_(points_read) {}

    bool more(Pushed& /*pushed*/) override { return false; }
    [[nodiscard]] bool wait_for_row(Patience /*patience*/) override { return true; }
    [[nodiscard]] std::uint64_t rows() const noexcept override { return points_read_; }

private:
    std::uint64_t points_read_;
};

} // namespace

std::string PathFeeder::name_of_row(std::uint32_t row) const {
    return fmt::format("point {}", row + 1);
}

std::uint64_t PathFeeder::whole_row(std::uint32_t row) const noexcept {
    const auto ago = static_cast<std::uint32_t>(static_cast<std::uint32_t>(rows()) - row);
    return rows() >= ago ? rows() - ago : row;
}

std::unique_ptr<PathFeeder> make_feeder(PathInput& input, MoveStream& stream) {
    return std::make_unique<ElementFeeder>(input, stream);
}

std::unique_ptr<PathFeeder> make_feeder(PathInput& input, WaypointSink sink) {
    if (input.segments() != nullptr) {
        return std::make_unique<NothingToFeed>(input.points_read());
    }
    return std::make_unique<WaypointFeeder>(input, std::move(sink));
}

} // namespace splinefeed::host
