// SPDX-License-Identifier: MIT
#include "host_sim/serve/simulated_tool.hpp"

#include "host_sim/config/decimal_number.hpp"
#include "host_sim/machine/simulated_machine.hpp"

#include <cmath>
#include <deque>
#include <optional>

namespace splinefeed::host {

namespace {

constexpr std::chrono::milliseconds homing_time{500};

std::chrono::nanoseconds duration_of(const FeedSegment& segment) {
    return std::chrono::nanoseconds(std::int64_t{segment.duration_ticks} * 125);
}

// It executes each segment when its time has passed. Where segments come late the motion waits: its time stands still.
// Homing takes half a second, and then the axes stand at 0. A spindle takes the time that the machine file says.
class SimulatedTool final : public ServedMachine {
public:
    static constexpr std::chrono::milliseconds ahead{20}; // of motion that it holds
    static constexpr std::chrono::milliseconds dry{8};    // with less the plan must not wait for more lines

    SimulatedTool(MachineDescription machine, int segments_per_sample, const PerAxis<double>& position, bool known)
        : description_(std::move(machine)), segments_per_sample_(segments_per_sample), mm_(position), known_(known) {
        for (const unsigned k : indices(max_axes)) {
            position_[k] = position_from_mm(mm_[k]);
        }
        begin_chain();
    }

    // Executes what is due.
    void advance(Time now) override {
        now_ = now;
        if (queue_.empty()) {
            time_ = now;
        }
        while (!queue_.empty() && time_ + duration_of(queue_.front()) <= now) {
            const FeedSegment segment = queue_.front();
            queue_.pop_front();
            queued_ -= duration_of(segment);
            time_ += duration_of(segment);
            execute(segment);
        }
        if (homing_ == HomingPhase::busy && now >= homed_) {
            homing_ = HomingPhase::done;
            known_ = true;
            for (const unsigned k : indices(description_.settings.axes)) {
                const bool homes = (homing_axes_ >> k & 1U) != 0;
                mm_[k] = homes ? 0.0 : mm_[k];
                position_[k] = homes ? Position{} : position_[k];
            }
            begin_chain();
        }
    }

    [[nodiscard]] bool has_room() const noexcept override { return queued_ < ahead; }
    [[nodiscard]] bool is_dry() const noexcept override { return queued_ < dry; }

    void submit(const FeedSegment& segment) override {
        queue_.push_back(segment);
        queued_ += duration_of(segment);
    }

    void rest() override {}
    [[nodiscard]] bool stands() const noexcept override { return queue_.empty() && !moves_; }

    [[nodiscard]] std::vector<RunTarget::AxisPlace> places() const override {
        std::vector<RunTarget::AxisPlace> out;
        for (const unsigned k : indices(description_.settings.axes)) {
            out.push_back({k, mm_[k]});
        }
        return out;
    }

    MachineReading read() noexcept override {
        MachineReading out;
        out.position = position_;
        out.stands = stands();
        out.executes = !queue_.empty();
        out.waypoint = out.executes ? queue_.front().waypoint : 0;
        out.known = known_;
        out.spindle_ready = now_ >= spindle_ready_;
        out.homing = homing_;
        out.alarm = fault_.empty() ? Alarm::none : Alarm::drive_fault;
        out.alarm_sentence = fault_;
        out.feed_mm_min = Decimal{static_cast<std::int64_t>(speed_mm_s_ * 60e9)};
        return out;
    }

    void obey(const ProgramEvent& event) noexcept override {
        const bool back = event.kind == EventKind::spindle_counterclockwise;
        if ((back || event.kind == EventKind::spindle_clockwise || event.kind == EventKind::spindle_stop) &&
            description_.spindle) {
            const double rpm =
                event.kind == EventKind::spindle_stop ? 0.0 : number_of(event.value) * (back ? -1.0 : 1.0);
            const std::chrono::duration<double> takes(description_.spindle->change_s(rpm_, rpm));
            spindle_ready_ = now_ + std::chrono::duration_cast<std::chrono::nanoseconds>(takes);
            rpm_ = rpm;
        }
    }

    [[nodiscard]] bool has_output(EventKind /*kind*/, std::int32_t /*number*/) const noexcept override { return true; }

    // Nothing is ever touched.
    void watch_probe(bool /*away*/) noexcept override {}

    void home(std::uint32_t axes) noexcept override {
        homing_ = HomingPhase::busy;
        homing_axes_ = axes;
        homed_ = now_ + homing_time;
    }

    bool halt() noexcept override { return false; }

    void quick_stop() noexcept override {
        homing_ = homing_ == HomingPhase::busy ? HomingPhase::failed : homing_;
        begin_chain();
    }

    void enable(bool /*on*/) noexcept override {}

    void reset_faults() noexcept override { fault_.clear(); }

private:
    // It checks every limit: what breaks one is a fault, as on a machine.
    void execute(const FeedSegment& segment) {
        if (!fault_.empty()) {
            return;
        }
        if (!machine_->submit(segment) || machine_->poll().phase == hal::PortPhase::fault) {
            fault_ = machine_->failure().what;
            begin_chain();
            return;
        }
        const PerAxis<double> before = mm_;
        double way_sq = 0.0;
        for (const unsigned k : indices(description_.settings.axes)) {
            mm_[k] = static_cast<double>(segment.end[k]) /
                     (static_cast<double>(units_per_count) * description_.settings.axis[k].steps_per_mm);
            position_[k] = position_from_mm(mm_[k]);
            way_sq += (mm_[k] - before[k]) * (mm_[k] - before[k]);
        }
        moves_ = !segment.ends_at_rest();
        speed_mm_s_ = moves_ ? std::sqrt(way_sq) / std::chrono::duration<double>(duration_of(segment)).count() : 0.0;
    }

    void begin_chain() {
        queue_.clear();
        queued_ = {};
        moves_ = false;
        speed_mm_s_ = 0.0;
        machine_.emplace(description_, segments_per_sample_);
    }

    MachineDescription description_;
    int segments_per_sample_;
    std::optional<SimulatedMachine> machine_; // of this chain of segments
    std::deque<FeedSegment> queue_;
    std::chrono::nanoseconds queued_{};
    Time time_{}; // up to which the motion has come
    Time now_{};
    Time homed_{};
    Time spindle_ready_{};
    PerAxis<double> mm_{};
    PerAxis<Position> position_{};
    double speed_mm_s_ = 0.0;
    double rpm_ = 0.0;
    std::uint32_t homing_axes_ = 0;
    HomingPhase homing_ = HomingPhase::none;
    std::string fault_;
    bool known_ = true;
    bool moves_ = false;
};

} // namespace

std::unique_ptr<ServedMachine> make_simulated_tool(const MachineDescription& machine, int segments_per_sample,
                                                   const PerAxis<double>& position, bool known) {
    return std::make_unique<SimulatedTool>(machine, segments_per_sample, position, known);
}

} // namespace splinefeed::host
