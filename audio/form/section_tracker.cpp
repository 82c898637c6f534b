#include "audio/form/section_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

// While the whole band plays, the sound of the last bar is remembered every so many hops.
constexpr int kHopsBetweenBars = 20;
// From so many remembered bars on, 12 s, there is something to compare a bar with.
constexpr std::size_t kLeastBars = 60;
// calmness() of the last two beats and of the last bar is over these when a breakdown begins, and
// has been for so many hops when it is told.
constexpr float kCalmBeats = 1.5F;
constexpr float kCalmBar = -1.5F;
constexpr int kBreakdownHops = 12;
// Between two places that are tried for its begin, in hops.
constexpr std::size_t kPlaceHops = 2;
// After 45 s a breakdown is no breakdown any more: the song is like that.
constexpr HopIndex kLongestBreakdownHops = 4'500;
// rise_of() of a build-up is at least this.
constexpr float kLeastBuildUpRise = 1.2F;
// calmness() falls by so much at a drop out of a build-up.
constexpr float kStepOutOfRise = 4.5F;
// A build-up begins so many bars after the breakdown at the earliest.
constexpr int kCalmBars = 2;
// A build-up is told within so many hops of its begin, or not at all: later it is of no use.
constexpr HopIndex kBuildUpHops = 400;
// This many times the onsets of the full band are a drum roll, which leads to a drop.
constexpr float kRollFactor = 1.3F;
// Where a song that began calm comes in: the sound of half a second against that of so many seconds
// before it, for so many hops.
constexpr std::size_t kComeInHops = 50;
constexpr std::size_t kCalmBeginHops = 400;
constexpr int kComeInHeldHops = 30;
// Only within so many hops from the begin of the stream.
constexpr std::size_t kLongestBegin = 6'000;

}  // namespace

void SectionTracker::remember(const StretchSound& bar) noexcept {
    low_.add(bar.low);
    level_.add(bar.level);
    top_.add(bar.top);
    low_onsets_.add(bar.low_onsets);
    onsets_.add(bar.onsets);
    full_ = FullBand::of([this](double share, float StretchSound::*part) {
        return part == &StretchSound::low          ? low_.at(share)
               : part == &StretchSound::level      ? level_.at(share)
               : part == &StretchSound::top        ? top_.at(share)
               : part == &StretchSound::low_onsets ? low_onsets_.at(share)
                                                   : onsets_.at(share);
    });
}

void SectionTracker::enter(MusicPart part, HopIndex hop) noexcept {
    before_ = part_;
    part_ = part;
    entered_ = hop;
    fallen_hops_ = 0;
    full_hops_ = 0;
}

// Of the last two bars, the hop after which the sound differs most from what it was before; -1
// where the sound has faded little by little.
HopIndex SectionTracker::place_of_fall(const BeatLengths& lengths) const noexcept {
    const auto bar = static_cast<std::size_t>(lengths.bar);
    const auto least = static_cast<std::size_t>(lengths.beat) / 2;
    const std::size_t most = std::min(sums_.size() - 1, 2 * bar);
    std::size_t best = std::min(bar, most);
    float greatest = -1e9F;
    float steepest = 0.0F;
    for (std::size_t ago = least; ago <= most; ago += kPlaceHops) {
        const std::size_t from = std::min(sums_.size(), ago + bar);
        if (from == ago) {
            break;
        }
        // A short stretch differs by chance.
        const float sure = std::sqrt(static_cast<float>(std::min(ago, bar)));
        const float step =
            calmness(sums_.mean(ago, 0), full_) - calmness(sums_.mean(from, ago), full_);
        if (sure * step > greatest) {
            greatest = sure * step;
            steepest = step;
            best = ago;
        }
    }
    return steepest < kLeastStep ? -1 : hops_[(count_ - best) % HopSums::kKept];
}

// The strongest onset of the last beat and a half; at the end of a phrase, of the beat's
// surroundings at which it ends.
HopIndex SectionTracker::place_of_drop(HopIndex hop, const BeatLengths& lengths) const noexcept {
    const bool is_phrase = is_end_of_phrase(hop, lengths);
    const int first = is_phrase ? lengths.beat / 2 : 1;
    const auto most =
        std::min(sums_.size(), static_cast<std::size_t>(lengths.beat + lengths.beat / 2));
    std::size_t best = static_cast<std::size_t>(first);
    for (std::size_t ago = best; ago <= most; ++ago) {
        if (hits_[(count_ - ago) % HopSums::kKept] >= hits_[(count_ - best) % HopSums::kKept]) {
            best = ago;
        }
    }
    return hops_[(count_ - best) % HopSums::kKept];
}

