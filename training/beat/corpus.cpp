#include "training/beat/corpus.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <span>
#include <thread>

#include "audio/features/onset.hpp"
#include "audio/features/rhythm_frames.hpp"
#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music/instruments/soundfont_band.hpp"
#include "audio/music/instruments/studio.hpp"
#include "audio/music/score/arrangement.hpp"
#include "audio/music/score/band.hpp"
#include "audio/music/score/keyboard_scores.hpp"
#include "audio/music/score/metre_variations.hpp"
#include "audio/music/score/midi_scores.hpp"
#include "audio/music/score/other_music.hpp"

namespace raks::audio {
namespace {

constexpr int kMostBeats = 112;           // 22 s at 217 BPM and some to choose from
constexpr int kMostEighths = 140;         // 22 s at 330 eighths a minute, and some
constexpr double kShortestSeconds = 8.0;  // a shorter piece is drawn again
// One excerpt in twenty has no beat. Numbers decide it, so the share is exact.
constexpr int kNonMusicEvery = 20;
constexpr int kNonMusic = 12;

/// A piece before it is rendered by soundfonts.
struct Piece {
    std::string family;
    std::string style;
    Performance performance;
    std::vector<float> samples;  // set by the built-in generator, which renders its own music
    bool is_electronic = false;  // by drum machines and synthesizers
};

/// Checks that there is a rhythm to draw. Errors: there is none.
Expected<void> check_styles(const CorpusPlan& plan) {
    const auto styles = plan.styles->rhythms_for_beats();
    if (styles.empty()) {
        return fail("the styles of music have no rhythm for the beat tracker's training");
    }
    const bool has_machines = std::any_of(
        styles.begin(), styles.end(), [](const auto* style) { return style->is_by_machines; });
    if (plan.with_machines && !has_machines) {
        return fail("the styles of music have no rhythm that machines play (machines = true)");
    }
    return {};
}

/// Widens the tempo range of some pieces beyond that at which the style is danced; BPM.
void widen_tempi(double chance, Score& score, Dice& dice) {
    if (dice.chance(chance)) {
        score.lowest_bpm = std::max(55.0, 0.75 * score.lowest_bpm);
        score.highest_bpm = std::min(217.0, 1.3 * score.highest_bpm);
    }
}

/// Mel magnitudes as the analyzer computes them, hops x 36; empty for a rate that is not supported.
std::vector<float> mel_magnitudes_of(std::span<const float> samples, int rate) {
    // The same rate, window and hop as the detector's, or training would not match run time.
    static_assert(RhythmFrames::kSampleRate == OnsetDetector::kSampleRate);
    static_assert(RhythmFrames::kWindow == OnsetDetector::kWindow);
    static_assert(RhythmFrames::kHop == OnsetDetector::kHop);
    RhythmFrames frames;
    if (!frames.prepare(SampleRate(rate))) {
        return {};
    }
    OnsetDetector detector;
    std::vector<float> mel;
    frames.process(samples, [&](std::span<const float> window) {
        detector.compute(window, false);
        const auto magnitudes = detector.mel_magnitudes();
        mel.insert(mel.end(), magnitudes.begin(), magnitudes.end());
    });
    return mel;
}

// Draws and writes pieces of all kinds.
class PieceMaker {
 public:
    PieceMaker(std::vector<MidiStretch> pack, const CorpusPlan& plan)
        : seconds_(plan.seconds),
          with_machines_(plan.with_machines),
          with_metres_(plan.with_metres),
          book_(plan.styles),
          styles_(plan.styles->rhythms_for_beats()) {
        // Sorts the MIDI pack by set; the drum grooves keep their styles beside them.
        for (MidiStretch& stretch : pack) {
            auto& set = stretch.set == "groove"     ? (stretch.is_fill ? fills_ : groove_)
                        : stretch.set == "freedoom" ? freedoom_
                                                    : lieder_;
            if (stretch.set == "groove" && !stretch.is_fill) {
                groove_styles_.push_back(stretch.style);
            }
            set.push_back(std::move(stretch.score));
        }
        std::copy_if(styles_.begin(),
                     styles_.end(),
                     std::back_inserter(electronic_),
                     [](const RhythmStyle* style) { return style->is_by_machines; });
    }

