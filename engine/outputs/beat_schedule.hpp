#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Something in the music that others are told of at the moment when it is heard.
struct Notice {
    /// What it is.
    enum class Kind : std::uint8_t { beat, event, accent };
    Kind kind = Kind::beat;   ///< what it is
    StreamTime time{};        ///< when it sounds
    int count = 0;            ///< beat: 1 to beats per bar
    std::int64_t bar = 0;     ///< beat: 1, 2, ..: bars since the beat was found
    Bpm tempo{120.0};         ///< of the music, as it is then
    float confidence = 0.0F;  ///< of the beat, [0, 1]
    /// Beat: the first one, or one that does not follow the one before at its tempo.
    bool is_change = false;
    bool is_counted = true;  ///< beat: one of the music's; else half way to the next one
    /// Beat: it is one as the target has them (BeatSchedule::Pace); all others count bars alone.
    bool is_paced = true;
    Bpm paced_tempo{120.0};                           ///< of the beats that are paced
    MusicEvent::Kind event = MusicEvent::Kind::none;  ///< event: which
    MusicAccent accent{};                             ///< accent: which
};

/// Beats, events and accents of the music in the order in which they are heard. Every beat comes
/// once: a grid that moves by less than half a beat neither repeats nor skips one. There are no
/// beats while nothing can be danced to (BeatGrid::kDanceable), unless a person holds the tempo.
///
/// It knows no clock: tell it what is heard, in any steps. Pure; bounded work. Threads: one.
class BeatSchedule {
 public:
    /// How many beats a target has for each of the music's.
    enum class Pace : std::uint8_t {
        half,   ///< every second one, where the bar allows it the odd counts
        same,   ///< as they are
        twice,  ///< one more half way to the next one
    };
    BeatSchedule() noexcept = default;                          ///< nothing is known, at Pace::same
    explicit BeatSchedule(Pace pace) noexcept : pace_(pace) {}  ///< nothing is known

    /// What became known at the next hop.
    void take(const MusicState& state) noexcept;
    /// The next notice that is due when the music is heard up to `heard`; nothing: none. Call it
    /// until nothing comes. Beats that were heard longer ago than half a beat are passed over and
    /// counted.
    [[nodiscard]] std::optional<Notice> next(StreamTime heard) noexcept;
    /// When the next notice sounds, as far as is known; nothing: not known.
    [[nodiscard]] std::optional<StreamTime> next_time() const noexcept;
    /// When the next beat of the music sounds; nothing: there is none.
    [[nodiscard]] std::optional<StreamTime> next_beat_time() const noexcept;
    /// Beats that were passed over, as nobody asked in time.
    [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }

 private:
    [[nodiscard]] std::optional<double> next_beat() const noexcept;
    [[nodiscard]] std::optional<StreamTime> half_beat_time() const noexcept;
    [[nodiscard]] Notice tell_beat(double beat) noexcept;
    [[nodiscard]] Notice tell_half_beat() noexcept;
    [[nodiscard]] bool is_next_paced(int count) noexcept;
    void keep(const Notice& notice) noexcept;
    void drop_first() noexcept;

    static constexpr std::size_t kMostWaiting = 32;

    Pace pace_ = Pace::same;

    BeatGrid grid_;
    bool is_locked_ = false;
    StreamTime begins_{};                // no beat was before this, since it is locked
    std::optional<StreamTime> told_at_;  // the last beat, since it is locked
    Bpm told_tempo_{120.0};
    std::int64_t bar_ = 0;
    int count_ = 0;                               // of the last beat
    bool was_paced_ = false;                      // the last beat
    bool owes_half_ = false;                      // the one half way behind it is still to come
    std::array<Notice, kMostWaiting> waiting_{};  // events and accents, by time
    std::size_t waiting_count_ = 0;
    std::uint64_t missed_ = 0;
};

}  // namespace raks::engine
