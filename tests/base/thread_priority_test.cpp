#include "base/thread_priority.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <fstream>
#include <string>
#include <thread>

#include "base/locked_memory.hpp"

namespace raks {
namespace {

TEST(ThreadPriority, threads_of_a_name_are_put_behind_and_no_others) {
    int found = 0;
    int own = 0;
    std::thread([&] {
        pthread_setname_np(pthread_self(), "raks-draws-0");
        found = put_threads_behind("raks-draws");
        own = getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
    }).join();
    EXPECT_EQ(found, 1);
    EXPECT_EQ(own, 10);
    EXPECT_EQ(put_threads_behind("raks-draws"), 0) << "it has ended";
}

TEST(ThreadPriority, a_thread_of_sound_says_whether_it_comes_first) {
    bool is_granted = false;
    int policy = SCHED_OTHER;
    int nice = 0;
    std::thread([&] {
        is_granted = prefer_this_thread(RealtimeThread::callback);
        sched_param parameters{};
        pthread_getschedparam(pthread_self(), &policy, &parameters);
        nice = getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
    }).join();
    EXPECT_EQ(is_granted, policy == SCHED_FIFO || nice < 0);
}

TEST(LockedMemory, is_locked_or_says_why_not) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers lock no memory: theirs is far larger than what there is";
#endif
    const auto locked = lock_memory();
    std::ifstream status("/proc/self/status");
    std::string line;
    while (std::getline(status, line) && !line.starts_with("VmLck:")) {
    }
    const bool holds_some = line.find_first_of("123456789") != std::string::npos;
    EXPECT_EQ(holds_some, locked.has_value()) << line;
    if (!locked) {
        EXPECT_TRUE(locked.error().message.starts_with("memory is not locked: "));
    }
    munlockall();
}

}  // namespace
}  // namespace raks
