// Repertoire: which dance belongs to which genre.
#pragma once

#include <array>
#include <atomic>
#include <bitset>
#include <memory>

#include "base/beats.hpp"
#include "base/dance_list.hpp"
#include "base/realtime.hpp"
#include "motion/dance_library.hpp"
#include "motion/figures/dance_mood.hpp"

namespace raks::motion {

/// The tempo of music that a dance is danced to, as it is listed.
struct DanceTempo {
    Bpm lowest{1.0};        ///< slowest music
    Bpm highest{1e6};       ///< fastest music
    Bpm likely{120.0};      ///< as usual
    int beats_per_bar = 4;  ///< of the music
};

/// Some dances, by their numbers in the program's list.
using DanceSet = std::bitset<kMostDances>;

/// The dances that a dancer knows, by their numbers in the program's list, and what is danced to
/// music of none of them. It may grow while a dancer reads it: a dance added later is available
/// from then on.
class Repertoire {
 public:
    /// What is danced while the genre is unknown, or its dance is not known.
    enum class Fallback {
        first,  ///< the first dance; to music far from its tempo the nearest one
        keep,   ///< what is danced already
        stand,  ///< nothing
    };

    /// Starts with one dance. `library` must not be null. Threads: any. Real-time: no.
    Repertoire(DanceId first,
               std::shared_ptr<const DanceLibrary> library,
               Fallback otherwise = Fallback::first,
               const DanceTempo& tempo = {},
               const DanceMood& mood = {});

    /// A repertoire of one dance for any music; null for a null library. Threads: any. Real-time:
    /// no.
    [[nodiscard]] static std::shared_ptr<const Repertoire> of_one(
        std::shared_ptr<const DanceLibrary> library);

    /// Adds a dance; each number at most once. It stays for as long as the repertoire lives.
    /// Threads: one adds at a time, others may read. Real-time: no.
    void add(DanceId id,
             std::shared_ptr<const DanceLibrary> library,
             const DanceTempo& tempo = {},
             const DanceMood& mood = {});

    /// The library of a dance; null: not known (yet). Threads: any. Real-time: yes.
    [[nodiscard]] const DanceLibrary* of(DanceId id) const noexcept RAKS_NONBLOCKING;
    /// How the faces of a dance that is known look. Threads: any, after of(). Real-time: yes.
    [[nodiscard]] const DanceMood& mood_of(DanceId id) const noexcept RAKS_NONBLOCKING;
    /// The dance given to the constructor. Threads: any. Real-time: yes.
    [[nodiscard]] DanceId first() const noexcept { return first_; }
    /// What is danced to other music. Threads: any. Real-time: yes.
    [[nodiscard]] Fallback otherwise() const noexcept { return fallback_; }
    /// The dance for music of no dance: the first one, where the tempo, half or twice of it lies in
    /// its range; otherwise the dance of this metre whose likely tempo is nearest, in octaves. A
    /// dance that is danced already, `present`, stays a little longer than it would be chosen. None
    /// of `forbidden`; where all others have another metre, one of them; where all are forbidden,
    /// the first.
    /// Threads: any. Real-time: yes.
    [[nodiscard]] DanceId nearest(Bpm tempo,
                                  int beats_per_bar,
                                  DanceId present,
                                  const DanceSet& forbidden = {}) const noexcept RAKS_NONBLOCKING;

 private:
    DanceId first_;
    Fallback fallback_;
    std::array<std::shared_ptr<const DanceLibrary>, kMostDances> owned_;
    std::array<DanceTempo, kMostDances> tempos_{};  // of those that are in dances_
    std::array<DanceMood, kMostDances> moods_{};    // likewise
    std::array<std::atomic<const DanceLibrary*>, kMostDances> dances_{};
};

}  // namespace raks::motion
