// Cell rows: what was danced before, to be danced again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/realtime.hpp"
#include "motion/dance/cell_chooser.hpp"

namespace raks::motion {

/// Where a known song is, on the dance's phase: which bars come, and which earlier ones they
/// repeat.
struct SongBars {
    int bar = 0;        ///< number of the bar that sounds
    int beats = 4;      ///< of the dance in a bar of the music
    double begins = 0;  ///< phase at which this bar begins, a whole number
    /// Of this bar and of the next ones: the number of the earliest bar that it repeats; negative:
    /// it is new.
    std::array<std::int16_t, 4> repeats{-1, -1, -1, -1};
};

/// Remembers which cells were danced in which bar of a song, and the last ones of all: a part that
/// comes again gets the same row of cells, and a row can be kept by the user. Threads: one.
/// Real-time: yes.
class CellRows {
 public:
    static constexpr int kMostBars = 1024;  ///< of a song; later ones are new each time
    static constexpr int kMostBeats = 8;    ///< of a bar
    static constexpr int kLoop = 8;         ///< beats that are kept

    /// A step was decided; it is danced from this phase on. `song`: null where none is known.
    void note(const CellStep& step, double phase, const SongBars* song) noexcept RAKS_NONBLOCKING;
    /// The step that was danced when the bar at this phase came first; nothing: the bar is new.
    [[nodiscard]] std::optional<CellStep> repeated(
        double phase, const SongBars& song) const noexcept RAKS_NONBLOCKING;

    /// Keeps the last beats as a row that is danced on and on from the next beat: kLoop of them, or
    /// fewer where only then its end leads to its beginning.
    void keep(const CellGraph& graph) noexcept RAKS_NONBLOCKING;
    /// No row is kept.
    void let_go() noexcept { loop_beats_ = 0; }
    /// Whether a row is kept.
    [[nodiscard]] bool is_kept() const noexcept { return loop_beats_ > 0; }
    /// The step of the kept row that is `ahead` beats after the next one that is noted.
    [[nodiscard]] CellStep kept(int ahead) const noexcept RAKS_NONBLOCKING;

 private:
    struct Slot {
        int bar = 0;
        int beat = 0;
    };
    [[nodiscard]] static std::optional<Slot> slot_of(double phase, const SongBars& song) noexcept;

    struct Danced {
        CellStep step;
        bool is_known = false;
    };
    std::array<std::array<Danced, kMostBeats>, kMostBars> song_{};
    std::array<CellStep, kLoop> last_{};  // a ring
    std::int64_t noted_ = 0;
    std::array<CellStep, kLoop> loop_{};
    int loop_beats_ = 0;
    std::int64_t loop_from_ = 0;  // `noted_` as it was kept
};

}  // namespace raks::motion
