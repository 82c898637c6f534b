#include "audio/form/section_tracker.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

constexpr int kBarEvery = 20;         // hops between two bars that are remembered
constexpr std::size_t kKnown = 25;    // bars after which there is something to compare with
constexpr double kFull = 0.7;         // share of the bars that are less full
constexpr int kSureHops = 12;         // in which a bar must be a breakdown
constexpr HopIndex kLongest = 4'500;  // hops: after 45 s a breakdown is how the song is
constexpr float kBuildUpRise = 1.0F;  // rise_of() of a build-up

}  // namespace

void SectionTracker::remember(const StretchSound& bar) noexcept {
    low_.add(bar.low);
    level_.add(bar.level);
    low_onsets_.add(bar.low_onsets);
    onsets_.add(bar.onsets);
    full_ = {low_.at(kFull), level_.at(kFull), low_onsets_.at(kFull), onsets_.at(kFull), 0.0F};
}

void SectionTracker::enter(MusicPart part, HopIndex hop) noexcept {
    part_ = part;
    entered_ = hop;
    fallen_hops_ = 0;
}

// The hop of the last two bars after which the sound is most unlike that before.
HopIndex SectionTracker::place_of_fall(const BeatLengths& lengths) const noexcept {
    const auto bar = static_cast<std::size_t>(lengths.bar);
    const auto least = static_cast<std::size_t>(lengths.beat) / 2;
    const std::size_t most = std::min(sums_.size() - 1, 2 * bar);
    std::size_t best = std::min(bar, most);
    float greatest = -1e9F;
    for (std::size_t ago = least; ago <= most; ++ago) {
        const std::size_t from = std::min(sums_.size(), ago + bar);
        const float step = step_down(sums_.mean(from, ago), sums_.mean(ago, 0), full_);
        if (step > greatest) {
            greatest = step;
            best = ago;
        }
    }
    return hops_[(count_ - best) % HopSums::kKept];
}

// The strongest onset of the last beat and a half.
HopIndex SectionTracker::place_of_drop(const BeatLengths& lengths) const noexcept {
    const std::size_t most =
        std::min(sums_.size(), static_cast<std::size_t>(lengths.beat + lengths.beat / 2));
    std::size_t best = 1;
    for (std::size_t ago = 1; ago <= most; ++ago) {
        if (hits_[(count_ - ago) % HopSums::kKept] >= hits_[(count_ - best) % HopSums::kKept]) {
            best = ago;
        }
    }
    return hops_[(count_ - best) % HopSums::kKept];
}

// While the whole band plays.
MusicEvent SectionTracker::listen(HopIndex hop, const BeatLengths& lengths) noexcept {
    const StretchSound bar = sums_.mean(static_cast<std::size_t>(lengths.bar), 0);
    const bool is_known = low_.size() >= kKnown;
    if (!is_known || !fall_of(bar, full_).is_breakdown()) {
        fallen_hops_ = 0;
        if (count_ % kBarEvery == 0) {
            remember(bar);
        }
        return {};
    }
    if (++fallen_hops_ < kSureHops) {
        return {};
    }
    enter(MusicPart::breakdown, hop);
    calm_ = bar;
    calm_hop_ = hop;
    return {MusicEvent::Kind::breakdown, time_of_hop(place_of_fall(lengths))};
}

// While the rhythm section is gone.
MusicEvent SectionTracker::wait(HopIndex hop, const BeatLengths& lengths) noexcept {
    const auto beat = static_cast<std::size_t>(lengths.beat);
    if (fall_of(sums_.mean(beat, 0), full_).is_full()) {
        enter(MusicPart::playing, hop);
        return {MusicEvent::Kind::drop, time_of_hop(place_of_drop(lengths))};
    }
    const StretchSound bar = sums_.mean(static_cast<std::size_t>(lengths.bar), 0);
    const Fall fall = fall_of(bar, full_);
    if (hop - entered_ > kLongest || (part_ == MusicPart::breakdown && fall.is_full())) {
        // How the song goes on: there is nothing to wait for.
        for (auto* range : {&low_, &level_, &low_onsets_, &onsets_}) {
            range->reset();
        }
        enter(MusicPart::playing, hop);
        return {};
    }
    if (bar.level <= calm_.level) {
        calm_ = bar;
        calm_hop_ = hop;
    }
    if (part_ == MusicPart::breakdown && rise_of(calm_, bar, full_) > kBuildUpRise) {
        part_ = MusicPart::build_up;
        return {MusicEvent::Kind::build_up, time_of_hop(calm_hop_)};
    }
    return {};
}

MusicEvent SectionTracker::advance(HopIndex hop,
                                   const HopSound& sound,
                                   const BeatLengths& lengths) noexcept RAKS_NONBLOCKING {
    sums_.add(sound);
    hops_[count_ % HopSums::kKept] = hop;
    hits_[count_ % HopSums::kKept] = sound.hits[0] + sound.hits[1] + sound.hits[2];
    ++count_;
    if (sums_.size() < static_cast<std::size_t>(lengths.bar)) {
        return {};
    }
    return part_ == MusicPart::playing ? listen(hop, lengths) : wait(hop, lengths);
}

}  // namespace raks::audio
