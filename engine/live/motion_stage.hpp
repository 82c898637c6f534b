#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "base/channels/event_queue.hpp"
#include "base/channels/retire_queue.hpp"
#include "base/music_state.hpp"
#include "base/thread_priority.hpp"
#include "engine/live/music_feed.hpp"
#include "engine/live/stage_state.hpp"
#include "motion/ensemble.hpp"
#include "motion/skeleton/pose_track.hpp"

namespace raks::engine {

/// One hop of the first dancer, for tests and benchmarks that need every hop and not only the
/// newest.
struct DancedHop {
    HopIndex hop = 0;   ///< number of the hop since the stream's start
    motion::Pose pose;  ///< that was danced for this hop
};

/// The work of the motion thread at each wake-up, without the thread: takes every MusicState in
/// order, advances the dancers, publishes. States that piled up are danced in order, none is
/// skipped.
class MotionStage {
 public:
    /// What a stage works with besides the dancers. All of it must outlive the stage.
    struct Wiring {
        /// The states to dance to; this stage is their one consumer.
        EventQueue<MusicState>& states;
        /// One channel a reader; each reads on a thread of its own and none disturbs another. A
        /// reader costs the motion thread one copy of the stage (70 kB a dancer) a wake-up.
        std::vector<StageChannel*> readers = {};
        /// Gets every danced hop; what it has no room for is not counted as danced.
        EventQueue<DancedHop>* record = nullptr;
        /// Is told every state that is danced to; null: nobody is.
        MusicFeed* feed = nullptr;
    };

    /// `dancers` are prepared, at least one.
    MotionStage(motion::Ensemble dancers, Wiring wiring);
    ~MotionStage();  ///< frees dancers that were queued and never danced
    /// Not copied: readers and queues are tied to one stage.
    MotionStage(const MotionStage&) = delete;
    MotionStage& operator=(const MotionStage&) = delete;  ///< likewise

    /// Dances all states that wait and publishes once. Threads: one, the consumer of the states.
    /// Real-time: yes (no allocation).
    void tick() noexcept RAKS_NONBLOCKING;

    /// Queues a command. Threads: main. False when the queue is full.
    bool command(const motion::DancerCommand& command) noexcept;

    /// How other dancers begin.
    enum class Entry {
        anew,    ///< from standing, on tracks that begin anew
        onward,  ///< where those before are, on their tracks (motion::Ensemble::go_on_from)
    };
    /// Queues other dancers: from the next tick on they dance instead. A command queued before this
    /// goes to the dancers before, a later one to these. Threads: main. Real-time: no (frees
    /// dancers who have left). False when the queue is full.
    bool replace(motion::Ensemble dancers, Entry entry = Entry::anew);

    /// From the next tick on so many of the newest states, at most kMostHeldBack, wait: for sound
    /// that is heard much later than it is analyzed. The dance itself stays the same. Threads: any.
    void hold_back(std::size_t states) noexcept {
        held_back_.store(std::min(states, kMostHeldBack), std::memory_order_relaxed);
    }
    /// 4 s: the queue of states has room for more.
    static constexpr std::size_t kMostHeldBack = 400;

    /// Hops danced so far. Threads: any.
    [[nodiscard]] std::int64_t danced_hops() const noexcept {
        return danced_hops_.load(std::memory_order_acquire);  // pairs with the release in tick()
    }

 private:
    /// A command to the dancers or, where `dancers` is not null, the dancers who follow them.
    struct Order {
        motion::DancerCommand command{};
        motion::Ensemble* dancers = nullptr;
        Entry entry = Entry::anew;
    };
    static constexpr std::size_t kQueuedOrders = 64;

    void obey(const Order& order) noexcept RAKS_NONBLOCKING;
    void take_places() noexcept;
    void publish() noexcept;

    std::unique_ptr<motion::Ensemble> dancers_;
    Wiring wiring_;
    EventQueue<Order> orders_{kQueuedOrders};
    // Never full: replace() empties it before it queues one more.
    RetireQueue<motion::Ensemble> left_{kQueuedOrders};
    std::unique_ptr<StageState> stage_;  // the ticking thread's own working copy
    std::atomic<std::int64_t> danced_hops_{0};
    std::atomic<std::size_t> held_back_{0};  // relaxed: a wish by itself
};

/// The motion thread: a MotionStage that ticks by itself every 2 ms.
/// Threads: create and destroy on the main thread. The queue of states has the audio thread as its
/// one producer.
class MotionThread {
 public:
    /// Starts the thread. `dancers` are prepared; what `wiring` refers to must outlive this.
    MotionThread(motion::Ensemble dancers, MotionStage::Wiring wiring);
    ~MotionThread();  ///< stops and joins the thread
    /// Not copied: the thread holds a reference to it.
    MotionThread(const MotionThread&) = delete;
    MotionThread& operator=(const MotionThread&) = delete;  ///< likewise

    /// Queues a command. Threads: main. False when the queue is full.
    bool command(const motion::DancerCommand& command) noexcept { return stage_.command(command); }
    /// Queues other dancers; see MotionStage::replace. Threads: main. False when the queue is full.
    bool replace(motion::Ensemble dancers, MotionStage::Entry entry) {
        return stage_.replace(std::move(dancers), entry);
    }

    /// See MotionStage::hold_back. Threads: any.
    void hold_back(std::size_t states) noexcept { stage_.hold_back(states); }
    /// From the next tick on its priority is below this one: that of the thread that calls back for
    /// sound (audio::DeviceStream::callback_priority). Threads: any.
    void stay_below(int priority) noexcept {
        below_.store(priority, std::memory_order_relaxed);  // relaxed: a wish by itself
    }

    /// Hops danced so far. Threads: any.
    [[nodiscard]] std::int64_t danced_hops() const noexcept { return stage_.danced_hops(); }

 private:
    void run() noexcept;

    MotionStage stage_;
    std::atomic<bool> is_stopping_{false};
    std::atomic<int> below_{kAnyPriority};
    std::thread thread_;
};

}  // namespace raks::engine
