#include "training/genre/written_corpus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "audio/music/damage/sound_augmentation.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "audio/music/instruments/soundfont_band.hpp"
#include "audio/music/instruments/synthesizers.hpp"
#include "audio/music/score/arrangement.hpp"
#include "audio/music/score/other_music.hpp"
#include "audio/music/score/score.hpp"
#include "base/music_state.hpp"
#include "base/parallel.hpp"
#include "training/beat/corpus.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr double kShortestPiece = 8.0;  // seconds; a shorter one is drawn again

// Does the plan's choice of families include this rhythm?
bool is_among(const DanceLabel& label, WrittenCorpusPlan::Families families) {
    const bool is_held_out = label.use == DanceLabel::Use::held_out;
    return families == WrittenCorpusPlan::Families::all ||
           (families == WrittenCorpusPlan::Families::held_out) == is_held_out;
}

// Rhythms for the dance within the plan's families; `dance` empty: for none of the dances.
std::vector<const RhythmStyle*> styles_of(const WrittenCorpusPlan& plan, const std::string& dance) {
    std::vector<const RhythmStyle*> chosen = plan.styles->rhythms_for(dance);
    std::erase_if(chosen, [&plan](const RhythmStyle* style) {
        return !is_among(*style->label, plan.families);
    });
    return chosen;
}

/// The dances that the built-in generator has music for, in the order of the palettes.
std::vector<std::string> dances_of_generator(const StyleBook& styles) {
    std::vector<std::string> dances;
    for (const BandPalette& palette : styles.palettes) {
        if (palette.own && !palette.dance.empty()) {
            dances.push_back(palette.dance);
        }
    }
    return dances;
}

/// Checks that there is something to draw for every dance of the plan. Errors: there is not.
Expected<void> check_styles(const WrittenCorpusPlan& plan) {
    using Music = WrittenCorpusPlan::Music;
    if (plan.styles->rhythms_for("").empty()) {
        return fail("the styles of music have no rhythm with dance = \"none\"");
    }
    // Only these two kinds of music are written from the book's rhythms by dance.
    const bool has_dances = plan.music == Music::all || plan.music == Music::synthesized;
    for (const std::string& dance : plan.styles->dances()) {
        if (has_dances && styles_of(plan, dance).empty()) {
            const char* const use = plan.families == WrittenCorpusPlan::Families::all ? ""
                                    : plan.families == WrittenCorpusPlan::Families::held_out
                                        ? " that is held out"
                                        : " that is always used";
            return fail(fmt::format(
                "the styles of music have no rhythm with dance = \"{}\"{}", dance, use));
        }
    }
    if (plan.music == Music::own && dances_of_generator(*plan.styles).empty()) {
        return fail("the styles of music have no palette with own = { ... }");
    }
    // own_piece relies on it that every palette's style is known.
    for (const BandPalette& palette : plan.styles->palettes) {
        if (palette.own && !style_from_name(palette.own->style)) {
            return fail(fmt::format("the palette of \"{}\": own: {}",
                                    palette.dance,
                                    style_from_name(palette.own->style).error().message));
        }
    }
    return {};
}

/// A piece of the built-in generator, which has sounds that no soundfont has (darbuka, oud).
WrittenPiece own_piece(const BandPalette& palette, double seconds, Dice& dice) {
    const OwnMusic& own = *palette.own;
    MusicPlan plan;
    plan.style = style_from_name(own.style).value_or(Style::drums);  // known: check_styles
    const double bpm = dice.uniform(own.lowest_bpm, own.highest_bpm);
    plan.tempo = {{0.0, bpm}};
    plan.seconds = seconds;
    plan.channels = 1;
    plan.rate = SampleRate(kPerformanceRate);
    plan.seed = static_cast<std::uint64_t>(dice.whole(1, 1'000'000));
    WrittenPiece piece{own.name, palette.dance, {}, {}};
    if (auto music = generate(plan)) {
        piece.samples = std::move(music->samples);
    }
    return piece;
}

// The first edition had semitones only.
OrientalScales scales_of(const WrittenCorpusPlan& plan) {
    return plan.edition == WrittenCorpusPlan::Edition::first ? OrientalScales::semitones
                                                             : OrientalScales::quarter_tones;
}

/// Removes the melody from a performance and returns it as notes for the oud: times in seconds,
/// pitches in Hz (key 69 is 440 Hz), velocities 0 to 1.
std::vector<OudNote> take_melody(Performance& performance) {
    std::vector<OudNote> melody;
    for (const PlayedNote& note : performance.notes) {
        if (note.channel == kMelodyChannel) {
            const double semitones = note.key - 69 + note.cents / 100.0;
            melody.push_back({note.time,
                              note.length,
                              440.0 * std::exp2(semitones / 12.0),
                              note.velocity / 127.0});
        }
    }
    std::erase_if(performance.notes,
                  [](const PlayedNote& note) { return note.channel == kMelodyChannel; });
    return melody;
}

