#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

#include "engine/live/motion_stage.hpp"

namespace raks::engine {

/// The motion thread: a MotionStage that ticks by itself, every 2 ms.
/// Threads: create and destroy on the main thread. The queue of states has the audio thread as its
/// one producer.
class MotionThread {
 public:
    /// `states` must outlive this. `record`, if given, gets every danced hop (drops when full).
    MotionThread(motion::Ensemble dancers,
                 EventQueue<MusicState>& states,
                 EventQueue<DancedHop>* record = nullptr);
    ~MotionThread();
    MotionThread(const MotionThread&) = delete;
    MotionThread& operator=(const MotionThread&) = delete;

    /// The newest stage. Threads: one reader (drawing).
    [[nodiscard]] const StageState& newest() noexcept { return stage_.newest(); }

    /// Queues a command. Threads: main. False when the queue is full.
    bool command(const motion::DancerCommand& command) noexcept { return stage_.command(command); }

    /// Hops danced so far. Threads: any.
    [[nodiscard]] std::int64_t danced_hops() const noexcept { return stage_.danced_hops(); }

 private:
    void run() noexcept;

    MotionStage stage_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

}  // namespace raks::engine
