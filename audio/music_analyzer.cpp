#include "audio/music_analyzer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audio/beat/beat_tracker.hpp"
#include "audio/beat/evidence_fusion.hpp"
#include "audio/beat/paper_beat.hpp"
#include "audio/features/loudness.hpp"
#include "audio/features/mfcc.hpp"
#include "audio/features/mfcc_hops.hpp"
#include "audio/features/onset.hpp"
#include "audio/form/form_tracker.hpp"
#include "audio/genre/genre_recognizer.hpp"
#include "audio/genre/tag_source.hpp"
#include "audio/resample/resampler.hpp"
#include "base/decibels.hpp"
#include "base/simd_clones.hpp"

namespace raks::audio {
namespace {

constexpr SampleRate kRhythmRate(OnsetDetector::kSampleRate);  // 32 kHz
constexpr std::size_t kWindow = OnsetDetector::kWindow;
constexpr std::size_t kChunk = 256;      // input samples worked on at a time
constexpr double kPassBand = 0.9;        // of the source's band that the resampler passes
constexpr float kLoudest = 16.0F;        // samples beyond are clamped: 24 dB over full scale
constexpr float kLowestLevel = -120.0F;  // dBFS of digital silence
// Silence: a level below this (dBFS) for longer than a beat at 50 BPM takes (120 hops).
constexpr float kSilentLevel = -58.0F;
constexpr int kSilentHops = 130;
constexpr std::size_t kLevelsKept = 8;  // hops: mfcc are of the hop kHopsBehind ago
static_assert(kLevelsKept > MfccHops::kHopsBehind);
// Bounds the states that one process() hands out.
constexpr Nanos kLongestGap = std::chrono::seconds(10);
// The beat grid runs on over shorter gaps; after longer ones the beat is sought anew.
constexpr Nanos kLongestBlindGap = std::chrono::milliseconds(200);

// RMS level in dBFS; the small constant keeps silence finite.
float level_of(std::span<const float> samples) noexcept {
    return std::max(kLowestLevel,
                    static_cast<float>(decibels_of_power(mean_square(samples) + 1e-12)));
}

Expected<void> check_rate(SampleRate rate) {
    if (!rate.is_supported()) {
        return fail("sample rate is " + std::to_string(rate.hertz()) +
                    " Hz, must be 8000 to 192000");
    }
    return {};
}

// NaN would stay in every filter for ever, so it must not get in. Returns how many samples were NaN
// or infinite.
RAKS_SIMD_CLONES std::uint32_t clean_samples(const float* input,
                                             std::size_t count,
                                             float* __restrict clean) noexcept {
    std::uint32_t bad = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float sample = input[i];
        const bool is_good = std::abs(sample) <= std::numeric_limits<float>::max();
        const float above = sample < -kLoudest ? -kLoudest : sample;
        const float inside = above > kLoudest ? kLoudest : above;
        bad += is_good ? 0U : 1U;
        clean[i] = is_good ? inside : 0.0F;
    }
    return bad;
}

// The genre fields without a model: one class, none, with probability 1.
void leave_genre_unknown(MusicState& state) noexcept {
    state.genre_log_probability.fill(-20.0F);
    state.genre_log_probability.front() = 0.0F;  // of the one class: none
}

}  // namespace

// The samples at 32 kHz run through a window of 1,024 samples; each hop of 320 makes one state.
struct MusicAnalyzer::State {
    Resampler resampler;
    LoudnessMeter loudness{kRhythmRate};
    OnsetDetector onsets;
    BeatTracker tracker;
    TrackedHop tracked;  // the newest hop, as the tracker got it
    PaperTracker paper;
    BeatMethod beat_method = BeatMethod::pointer;
    NetworkInput network_input;
    std::optional<EvidenceFusion> evidence;  // none: no network
    FormTracker form;
    MfccHops mfcc_hops;
    CepstralMean cepstral_mean;
    bool is_mfcc_wanted = false;  // by a genre model, or by who reads them
    // Somebody hears the sound at 16 kHz: it costs a resampler.
    [[nodiscard]] bool is_low_wanted() const noexcept { return is_mfcc_wanted || tags; }
    std::optional<GenreRecognizer> recognizer;
    std::shared_ptr<TagSource> tags;              // may be null
    TaggerHop tagged;                             // the newest hop, as the tagger got it
    bool is_other_music = true;                   // of the next hop that the tagger gets
    const TaggerWord* tagger_word = nullptr;      // as of the newest hop; null: no tagger
    DanceId hinted = DanceId::none;               // last genre hint that the tracker got
    MfccVector mfcc{};                            // of the newest hop, normalized
    std::array<float, kLevelsKept> level_dbfs{};  // of the last hops, ring