/// Adds `more` at `gain` times the level and divides by 1 + gain, so that the sum keeps the range.
void mix_in(std::span<const float> more, float gain, std::vector<float>& samples) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = (samples[i] + gain * more[i]) / (1.0F + gain);
    }
}

/// Plays with a soundfont or, since the third edition, mostly with a band of several; since the
/// second edition the synthesized oud may play a maqam melody instead.
Expected<std::vector<float>> play_piece(const WrittenCorpusPlan& plan,
                                        WrittenPiece& piece,
                                        std::span<const std::filesystem::path> soundfonts,
                                        Dice& dice) {
    const PlayerRoom room = dice.chance(0.5)
                                ? PlayerRoom{dice.uniform(0.1, 0.9), dice.uniform(0.1, 0.6)}
                                : PlayerRoom{};
    std::vector<OudNote> melody;
    // Draws happen in a fixed order: one draw more would change the pieces of earlier models.
    const bool is_maqam = plan.styles->palette_of(piece.dance).melody == Melody::maqam;
    if (plan.edition != WrittenCorpusPlan::Edition::first && is_maqam && dice.chance(0.5)) {
        melody = take_melody(piece.performance);
    }
    auto samples = play_with(soundfonts, piece.performance, room, dice);
    if (!samples || melody.empty()) {
        return samples;
    }
    std::vector<float> oud = play_oud(melody, kPerformanceRate, samples->size());
    add_room(kPerformanceRate, 0.3, 0.4 * room.level, oud, dice);
    mix_in(oud, static_cast<float>(dice.uniform(0.2, 0.8)), *samples);
    return samples;
}

/// Plays some or all instruments with synthesized sounds, the others as play_piece does.
Expected<std::vector<float>> synthesize_piece(const WrittenCorpusPlan& plan,
                                              WrittenPiece& piece,
                                              std::span<const std::filesystem::path> soundfonts,
                                              Dice& dice) {
    constexpr double kAll = 0.4;  // of the pieces: no instrument of a soundfont
    const double share = dice.chance(kAll) ? 1.0 : dice.uniform(0.3, 0.9);
    std::vector<float> drawn = play_synthesizers(share, kPerformanceRate, piece.performance, dice);
    if (!drawn.empty() && dice.chance(0.5)) {
        const double wet = dice.uniform(0.05, 0.3);
        add_room(kPerformanceRate, dice.uniform(0.1, 0.4), wet, drawn, dice);
    }
    // Every instrument was synthesized: no soundfont is needed.
    if (piece.performance.notes.empty()) {
        return drawn;
    }
    auto samples = play_piece(plan, piece, soundfonts, dice);
    if (samples && !drawn.empty()) {
        mix_in(drawn, static_cast<float>(dice.log_uniform(0.4, 2.0)), *samples);
    }
    return samples;
}

// Writes the piece (or, for the generator, renders it) without playing it through a soundfont.
WrittenPiece draw_piece(const WrittenCorpusPlan& plan, const std::string& dance, Dice& dice) {
    if (plan.music == WrittenCorpusPlan::Music::undanceable) {
        return undanceable_piece(*plan.styles, plan.seconds, dice);
    }
    const BandPalette& palette = plan.styles->palette_of(dance);
    if (plan.music == WrittenCorpusPlan::Music::own) {
        return own_piece(palette, plan.seconds, dice);
    }
    if (dance.empty()) {
        return other_piece(*plan.styles, plan.seconds, dice);
    }
    // Held-out music is written in held-out rhythms only, never by the generator.
    const bool may_be_ours = palette.own && palette.own->share > 0.0 &&
                             plan.families != WrittenCorpusPlan::Families::held_out;
    if (may_be_ours && dice.chance(palette.own->share)) {
        return own_piece(palette, plan.seconds, dice);
    }
    const auto styles = styles_of(plan, dance);
    const RhythmStyle& style = *dice.pick<const RhythmStyle*>(styles);
    const Score score = arrange(*plan.styles, style, kWrittenBeats, dice, scales_of(plan));
    return {style.name, dance, perform(score, plan.seconds, dice), {}};
}

/// The soundfonts of a piece: one, or several for a band, whose instruments then differ.
std::vector<std::filesystem::path> soundfonts_of(const WrittenCorpusPlan& plan, Dice& dice) {
    const bool has_bands = plan.edition >= WrittenCorpusPlan::Edition::third &&
                           plan.augmentation == WrittenCorpusPlan::Augmentation::on &&
                           plan.effects.has(SoundEffect::players) && plan.soundfonts.size() > 1;
    if (has_bands) {
        return draw_soundfonts(plan.soundfonts, dice);
    }
    return {dice.pick<std::filesystem::path>(plan.soundfonts)};
}

