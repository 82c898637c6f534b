// Clip course: when in the music each moment of a clip is performed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/beats.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// What the time of a performed clip goes by.
enum class ClipSync : std::uint8_t {
    song,  ///< the song that it was made for: it runs at its own rate from one place of it on
    beat,  ///< any music: it begins on a 1, and its beats are stretched to those of the music
};
inline constexpr std::array<std::string_view, 2> kClipSyncNames = {"song",
                                                                   "beat"};  ///< words for it

/// Whether a clip begins again at its end.
enum class ClipLoop : std::uint8_t {
    where_ends_meet,  ///< at once, where its last pose is about its first; else at the next phrase
    always,           ///< at once
    never,
};

/// What a person says of a clip's time.
struct ClipTiming {
    ClipSync sync = ClipSync::beat;
    ClipLoop loop = ClipLoop::where_ends_meet;
    double offset = 0.0;  ///< seconds of the song at the clip's first pose; ClipSync::song alone
};

/// What a course has to know of a clip.
struct ClipSpan {
    double seconds = 0.0;  ///< to its last pose, > 0
    double bpm = 0.0;      ///< its tempo; 0: not known, it is never stretched
    bool do_ends_meet = false;
};

/// The course of one clip. With ClipSync::beat it waits for a 1 of music that can be danced to, or
/// begins by itself where there is none for 4 s; it then follows the music's beats, at the octave
/// that suits it, while that takes a rate of 0.75 to 1.33, and else runs at its own rate. Behind
/// its end it begins again as ClipTiming::loop says; a phrase is every eighth bar since it began
/// first. With ClipSync::song it begins again only where it loops. Threads: one. Real-time: yes.
class ClipCourse {
 public:
    static constexpr double kLeastRate = 0.75;
    static constexpr double kMostRate = 1.33;

    ClipCourse(const ClipSpan& span, const ClipTiming& timing) : span_(span), timing_(timing) {}

    /// Another stream begins.
    void begin_anew() noexcept;
    /// Where the song is at the start of the stream, in its seconds; it changes with each seek.
    void set_song_start(double seconds) noexcept { song_start_ = seconds; }

    /// Seconds of the clip at a moment of the stream, later than the one before; none: it waits, or
    /// is over. `music`: the newest that is known.
    [[nodiscard]] std::optional<double> advance(StreamTime moment,
                                                const MusicState& music) noexcept;
    /// How fast it runs, against its own rate.
    [[nodiscard]] double rate() const noexcept { return rate_; }

 private:
    enum class Stage : std::uint8_t { waiting, running, over };
    [[nodiscard]] bool loops() const noexcept;
    [[nodiscard]] std::optional<double> in_song(StreamTime moment) const noexcept;
    [[nodiscard]] bool may_begin(StreamTime moment, const MusicState& music) noexcept;
    void begin(StreamTime moment, const MusicState& music) noexcept;
    void run(double seconds, StreamTime moment, const MusicState& music) noexcept;
    void end() noexcept;

    ClipSpan span_;
    ClipTiming timing_;
    double song_start_ = 0.0;

    Stage stage_ = Stage::waiting;
    std::optional<StreamTime> waits_since_;
    std::optional<StreamTime> last_;
    std::optional<long long> bar_;        // of the last moment
    std::optional<long long> first_bar_;  // in which it began first
    double place_ = 0.0;                  // seconds of the clip
    double rate_ = 1.0;
    double octave_ = 1.0;           // beats of the clip to one of the music
    std::optional<Beats> began_{};  // the music's beat at the clip's first pose; none: free
};

}  // namespace raks::engine