// Whether a phrase since the breakdown began was over one beat ago, and the band has played since.
bool SectionTracker::is_end_of_phrase(HopIndex hop, const BeatLengths& lengths) const noexcept {
    const double phrases = static_cast<double>(hop - lengths.beat - fell_) / lengths.phrase;
    const double apart = std::abs(phrases - std::round(phrases)) * lengths.phrase;
    const auto beat = static_cast<std::size_t>(lengths.beat);
    return phrases > 0.5 && apart < 0.35 * lengths.beat && sums_.size() > beat &&
           calmness(sums_.mean(beat, beat / 2), full_) < kFullBelow;
}

// Whether the band of a song that began calm has come in.
bool SectionTracker::has_come_in() noexcept {
    if (count_ < may_come_in_from_ || count_ > kLongestBegin ||
        sums_.size() < kComeInHops + kCalmBeginHops) {
        return false;
    }
    const bool has =
        comes_in(sums_.mean(kComeInHops + kCalmBeginHops, kComeInHops), sums_.mean(kComeInHops, 0));
    come_in_hops_ = has ? come_in_hops_ + 1 : 0;
    return come_in_hops_ >= kComeInHeldHops;
}

// One hop while the whole band plays: has a breakdown begun?
MusicEvent SectionTracker::listen(HopIndex hop, const BeatLengths& lengths, bool is_gap) noexcept {
    if (has_come_in()) {
        // What was heard before it was not the full band.
        for (auto* range : {&low_, &level_, &top_, &low_onsets_, &onsets_}) {
            range->reset();
        }
        come_in_hops_ = 0;
        may_come_in_from_ = count_ + kCalmBeginHops + kComeInHops;
        const HopIndex at = place_of_drop(hop, lengths);
        enter(MusicPart::playing, hop);
        return {MusicEvent::Kind::drop, time_of_hop(at)};
    }
    const StretchSound bar = sums_.mean(static_cast<std::size_t>(lengths.bar), 0);
    // After a drop the last bar must be of the whole band.
    const bool is_known = low_.size() >= kLeastBars && hop - entered_ > lengths.bar;
    const std::size_t beats = std::min(sums_.size(), 2 * static_cast<std::size_t>(lengths.beat));
    if (!is_known || calmness(sums_.mean(beats, 0), full_) < kCalmBeats ||
        calmness(bar, full_) < kCalmBar) {
        fallen_hops_ = 0;
        if (count_ % kHopsBetweenBars == 0) {
            remember(bar);
        }
        return {};
    }
    // Nor do the beats tell that hold a stop.
    const bool is_after_stop = went_on_ >= 0 && hop - went_on_ < HopIndex{2} * lengths.beat;
    if (++fallen_hops_ < kBreakdownHops || is_gap || is_after_stop) {
        return {};
    }
    // A fade has no step.
    const HopIndex place = place_of_fall(lengths);
    if (place < 0) {
        return {};
    }
    // After a stop it begins where music goes on.
    const HopIndex fell = std::max(place, went_on_);
    may_come_in_from_ = kLongestBegin + 1;
    enter(MusicPart::breakdown, hop);
    calm_ = sums_.mean(2 * static_cast<std::size_t>(lengths.beat), 0);
    calm_hop_ = hop;
    fell_ = fell;
    fell_count_ = count_ - std::min(count_, static_cast<std::size_t>(hop - fell));
    went_on_ = -1;
    return {MusicEvent::Kind::breakdown, time_of_hop(fell_)};
}

// Whether everything has come in within the last beat. Loudness alone does not tell it from a
// build-up, which is as loud in the end: it comes after a stop, or with a great step, or at the end
// of a phrase.
bool SectionTracker::is_drop(HopIndex hop, const BeatLengths& lengths) const noexcept {
    const auto beat = static_cast<std::size_t>(lengths.beat);
    const StretchSound now = sums_.mean(beat, 0);
    if (calmness(now, full_) > kFullBelow) {
        return false;
    }
    if (went_on_ >= 0 && hop - went_on_ < HopIndex{2} * lengths.beat) {
        return true;
    }
    // Of the breakdown alone, which may be short.
    const std::size_t calm = std::clamp(count_ - fell_count_, beat + beat / 2, 5 * beat);
    const StretchSound before = sums_.mean(std::min(sums_.size(), calm), beat);
    const float step = calmness(before, full_) - calmness(now, full_);
    if (step > (part_ == MusicPart::breakdown ? kLeastStep : kStepOutOfRise) &&
        now.onsets < kRollFactor * full_.usual.onsets) {
        return true;
    }
    return is_end_of_phrase(hop, lengths);
}