    std::vector<float> clean = std::vector<float>(kChunk);    // input without NaN
    std::vector<float> resampled = std::vector<float>(1536);  // a chunk at 8 kHz becomes 1024
    std::vector<float> window = std::vector<float>(OnsetDetector::kWindow);  // as of OnsetDetector
    std::size_t filled = 0;                                                  // samples in `window`
    HopIndex next_hop = 0;          // number of the next hop
    std::int64_t lost_samples = 0;  // at kRhythmRate, to be jumped over next; even
    int quiet_hops = 0;             // hops in a row below kSilentLevel, at most kSilentHops
    bool has_sound = false;         // in any hop so far
    bool is_discontinuity = false;  // of the next state
    std::uint64_t bad_samples = 0;

    void reset() noexcept RAKS_NONBLOCKING;
    // Also before the first sound: a stream that starts with silence has had no beat.
    [[nodiscard]] bool is_silent() const noexcept {
        return quiet_hops == kSilentHops || !has_sound;
    }
    void take(std::span<const float> rhythm, Sink& sink) noexcept;
    void finish_hop(Sink& sink) noexcept RAKS_NONBLOCKING;
    void track(const Onset& onset, MusicState& state) noexcept;
    void score_mfcc(const MusicState& state) noexcept;
    void hear_tags(MusicState& state) noexcept;
    void recognize(MusicState& state) noexcept;
    void hint_tempo(DanceId genre) noexcept;
    void jump_gap(Sink& sink) noexcept RAKS_NONBLOCKING;
    static void hand_out(const MusicState& state, Sink& sink) noexcept RAKS_NONBLOCKING;
};

void MusicAnalyzer::State::reset() noexcept RAKS_NONBLOCKING {
    resampler.reset();
    loudness.reset();
    onsets.reset();
    tracker.reset();
    paper.reset();
    network_input.reset();
    if (evidence) {
        evidence->reset();
    }
    form.reset();
    mfcc_hops.reset();
    cepstral_mean.reset();
    if (recognizer) {
        recognizer->reset();
    }
    is_other_music = true;
    tagger_word = nullptr;
    hinted = DanceId::none;
    mfcc.fill(0.0F);
    level_dbfs.fill(kLowestLevel);
    // The first hop's window is centred on the first sample: half of it lies before the stream.
    std::fill(window.begin(), window.end(), 0.0F);
    filled = OnsetDetector::kWindow / 2;
    next_hop = 0;
    lost_samples = 0;
    quiet_hops = 0;
    has_sound = false;
    is_discontinuity = false;
    bad_samples = 0;
}

// Fills the window with samples at 32 kHz; the rest of it is kept for the next hop.
void MusicAnalyzer::State::take(std::span<const float> rhythm, Sink& sink) noexcept {
    while (!rhythm.empty()) {
        const std::size_t count = std::min(window.size() - filled, rhythm.size());
        std::copy_n(rhythm.data(), count, window.begin() + static_cast<std::ptrdiff_t>(filled));
        // Only the samples of this hop: nothing must depend on how much came in at once.
        loudness.add(rhythm.first(count));
        if (is_low_wanted()) {
            mfcc_hops.push(rhythm.first(count));
        }
        filled += count;
        rhythm = rhythm.subspan(count);
        if (filled == window.size()) {
            finish_hop(sink);
            std::copy(window.begin() + OnsetDetector::kHop, window.end(), window.begin());
            filled -= OnsetDetector::kHop;
        }
    }
}

// One hop, in the order of dependence: level and silence, onset, beat, form, MFCC, genre.
void MusicAnalyzer::State::finish_hop(Sink& sink) noexcept RAKS_NONBLOCKING {
    MusicState state;
    state.hop = next_hop++;
    state.time = time_of_hop(state.hop);
    state.audio_end =
        state.time + kRhythmRate.time_of(OnsetDetector::kWindow / 2).time_since_epoch();
    // Level of the hop's own samples, in the middle of the window.
    state.level_dbfs = level_of(std::span(window).subspan(
        (OnsetDetector::kWindow - OnsetDetector::kHop) / 2, OnsetDetector::kHop));
    quiet_hops = state.level_dbfs < kSilentLevel ? std::min(quiet_hops + 1, kSilentHops) : 0;
    has_sound = has_sound || quiet_hops == 0;
    state.is_silent = is_silent();
    const Onset onset = onsets.compute(window, state.is_silent);
    state.onset_strength = onset.total;
    state.loudness_lufs = loudness.momentary();
    state.is_discontinuity = is_discontinuity;
    is_discontinuity = false;
    if (beat_method == BeatMethod::paper) {
        paper.advance(window, state);
    } else {
        track(onset, state);
    }
    form.advance(onsets.mel_magnitudes(), state);
    hear_tags(state);
    score_mfcc(state);
    recognize(state);
    hand_out(state, sink);
}

