// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_items.hpp"

#include "splinefeed/s1_blended_path/element_cast.hpp"

#include "splinefeed/s0_program/cycles/spline_points.hpp"
#include "splinefeed/s0_program/interpreter.hpp"

namespace splinefeed::host {

namespace {

template <Scalar S>
class ScalarItems final : public ProgramItems {
public:
    ScalarItems(const ProgramSettings& settings, Expression& expression, double max_feed_mm_s)
        : interpreter_(settings, &expression, &points_), max_feed_mm_s_(from_double<S>(max_feed_mm_s)) {}

    [[nodiscard]] BlockInterpreter& interpreter() noexcept override { return interpreter_; }

    Pull next(ProgramItem<double>& out, std::optional<BezierShape<Fixed>>& exact) override {
        const Pull pull = interpreter_.next(item_);
        if (pull != Pull::item) {
            return pull;
        }
        exact.reset();
        out.kind = item_.kind;
        out.line = item_.line;
        out.stops_before = item_.stops_before;
        switch (item_.kind) {
        case ItemKind::move: take_move(out, exact); break;
        case ItemKind::dwell: out.dwell_s = item_.dwell_s; break;
        case ItemKind::event: out.event = item_.event; break;
        }
        return pull;
    }

private:
    void take_move(ProgramItem<double>& out, std::optional<BezierShape<Fixed>>& exact) {
        out.move = item_.move;
        out.probe = item_.probe;
        if (item_.move != MoveKind::rapid && item_.move != MoveKind::home) {
            item_.element.max_feed_mm_s = max_feed_mm_s_;
        }
        out.element = element_cast<double>(item_.element);
        if constexpr (std::same_as<S, Fixed>) {
            if (item_.element.shape == MoveShape::bezier) {
                exact = item_.element.bezier;
            }
        }
    }

    SplinePoints<S> points_;
    Interpreter<S> interpreter_;
    ProgramItem<S> item_;
    S max_feed_mm_s_;
};

} // namespace

std::unique_ptr<ProgramItems> program_items(ScalarKind scalar, const ProgramSettings& settings, Expression& expression,
                                            double max_feed_mm_s) {
    switch (scalar) {
    case ScalarKind::fixed: return std::make_unique<ScalarItems<Fixed>>(settings, expression, max_feed_mm_s);
    case ScalarKind::float32: return std::make_unique<ScalarItems<float>>(settings, expression, max_feed_mm_s);
    case ScalarKind::float64: break;
    }
    return std::make_unique<ScalarItems<double>>(settings, expression, max_feed_mm_s);
}

} // namespace splinefeed::host
