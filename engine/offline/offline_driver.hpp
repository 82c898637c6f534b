#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audio/music_analyzer.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dancers.hpp"
#include "motion/ensemble.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/pose_track.hpp"

namespace raks::engine {

/// The result of one hop, for whoever records or draws it. Valid during on_hop() only.
struct PerformedHop {
    const MusicState& music;                    ///< the state that was danced to
    const motion::PoseTrack& track;             ///< of the first dancer
    std::span<const motion::PoseTrack> tracks;  ///< of all
    const motion::DancerStatus& dancer;         ///< what the first dancer does, after this hop
    motion::GripWeights held{};                 ///< how firmly a couple holds one another
    std::span<const glm::vec2> places{};        ///< motion::Ensemble::places
};

/// The offline driver: the same analyzer and dancers as in the live graph, on a virtual clock that
/// the samples move. The same audio, seed and commands give the same poses by hop number as live.
///
///     auto driver = OfflineDriver::create(rate, models, dancers.cast());
///     while (... block of mono samples ...) driver->feed(block, sink);
///     driver->finish(sink);
///
/// Threads: one. Real-time: not needed, but feed() does not allocate.
class OfflineDriver {
 public:
    /// Receives every hop in order.
    class Sink {
     public:
        /// Called once a hop, inside feed() and finish().
        virtual void on_hop(const PerformedHop& hop) = 0;

     protected:
        ~Sink() = default;
    };

    /// Analyzes as the music comes. Errors: a sample rate out of range, no dancer, a library that
    /// is missing.
    [[nodiscard]] static Expected<OfflineDriver> create(SampleRate rate,
                                                        const AnalyzerModels& models,
                                                        const Cast& cast);
    /// Dances to a song that is known, from this place of it on. `plan`: not null. Errors: as
    /// above.
    [[nodiscard]] static Expected<OfflineDriver> create(SampleRate rate,
                                                        std::shared_ptr<const audio::SongPlan> plan,
                                                        StreamTime start,
                                                        const Cast& cast);

    /// Takes the next samples; calls the sink once for each hop that is complete.
    void feed(std::span<const float> mono, Sink& sink);

    /// Ends the music: feeds silence until every hop that begins before the end has been danced.
    void finish(Sink& sink);

    /// A command for the analyzer; it takes effect at its own time, and not where the song is
    /// known.
    void command(const audio::AnalyzerCommand& command) { analyzer_.command(command); }
    /// A command for all dancers; it takes effect at its own time.
    void command(const motion::DancerCommand& command) { dancers_.command(command); }

 private:
    OfflineDriver(SampleRate rate, audio::MusicAnalyzer analyzer, motion::Ensemble dancers);
    void perform_until(StreamTime end, Sink& sink);

    SampleRate rate_;
    std::shared_ptr<const audio::SongPlan> plan_;  // null: the music is analyzed as it comes
    StreamTime plan_start_{};                      // place of the song at stream time 0
    HopIndex next_hop_ = 0;                        // of the plan
    audio::MusicAnalyzer analyzer_;
    motion::Ensemble dancers_;
    std::vector<motion::PoseTrack> tracks_;
    std::int64_t samples_fed_ = 0;
};

/// Samples all dancers' pose tracks at an even frame rate while they grow: pose i at i / fps
/// seconds.
class CollectPoses final : public OfflineDriver::Sink {
 public:
    /// `fps`: poses a second, > 0.
    explicit CollectPoses(double fps) : fps_(fps) {}

    /// Appends the poses whose time the hop's tracks have reached.
    void on_hop(const PerformedHop& hop) override;

    /// Cuts or extends each dancer's poses to the length of the music, ceil(duration x fps); the
    /// last pose is repeated where poses lack.
    void finish(Nanos duration);

    std::vector<std::vector<motion::Pose>> dancers;  ///< by dancer, then by pose

 private:
    [[nodiscard]] StreamTime next_time() const;

    double fps_;
    std::int64_t next_ = 0;
    std::vector<motion::Pose> last_;
};

}  // namespace raks::engine
