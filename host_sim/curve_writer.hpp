// SPDX-License-Identifier: MIT
// CurveWriter: the curve .json, written while the curve is made.
#pragma once

#include "output_file.hpp"

#include "splinefeed/s1_curve/curve_segment.hpp"

#include <nlohmann/json_fwd.hpp>

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

    /// Ends the document. Call it once, before the file is committed.
    void finish();
    /// The same, with the keys of an object added at the top level: a method's further results.
    /// Throws std::invalid_argument where `results` is no object or has one of the keys above.
    void finish(const nlohmann::json& results);

private:
    OutputFile* file_;
    bool first_ = true;
};

} // namespace splinefeed::host
