#include "audio/genre/genre_recognizer.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "audio/features/mfcc_hops.hpp"

namespace raks::audio {
namespace {

constexpr int kBlock = 10;  // hops: the HMMs' scores change every 100 ms
constexpr int kBlocksASegment = BarPatterns::kSegmentHops / kBlock;
constexpr float kQuiet = -58.0F;   // dBFS, of one hop: below is silence
constexpr HopIndex kFirstHop = 6;  // no MFCC vector is complete before
// ln probability of classes that the model lacks, and the lowest one that is published.
constexpr float kImprobable = -20.0F;
static_assert(kBlock / kHopsPerSecond == DanceDecision::kStep);

}  // namespace

// The states as one mixture of equal weights: ln of the mean of their densities.
double frame_density(std::span<const double> log_emissions) noexcept {
    return models::log_sum(log_emissions) - std::log(static_cast<double>(log_emissions.size()));
}

bool is_genre_evidence(const MusicState& state) noexcept {
    return state.hop >= kFirstHop && state.level_dbfs > kQuiet;
}

Expected<GenreRecognizer> GenreRecognizer::create(std::shared_ptr<const GenreModel> model,
                                                  const GenreSettings& settings) {
    if (auto valid = validate(*model); !valid) {
        return fail(valid.error());
    }
    if (!(settings.window_seconds >= 0.5 && settings.window_seconds <= 10.0)) {
        return fail("genre window is " + std::to_string(settings.window_seconds) +
                    " s, must be 0.5 to 10");
    }
    // Without the similarity model this evidence would be 0 for all classes.
    if (settings.evidence == GenreEvidence::mfcc_similarity && !model->similarity) {
        return fail("the genre model has no inter-genre similarity; train it with --similarity");
    }
    return GenreRecognizer(std::move(model), settings);
}

GenreRecognizer::GenreRecognizer(std::shared_ptr<const GenreModel> model,
                                 const GenreSettings& settings)
    : model_(std::move(model)), settings_(settings) {
    // Without a list of dances every class is none; genre_class still tells them apart.
    dances_.fill(DanceId::none);
    for (std::size_t c = 0; settings_.dances && c < model_->genres.size(); ++c) {
        dances_[c] = settings_.dances->id_of(model_->genres[c]);
        const DanceInfo* const dance = settings_.dances->find(dances_[c]);
        bars_[c] = dance != nullptr ? dance->beats_per_bar : 0;
    }
    song_ = SongJudgement(model_->classes());
    decision_ = decision(settings_.prior);
    // The window length nearest to the wanted one.
    const auto nearest = [&](int a, int b) {
        const double wanted = settings_.window_seconds / kSegmentSeconds;
        return std::abs(a - wanted) < std::abs(b - wanted);
    };
    window_ = static_cast<std::size_t>(
        std::min_element(kGenreWindows.begin(), kGenreWindows.end(), nearest) -
        kGenreWindows.begin());
    const auto add = [&](const models::GaussianHmm& hmm) {
        // Valid: the whole model was validated.
        scorers_.push_back(*models::HmmScorer::create(hmm));
        emissions_.emplace_back(scorers_.back().states());
        sliding_.emplace_back(
            scorers_.back(),
            models::SlidingScore::Plan{.block = kBlock,
                                       .blocks = BarPatterns::kSegments * kBlocksASegment});
    };
    std::for_each(model_->mfcc.begin(), model_->mfcc.end(), add);
    add(model_->background);
    // Used only where asked for: the similarity model costs emissions in every hop.
    if (model_->similarity && settings_.evidence == GenreEvidence::mfcc_similarity) {
        similarity_ = *models::HmmScorer::create(*model_->similarity);
        similarity_work_.resize(similarity_->states());
    }
    selected_.resize(static_cast<std::size_t>(model_->features.dimension()));
    reset();
}

void GenreRecognizer::reset() noexcept RAKS_NONBLOCKING {
    for (models::SlidingScore& sliding : sliding_) {
        sliding.reset();
    }
    noise_.reset();
    patterns_.reset();
    network_scorer_.reset();
    next_pattern_ = kGenreWindows.size();
    judged_ = {};
    counted_hops_ = 0;
    song_.reset();
    quiet_hops_ = 0;
    moment_ = {};
    decision_.reset();
}

void GenreRecognizer::advance(const MfccVector& mfcc,
                              std::span<const float, BarPatterns::kMelBands> mel,
                              const TaggerWord* word,
                              MusicState& state) noexcept RAKS_NONBLOCKING {
    constexpr auto kEndOfSong = static_cast<HopIndex>(SongJudgement::kEndOfSong * kHopsPerSecond);
    if (!is_genre_evidence(state)) {
        if (++quiet_hops_ == kEndOfSong) {
            song_.reset();
        }
    } else {
        quiet_hops_ = 0;
        score_frame(mfcc);
        const NoiseFloor::Bands& music = noise_.subtract(mel);
        network_scorer_.next(model_->networks, music);
        if (patterns_.add(music, state.grid, state.time)) {
            next_pattern_ = 0;
        }
        score_patterns();
        ++counted_hops_;
        if (counted_hops_ % kBlock ==
            kBlock / 2) {  // not the hop that closes a block: work is spread
            decide(word, state);
        }
    }
    publish(state);
}

void GenreRecognizer::advance_blind(MusicState& state) const noexcept RAKS_NONBLOCKING {
    publish(state);
}

// One frame for the HMMs: emissions of all classes into their sliding scores.
void GenreRecognizer::score_frame(const MfccVector& mfcc) noexcept {
    model_->features.select(mfcc, selected_);
    double best = models::kImpossible;
    for (std::size_t c = 0; c < scorers_.size(); ++c) {
        scorers_[c].log_emissions(selected_, emissions_[c]);
        if (similarity_ && c < model_->genres.size()) {
            best = std::max(best, frame_density(emissions_[c]));
        }
    }
    // Inter-genre similarity: a frame that the shared model explains best is made to count nothing
    // (emissions of 0), for all classes alike.
    if (similarity_) {
        similarity_->log_emissions(selected_, similarity_work_);
        if (frame_density(similarity_work_) > best) {
            for (std::vector<double>& emissions : emissions_) {
                std::fill(emissions.begin(), emissions.end(), 0.0);
            }
        }
    }
    for (std::size_t c = 0; c < sliding_.size(); ++c) {
        sliding_[c].process(emissions_[c]);
    }
}

// After each segment, one window length in each hop: the work is spread over the hops.
void GenreRecognizer::score_patterns() noexcept {
    if (next_pattern_ == kGenreWindows.size()) {
        return;
    }
    const std::size_t window = next_pattern_++;
    if (kGenreWindows[window] > patterns_.segments()) {
        return;
    }
    std::array<float, BarPatterns::kFeatures> features{};
    std::array<float, PatternNetwork::kInputs> inputs{};
    patterns_.features(kGenreWindows[window], features);
    Patterns& judged = judged_[window];
    const std::size_t classes = model_->classes();
    model_->rhythm.standardize(features, kGenreWindows[window], inputs);
    model_->rhythm.log_chances(inputs, std::span(judged.rhythm).first(classes));
    model_->sound.standardize(features, kGenreWindows[window], inputs);
    model_->sound.log_chances(inputs, std::span(judged.sound).first(classes));
    judged.is_scored = true;
}

GenreRecognizer::Judgement GenreRecognizer::judge(std::size_t window) const noexcept
    RAKS_NONBLOCKING {
    Judgement judgement;
    const int segments = kGenreWindows[window];
    const int blocks = segments * kBlocksASegment;
    // All HMMs have taken the same frames: the first one stands for all.
    const bool has_mfcc = sliding_.front().blocks_scored() >= blocks;
    judgement.is_full = judged_[window].is_scored && has_mfcc && network_scorer_.blocks() >= blocks;
    if (!judgement.is_full) {
        return judgement;
    }
    const std::size_t classes = model_->classes();
    GenreScores scores;
    for (std::size_t c = 0; c < classes; ++c) {
        // With inter-genre similarity, score_frame() passed the shared frames on as 0.
        scores.mfcc[c] = static_cast<float>(sliding_[c].score(blocks) / (blocks * kBlock));
    }
    scores.similarity = scores.mfcc;
    scores.rhythm = judged_[window].rhythm;
    scores.sound = judged_[window].sound;
    network_scorer_.log_chances(blocks, std::span(scores.network).first(classes));
    judgement.log_chances = fuse(scores, model_->fusion[window], settings_.evidence, classes);
    return judgement;
}

DanceDecision GenreRecognizer::decision(const GenreLogProbabilities& prior) const noexcept {
    return {model_->classes(), bars_, prior, settings_.rules};
}

GenreScores::Values GenreRecognizer::heard(SongJudgement::Asked asked,
                                           const BeatGrid& grid) const noexcept RAKS_NONBLOCKING {
    constexpr float kSureBar = 0.6F;  // confidence of the beat grid
    return song_.log_chances(asked, grid.confidence > kSureBar ? grid.beats_per_bar : 0, bars_);
}

// The mean over the song; what a single kind of evidence says stays as it is.
GenreScores::Values GenreRecognizer::judge_song(const TaggerWord* word,
                                                const BeatGrid& grid) noexcept {
    if (settings_.evidence != GenreEvidence::fused) {
        return moment_.logs;
    }
    song_.add(moment_.logs, moment_.sureness, DanceDecision::kStep);
    const bool has_tagger = word != nullptr && model_->tagger;
    if (has_tagger) {
        song_.add(*word, *model_->tagger);
    }
    using Asked = SongJudgement::Asked;
    return heard(has_tagger ? Asked::both : Asked::own_parts, grid);
}

// One decision every kBlock hops.
void GenreRecognizer::decide(const TaggerWord* word, const MusicState& state) noexcept {
    // Until the wanted window is full, the longest full one is used.
    std::size_t window = window_ + 1;
    Judgement judgement;
    while (window > 0 && !judgement.is_full) {
        judgement = judge(--window);
    }
    if (!judgement.is_full) {
        return;
    }
    const auto segments = [](std::size_t of) { return static_cast<double>(kGenreWindows[of]); };
    moment_ = {.number = moment_.number + 1,
               .heard_hops = counted_hops_,
               .seconds = segments(window) * kSegmentSeconds,
               .sureness = segments(window) / segments(window_),
               .logs = judgement.log_chances};
    decision_.advance(judge_song(word, state.grid), counted_hops_, state.grid);
}

// Writes the genre fields of every hop, with or without evidence in it.
void GenreRecognizer::publish(MusicState& state) const noexcept {
    state.genre_log_probability.fill(kImprobable);
    for (std::size_t c = 0; c < model_->classes(); ++c) {
        state.genre_log_probability[c] = std::max(kImprobable, decision_.log_chances()[c]);
    }
    const std::size_t shown = decision_.shown();
    state.genre_class = static_cast<std::uint8_t>(shown);
    state.genre = dances_[shown];
    state.is_genre_told = decision_.is_told();
}

}  // namespace raks::audio
