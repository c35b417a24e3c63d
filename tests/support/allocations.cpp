// SPDX-License-Identifier: MIT
//
// Replaces operator new in every executable of tests by one that counts; under a sanitizer, which brings its own,
// malloc is counted as well. In a file of its own, so that no compiler sees through a pair of new and delete.
#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SPLINEFEED_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SPLINEFEED_SANITIZED
#endif

namespace {

std::atomic<std::size_t> count{0};

} // namespace

std::size_t splinefeed_test::allocations() noexcept {
    return count.load();
}

#ifdef SPLINEFEED_SANITIZED

// The sanitizers call it for whatever is allocated. Weak there: defining it is enough.
extern "C" void __sanitizer_malloc_hook(const volatile void* /*place*/, std::size_t /*size*/) {
    count.fetch_add(1, std::memory_order_relaxed);
}

#else

void* operator new(std::size_t size) {
    count.fetch_add(1, std::memory_order_relaxed);
    if (void* p = std::malloc(size > 0 ? size : 1)) {
        return p;
    }
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}

#endif
