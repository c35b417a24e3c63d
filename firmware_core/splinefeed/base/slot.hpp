// SPDX-License-Identifier: MIT
// Slot: memory for an object that is constructed later.
#pragma once

#include <new>
#include <type_traits>
#include <utility>

namespace splinefeed {

/// There is no flag that says whether the object exists: the owner knows. A second build() replaces the object.
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
    /// @pre build() was called; the same for the next three
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
