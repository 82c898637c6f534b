#pragma once

#include <memory>
#include <optional>

#include "apps/raks/commands.hpp"
#include "apps/raks/play_set.hpp"
#include "apps/raks/stage_loop.hpp"
#include "audio/io/devices.hpp"
#include "audio/io/file_player.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/offline/song_planner.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/formations.hpp"

namespace raks::apps {

/// Plays files, one after the other, in one window. What it is given must outlive it. Threads:
/// main.
class SongPlayer {
 public:
    /// What it plays with.
    struct Means {
        const PlayArguments& arguments;
        const std::optional<audio::AudioDevice>& output;  ///< none: our own clock paces, no sound
        const engine::AnalyzerModels& models;
        const engine::Formations& formations;  ///< their cast dances on from file to file
        StageLoop& loop;
    };
    explicit SongPlayer(const Means& means);

    /// Why play() has returned.
    enum class End : std::uint8_t {
        over,  ///< the files are at their end, or the person has ended it
        wish,  ///< the stage has a wish of the person's: StageLoop::take_wish
    };
    /// Plays until the end. Files that cannot be played are skipped and noted in `files`. The first
    /// file begins at `place`, in seconds, where that is given.
    [[nodiscard]] End play(PlaySet& files, std::optional<double> place = std::nullopt);
    /// Where in the file it was when the person wished for something else, in seconds.
    [[nodiscard]] double place() const noexcept { return place_; }

    /// True when the device died.
    [[nodiscard]] bool has_failed() const noexcept { return has_failed_; }
    /// True when a file was played, or somebody ended it.
    [[nodiscard]] bool has_played() const noexcept { return has_played_; }

 private:
    using FilePlayerPtr = std::unique_ptr<audio::FilePlayer>;
    /// One file, and what is around it.
    struct Song {
        const Path& file;
        StageSource::Behind behind;
        Path next;
        std::optional<double> place;
    };
    [[nodiscard]] Expected<StageEnd> play(const Song& song, PlaySet& files);
    [[nodiscard]] StageSource source_of(const Song& song,
                                        PlaySet& files,
                                        const audio::FilePlayer& player,
                                        const engine::AnalyzerModels& models) const;
    [[nodiscard]] Expected<StageEnd> after(engine::LiveGraph& graph,
                                           StageEnd end,
                                           const Path& file);
    [[nodiscard]] Expected<FilePlayerPtr> open(PlaySet& files) const;
    [[nodiscard]] engine::LiveGraphConfig config_for(const Path& file) const;

    const PlayArguments& arguments_;
    const std::optional<audio::AudioDevice>& output_;
    const engine::AnalyzerModels& models_;
    const engine::Formations& formations_;
    StageLoop& loop_;
    engine::LiveGraphConfig sound_;                       // of every song
    std::optional<engine::OpenLoudspeaker> loudspeaker_;  // between two songs
    engine::SongPlanner planner_;
    bool is_first_ = true;  // the next song to play
    bool has_failed_ = false;
    bool has_played_ = false;
    double place_ = 0.0;
};

}  // namespace raks::apps
