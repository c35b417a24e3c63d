// SPDX-License-Identifier: MIT
// Slot: room for an object that is built later.
#pragma once

#include <new>
#include <type_traits>
#include <utility>

namespace splinefeed {

/// Holds no flag for whether the object was built: its owner knows. Building again replaces the object.
template <class T>
class Slot {
    static_assert(std::is_trivially_destructible_v<T>);

public:
    constexpr Slot() noexcept : none_{} {}
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;

    template <class... Arguments>
    T& build(Arguments&&... arguments) noexcept {
        return *::new (static_cast<void*>(&value_)) T(std::forward<Arguments>(arguments)...);
    }
    /// @pre it was built, as for the next
    [[nodiscard]] T& operator*() noexcept { return value_; }
    [[nodiscard]] const T& operator*() const noexcept { return value_; }
    [[nodiscard]] T* operator->() noexcept { return &value_; }
    [[nodiscard]] const T* operator->() const noexcept { return &value_; }

private:
    union {
        char none_;
        T value_;
    };
};

} // namespace splinefeed