// A real-time thread has a sink that does not block, whoever works through a file any other.
void MusicAnalyzer::State::hand_out(const MusicState& state, Sink& sink) noexcept RAKS_NONBLOCKING {
    RAKS_TRUSTED(sink.on_state(state));
}

// The hop's evidence for the beat tracker; the network takes the same mel magnitudes as the onsets.
void MusicAnalyzer::State::track(const Onset& onset, MusicState& state) noexcept {
    tracked = TrackedHop();
    tracked.hop = state.hop;
    tracked.mel_magnitudes = onsets.mel_magnitudes();
    tracked.audio_end = state.audio_end;
    tracked.onset_strength = onset.strength;
    tracked.quiet_hops = quiet_hops;
    tracked.is_silent = state.is_silent;
    if (evidence) {
        const FusedEvidence now = evidence->next(network_input.next(onsets.mel_magnitudes()),
                                                 std::span(window).first<kWindow>());
        tracked.has_evidence = true;
        tracked.evidence_lag = evidence->lag();
        tracked.evidence = now.fused;
        tracked.own_evidence = now.own;
    }
    tracker.advance(tracked, state);
}

// The tagger takes the samples that the MFCC are about to take.
void MusicAnalyzer::State::hear_tags(MusicState& state) noexcept {
    if (!tags) {
        return;
    }
    tagged.hop = state.hop;
    tagged.is_other_music = is_other_music;
    is_other_music = false;
    tagged.samples.fill(0.0F);
    const std::span<const float> coming = mfcc_hops.coming();
    std::transform(coming.begin(), coming.end(), tagged.samples.begin(), [](float sample) {
        return sample / MfccHops::kScale;
    });
    tags->hear(tagged);
    tagger_word = &tags->word();
    if (tagger_word->patches > 0) {
        const auto strongest = strongest_tags(*tagger_word);
        std::transform(strongest.begin(), strongest.end(), state.tags.begin(), [](std::size_t tag) {
            return kTagNames[tag];
        });
    }
}

// The vector is some hops old, so the level of that time decides whether it is silence.
void MusicAnalyzer::State::score_mfcc(const MusicState& state) noexcept {
    const auto place = [](HopIndex hop) { return static_cast<std::size_t>(hop) % kLevelsKept; };
    level_dbfs[place(state.hop)] = state.level_dbfs;
    if (!is_mfcc_wanted) {
        mfcc_hops.discard();
        return;
    }
    const MfccVector* vector = mfcc_hops.next();
    if (vector == nullptr || state.hop < MfccHops::kHopsBehind) {
        return;
    }
    const bool was_silent = level_dbfs[place(state.hop - MfccHops::kHopsBehind)] < kSilentLevel;
    mfcc = *vector;
    cepstral_mean.normalize(was_silent ? CepstralMean::Frame::silence : CepstralMean::Frame::music,
                            mfcc);
}

// Genre from the newest vector and magnitudes; the dance's tempi go to the tracker.
void MusicAnalyzer::State::recognize(MusicState& state) noexcept {
    if (recognizer) {
        recognizer->advance(mfcc, onsets.mel_magnitudes(), tagger_word, state);
    } else {
        leave_genre_unknown(state);
    }
    hint_tempo(state.genre);
}

// Makes the tempi of the recognised dance likelier, from the next hop on. A command that found no
// room is tried again.
void MusicAnalyzer::State::hint_tempo(DanceId genre) noexcept {
    const AnalyzerCommand hint{
        AnalyzerCommand::Kind::hint_genre, {}, static_cast<double>(index_of(genre))};
    if (genre != hinted && tracker.command(hint)) {
        hinted = genre;
    }
}

