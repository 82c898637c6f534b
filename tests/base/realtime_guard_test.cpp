#include "tests/support/realtime_guard.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <latch>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/realtime.hpp"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RAKS_COUNTS_LOCKS_AND_THROWS 1
#endif

namespace raks::test {
namespace {

// Keeps the compiler from removing an allocation whose result is not used.
const void* volatile g_escape = nullptr;
volatile double g_result = 0.0;

RealtimeCounts counts_of(const std::function<void()>& action) {
    RealtimeScope scope;
    action();
    return scope.stop();
}

struct Case {
    const char* name;
    std::function<void()> action;
};

TEST(RealtimeGuard, arithmetic_is_clean) {
    double sum = 0;
    const RealtimeCounts counts = counts_of([&] {
        for (int i = 1; i < 1000; ++i) {
            sum += 1.0 / i;
        }
    });
    EXPECT_GT(sum, 1.0);
    EXPECT_TRUE(counts.is_clean()) << counts.describe();
}

TEST(RealtimeGuard, every_kind_of_allocation_is_counted) {
    struct alignas(128) Aligned {
        char data[256];
    };
    struct Large {
        double data[8];
    };
    std::vector<int> grows(16);
    const Case cases[] = {
        {"new", [] { g_escape = std::make_unique<int>(1).get(); }},
        {"vector", [] { g_escape = std::vector<int>(100).data(); }},
        {"growing vector", [&] { grows.resize(4096); }},
        {"long string", [] { g_escape = std::string(100, 'x').data(); }},
        {"make_shared", [] { g_escape = std::make_shared<int>(1).get(); }},
        {"aligned new", [] { g_escape = std::make_unique<Aligned>().get(); }},
        {"large std::function",
         [] {
             const Large large{};
             const std::function<double()> f = [large] { return large.data[0]; };
             g_result = f();
         }},
        {"calloc",
         [] {
             void* p = std::calloc(3, 5);
             g_escape = p;
             std::free(p);
         }},
#ifndef __SANITIZE_THREAD__  // whose hooks are not called for this one
        {"aligned_alloc",
         [] {
             void* p = std::aligned_alloc(64, 128);
             g_escape = p;
             std::free(p);
         }},
#endif
    };
    for (const Case& c : cases) {
        const RealtimeCounts counts = counts_of(c.action);
        EXPECT_GE(counts.allocations, 1U) << c.name;
        EXPECT_FALSE(counts.is_clean()) << c.name;
    }
}

TEST(RealtimeGuard, a_free_alone_is_counted) {
    auto object = std::make_unique<int>(3);
    EXPECT_EQ(counts_of([&] { object.reset(); }).frees, 1U);
}

#ifdef RAKS_COUNTS_LOCKS_AND_THROWS
TEST(RealtimeGuard, a_mutex_and_a_throw_are_counted) {
    std::mutex mutex;
    EXPECT_EQ(counts_of([&] { const std::lock_guard lock(mutex); }).locks, 1U);
    const RealtimeCounts counts = counts_of([] {
        try {
            throw 1;
        } catch (int) {
        }
    });
    EXPECT_EQ(counts.throws, 1U);
}
#endif

#ifndef RAKS_SANITIZED  // whose own waits do not count
TEST(RealtimeGuard, a_wait_is_counted) {
    // A contended lock makes this thread give up its core.
    std::mutex mutex;
    std::latch started(1);
    mutex.lock();
    long waits = 0;
    std::thread waiter([&] {
        started.count_down();
        RealtimeScope scope;
        const std::lock_guard lock(mutex);
        waits = scope.stop().waits;
    });
    started.wait();
    // Until the waiter sleeps in the kernel; a spin on its state would need /proc.
    std::this_thread::yield();
    timespec pause{0, 20'000'000};
    nanosleep(&pause, nullptr);
    mutex.unlock();
    waiter.join();
    EXPECT_GE(waits, 1);
}
#endif

TEST(FlushToZero, is_set_inside_and_restored_outside) {
    volatile float tiny = 1e-39F;
    {
        const FlushToZeroScope scope;
        const volatile float inside = tiny * 0.5F;
        EXPECT_EQ(inside, 0.0F);
    }
    const volatile float outside = tiny * 0.5F;
    EXPECT_GT(outside, 0.0F);
}

}  // namespace
}  // namespace raks::test