// The softest beats of the breakdown, or the end of a phrase near them.
HopIndex SectionTracker::place_of_rise(HopIndex hop, const BeatLengths& lengths) const noexcept {
    const double phrases = static_cast<double>(calm_hop_ - fell_) / lengths.phrase;
    const auto end = fell_ + static_cast<HopIndex>(std::round(phrases) * lengths.phrase);
    const HopIndex apart = end > calm_hop_ ? end - calm_hop_ : calm_hop_ - end;
    return phrases > 0.5 && apart < HopIndex{5} * lengths.beat && end < hop ? end : calm_hop_;
}

// One hop while the rhythm section is gone: has a drop come?
MusicEvent SectionTracker::wait(HopIndex hop, const BeatLengths& lengths) noexcept {
    if (is_drop(hop, lengths)) {
        const HopIndex at = went_on_ >= 0 && hop - went_on_ < HopIndex{2} * lengths.beat
                                ? went_on_
                                : place_of_drop(hop, lengths);
        enter(MusicPart::playing, hop);
        return {MusicEvent::Kind::drop, time_of_hop(at)};
    }
    const StretchSound bar = sums_.mean(static_cast<std::size_t>(lengths.bar), 0);
    full_hops_ = calmness(bar, full_) < kFullBelow ? full_hops_ + 1 : 0;
    // A build-up sounds full for its last bars.
    const int patience = part_ == MusicPart::build_up ? lengths.phrase : 2 * lengths.bar;
    if (full_hops_ > patience) {
        // Nothing told when it came in, but the band plays.
        const HopIndex since = std::max(fell_, hop - full_hops_ - lengths.bar);
        enter(MusicPart::playing, hop);
        return {MusicEvent::Kind::drop, time_of_hop(since)};
    }
    if (hop - entered_ > kLongestBreakdownHops) {
        // How the song goes on: there is nothing to wait for.
        for (auto* range : {&low_, &level_, &top_, &low_onsets_, &onsets_}) {
            range->reset();
        }
        enter(MusicPart::playing, hop);
        return {};
    }
    const auto beat = static_cast<std::size_t>(lengths.beat);
    const StretchSound now = sums_.mean(2 * beat, 0);
    if (now.level + now.low <= calm_.level + calm_.low) {
        calm_ = now;
        calm_hop_ = hops_[(count_ - 2 * beat) % HopSums::kKept];
    }
    // It rises step by step; a drop rises at once.
    const auto risen = [&](std::size_t ago) {
        return rise_of(calm_, sums_.mean((ago + 2) * beat, ago * beat), full_.usual);
    };
    const float rise = part_ == MusicPart::breakdown && sums_.size() > 6 * beat ? risen(0) : 0.0F;
    if (rise > kLeastBuildUpRise && risen(2) > 0.55F * rise && risen(4) > 0.15F * rise) {
        const HopIndex from = place_of_rise(hop, lengths);
        if (hop - from <= kBuildUpHops && from - fell_ >= HopIndex{kCalmBars} * lengths.bar) {
            part_ = MusicPart::build_up;
            full_hops_ = 0;
            return {MusicEvent::Kind::build_up, time_of_hop(from)};
        }
    }
    return {};
}

void SectionTracker::pause(HopIndex hop, const BeatLengths& lengths) noexcept RAKS_NONBLOCKING {
    if (part_ == MusicPart::playing && before_ != MusicPart::playing &&
        hop - entered_ < lengths.phrase / 2) {
        part_ = before_;
    }
}

void SectionTracker::go_on(HopIndex hop) noexcept RAKS_NONBLOCKING { went_on_ = hop; }

MusicEvent SectionTracker::advance(HopIndex hop,
                                   const HopSound& sound,
                                   const BeatLengths& lengths,
                                   bool is_gap) noexcept RAKS_NONBLOCKING {
    sums_.add(sound);
    hops_[count_ % HopSums::kKept] = hop;
    hits_[count_ % HopSums::kKept] = sound.hits[0] + sound.hits[1] + sound.hits[2];
    ++count_;
    if (sums_.size() < static_cast<std::size_t>(lengths.bar)) {
        return {};
    }
    return part_ == MusicPart::playing ? listen(hop, lengths, is_gap) : wait(hop, lengths);
}

}  // namespace raks::audio
