#include "base/thread_priority.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include <thread>

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

}  // namespace
}  // namespace raks
