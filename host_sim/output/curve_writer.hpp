// SPDX-License-Identifier: MIT
// CurveWriter: the curve .json, written while the curve is made.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/curve/curve_file.hpp"

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <string_view>

namespace splinefeed::host {

/// `{"curve": METHOD, "closed": false, "segments": [...]}` in travel order, one segment a line, numbers with 17
/// significant digits. Memory: none of its own, whatever the length. Errors: OutputError from the file.
class CurveWriter {
public:
    /// Writes the head. The caller commits the file, which must outlive the writer.
    CurveWriter(OutputFile& file, std::string_view method, bool closed = false);

    template <Scalar S>
    void segment(const CurveSegment<S>& segment);
    /// All segments of a curve that is there whole, in the numbers it was computed in. Those of a description come with
    /// their interval, where the curve has a parameter of its own, and with samples.
    void segments(const CurveFile& curve);

    /// Ends the document. Call it once, before the file is committed.
    void finish();
    /// The same, with the keys of an object added at the top level: a method's further results.
    /// Throws std::invalid_argument where `results` is no object or has one of the keys above.
    void finish(const nlohmann::ordered_json& results);

private:
    void open_segment(int degree);
    void number(double value, int axis, int point);

    OutputFile* file_;
    bool first_ = true;
};

} // namespace splinefeed::host