    /// Sound without a beat: notes without a pulse, or noise of people.
    [[nodiscard]] Piece make_non_music(Dice& dice) const {
        if (dice.chance(0.35)) {
            return {"none", "no pulse", notes_without_pulse(seconds_, dice), {}};
        }
        return {"none", "people", {}, noise_of_people(kPerformanceRate, seconds_, dice)};
    }

    [[nodiscard]] Piece make(Dice& dice) const {
        if (with_metres_ && dice.chance(0.07)) {
            return {"additive",
                    "additive",
                    perform(additive_score(kMostEighths, dice), seconds_, dice),
                    {}};
        }
        // Shares of the kinds, cumulative. A set that the pack lacks passes its share to the next
        // kind.
        const double kind = dice.uniform();
        if (kind < 0.44) {
            // With machines, 0.35 to 0.44 goes to electronic styles.
            const bool is_electronic = with_machines_ && kind >= 0.35;
            return from_style(draw_style(is_electronic ? electronic_ : styles_, dice), dice);
        }
        if (kind < 0.51) {
            return from_free(dice);
        }
        if (kind < 0.65 && !groove_.empty()) {
            return from_groove(dice);
        }
        if (kind < 0.74 && !freedoom_.empty()) {
            return {"game", "game", perform(dice.pick<Score>(freedoom_), seconds_, dice), {}};
        }
        if (kind < 0.82 && !lieder_.empty()) {
            return from_lied(dice);
        }
        if (kind < 0.91) {
            return {
                "piano", "piano", perform(keyboard_score(kMostBeats, dice), seconds_, dice), {}};
        }
        return from_own_generator(dice);
    }

