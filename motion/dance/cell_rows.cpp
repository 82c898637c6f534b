#include "motion/dance/cell_rows.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {

std::optional<CellRows::Slot> CellRows::slot_of(double phase, const SongBars& song) noexcept {
    if (song.beats < 1 || song.beats > kMostBeats) {
        return std::nullopt;
    }
    const auto beats = static_cast<int>(std::lround(phase - song.begins));
    const int bars =
        static_cast<int>(std::floor(static_cast<double>(beats) / static_cast<double>(song.beats)));
    const Slot slot{song.bar + bars, beats - bars * song.beats};
    return slot.bar >= 0 && slot.bar < kMostBars ? std::optional(slot) : std::nullopt;
}

void CellRows::note(const CellStep& step,
                    double phase,
                    const SongBars* song) noexcept RAKS_NONBLOCKING {
    last_[static_cast<std::size_t>(noted_ % kLoop)] = step;
    ++noted_;
    if (song == nullptr) {
        return;
    }
    if (const auto slot = slot_of(phase, *song)) {
        song_[static_cast<std::size_t>(slot->bar)][static_cast<std::size_t>(slot->beat)] = {step,
                                                                                            true};
    }
}

std::optional<CellStep> CellRows::repeated(double phase,
                                           const SongBars& song) const noexcept RAKS_NONBLOCKING {
    const auto slot = slot_of(phase, song);
    if (!slot || slot->bar < song.bar ||
        slot->bar - song.bar >= static_cast<int>(song.repeats.size())) {
        return std::nullopt;
    }
    const int first = song.repeats[static_cast<std::size_t>(slot->bar - song.bar)];
    if (first < 0 || first >= kMostBars || first >= slot->bar) {
        return std::nullopt;
    }
    const Danced& danced =
        song_[static_cast<std::size_t>(first)][static_cast<std::size_t>(slot->beat)];
    return danced.is_known ? std::optional(danced.step) : std::nullopt;
}

void CellRows::keep(const CellGraph& graph) noexcept RAKS_NONBLOCKING {
    const int most = static_cast<int>(std::min<std::int64_t>(noted_, kLoop));
    const auto last = [&](int back) {
        return last_[static_cast<std::size_t>((noted_ - back) % kLoop)];
    };
    // An even number of beats, so that halves of the bar stay where they are.
    loop_beats_ = most - most % 2;
    for (int beats = loop_beats_; beats >= 4; beats -= 2) {
        if (may_follow(graph, last(1), last(beats))) {
            loop_beats_ = beats;
            break;
        }
    }
    for (int i = 0; i < loop_beats_; ++i) {
        loop_[static_cast<std::size_t>(i)] = last(loop_beats_ - i);
    }
    loop_from_ = noted_;
}

CellStep CellRows::kept(int ahead) const noexcept RAKS_NONBLOCKING {
    const std::int64_t beat = noted_ - loop_from_ + ahead;
    return loop_[static_cast<std::size_t>(beat % loop_beats_)];
}

}  // namespace raks::motion
