#include "audio/song/song_dances.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "audio/genre/genre_model.hpp"
#include "audio/genre/music_tagger.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kStep = 50;        // hops: evidence is summed up over half a second
constexpr std::size_t kLeastSteps = 30;  // of a section: 15 s
constexpr double kStepSeconds = static_cast<double>(kStep) / kHopsPerSecond;
// Seconds in which evidence is as good as independent: windows overlap.
constexpr double kIndependent = 3.0;
constexpr double kPatchSeconds = 2.99;
// ln of the odds against another class at any step, and after a silence that may end a song.
constexpr double kChangeCost = 8.0;
constexpr double kChangeAtSilence = 3.0;
// A probability of the model is not believed to be smaller: it was learnt on other music.
constexpr float kLeastLog = -4.0F;
constexpr float kSureBar = 0.6F;  // confidence of the beat grid
// Hops that are silent in a row where a song ends: a hop is silent after 1.3 s without sound.
constexpr std::size_t kSilentHopsAtEnd = 120;
// Hops within which a section's begin is looked for around the step that was found: what is said of
// a class needs some seconds of music, which may be of both sections.
constexpr std::size_t kNearChange = 740;  // two of them less than kLeastSteps
// How much it speaks for a begin that sound begins again there, that another metre or beat begins,
// that the tempo changes (of its logarithm, and at most), that a bar begins; in nats.
constexpr double kBeginAtSilence = 8.0;
constexpr double kBeginOfMetre = 3.0;
constexpr double kBeginOfTempo = 40.0;
constexpr double kMostOfTempo = 6.0;
constexpr double kBeginOfBar = 0.5;
// Hops by which what was said of a section may reach over its ends.
constexpr std::size_t kOverEnd = 50;

using ClassSums = std::array<double, PatternNetwork::kMaxClasses>;

std::size_t hop_of(StreamTime time) {
    return static_cast<std::size_t>(std::max<std::int64_t>(0, time.time_since_epoch() / kHop));
}

bool is_other_bar(int beats_per_bar, int of_dance) {
    return of_dance > 0 && (beats_per_bar % 3 == 0) != (of_dance % 3 == 0);
}

// The hops that something was said of.
struct Stretch {
    std::size_t first = 0;
    std::size_t end = 0;
    [[nodiscard]] std::size_t middle() const { return (first + end) / 2; }
    [[nodiscard]] bool is_within(std::size_t from, std::size_t to) const {
        return first + kOverEnd >= from && end <= to + kOverEnd;
    }
};
Stretch stretch_of(std::size_t end, double seconds) {
    return {end - std::min(end, static_cast<std::size_t>(seconds * kHopsPerSecond)), end};
}
Stretch stretch_of(const SongRecording::Moment& moment) {
    return stretch_of(moment.hop, moment.said.seconds);
}
Stretch stretch_of(const SongJudgement::Patch& patch) {
    return stretch_of(hop_of(patch.until), kPatchSeconds);
}

// How much each step speaks for each class, in nats.
class StepEvidence {
 public:
    StepEvidence(const SongHeard& heard, const GenreRecognizer& genres)
        : classes_(genres.model().classes()), steps_(heard.states.size() / kStep) {
        const float own = heard.patches.empty() ? 1.0F : SongJudgement::kOwnWeight;
        for (const SongRecording::Moment& moment : heard.moments) {
            const double share = moment.said.sureness * DanceDecision::kStep / kIndependent;
            add(stretch_of(moment).middle(), share * static_cast<double>(own), moment.said.logs);
        }
        for (const SongJudgement::Patch& patch : heard.patches) {
            const Stretch of = stretch_of(patch);
            const double share =
                static_cast<double>(SongJudgement::kTaggerWeight) * kStepSeconds / kIndependent;
            for (std::size_t hop = of.first + kStep / 2; hop < of.end; hop += kStep) {
                add(hop, share, patch.logs);
            }
        }
        add_metre(heard.states, genres.bars());
        for (std::size_t step = 0; step < steps_.size(); ++step) {
            if (heard.states[step * kStep + kStep / 2].is_silent) {
                steps_[step].fill(0.0);
            }
        }
    }
    [[nodiscard]] std::size_t size() const { return steps_.size(); }
    [[nodiscard]] double of(std::size_t step, std::size_t c) const { return steps_[step][c]; }

