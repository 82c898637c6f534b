#include "motion/repertoire.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/assert.hpp"

namespace raks::motion {
namespace {

constexpr std::array<double, 3> kOctaves = {1.0, 2.0, 0.5};
constexpr double kStays = 0.06;       // octaves: the tempo of music wavers
constexpr double kOtherOctave = 0.1;  // octaves that dancing at half or twice the tempo counts

// Octaves from a tempo to the range, at best; 0: within.
double octaves_beyond(Bpm tempo, const DanceTempo& range) noexcept {
    double least = 1e9;
    for (const double octave : kOctaves) {
        const double own = octave * tempo.bpm();
        least = std::min(
            least,
            std::max(
                {std::log2(range.lowest.bpm() / own), std::log2(own / range.highest.bpm()), 0.0}));
    }
    return least;
}

double octaves_from_likely(Bpm tempo, const DanceTempo& range) noexcept {
    double least = 1e9;
    for (const double octave : kOctaves) {
        const double apart = std::abs(std::log2(octave * tempo.bpm() / range.likely.bpm()));
        least = std::min(least, apart + (octave == 1.0 ? 0.0 : kOtherOctave));
    }
    return least;
}

}  // namespace

Repertoire::Repertoire(DanceId first,
                       std::shared_ptr<const DanceLibrary> library,
                       Fallback otherwise,
                       const DanceTempo& tempo,
                       const DanceMood& mood)
    : first_(first), fallback_(otherwise) {
    add(first, std::move(library), tempo, mood);
}

std::shared_ptr<const Repertoire> Repertoire::of_one(std::shared_ptr<const DanceLibrary> library) {
    return library ? std::make_shared<const Repertoire>(DanceId{0}, std::move(library)) : nullptr;
}

void Repertoire::add(DanceId id,
                     std::shared_ptr<const DanceLibrary> library,
                     const DanceTempo& tempo,
                     const DanceMood& mood) {
    const auto slot = index_of(id);
    RAKS_ASSERT(library != nullptr && slot < owned_.size() && owned_[slot] == nullptr);
    owned_[slot] = std::move(library);
    tempos_[slot] = tempo;
    moods_[slot] = mood;
    // release: pairs with the acquire in of(); the dancer sees a dance that is whole.
    dances_[slot].store(owned_[slot].get(), std::memory_order_release);
}

const DanceLibrary* Repertoire::of(DanceId id) const noexcept RAKS_NONBLOCKING {
    return index_of(id) < dances_.size() ? dances_[index_of(id)].load(std::memory_order_acquire)
                                         : nullptr;
}

const DanceMood& Repertoire::mood_of(DanceId id) const noexcept RAKS_NONBLOCKING {
    return moods_[index_of(id) < moods_.size() ? index_of(id) : index_of(first_)];
}

// In music of a metre that no dance has, the first one is danced; where that is forbidden, any that
// is allowed.
DanceId Repertoire::nearest(Bpm tempo,
                            int beats_per_bar,
                            DanceId present,
                            const DanceSet& forbidden) const noexcept RAKS_NONBLOCKING {
    constexpr double kOtherMetre = 100.0;  // octaves
    const bool is_first_allowed = !forbidden[index_of(first_)];
    if (is_first_allowed &&
        (!(tempo.bpm() > 0.0) ||
         octaves_beyond(tempo, tempos_[index_of(first_)]) <= (present == first_ ? kStays : 0.0))) {
        return first_;
    }
    DanceId best = first_;
    double least = 1e9;
    for (std::size_t slot = 0; slot < dances_.size(); ++slot) {
        const auto id = static_cast<DanceId>(slot);
        const double other = tempos_[slot].beats_per_bar == beats_per_bar ? 0.0 : kOtherMetre;
        if (forbidden[slot] || of(id) == nullptr || (is_first_allowed && other > 0.0)) {
            continue;
        }
        const double apart = (tempo.bpm() > 0.0 ? octaves_from_likely(tempo, tempos_[slot]) : 0.0) +
                             other - (id == present ? kStays : 0.0);
        if (apart < least) {
            least = apart;
            best = id;
        }
    }
    return best;
}

}  // namespace raks::motion
