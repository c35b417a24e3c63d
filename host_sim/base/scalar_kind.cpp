// SPDX-License-Identifier: MIT
#include "host_sim/base/scalar_kind.hpp"

#include "host_sim/base/option_number.hpp"

namespace splinefeed::host {

ScalarKind read_scalar(std::string_view option, std::string_view name, std::initializer_list<std::string_view> known) {
    require_word(option, name, known);
    return name == "fixed" ? ScalarKind::fixed : name == "float" ? ScalarKind::float32 : ScalarKind::float64;
}

} // namespace splinefeed::host
