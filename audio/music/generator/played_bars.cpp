#include "audio/music/generator/played_bars.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace raks::audio {
namespace {

constexpr double kPlacesPerBeat = 24.0;
// Share of all notes of two bars that must be in both for them to count as alike.
constexpr float kAlike = 0.75F;

std::uint32_t code_of(const Note& note, double beat_in_bar) {
    const auto place = static_cast<std::uint32_t>(std::lround(beat_in_bar * kPlacesPerBeat));
    return static_cast<std::uint32_t>(note.sound) << 24U |
           static_cast<std::uint32_t>(note.pitch & 0xFF) << 16U | place;
}

SectionKind kind_at(std::span<const SectionSpan> form, int beat) {
    for (const SectionSpan& section : form) {
        if (beat >= section.from && beat < section.to) {
            return section.kind;
        }
    }
    return form.empty() ? SectionKind::full : SectionKind::stop;
}

// A drop is the whole band, as in full.
SectionKind sounds_like(SectionKind kind) {
    return kind == SectionKind::drop ? SectionKind::full : kind;
}

}  // namespace

std::vector<PlayedBar> played_bars(const MusicPlan& plan,
                                   const TempoCurve& curve,
                                   const Notes& score,
                                   std::span<const SectionSpan> form) {
    const int length = beats_per_bar(plan.style);
    std::vector<PlayedBar> bars;
    for (int beat = 0; curve.seconds_at(beat) < plan.seconds; beat += length) {
        bars.push_back({stream_time_from_seconds(curve.seconds_at(beat)), kind_at(form, beat), {}});
    }
    for (const Note& note : score) {
        // Swing and drags lie close to their place, never before their bar.
        const double bar = std::floor((note.beat + 1e-6) / length);
        if (bar >= 0.0 && bar < static_cast<double>(bars.size())) {
            bars[static_cast<std::size_t>(bar)].notes.push_back(
                code_of(note, std::max(0.0, note.beat - bar * length)));
        }
    }
    for (PlayedBar& bar : bars) {
        std::sort(bar.notes.begin(), bar.notes.end());
    }
    return bars;
}

float distance_of(const PlayedBar& a, const PlayedBar& b) {
    if (sounds_like(a.kind) != sounds_like(b.kind) || a.notes.empty() || b.notes.empty()) {
        return std::numeric_limits<float>::infinity();
    }
    std::vector<std::uint32_t> both;
    std::set_intersection(
        a.notes.begin(), a.notes.end(), b.notes.begin(), b.notes.end(), std::back_inserter(both));
    const std::size_t all = a.notes.size() + b.notes.size() - both.size();
    const float share = static_cast<float>(both.size()) / static_cast<float>(all);
    return (1.0F - share) / (1.0F - kAlike);
}

}  // namespace raks::audio