 private:
    using Styles = std::vector<const RhythmStyle*>;
    // Draws by the styles' weights.
    static const RhythmStyle& draw_style(const Styles& styles, Dice& dice) {
        const double total = std::accumulate(
            styles.begin(), styles.end(), 0.0, [](double sum, const RhythmStyle* style) {
                return sum + style->weight;
            });
        double left = dice.uniform(0.0, total);
        for (const RhythmStyle* style : styles) {
            left -= style->weight;
            if (left < 0.0) {
                return *style;
            }
        }
        // Rounding may leave nothing: any style will do.
        return *styles.front();
    }
    [[nodiscard]] Piece from_style(const RhythmStyle& style, Dice& dice) const {
        Score score = drum_score(style, kMostBeats, dice);
        // The other pieces are drums alone.
        if (dice.chance(0.65)) {
            add_band(style.bass, style.comping, score, dice);
        }
        if (with_machines_) {
            widen_tempi(style.is_by_machines ? 0.5 : 0.2, score, dice);
        }
        return played(
            style.family, style.name, std::move(score), style.is_by_machines ? 0.75 : 0.0, dice);
    }
    /// Performs a score. `machines`: the chance that machines play it, if the plan has machines.
    [[nodiscard]] Piece played(
        std::string family, std::string style, Score score, double machines, Dice& dice) const {
        const bool is_electronic = with_machines_ && dice.chance(machines);
        if (is_electronic) {
            give_to_machines(score, dice);
        }
        if (with_metres_) {
            family += vary_metre(score, dice);
        }
        return {
            std::move(family), std::move(style), perform(score, seconds_, dice), {}, is_electronic};
    }
    /// Gives half of the pieces another metre or feel; returns what is added to their family's
    /// name.
    static std::string vary_metre(Score& score, Dice& dice) {
        struct Variation {
            double until;  // cumulative share of the pieces
            const char* name;
            void (*vary)(Score&, Dice&);
        };
        constexpr std::array kVariations = {Variation{0.25, " compound", make_compound},
                                            Variation{0.31, " triplet hats", add_triplet_hats},
                                            Variation{0.36, " swung", swing_sixteenths},
                                            Variation{0.43, " off-beat", press_off_beats},
                                            Variation{0.50, " slow", slow_down},
                                            Variation{0.55, " strings", give_to_strings},
                                            Variation{0.58, " claps", add_claps}};
        const double drawn = dice.uniform();
        for (const Variation& variation : kVariations) {
            if (drawn < variation.until) {
                variation.vary(score, dice);
                return variation.name;
            }
        }
        return "";
    }
    [[nodiscard]] Piece from_free(Dice& dice) const {
        Score score = free_drum_score(kMostBeats, dice);
        if (dice.chance(0.6)) {
            add_band({}, {}, score, dice);
        }
        return played("free", "free", std::move(score), 0.3, dice);
    }
    [[nodiscard]] Piece from_groove(Dice& dice) const {
        // Picked from the span itself, because the index is needed for the style; the draw is the
        // same as a pick of a score.
        const auto chosen = static_cast<std::size_t>(
            &dice.pick<Score>(std::span<const Score>(groove_)) - groove_.data());
        Score score = groove_[chosen];
        const int beats = static_cast<int>(score.bar_position.size());
        const int bar = *std::max_element(score.bar_position.begin(), score.bar_position.end());
        // Cut at a bar line, to whole bars.
        if (beats > kMostBeats) {
            const int last_bar = (beats - kMostBeats) / bar;
            score = cut_beats(score, bar * dice.whole(0, last_bar), kMostBeats / bar * bar);
        }
        if (dice.chance(0.7)) {
            add_band({}, {}, score, dice);
        }
        std::string family = "groove";
        if (with_metres_) {
            family += vary_metre(score, dice);
        }
        return {std::move(family),
                "groove " + groove_styles_[chosen],
                perform(score, seconds_, dice),
                {}};
    }
    [[nodiscard]] Piece from_lied(Dice& dice) const {
        Score score = dice.pick<Score>(lieder_);
        const bool is_piano = dice.chance(0.7);
        // Dynamics of a lied: accents on the beats of a drawn strength, and noise.
        const double accent = dice.uniform(0.0, 14.0);
        const double loudness = dice.uniform(55.0, 85.0);
        for (ScoreNote& note : score.notes) {
            const double off = std::abs(note.beat - std::round(note.beat));
            note.velocity = loudness + (off < 0.05 ? accent : 0.0) + dice.normal(8.0);
            note.program = is_piano ? 0 : note.program;
        }
        return {"piano", "lied", perform(score, seconds_, dice), {}};
    }
    [[nodiscard]] Piece from_own_generator(Dice& dice) const {
        MusicPlan plan;
        // Drums stand twice: they are drawn twice as often.
        plan.style = dice.pick({Style::clicks,
                                Style::drums,
                                Style::drums,
                                Style::montuno,
                                Style::maqsum,
                                Style::four_on_the_floor});
        // Tempo ranges in BPM, by style; the tempo drifts by up to 18 % over the piece.
        const double bpm = plan.style == Style::montuno             ? dice.uniform(150.0, 217.0)
                           : plan.style == Style::maqsum            ? dice.uniform(80.0, 150.0)
                           : plan.style == Style::four_on_the_floor ? dice.uniform(110.0, 135.0)
                                                                    : dice.log_uniform(57.0, 205.0);
        plan.tempo = {{0.0, bpm}, {seconds_, bpm * dice.uniform(0.85, 1.18)}};
        plan.seconds = seconds_;
        plan.channels = 1;
        plan.rate = SampleRate(kPerformanceRate);
        plan.seed = static_cast<std::uint64_t>(dice.whole(1, 1'000'000));
        plan.first_beat_seconds = dice.uniform(0.0, 0.5);
        Piece piece{"own", book_->own_name(name_of(plan.style)), {}, {}};
        if (auto music = generate(plan)) {
            piece.samples = std::move(music->samples);
            for (const ReferenceBeat& beat : music->beats) {
                // Nanoseconds to seconds.
                piece.performance.beats.push_back(
                    {static_cast<double>(beat.time.time_since_epoch().count()) * 1e-9,
                     beat.bar_position});
            }
        }
        return piece;
    }

