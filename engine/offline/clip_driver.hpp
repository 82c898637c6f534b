#pragma once

#include <functional>
#include <optional>
#include <span>

#include "audio/music_analyzer.hpp"
#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/offline/offline_driver.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/pose_track.hpp"

namespace raks::engine {

/// As OfflineDriver, but one performer does what a clip says instead of dancing: to music, which is
/// analyzed as it comes, or without. Threads: one. Real-time: no.
class ClipDriver {
 public:
    /// The pose at a hop; called for each in order, in silence with a state that has only its hop
    /// and time.
    using PoseAt = std::function<motion::Pose(const MusicState& state)>;

    /// Without music: for perform().
    explicit ClipDriver(PoseAt pose_at) : performer_(std::move(pose_at)) {}
    /// To music. Errors: a sample rate out of range.
    [[nodiscard]] static Expected<ClipDriver> create(SampleRate rate,
                                                     const AnalyzerModels& models,
                                                     PoseAt pose_at);

    /// Takes the next samples; calls the sink once for each hop that is complete.
    void feed(std::span<const float> mono, OfflineDriver::Sink& sink);
    /// Ends the music: feeds silence until every hop that begins before the end was performed.
    void finish(OfflineDriver::Sink& sink);
    /// Performs every hop that begins before `end`, in silence.
    void perform(StreamTime end, OfflineDriver::Sink& sink);

 private:
    // Passes each state of the music on, with the clip's pose of its hop.
    class Performer final : public audio::MusicAnalyzer::Sink {
     public:
        explicit Performer(PoseAt pose_at) : pose_at_(std::move(pose_at)) {}
        void on_state(const MusicState& state) noexcept override;
        [[nodiscard]] HopIndex newest_hop() const noexcept { return track_.newest_final(); }

        OfflineDriver::Sink* sink = nullptr;
        StreamTime newest{Nanos(-1)};  // time of the last state

     private:
        PoseAt pose_at_;
        motion::PoseTrack track_;
    };

    Performer performer_;
    std::optional<audio::MusicAnalyzer> analyzer_;  // none: there is no music
    SampleRate rate_{48'000};
    std::int64_t samples_fed_ = 0;
};

}  // namespace raks::engine
