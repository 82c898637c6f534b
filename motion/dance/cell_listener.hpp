// Cell listener: what the music asks of a dance of cells.
#pragma once

#include <cstdint>
#include <optional>

#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "motion/dance/beat_phase.hpp"
#include "motion/dance/cell_sequence.hpp"
#include "motion/dance/dynamics/energy_range.hpp"
#include "motion/dance/dynamics/manner.hpp"
#include "motion/dance/dynamics/phrases.hpp"

namespace raks::motion {

/// The dancer's moment in which something is asked of its cells.
struct CellMoment {
    const DancePhase& phase;
    const MannerOfMusic& manner;
    const Phrases& phrases;
    std::uint64_t seed = 1;    ///< of what is drawn: which phrases end in a rest
    bool has_dynamics = true;  ///< false: only energy and bars are followed
};

/// Hears what the music gives and what is ahead, and says which cells suit it: energies by how
/// often the music has given less, rests at the ends of phrases and where a known song stops, the
/// greatest cells where everything comes in, calm ones in a breakdown, another piece where a phrase
/// begins, and the bars of a known song. Threads: one. Real-time: yes.
class CellListener {
 public:
    /// One hop of music, danced or not.
    void hear(const MusicState& music) noexcept RAKS_NONBLOCKING;
    /// A dance begins at phase 0: what was told by phases is over.
    void begin() noexcept { song_.reset(); }
    /// What is asked at this hop, which was heard.
    [[nodiscard]] CellMusic asked(const MusicState& music,
                                  const CellMoment& moment) noexcept RAKS_NONBLOCKING;

 private:
    [[nodiscard]] double energy_of(const MusicState& music,
                                   const CellMoment& moment) const noexcept;
    void look_at_drop(const MusicState& music, const CellMoment& moment, CellMusic& asked) noexcept;
    void look_at_phrase(const MusicState& music,
                        const CellMoment& moment,
                        CellMusic& asked) const noexcept;
    void look_at_song(const MusicState& music, const CellMoment& moment, CellMusic& asked) noexcept;

    EnergyRange range_;
    double felt_ = 0.5;                    // energy of the last second or so
    std::optional<StreamTime> dropped_{};  // the last drop that was heard
    bool has_come_in_ = false;             // something, since it was asked last
    std::optional<SongBars> song_{};       // as it was told last, away from a bar line
};

}  // namespace raks::motion