 private:
    void add(std::size_t hop, double weight, const GenreScores::Values& logs) {
        if (hop / kStep < steps_.size()) {
            for (std::size_t c = 0; c < classes_; ++c) {
                steps_[hop / kStep][c] +=
                    weight * static_cast<double>(std::max(kLeastLog, logs[c]));
            }
        }
    }
    void add_metre(std::span<const MusicState> states, const ClassBars& bars) {
        constexpr double kNats =
            static_cast<double>(SongJudgement::kOtherBar) * kStepSeconds / kIndependent;
        for (std::size_t step = 0; step < steps_.size(); ++step) {
            const BeatGrid& grid = states[step * kStep + kStep / 2].grid;
            for (std::size_t c = 0; c < classes_ && grid.confidence > kSureBar; ++c) {
                steps_[step][c] -= is_other_bar(grid.beats_per_bar, bars[c]) ? kNats : 0.0;
            }
        }
    }

    std::size_t classes_;
    std::vector<ClassSums> steps_;
};

// Where sound begins again after a silence in which a song can end.
std::vector<std::size_t> ends_of_silences(std::span<const MusicState> states) {
    std::vector<std::size_t> ends;
    std::size_t silent = 0;
    for (std::size_t hop = 0; hop < states.size(); ++hop) {
        if (states[hop].is_silent) {
            ++silent;
            continue;
        }
        if (silent >= kSilentHopsAtEnd) {
            ends.push_back(hop);
        }
        silent = 0;
    }
    return ends;
}

// A section of one class ends with a step, and one of another begins.
struct ClassChange {
    std::size_t step;
    std::size_t before;
    std::size_t after;
};

// The most likely path of classes, in which none lasts for less than kLeastSteps.
class SectionPath {
 public:
    SectionPath(const StepEvidence& evidence,
                std::size_t classes,
                std::span<const std::size_t> silences)
        : evidence_(evidence), classes_(classes) {
        costs_.assign(evidence.size() + 1, kChangeCost);
        for (const std::size_t silence : silences) {
            // The evidence before a silence is as late as its window.
            constexpr std::size_t kAround = 3;
            const std::size_t step = silence / kStep;
            for (std::size_t i = step - std::min(step, kAround);
                 i <= std::min(step + kAround, evidence.size());
                 ++i) {
                costs_[i] = kChangeAtSilence;
            }
        }
        costs_[0] = 0.0;
    }

    // Where another section begins, without the first.
    std::vector<ClassChange> changes() {
        const std::size_t steps = evidence_.size();
        if (steps < 2 * kLeastSteps) {
            return {};
        }
        best_.assign(steps + 1, kNever);
        leader_.assign(steps + 1, 0);
        is_opened_.assign(steps + 1, {});
        best_[0] = 0.0;
        ClassSums paths;
        paths.fill(kNever);
        ClassSums sums{};  // over the last kLeastSteps
        for (std::size_t step = 1; step <= steps; ++step) {
            advance(step, paths, sums);
        }
        return walk_back();
    }

 private:
    static constexpr double kNever = -1e18;

