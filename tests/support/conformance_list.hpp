// SPDX-License-Identifier: MIT
//
// The cases of tests/controller/conformance.txt, in virtual time, on any machine with a controller.
#pragma once

#include "splinefeed/controller/controller.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace splinefeed::test {

/// A controller with a machine, which the list operates.
class ListedMachine {
public:
    ListedMachine() = default;
    ListedMachine(const ListedMachine&) = delete;
    ListedMachine& operator=(const ListedMachine&) = delete;
    virtual ~ListedMachine() = default;

    virtual void send(std::string_view bytes) = 0;
    /// A millisecond.
    virtual void tick() = 0;
    [[nodiscard]] virtual Controller& controller() = 0;
    /// What it has said so far; the list may take parts of it.
    [[nodiscard]] virtual std::string& text() = 0;
    /// "way 50", "told 12 0", "machine plate -5" of the list.
    virtual void obey(const std::string& command, const std::string& rest) = 0;
    /// What is checked at the end of each case.
    virtual void finish() {}
};

/// Runs all cases whose lines `takes` takes; each begins with a new machine. Returns how many.
/// @param takes  a command of the list and the rest of its line
int run_conformance_list(const std::function<std::unique_ptr<ListedMachine>()>& make,
                         const std::function<bool(const std::string& command, const std::string& rest)>& takes);

} // namespace splinefeed::test
