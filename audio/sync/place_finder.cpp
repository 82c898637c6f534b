#include "audio/sync/place_finder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raks::audio {
namespace {

// What loudspeakers, rooms and coders leave of music.
constexpr PhaseCorrelator::Band kSongBand{150.0, 1'500.0};
constexpr std::size_t kMostPlaces = 4;
constexpr double kPlacesApart = 0.05;  // seconds between two places
constexpr double kLeastPlace = 9.0;    // standard deviations, of a place in a whole song
// Height of one that is expected there. Around it lie the sidelobes of the music's own tones, so
// that deviations say little; other sound reaches 0.06.
constexpr double kLeastThere = 0.1;
constexpr double kAsLikely = 0.5;  // of the highest peak: a place that is as likely

std::size_t place_samples(double seconds) {
    return static_cast<std::size_t>(std::lround(seconds * PlaceFinder::kRate));
}

bool is_long_enough(std::span<const float> heard) {
    return heard.size() >= place_samples(PlaceFinder::kShortest);
}

}  // namespace

// Silence behind it: what is heard may go on when the song has ended.
PlaceFinder::PlaceFinder(std::vector<float> song)
    : song_(std::move(song)), whole_(kRate, kSongBand, song_.size() + place_samples(kLongest)) {
    song_.resize(song_.size() + place_samples(kLongest));
    whole_.set_whole(song_);
}

std::optional<double> PlaceFinder::find(std::span<const float> heard, std::optional<double> hint) {
    heard = heard.first(std::min(heard.size(), place_samples(kLongest)));
    if (!is_long_enough(heard)) {
        return std::nullopt;
    }
    std::vector<CorrelationPeak> peaks = highest_peaks(
        whole_.correlate(heard), kMostPlaces, place_samples(kPlacesApart), kLeastPlace);
    std::erase_if(peaks, [highest = peaks.empty() ? 0.0 : peaks.front().height](const auto& peak) {
        return peak.height < kAsLikely * highest;
    });
    if (hint && peaks.size() > 1) {
        std::erase_if(peaks, [&](const CorrelationPeak& peak) {
            return std::abs(peak.lag / kRate - *hint) > kHintReach;
        });
    }
    return peaks.size() == 1 ? std::optional(peaks.front().lag / kRate) : std::nullopt;
}

std::optional<double> PlaceFinder::find_near(std::span<const float> heard,
                                             double place,
                                             double reach) const {
    const double first = std::max(0.0, place - reach) * kRate;
    if (!is_long_enough(heard) || first >= static_cast<double>(song_.size())) {
        return std::nullopt;
    }
    const auto begin = static_cast<std::size_t>(first);
    const std::size_t size =
        std::min(song_.size() - begin, heard.size() + 2 * place_samples(reach));
    if (size < heard.size()) {
        return std::nullopt;
    }
    PhaseCorrelator near(kRate, kSongBand, size);
    near.set_whole(std::span(song_).subspan(begin, size));
    const auto peaks = highest_peaks(near.correlate(heard), 1, place_samples(kPlacesApart), 0.0);
    return peaks.empty() || peaks.front().height < kLeastThere
               ? std::nullopt
               : std::optional((static_cast<double>(begin) + peaks.front().lag) / kRate);
}

}  // namespace raks::audio