    void advance(std::size_t step, ClassSums& paths, ClassSums& sums) {
        for (std::size_t c = 0; c < classes_; ++c) {
            const double here = evidence_.of(step - 1, c);
            sums[c] += here;
            double opened = kNever;
            if (step >= kLeastSteps) {
                const std::size_t from = step - kLeastSteps;
                sums[c] -= from > 0 ? evidence_.of(from - 1, c) : 0.0;
                opened = best_[from] - costs_[from] + sums[c];
            }
            const double stayed = paths[c] + here;
            is_opened_[step][c] = opened > stayed;
            paths[c] = std::max(opened, stayed);
            if (paths[c] > best_[step]) {
                best_[step] = paths[c];
                leader_[step] = c;
            }
        }
    }

    [[nodiscard]] std::vector<ClassChange> walk_back() const {
        std::vector<ClassChange> changes;
        std::size_t step = evidence_.size();
        std::size_t c = leader_[step];
        while (step > kLeastSteps) {
            if (!is_opened_[step][c]) {
                --step;
                continue;
            }
            step -= kLeastSteps;
            changes.push_back({step, leader_[step], c});
            c = leader_[step];
        }
        std::reverse(changes.begin(), changes.end());
        return changes;
    }

    const StepEvidence& evidence_;
    std::size_t classes_;
    std::vector<double> costs_;  // of a change at each step
    std::vector<double> best_;   // of all paths that end a section with a step
    std::vector<std::size_t> leader_;
    std::vector<std::array<bool, PatternNetwork::kMaxClasses>> is_opened_;
};

// By how much the tempo after a beat is another than before it, in nats.
double tempo_change(std::span<const SongBeat> beats, std::size_t at) {
    constexpr std::size_t kAround = 4;  // beats
    if (at < kAround || at + kAround >= beats.size()) {
        return 0.0;
    }
    const double before = to_seconds(beats[at].time - beats[at - kAround].time);
    const double after = to_seconds(beats[at + kAround].time - beats[at].time);
    return before > 0.0 && after > 0.0 ? std::abs(std::log(after / before)) : 0.0;
}

// A place where a section can begin, and how much speaks for it besides the classes.
struct Begin {
    std::size_t hop;
    double gain;  // nats
};
std::vector<Begin> begins_of(const SongHeard& heard, std::span<const std::size_t> silences) {
    std::vector<Begin> begins;
    for (const std::size_t silence : silences) {
        begins.push_back({silence, kBeginAtSilence});
    }
    for (std::size_t i = 1; i < heard.beats.size(); ++i) {
        const SongBeat& beat = heard.beats[i];
        const bool is_other =
            beat.is_restart || beat.place.beats_per_bar != heard.beats[i - 1].place.beats_per_bar;
        const double gain = (is_other ? kBeginOfMetre : 0.0) +
                            (beat.place.position == 0 ? kBeginOfBar : 0.0) +
                            std::min(kMostOfTempo, kBeginOfTempo * tempo_change(heard.beats, i));
        if (gain > 0.0) {
            begins.push_back({hop_of(beat.time), gain});
        }
    }
    return begins;
}

// The place that is most likely by both: what is heard before and after it, and what begins there.
std::size_t begin_of(const ClassChange& change,
                     const StepEvidence& evidence,
                     std::span<const Begin> begins) {
    const std::size_t middle = change.step * kStep;
    const std::size_t low = (middle - std::min(middle, kNearChange)) / kStep;
    std::vector<double> gains = {0.0};  // of a change with step `low` and those after it
    for (std::size_t step = low; step < evidence.size(); ++step) {
        gains.push_back(gains.back() + evidence.of(step, change.before) -
                        evidence.of(step, change.after));
    }
    std::size_t best = middle;
    double most = gains[change.step - low];
    for (const Begin& begin : begins) {
        const bool is_near = begin.hop + kNearChange >= middle && begin.hop <= middle + kNearChange;
        const std::size_t step = (begin.hop + kStep / 2) / kStep;
        if (!is_near || step < low || step - low >= gains.size()) {
            continue;
        }
        if (const double gain = gains[step - low] + begin.gain; gain > most) {
            most = gain;
            best = begin.hop;
        }
    }
    return best;
}

