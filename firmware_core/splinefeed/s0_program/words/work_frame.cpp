// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/work_frame.hpp"

namespace splinefeed {

const WorkSystem& WorkFrame::system() const noexcept {
    const WorkSystem* const other = extension_ != nullptr ? extension_->system() : nullptr;
    return other != nullptr ? *other : offsets_.systems[static_cast<unsigned>(offsets_.active)];
}

void WorkFrame::update() noexcept {
    const Decimal angle = system().rotation_deg;
    turned_ = angle.raw != 0 && x_ >= 0 && y_ >= 0;
    turn_ = sine_cosine(turned_ ? angle : Decimal{});
}

void WorkFrame::turn(AxisPoint& point, const SineCosine& by, bool back) const noexcept {
    const std::int64_t sine = back ? -by.sine : by.sine;
    Decimal& x = point[static_cast<unsigned>(x_)];
    Decimal& y = point[static_cast<unsigned>(y_)];
    const Decimal old_x = x;
    x = turned(x, by.cosine) - turned(y, sine);
    y = turned(old_x, sine) + turned(y, by.cosine);
}

AxisPoint WorkFrame::to_machine(const AxisPoint& program) const noexcept {
    AxisPoint point = program;
    if (extension_ != nullptr) {
        extension_->turn(point, false);
    }
    for (int k = 0; k < axes_; ++k) {
        point[static_cast<unsigned>(k)] += g92(k);
    }
    if (turned_) {
        turn(point, turn_, false);
    }
    const WorkSystem& of = system();
    for (const unsigned k : indices(axes_)) {
        point[k] += of.origin[k] + offsets_.tool[k];
    }
    return point;
}

AxisPoint WorkFrame::to_program(const AxisPoint& machine) const noexcept {
    AxisPoint point = leave(system(), machine);
    if (extension_ != nullptr) {
        extension_->turn(point, true);
    }
    return point;
}

AxisPoint WorkFrame::to_program(const AxisPoint& machine, int system) const noexcept {
    return leave(offsets_.systems[static_cast<unsigned>(system)], machine);
}

AxisPoint WorkFrame::leave(const WorkSystem& of, const AxisPoint& machine) const noexcept {
    AxisPoint point = machine;
    for (const unsigned k : indices(axes_)) {
        point[k] -= of.origin[k] + offsets_.tool[k];
    }
    if (of.rotation_deg.raw != 0 && x_ >= 0 && y_ >= 0) {
        turn(point, &of == &system() && turned_ ? turn_ : sine_cosine(of.rotation_deg), true);
    }
    for (int k = 0; k < axes_; ++k) {
        point[static_cast<unsigned>(k)] -= g92(k);
    }
    return point;
}

void WorkFrame::set_place(int system, const AxisPoint& machine, const AxisPoint& values) noexcept {
    WorkSystem& of = offsets_.systems[static_cast<unsigned>(system)];
    AxisPoint point = values;
    for (int k = 0; k < axes_; ++k) {
        point[static_cast<unsigned>(k)] += g92(k);
    }
    if (of.rotation_deg.raw != 0 && x_ >= 0 && y_ >= 0) {
        turn(point, sine_cosine(of.rotation_deg), false);
    }
    for (const unsigned k : indices(axes_)) {
        of.origin[k] = machine[k] - offsets_.tool[k] - point[k];
    }
}

void WorkFrame::begin_g92() noexcept {
    if (!offsets_.g92_applies) {
        offsets_.g92 = {};
        offsets_.g92_applies = true;
    }
}

} // namespace splinefeed
