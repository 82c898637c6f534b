#include "apps/raks/genre_watch.hpp"

#include <algorithm>

#include "audio/genre/genre_model.hpp"
#include "audio/genre/genre_recognizer.hpp"
#include "base/time.hpp"

namespace raks::apps {
namespace {

using audio::SongJudgement;

constexpr std::size_t place(GenreVoice voice) { return static_cast<std::size_t>(voice); }

// The same object for each voice.
template <class Value>
ByVoice<Value> for_all(const Value& value) {
    return {value, value, value, value, value};
}

// Who listens, and is asked of the song so far.
struct Listener {
    GenreVoice voice;
    SongJudgement::Asked asked;
};

}  // namespace

GenreWatch::GenreWatch(const audio::MusicAnalyzer& analyzer, const File& file)
    : analyzer_(analyzer),
      truth_(file.truth),
      decisions_(for_all(analyzer.genres()->decision({}))),
      tallies_(for_all(ShownDanceTally(file.truth, analyzer.genres()->model().genres.size()))) {
    track_.genres = analyzer.genres()->model().genres;
    decisions_[place(GenreVoice::tags)] = analyzer.genres()->decision(file.prior);
    decisions_[place(GenreVoice::all)] = analyzer.genres()->decision(file.prior);
    track_.is_asked = for_all(true);
    track_.is_asked[place(GenreVoice::tags)] =
        std::any_of(file.prior.begin(), file.prior.end(), [](float nats) { return nats != 0.0F; });
    track_.is_asked[place(GenreVoice::all)] = track_.is_asked[place(GenreVoice::tags)];
    track_.is_asked[place(GenreVoice::tagger)] =
        file.has_tagger && analyzer.genres()->model().tagger.has_value();
}

void GenreWatch::on_state(const MusicState& state) noexcept {
    if (analyzer_.genres()->moment().number != judged_) {
        judged_ = analyzer_.genres()->moment().number;
        judge(state);
    }
    track_.seconds = to_seconds(state.time);
    for (std::size_t voice = 0; voice < tallies_.size(); ++voice) {
        tallies_[voice].add(track_.seconds, decisions_[voice].shown());
    }
}

// Each decides as the program does, by what it has to say.
void GenreWatch::judge(const MusicState& state) {
    const audio::GenreRecognizer& genres = *analyzer_.genres();
    const bool has_tagger = track_.is_asked[place(GenreVoice::tagger)];
    const auto both = has_tagger ? SongJudgement::Asked::both : SongJudgement::Asked::own_parts;
    const std::array<Listener, 4> listeners = {
        {{GenreVoice::own_parts, SongJudgement::Asked::own_parts},
         {GenreVoice::tagger, SongJudgement::Asked::tagger},
         {GenreVoice::heard, both},
         {GenreVoice::all, both}}};
    for (const auto& [voice, asked] : listeners) {
        decisions_[place(voice)].advance(
            genres.heard(asked, state.grid), genres.moment().heard_hops, state.grid);
    }
    GenreStep& step = track_.steps.emplace_back();
    step.seconds = to_seconds(state.time);
    step.is_heard = for_all(true);
    step.is_heard[place(GenreVoice::tagger)] = genres.patch().number > 0;
    for (std::size_t voice = 0; voice < decisions_.size(); ++voice) {
        step.logs[voice] = decisions_[voice].log_chances();
        step.shown[voice] = decisions_[voice].shown();
    }
}

ByVoice<std::optional<ShownDance>> GenreWatch::shown() const {
    ByVoice<std::optional<ShownDance>> shown;
    for (std::size_t voice = 0; voice < tallies_.size(); ++voice) {
        if (is_shown(voice)) {
            shown[voice] = tallies_[voice].result();
        }
    }
    return shown;
}

ByVoice<std::vector<audio::Claim>> GenreWatch::claims() const {
    ByVoice<std::vector<audio::Claim>> claims;
    for (std::size_t voice = 0; voice < claims.size(); ++voice) {
        if (is_shown(voice)) {
            claims[voice] = shown_claims(track_, static_cast<GenreVoice>(voice), truth_);
        }
    }
    return claims;
}

// By all a dance is shown in files without tags, too.
bool GenreWatch::is_shown(std::size_t voice) const noexcept {
    return track_.is_asked[voice] || voice == place(GenreVoice::all);
}

}  // namespace raks::apps
