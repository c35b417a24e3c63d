// SPDX-License-Identifier: MIT
//
// Replaces operator new in this executable by one that counts. In a file of its own, so that no compiler sees through a
// pair of new and delete.
#include "support/allocations.hpp"
#include "support/catch.hpp"

#include <cstdlib>
#include <new>
#include <string>

// A sanitizer brings an operator new of its own; counting is left to the other builds.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SPLINEFEED_SANITIZED
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define SPLINEFEED_SANITIZED
#endif

namespace {

std::size_t count = 0;

} // namespace

std::size_t splinefeed_test::allocations() noexcept {
    return count;
}

#ifdef SPLINEFEED_SANITIZED

TEST_CASE("allocations are counted", "[stream]") {
    WARN("SKIPPED: the sanitizer has an operator new of its own");
}

#else

void* operator new(std::size_t size) {
    ++count;
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

TEST_CASE("allocations are counted", "[stream]") {
    const std::size_t before = splinefeed_test::allocations();
    const std::string text(static_cast<std::size_t>(std::rand() % 2) + 1000, 'x'); // not to be optimised away
    const std::size_t after = splinefeed_test::allocations();
    CHECK(text.size() >= 1000);
    CHECK(after > before);
}

#endif
