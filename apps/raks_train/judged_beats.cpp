#include "apps/raks_train/judged_beats.hpp"

#include <utility>

#include "apps/terminal/program.hpp"
#include "audio/beat/beat_tracker.hpp"
#include "audio/evaluate/beat_corpus.hpp"
#include "audio/evaluate/beat_faults.hpp"
#include "audio/music_analyzer.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::apps {
namespace {

constexpr double kJudgedFrom = 5.0;  // seconds: a tracker may need the first ones

// Keeps time and features of each announced beat.
class KeepBeats final : public audio::MusicAnalyzer::Sink {
 public:
    explicit KeepBeats(const audio::MusicAnalyzer& analyzer) : analyzer_(analyzer) {}
    void on_state(const MusicState& state) noexcept override {
        if (state.has_beat && to_seconds(state.beat.time) >= kJudgedFrom) {
            times.push_back(to_seconds(state.beat.time));
            beats.push_back({.features = analyzer_.beats().features()});
        }
    }
    std::vector<double> times;
    std::vector<audio::JudgedBeat> beats;

 private:
    const audio::MusicAnalyzer& analyzer_;
};

// Adds the beats of one piece.
Expected<void> judge_piece(const audio::BeatExcerpt& piece,
                           const std::shared_ptr<const audio::BeatNetwork>& network,
                           std::size_t number,
                           std::vector<audio::JudgedBeat>& judged) {
    auto source = engine::MusicSource::open(piece.audio);
    if (!source) {
        return fail(std::move(source.error()));
    }
    auto analyzer = engine::make_analyzer(source->rate(), {network, nullptr, nullptr});
    if (!analyzer) {
        return fail(std::move(analyzer.error()));
    }
    KeepBeats kept(*analyzer);
    for (auto block = source->next(); !block.mono.empty() && !stop_signal();
         block = source->next()) {
        analyzer->process(block.mono, kept);
    }
    const auto& annotated = piece.reference.times;
    const std::vector<float> unknown(kept.times.size());
    std::size_t next = 0;
    for (const audio::Claim& claim : audio::beat_claims(annotated, kept.times, unknown)) {
        // Claims leave out beats outside the annotation.
        while (kept.times[next] < annotated.front() - audio::kHitTolerance) {
            ++next;
        }
        audio::JudgedBeat& beat = kept.beats[next++];
        beat.is_right = claim.is_right;
        beat.piece = number;
        judged.push_back(beat);
    }
    return {};
}

}  // namespace

Expected<std::vector<audio::JudgedBeat>> judge_beats_of(
    std::span<const std::filesystem::path> folders,
    const std::shared_ptr<const audio::BeatNetwork>& network) {
    std::vector<audio::JudgedBeat> judged;
    std::size_t number = 0;
    for (const std::filesystem::path& folder : folders) {
        const auto pieces = audio::load_beat_corpus(folder);
        if (!pieces) {
            return fail(pieces.error());
        }
        for (const audio::BeatExcerpt& piece : *pieces) {
            if (auto done = judge_piece(piece, network, number++, judged); !done) {
                return fail(done.error());
            }
        }
    }
    if (judged.empty()) {
        return fail("no beat was announced in this music: nothing to learn from");
    }
    return judged;
}

}  // namespace raks::apps
