// SPDX-License-Identifier: MIT
#include "host_sim/convert/source_value.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/short_number.hpp"

#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace splinefeed::host {

void refuse_value(const std::string& file, const SourceValue& value, std::string_view why) {
    throw InputError(file, value.line, "{} is {}: {}", value.name, in_quotes(value.text), why);
}

double source_number(const std::string& file, const SourceValue& value) {
    double number = 0.0;
    if (const NumberText read = read_number(value.text, number); read != NumberText::number) {
        refuse_value(file, value, fmt::format("it {}", why_no_number(read)));
    }
    return number;
}

double in_range(const std::string& file, const SourceValue& value, double number, std::string_view key,
                const NumberRange& range) {
    if (!(number >= range.low && number <= range.high)) {
        refuse_value(file, value,
                     fmt::format("{} would be {}; it must lie between {} and {} {}", key, short_number(number),
                                 range.low, range.high, range.unit));
    }
    return number;
}

NumberRange axis_range(std::string_view key) {
    const auto* const row = std::ranges::find_if(axis_numbers, [key](const auto& of) { return of.key == key; });
    return {row->low, row->high, row->unit};
}

} // namespace splinefeed::host