// Moves stream time over lost audio; the hops inside it come out with the grid running on.
void MusicAnalyzer::State::jump_gap(Sink& sink) noexcept RAKS_NONBLOCKING {
    if (lost_samples > kRhythmRate.index_at(StreamTime(kLongestBlindGap))) {
        tracker.jump();
        paper.jump();
        if (evidence) {
            evidence->jump();
        }
    }
    // Fills the window with silence: in the gap only the number of samples matters.
    std::int64_t left = lost_samples;
    lost_samples = 0;
    while (left > 0) {
        const auto count =
            std::min<std::int64_t>(static_cast<std::int64_t>(window.size() - filled), left);
        std::fill_n(window.begin() + static_cast<std::ptrdiff_t>(filled), count, 0.0F);
        filled += static_cast<std::size_t>(count);
        // 32 kHz to 16 kHz; the number of lost samples is even, so both clocks stay together.
        if (is_low_wanted()) {
            mfcc_hops.push_lost(static_cast<int>((left + 1) / 2 - (left - count + 1) / 2));
        }
        left -= count;
        if (filled == window.size()) {
            MusicState state;
            state.hop = next_hop++;
            state.time = time_of_hop(state.hop);
            state.audio_end = state.time;
            state.is_silent = is_silent();
            if (recognizer) {
                recognizer->advance_blind(state);
            } else {
                leave_genre_unknown(state);
            }
            if (beat_method == BeatMethod::paper) {
                paper.advance_blind(state);
            } else {
                tracker.advance_blind(state.hop, state);
            }
            form.advance_lost(state);
            mfcc_hops.discard();
            level_dbfs.fill(kLowestLevel);
            hand_out(state, sink);
            std::copy(window.begin() + OnsetDetector::kHop, window.end(), window.begin());
            filled -= OnsetDetector::kHop;
        }
    }
}

MusicAnalyzer::MusicAnalyzer() : state_(std::make_unique<State>()) {}
MusicAnalyzer::~MusicAnalyzer() = default;
MusicAnalyzer::MusicAnalyzer(MusicAnalyzer&&) noexcept = default;
MusicAnalyzer& MusicAnalyzer::operator=(MusicAnalyzer&&) noexcept = default;

Expected<void> MusicAnalyzer::prepare(const AnalyzerConfig& config) {
    if (auto checked = check_rate(config.sample_rate); !checked) {
        return checked;
    }
    if (auto prepared = state_->resampler.prepare(config.sample_rate, kRhythmRate); !prepared) {
        return prepared;
    }
    // A genre model defines the MFCC that it was trained on.
    GenreFeatures features;
    features.cepstral_mean = config.cepstral_mean.value_or(CepstralMeanConfig());
    state_->is_mfcc_wanted = config.genre_model || config.cepstral_mean;
    state_->tags = config.tags;
    state_->recognizer.reset();
    if (config.genre_model) {
        features = config.genre_model->features;
        auto recognizer = GenreRecognizer::create(config.genre_model,
                                                  {.dances = config.dances,
                                                   .window_seconds = config.genre_window,
                                                   .prior = config.genre_prior});
        if (!recognizer) {
            return fail(recognizer.error());
        }
        state_->recognizer.emplace(std::move(*recognizer));
    }
    if (auto prepared = state_->mfcc_hops.prepare(kRhythmRate, features.mfcc); !prepared) {
        return prepared;
    }
    state_->cepstral_mean = CepstralMean(features.cepstral_mean);
    // Bands above the source's own limit hold nothing.
    state_->onsets.limit_to(kPassBand * 0.5 * config.sample_rate.hertz());
    state_->beat_method = config.beat_method;
    state_->evidence.reset();
    state_->tracker.expect_dances(config.dances);
    state_->tracker.expect_told(config.told_bpm);
    state_->tracker.set_network(config.beat_network.get());
    if (config.beat_network) {
        state_->evidence.emplace(config.beat_network);
    }
    state_->reset();
    return {};
}

