#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "audio/song/song_plan.hpp"
#include "base/time.hpp"
#include "engine/live/sound_tap.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {

/// The local file that a player says it plays: read and planned as a whole (SongPlanner), and found
/// in the sound that an input hears (audio::PlaceFinder), so that its beats, parts and drops are
/// known ahead. Files of more than 20 minutes are left alone. All on a thread of its own with a low
/// priority, which holds nobody up.
///
/// Nothing is believed: a file that does not sound is not followed, whatever the player says, and
/// one that stops to sound is left after three checks, a second apart. Files are decoded in the
/// cage, as all are.
/// Threads: main, for all methods; tap() is filled by the audio thread.
class KnownSong {
 public:
    /// Plans with these models.
    explicit KnownSong(AnalyzerModels models);
    ~KnownSong();                                     ///< joins the thread
    KnownSong(const KnownSong&) = delete;             ///< the thread refers to it
    KnownSong& operator=(const KnownSong&) = delete;  ///< likewise

    /// Where the sound that is heard has to be put.
    [[nodiscard]] SoundTap& tap() noexcept;

    /// A player plays this file; where it is not a plain file, nothing happens. What is followed is
    /// sought anew. `from_start`: it begins now.
    void listen(const std::filesystem::path& file, bool from_start);
    /// Nothing that is known plays.
    void forget();

    /// What is heard.
    struct Heard {
        std::shared_ptr<const audio::SongPlan> plan;  ///< null: no known song
        Nanos shift{};                                ///< place in the song minus stream time
    };
    /// What has changed since the last call.
    [[nodiscard]] std::optional<Heard> take();

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::engine
