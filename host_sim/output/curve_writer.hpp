// SPDX-License-Identifier: MIT
// CurveWriter: writes the curve .json while the curve is computed.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/curve/curve_file.hpp"

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <string_view>

namespace splinefeed::host {

/// `{"curve": METHOD, "closed": false, "segments": [...]}` in the order of travel, one segment per line, numbers with
/// 17 significant digits. Memory: none of its own, for any length. Errors: OutputError from the file.
class CurveWriter {
public:
    /// Writes the beginning. The caller commits the file, which must outlive the writer.
    CurveWriter(OutputFile& file, std::string_view method, bool closed = false);

    void segment(const CurveSegment<double>& segment);
    /// Writes all segments of a complete curve, with the numbers as computed. Segments of a description also have their
    /// interval, if the curve has its own parameter, and samples.
    void segments(const CurveFile& curve);

    /// Ends the document. Call it once, before the file is committed.
    void finish();
    /// The same, with the keys of an object added at the top level: further results of a method. Throws
    /// std::invalid_argument if `results` is not an object or has one of the keys above.
    void finish(const nlohmann::ordered_json& results);

private:
    void open_segment(int degree);
    void number(double value, int axis, int point);

    OutputFile* file_;
    bool first_ = true;
};

} // namespace splinefeed::host
