#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>

#include "engine/live/motion_stage.hpp"

namespace raks::engine {

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
    bool replace(motion::Ensemble dancers) { return stage_.replace(std::move(dancers)); }

    /// Hops danced so far. Threads: any.
    [[nodiscard]] std::int64_t danced_hops() const noexcept { return stage_.danced_hops(); }

 private:
    void run() noexcept;

    MotionStage stage_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

}  // namespace raks::engine