    double seconds_;
    bool with_machines_;
    bool with_metres_;
    const StyleBook* book_;
    Styles styles_;
    Styles electronic_;
    std::vector<Score> groove_;
    std::vector<std::string> groove_styles_;  // of each
    std::vector<Score> fills_;
    std::vector<Score> freedoom_;
    std::vector<Score> lieder_;
};

/// Makes piece `number` from its own stream of draws. Errors: a drawn soundfont cannot be loaded.
Expected<CorpusPiece> make_piece(const CorpusPlan& plan, const PieceMaker& maker, int number) {
    Dice dice(plan.seed, static_cast<std::uint64_t>(number));
    Piece piece =
        number % kNonMusicEvery == kNonMusic ? maker.make_non_music(dice) : maker.make(dice);
    // Draws again while the performance is too short; rendered pieces have samples already.
    for (int tries = 0;
         piece.samples.empty() && piece.performance.seconds < kShortestSeconds && tries < 20;
         ++tries) {
        piece = maker.make(dice);
    }
    if (piece.samples.empty()) {
        const PlayerRoom room = dice.chance(0.5)
                                    ? PlayerRoom{dice.uniform(0.1, 0.9), dice.uniform(0.1, 0.7)}
                                    : PlayerRoom{};
        auto samples =
            play_with(draw_soundfonts(plan.soundfonts, dice), piece.performance, room, dice);
        if (!samples) {
            return fail(samples.error());
        }
        piece.samples = std::move(*samples);
    }
    // A mix as of a studio for electronic music, before the damage that any recording may have.
    if (piece.is_electronic) {
        produce(piece.performance, kPerformanceRate, piece.samples, dice);
    }
    augment_sound(kPerformanceRate, piece.samples, dice);
    return CorpusPiece{std::move(piece.family),
                       std::move(piece.style),
                       std::move(piece.samples),
                       std::move(piece.performance.beats)};
}

}  // namespace

Expected<void> make_pieces(const CorpusPlan& plan,
                           const std::function<Expected<void>(int, CorpusPiece)>& take) {
    if (auto enough = check_styles(plan); !enough) {
        return enough;
    }
    auto pack = read_midi_pack(plan.pack);
    if (!pack) {
        return fail(pack.error());
    }
    const PieceMaker maker(std::move(*pack), plan);
    // One result a thread: its first error ends that thread. Pieces are dealt out by a counter.
    std::vector<Expected<void>> done(static_cast<std::size_t>(plan.threads));
    std::atomic<int> next{0};
    std::vector<std::jthread> threads;
    threads.reserve(done.size());
    for (Expected<void>& mine : done) {
        threads.emplace_back([&next, &plan, &maker, &take, &mine] {
            for (int number = next++; number < plan.excerpts && mine; number = next++) {
                auto piece = make_piece(plan, maker, number);
                mine = piece ? take(number, std::move(*piece)) : fail(piece.error());
            }
        });
    }
    // Joins all threads before their results are read.
    threads.clear();
    for (Expected<void>& thread : done) {
        if (!thread) {
            return thread;
        }
    }
    return {};
}

Expected<std::vector<TrainingExcerpt>> make_corpus(const CorpusPlan& plan) {
    std::vector<TrainingExcerpt> corpus(static_cast<std::size_t>(plan.excerpts));
    const auto add = [&corpus](int number, CorpusPiece piece) -> Expected<void> {
        corpus[static_cast<std::size_t>(number)] = {
            std::move(piece.family),
            std::move(piece.style),
            mel_magnitudes_of(piece.samples, kPerformanceRate),
            std::move(piece.beats)};
        return {};
    };
    if (auto made = make_pieces(plan, add); !made) {
        return fail(made.error());
    }
    return corpus;
}

}  // namespace raks::audio
