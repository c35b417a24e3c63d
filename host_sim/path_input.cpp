// SPDX-License-Identifier: MIT
#include "path_input.hpp"

#include "input_error.hpp"
#include "text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iostream>

namespace splinefeed::host {

namespace {

const std::vector<std::string> every_axis{"x", "y", "z", "a", "b", "c"};

/// A waypoint file or a pipe.
class TableRows final : public WaypointRows {
public:
    TableRows(const std::string& path, const std::string& name, const std::vector<std::string>& axes)
        : reader_(open(path, name), name, axes.empty() ? every_axis : axes, axes.empty()) {}

    bool next(WaypointRow& out) override { return reader_.next(out); }
    [[nodiscard]] const std::vector<std::string>& axes() const noexcept { return reader_.axes(); }

private:
    std::istream& open(const std::string& path, const std::string& name) {
        if (path == "-") {
            return std::cin;
        }
        errno = 0;
        file_.open(path, std::ios::binary);
        if (!file_) {
            throw InputError(name, 0, fmt::format("cannot be opened: {}", std::strerror(errno)));
        }
        return file_;
    }

    std::ifstream file_;
    WaypointReader reader_;
};

/// The points of a curve description.
class PointRows final : public WaypointRows {
public:
    explicit PointRows(const CurveFile& file) : file_(&file) {}

    bool next(WaypointRow& out) override {
        if (next_ == file_->points()) {
            return false;
        }
        out = {};
        for (unsigned k = 0; k < static_cast<unsigned>(file_->axes); ++k) {
            out.position[k] = file_->at(next_, k);
        }
        ++next_;
        return true;
    }

private:
    const CurveFile* file_;
    std::size_t next_ = 0;
};

} // namespace

PathInput::PathInput(const Job& job, const std::vector<std::string>& machine_axes)
    : name_(job.input), path_(job.input) {
    if (job.format == InputFormat::json) {
        open_description(job, machine_axes);
        return;
    }
    choice_ = choose_curve(job.curve);
    if (path_ == "-" && is_regular_file("/dev/stdin")) {
        path_ = "/dev/stdin"; // it can be read twice
    }
    repeatable_ = is_regular_file(path_);
    machine_axes_ = machine_axes;
    auto rows = std::make_unique<TableRows>(path_, name_, machine_axes_);
    axes_ = rows->axes();
    opened_ = std::move(rows);
}

void PathInput::open_description(const Job& job, const std::vector<std::string>& machine_axes) {
    table_ = false;
    if (const std::string_view option = first_option(job.curve); !option.empty()) {
        throw UsageError(fmt::format("{}: a curve file says itself which curve it is; leave the option out", option));
    }
    file_ = read_curve_file(name_);
    choice_.method = file_.segments.empty() ? Method::catmull_rom : Method::bezier;
    choice_.closed = file_.closed;
    choice_.tension = file_.tension;
    choice_.parameterization = Parameterization::uniform;
    choice_.corner_angle_deg = 180.0; // none: the method has no corners
    const auto count = static_cast<std::size_t>(file_.axes);
    axes_ = machine_axes.empty() ? std::vector<std::string>(every_axis.begin(), every_axis.begin() + file_.axes)
                                 : machine_axes;
    if (count > axes_.size()) {
        throw InputError(name_, 0,
                         fmt::format("the points have {} coordinates; the machine has {} axes: {}", count, axes_.size(),
                                     fmt::join(axes_, ", ")));
    }
}

std::unique_ptr<WaypointRows> PathInput::rows() {
    if (opened_) {
        return std::move(opened_);
    }
    if (!table_) {
        return std::make_unique<PointRows>(file_);
    }
    return std::make_unique<TableRows>(path_, name_, machine_axes_);
}

} // namespace splinefeed::host
