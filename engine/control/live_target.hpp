#pragma once

#include "audio/beat/analyzer_command.hpp"
#include "base/beats.hpp"
#include "base/time.hpp"
#include "engine/live/live_graph.hpp"
#include "motion/dancer.hpp"

namespace raks::engine {

/// What the actions of playing, tempo and dance act upon: the live graph, or in a test a record of
/// what was asked. Threads: main.
class LiveTarget {
 public:
    virtual ~LiveTarget() = default;

    /// Commands for the two real-time threads, at the moment that is heard now. False when a queue
    /// is full.
    virtual bool command(audio::AnalyzerCommand::Kind kind, double value) = 0;
    virtual bool command(motion::DancerCommand::Kind kind, double value) = 0;
    /// That is danced to now.
    [[nodiscard]] virtual Bpm tempo() = 0;

    /// The user's part of the latency between picture and sound.
    [[nodiscard]] virtual Nanos latency_offset() = 0;
    virtual void set_latency_offset(Nanos offset) = 0;

    /// The file that plays; with a microphone nothing happens.
    virtual void toggle_pause() = 0;
    virtual void seek_by(double seconds) = 0;
    virtual void set_volume(float volume) = 0;  ///< [0, 2]
};

/// The live graph as a target.
class GraphTarget final : public LiveTarget {
 public:
    /// `graph` must outlive this.
    explicit GraphTarget(LiveGraph& graph) : graph_(graph) {}

    bool command(audio::AnalyzerCommand::Kind kind, double value) override;
    bool command(motion::DancerCommand::Kind kind, double value) override;
    [[nodiscard]] Bpm tempo() override;
    [[nodiscard]] Nanos latency_offset() override;
    void set_latency_offset(Nanos offset) override;
    void toggle_pause() override;
    void seek_by(double seconds) override;
    void set_volume(float volume) override;

 private:
    LiveGraph& graph_;
};

}  // namespace raks::engine