// Both resamplers start anew, without the samples that were inside them, of which each had another
// number: the clocks of 32 and 16 kHz are brought together again, and then to `taken`.
Expected<void> MusicAnalyzer::change_rate(SampleRate rate, StreamTime taken) {
    if (auto checked = check_rate(rate); !checked) {
        return checked;
    }
    State& state = *state_;
    if (auto prepared = state.resampler.prepare(rate, kRhythmRate); !prepared) {
        return prepared;
    }
    if (auto prepared = state.mfcc_hops.change_rate(kRhythmRate); !prepared) {
        return prepared;
    }
    state.onsets.limit_to(kPassBand * 0.5 * rate.hertz());
    const std::int64_t made = state.next_hop * static_cast<std::int64_t>(OnsetDetector::kHop) +
                              static_cast<std::int64_t>(state.filled) -
                              static_cast<std::int64_t>(OnsetDetector::kWindow / 2);
    const std::int64_t made_16k = state.next_hop * static_cast<std::int64_t>(MfccStream::kHop) +
                                  static_cast<std::int64_t>(state.mfcc_hops.waiting());
    if (state.is_low_wanted()) {
        state.mfcc_hops.push_lost(static_cast<int>(made / 2 - made_16k));
    }
    // To an even place, see jump_gap().
    const std::int64_t place = (kRhythmRate.index_at(taken) + 1) / 2 * 2;
    state.lost_samples = std::max<std::int64_t>(0, place - made);
    state.is_discontinuity = true;
    return {};
}

void MusicAnalyzer::process(std::span<const float> mono, Sink& sink) noexcept RAKS_NONBLOCKING {
    // Denormals in decaying filters would cost many times the ordinary time.
    const FlushToZeroScope flush_to_zero;
    State& state = *state_;
    if (state.lost_samples > 0) {
        state.jump_gap(sink);
    }
    // In chunks, as the work space is fixed; the partition does not change any result.
    while (!mono.empty()) {
        const std::size_t count = std::min(mono.size(), kChunk);
        state.bad_samples += clean_samples(mono.data(), count, state.clean.data());
        std::span<const float> chunk = std::span(state.clean).first(count);
        mono = mono.subspan(count);
        while (!chunk.empty()) {
            const auto progress = state.resampler.process(chunk, state.resampled);
            chunk = chunk.subspan(progress.taken);
            state.take(std::span(state.resampled).first(progress.made), sink);
        }
    }
}

void MusicAnalyzer::command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING {
    state_->tracker.command(command);
}

void MusicAnalyzer::skip(Nanos lost) noexcept RAKS_NONBLOCKING {
    State& state = *state_;
    state.is_discontinuity = true;
    if (lost.count() <= 0) {
        state.is_other_music = true;
        state.tracker.jump();
        state.paper.jump();
        if (state.evidence) {
            state.evidence->jump();
        }
        return;
    }
    // Rounded up to an even number of samples, see jump_gap().
    const std::int64_t samples = kRhythmRate.index_at(StreamTime(std::min(lost, kLongestGap)));
    state.lost_samples += (samples + 1) / 2 * 2;
}

void MusicAnalyzer::tell(const ToldSong& song) noexcept RAKS_NONBLOCKING {
    state_->tracker.expect_told(song.bpm);
    if (state_->recognizer) {
        state_->recognizer->expect(song.genre_prior);
    }
}

void MusicAnalyzer::begin_song() noexcept RAKS_NONBLOCKING {
    State& state = *state_;
    state.is_discontinuity = state.is_other_music = true;
    state.tracker.begin_song();
    state.paper.jump();
    if (state.evidence) {
        state.evidence->jump();
    }
    state.form.reset();
    state.cepstral_mean.reset();
    if (state.recognizer) {
        state.recognizer->reset();
    }
    state.hinted = DanceId::none;
    state.has_sound = false;
}

void MusicAnalyzer::announce_pause() noexcept RAKS_NONBLOCKING { state_->form.announce_pause(); }

void MusicAnalyzer::reset() noexcept RAKS_NONBLOCKING { state_->reset(); }

// The resampler's delay, and half a window after the hop's time.
Nanos MusicAnalyzer::delay() const noexcept {
    return state_->resampler.delay() +
           kRhythmRate.time_of(OnsetDetector::kWindow / 2).time_since_epoch();
}

const MfccVector& MusicAnalyzer::mfcc() const noexcept { return state_->mfcc; }

std::span<const float> MusicAnalyzer::mel_magnitudes() const noexcept {
    return state_->onsets.mel_magnitudes();
}

const TrackedHop& MusicAnalyzer::tracked() const noexcept { return state_->tracked; }

const BeatTracker& MusicAnalyzer::beats() const noexcept { return state_->tracker; }

const HopSound& MusicAnalyzer::sound() const noexcept { return state_->form.sound(); }

const GenreRecognizer* MusicAnalyzer::genres() const noexcept {
    return state_->recognizer ? &*state_->recognizer : nullptr;
}

std::uint64_t MusicAnalyzer::bad_samples() const noexcept { return state_->bad_samples; }

}  // namespace raks::audio
