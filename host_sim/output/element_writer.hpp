// SPDX-License-Identifier: MIT
// ElementWriter: writes the programmed path, as a file of elements.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/program/program_action.hpp"

#include "splinefeed/s1_blended_path/path_element.hpp"

#include <array>
#include <string>

namespace splinefeed::host {

/// {"elements": [...], "dwells": [...], "events": [...]}: positions in mm and degrees in the order x y z a b c, in
/// machine coordinates. A number is written so that it can be read back exactly. Memory: the dwells and events, which
/// come after the elements. Every method throws OutputError.
class ElementWriter {
public:
    struct Move {
        const PathElement<double>* element = nullptr;
        bool rapid = false;
        double feed_mm_s = 0.0; ///< along the linear axes; 0: the machine's
        std::uint64_t line = 0; ///< 0: unknown
    };

    /// The caller commits the file, which must outlive the writer.
    ElementWriter(OutputFile& file, const MachineDescription& machine);

    /// Where the first move begins.
    void start(const PerAxis<Position>& position) noexcept { here_ = position; }
    void move(const Move& move);
    void dwell(double seconds, std::uint64_t line);
    void event(const ProgramAction& action, std::uint64_t line);
    /// Nothing comes after it.
    void finish();

private:
    [[nodiscard]] std::string point(const PerAxis<Position>& position, std::size_t count) const;
    void shape(const PathElement<double>& element);

    OutputFile* file_;
    std::array<int, 6> index_{}; // of x, y, ... among the machine's axes; -1: it lacks the axis
    std::size_t count_ = 3;      // coordinates of a point
    PerAxis<Position> here_{};
    std::uint64_t elements_ = 0;
    std::string dwells_;
    std::string events_;
};

} // namespace splinefeed::host
