// SPDX-License-Identifier: MIT
#include "support/virtual_clock.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ucontext.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SPLINEFEED_ASAN_FIBERS 1
#include <sanitizer/common_interface_defs.h>
#endif
#if __has_feature(thread_sanitizer)
#define SPLINEFEED_TSAN_FIBERS 1
#include <sanitizer/tsan_interface.h>
#endif
#endif

namespace splinefeed_test {

namespace {

constexpr std::uint64_t never = UINT64_MAX;
#ifdef SPLINEFEED_ASAN_FIBERS
constexpr std::size_t stack_bytes = 512 * 1024;
#else
constexpr std::size_t stack_bytes = 112 * 1024; // malloc keeps it when it is freed
#endif
constexpr unsigned half_bits = 32;

} // namespace

struct VirtualClock::Fiber {
    ucontext_t context{};
    std::unique_ptr<std::byte[]> stack;
    std::function<void()> work;
    VirtualClock* clock = nullptr;
    Fiber* joined_by = nullptr;
    std::uint64_t wake_ns = 0;
    std::uint64_t turn = 0;
    bool ended = false;
    // What sanitizers must be told of a stack.
    const void* bottom = nullptr;
    std::size_t size = 0;
    void* fake = nullptr;
    void* tsan = nullptr;
};

namespace {

class VirtualThread final : public splinefeed::hal::ClockThread {
public:
    VirtualThread(VirtualClock& clock, VirtualClock::Fiber& fiber) : clock_(clock), fiber_(fiber) {}
    VirtualThread(const VirtualThread&) = delete;
    VirtualThread& operator=(const VirtualThread&) = delete;
    ~VirtualThread() override {
        clock_.join(fiber_);
        clock_.forget(fiber_);
    }
    void join() noexcept override { clock_.join(fiber_); }

private:
    VirtualClock& clock_;
    VirtualClock::Fiber& fiber_;
};

void arrive([[maybe_unused]] void* fake, [[maybe_unused]] const void** bottom, [[maybe_unused]] std::size_t* size) {
#ifdef SPLINEFEED_ASAN_FIBERS
    __sanitizer_finish_switch_fiber(fake, bottom, size);
#endif
}

} // namespace

VirtualClock::VirtualClock(std::uint64_t start_ns) : now_ns_(start_ns) {
    fibers_.push_back(std::make_unique<Fiber>());
    running_ = fibers_.front().get();
#ifdef SPLINEFEED_TSAN_FIBERS
    running_->tsan = __tsan_get_current_fiber();
#endif
}

VirtualClock::~VirtualClock() = default;

void VirtualClock::enter(unsigned high, unsigned low) noexcept {
    const auto address = static_cast<std::uintptr_t>(high) << half_bits | low;
    Fiber& self = *reinterpret_cast<Fiber*>(address); // makecontext passes integers alone
    VirtualClock& clock = *self.clock;
    arrive(nullptr, &clock.before_->bottom, &clock.before_->size);
    self.work();
    self.ended = true;
    self.wake_ns = never;
    if (self.joined_by != nullptr) {
        self.joined_by->wake_ns = clock.now_ns_;
    }
    clock.pass_on(); // and never back
}

// To the one that is to wake up first.
void VirtualClock::pass_on() noexcept {
    Fiber* next = nullptr;
    for (const auto& fiber : fibers_) {
        const bool sooner = next == nullptr || fiber->wake_ns < next->wake_ns ||
                            (fiber->wake_ns == next->wake_ns && fiber->turn < next->turn);
        next = sooner ? fiber.get() : next;
    }
    if (next->wake_ns == never) {
        std::fputs("virtual clock: every thread waits for another one\n", stderr);
        std::abort();
    }
    now_ns_ = std::max(now_ns_, next->wake_ns);
    next->turn = ++turn_;
    if (next == running_) {
        return;
    }
    Fiber& self = *running_;
    before_ = &self;
    running_ = next;
#ifdef SPLINEFEED_ASAN_FIBERS
    __sanitizer_start_switch_fiber(self.ended ? nullptr : &self.fake, next->bottom, next->size);
#endif
#ifdef SPLINEFEED_TSAN_FIBERS
    __tsan_switch_to_fiber(next->tsan, 0);
#endif
    swapcontext(&self.context, &next->context);
    arrive(self.fake, &before_->bottom, &before_->size);
}

void VirtualClock::sleep_until_ns(std::uint64_t instant_ns) noexcept {
    running_->wake_ns = std::max(instant_ns, now_ns_);
    pass_on();
}

std::unique_ptr<splinefeed::hal::ClockThread> VirtualClock::start(std::function<void()> work) {
    fibers_.push_back(std::make_unique<Fiber>());
    Fiber& fiber = *fibers_.back();
    fiber.stack.reset(new std::byte[stack_bytes]); // not zeroed
    fiber.bottom = fiber.stack.get();
    fiber.size = stack_bytes;
    fiber.work = std::move(work);
    fiber.clock = this;
    fiber.wake_ns = now_ns_;
    fiber.turn = ++turn_;
#ifdef SPLINEFEED_TSAN_FIBERS
    fiber.tsan = __tsan_create_fiber(0);
#endif
    getcontext(&fiber.context);
    fiber.context.uc_stack.ss_sp = fiber.stack.get();
    fiber.context.uc_stack.ss_size = stack_bytes;
    fiber.context.uc_link = nullptr;
    const auto address = reinterpret_cast<std::uintptr_t>(&fiber);
    makecontext(&fiber.context, reinterpret_cast<void (*)()>(&VirtualClock::enter), 2,
                static_cast<unsigned>(address >> half_bits), static_cast<unsigned>(address));
    fiber.context.uc_stack =
        {}; // where AddressSanitizer knows it, it maps its shadow anew at each switch: most of a test's time
    return std::make_unique<VirtualThread>(*this, fiber);
}

void VirtualClock::join(Fiber& fiber) noexcept {
    while (!fiber.ended) {
        fiber.joined_by = running_;
        running_->wake_ns = never;
        pass_on();
    }
}

void VirtualClock::forget(Fiber& fiber) noexcept {
#ifdef SPLINEFEED_TSAN_FIBERS
    __tsan_destroy_fiber(fiber.tsan);
#endif
    const auto found = std::find_if(fibers_.begin(), fibers_.end(), [&](const auto& f) { return f.get() == &fiber; });
    fibers_.erase(found);
}

} // namespace splinefeed_test