/// The dance that piece `number` is for, the same for any seed; empty: none of them.
std::string dance_of_number(const WrittenCorpusPlan& plan, int number) {
    const auto turn = static_cast<std::size_t>(number);
    if (plan.music == WrittenCorpusPlan::Music::undanceable) {
        return {};
    }
    if (plan.music == WrittenCorpusPlan::Music::own) {
        const std::vector<std::string> dances = dances_of_generator(*plan.styles);
        return dances[turn % dances.size()];
    }
    // None of the dances covers more kinds of music than any dance does: two pieces a round.
    const std::vector<std::string> dances = plan.styles->dances();
    const std::size_t place = turn % (dances.size() + 2);
    return place < dances.size() ? dances[place] : std::string();
}

// All draws come from the piece's own stream (seed, number), in this order: writing, playing,
// damage.
Expected<PieceFeatures> make_piece(const WrittenCorpusPlan& plan, int number) {
    Dice dice(plan.seed, static_cast<std::uint64_t>(number));
    const std::string dance = dance_of_number(plan, number);
    WrittenPiece piece = draw_piece(plan, dance, dice);
    // Draws again while the performance is too short; the generator's pieces have samples already.
    for (int tries = 0;
         piece.samples.empty() && piece.performance.seconds < kShortestPiece && tries < 20;
         ++tries) {
        piece = draw_piece(plan, dance, dice);
    }
    const std::vector<std::filesystem::path> soundfonts = soundfonts_of(plan, dice);
    if (piece.samples.empty()) {
        auto samples = plan.music == WrittenCorpusPlan::Music::synthesized
                           ? synthesize_piece(plan, piece, soundfonts, dice)
                           : play_piece(plan, piece, soundfonts, dice);
        if (!samples) {
            return fail(samples.error());
        }
        piece.samples = std::move(*samples);
    }
    // Damage is applied to the mix.
    if (plan.augmentation == WrittenCorpusPlan::Augmentation::on) {
        SoundEffects effects = plan.effects;
        if (plan.edition == WrittenCorpusPlan::Edition::first) {
            effects.leave_out(SoundEffect::codec);
            effects.leave_out(SoundEffect::resampling);
        }
        if (auto done = augment_for_genre(kPerformanceRate, piece.samples, dice, effects); !done) {
            return fail(done.error());
        }
    }
    // The group names rhythm and sound: cross-validation keeps such pieces in one fold.
    PieceFeatures features;
    features.name = piece.name + " " + std::to_string(number);
    features.group =
        piece.name + "/" + (soundfonts.size() > 1 ? "band" : soundfonts.front().stem().string());
    features.genre = piece.dance;
    features.kind = plan.families == WrittenCorpusPlan::Families::held_out
                        ? PieceFeatures::Kind::written_held_out
                        : PieceFeatures::Kind::written;
    if (auto done = extract_features(
            piece.samples, SampleRate(kPerformanceRate), plan.feature_plan, features);
        !done) {
        return fail(done.error());
    }
    return features;
}

}  // namespace

Expected<std::vector<PieceFeatures>> read_beats_corpus(const std::filesystem::path& file,
                                                       const StyleBook& styles,
                                                       WrittenCorpusPlan::Families families) {
    auto corpus = load_corpus(file);
    if (!corpus) {
        return fail(corpus.error());
    }
    // No beat has a bar position above 3.
    const auto is_in_three_beats = [](const TrainingExcerpt& excerpt) {
        return std::all_of(excerpt.beats.begin(), excerpt.beats.end(), [](const auto& beat) {
            return beat.bar_position <= 3;
        });
    };
    std::vector<PieceFeatures> pieces;
    for (TrainingExcerpt& excerpt : *corpus) {
        const auto label = styles.label_of(excerpt.style);
        // Some piano pieces in three are waltzes, though their style says nothing of it.
        const bool is_kept = label && is_among(*label, families) &&
                             !(excerpt.family == "piano" && is_in_three_beats(excerpt));
        if (!is_kept) {
            continue;
        }
        PieceFeatures& piece = pieces.emplace_back();
        piece.name = excerpt.style + " of the beat tracker's";
        piece.group = excerpt.style + "/beats";
        piece.genre = label->dance;
        piece.kind = PieceFeatures::Kind::written;
        piece.mel = std::move(excerpt.mel);
    }
    return pieces;
}

Expected<std::vector<PieceFeatures>> write_corpus(const WrittenCorpusPlan& plan) {
    if (auto enough = check_styles(plan); !enough) {
        return fail(enough.error());
    }
    const auto count = static_cast<std::size_t>(plan.pieces);
    // Every job fills its own slot; "not made" never remains.
    std::vector<Expected<PieceFeatures>> made(count, fail("not made"));
    run_parallel(count, plan.threads, [&](std::size_t number) {
        made[number] = make_piece(plan, plan.first + static_cast<int>(number));
    });
    // The first error by number, whichever job failed first.
    std::vector<PieceFeatures> pieces;
    for (Expected<PieceFeatures>& piece : made) {
        if (!piece) {
            return fail(piece.error());
        }
        pieces.push_back(std::move(*piece));
    }
    return pieces;
}

}  // namespace raks::audio