// The metre of most of a stretch, where its beat is mostly sure.
BeatGrid grid_of(std::span<const MusicState> states) {
    std::array<std::size_t, 16> bars{};
    float bar_confidence = 0.0F;
    std::size_t sure = 0;
    for (const MusicState& state : states) {
        if (!state.is_silent && state.grid.confidence > kSureBar && state.grid.beats_per_bar > 0) {
            ++bars[std::min<std::size_t>(bars.size() - 1,
                                         static_cast<std::size_t>(state.grid.beats_per_bar))];
            bar_confidence += state.grid.bar_confidence;
            ++sure;
        }
    }
    const auto most = std::max_element(bars.begin(), bars.end());
    BeatGrid grid;
    grid.confidence = 2 * *most > states.size() ? 1.0F : 0.0F;
    grid.beats_per_bar = static_cast<int>(most - bars.begin());
    grid.bar_confidence = sure > 0 ? bar_confidence / static_cast<float>(sure) : 0.0F;
    return grid;
}

// What was said of the hops [first, end) of a song alone, and what is decided by it.
DanceDecision judge(const SongHeard& heard,
                    const GenreRecognizer& genres,
                    const GenreLogProbabilities& prior,
                    Stretch section) {
    SongJudgement song(genres.model().classes(), SongJudgement::Songs::one);
    std::int64_t moments = 0;
    for (const SongRecording::Moment& moment : heard.moments) {
        if (stretch_of(moment).is_within(section.first, section.end)) {
            song.add(moment.said.logs, moment.said.sureness, DanceDecision::kStep);
            ++moments;
        }
    }
    bool has_patch = false;
    for (const SongJudgement::Patch& patch : heard.patches) {
        if (stretch_of(patch).is_within(section.first, section.end)) {
            song.add(patch);
            has_patch = true;
        }
    }
    DanceDecision decision = genres.decision(prior);
    if (moments > 0) {
        const BeatGrid grid =
            grid_of(heard.states.subspan(section.first, section.end - section.first));
        using Asked = SongJudgement::Asked;
        decision.settle(song.log_chances(has_patch ? Asked::both : Asked::own_parts,
                                         grid.confidence > kSureBar ? grid.beats_per_bar : 0,
                                         genres.bars()),
                        static_cast<std::int64_t>(section.end - section.first),
                        grid);
    }
    return decision;
}

SongSection section_of(const DanceDecision& decision, std::size_t first, std::size_t classes) {
    constexpr float kLeastPublished = -20.0F;
    SongSection section{first, static_cast<std::uint8_t>(decision.shown()), decision.is_told(), {}};
    section.log_chances.fill(kLeastPublished);
    for (std::size_t c = 0; c < classes; ++c) {
        section.log_chances[c] = std::max(kLeastPublished, decision.log_chances()[c]);
    }
    return section;
}

}  // namespace

std::vector<SongSection> find_sections(const SongHeard& heard,
                                       const GenreRecognizer& genres,
                                       const GenreLogProbabilities& prior) {
    if (heard.states.empty()) {
        return {};
    }
    const std::size_t classes = genres.model().classes();
    const std::vector<std::size_t> silences = ends_of_silences(heard.states);
    const std::vector<Begin> begins = begins_of(heard, silences);
    std::vector<std::size_t> firsts = {0};
    const StepEvidence evidence(heard, genres);
    for (const ClassChange& change : SectionPath(evidence, classes, silences).changes()) {
        firsts.push_back(begin_of(change, evidence, begins));
    }
    firsts.push_back(heard.states.size());
    std::vector<SongSection> sections;
    for (std::size_t i = 0; i + 1 < firsts.size(); ++i) {
        const DanceDecision decision = judge(heard, genres, prior, {firsts[i], firsts[i + 1]});
        sections.push_back(section_of(decision, firsts[i], classes));
    }
    return sections;
}

}  // namespace raks::audio
