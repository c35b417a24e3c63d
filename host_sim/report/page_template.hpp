// SPDX-License-Identifier: MIT
// page_template: the page without its data. Its source is made from page/dist/report.html by cmake/embed_page.cmake.
#pragma once

#include <span>
#include <string_view>

namespace splinefeed::host {

/// What stands before the data and behind them, in pieces.
[[nodiscard]] std::span<const std::string_view> page_head() noexcept;
[[nodiscard]] std::span<const std::string_view> page_tail() noexcept;

} // namespace splinefeed::host
