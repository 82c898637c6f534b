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

/// Class and priority of a thread that asked to be preferred, below another.
sched_param preferred(RealtimeThread kind, int below, int& policy) {
    sched_param parameters{};
    std::thread([&] {
        prefer_this_thread(kind, below);
        pthread_getschedparam(pthread_self(), &policy, &parameters);
        policy &= ~SCHED_RESET_ON_FORK;
    }).join();
    return parameters;
}

TEST(ThreadPriority, no_thread_comes_before_a_client_of_jack_or_the_sound_server) {
    constexpr int kClientOfDebiansJack = 5;
    int policy = SCHED_OTHER;
    const int motion = preferred(RealtimeThread::motion, kAnyPriority, policy).sched_priority;
    if (policy != SCHED_FIFO) {
        GTEST_SKIP() << "without the right to SCHED_FIFO";
    }
    const int audio = preferred(RealtimeThread::callback, kAnyPriority, policy).sched_priority;
    const int transport = preferred(RealtimeThread::transport, kAnyPriority, policy).sched_priority;
    EXPECT_LT(motion, audio);
    EXPECT_LT(audio, transport);
    EXPECT_LT(transport, kClientOfDebiansJack);
    EXPECT_EQ(preferred(RealtimeThread::motion, 2, policy).sched_priority, 1);
    EXPECT_EQ(policy, SCHED_FIFO);
}

TEST(ThreadPriority, below_the_lowest_priority_a_thread_is_an_ordinary_one) {
    for (const int below : {1, 0}) {
        int policy = SCHED_FIFO;
        EXPECT_EQ(preferred(RealtimeThread::motion, below, policy).sched_priority, 0);
        EXPECT_EQ(policy, SCHED_OTHER) << below;
    }
}

}  // namespace
}  // namespace raks
