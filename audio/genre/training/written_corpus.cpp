#include "audio/genre/training/written_corpus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "audio/beat/training/corpus.hpp"
#include "audio/beat/training/keyboard_scores.hpp"
#include "audio/beat/training/non_music.hpp"
#include "audio/beat/training/performance.hpp"
#include "audio/beat/training/soundfont_player.hpp"
#include "audio/genre/training/arrangement.hpp"
#include "audio/genre/training/genre_augmentation.hpp"
#include "audio/genre/training/genre_styles.hpp"
#include "audio/genre/training/oud.hpp"
#include "audio/genre/training/sound_damage.hpp"
#include "audio/synth/music_generator.hpp"
#include "base/parallel.hpp"

namespace raks::audio {
namespace {

constexpr int kBeats = 96;
constexpr double kShortest = 8.0;  // s

struct WrittenPiece {
    std::string name;
    Genre genre = Genre::unknown;
    Performance performance;
    std::vector<float> samples;  // of what no soundfont plays
};

bool is_among(const GenreStyle& style, WrittenCorpusPlan::Families families) {
    const bool is_held_out = style.use == GenreStyle::Use::held_out;
    return families == WrittenCorpusPlan::Families::all ||
           (families == WrittenCorpusPlan::Families::held_out) == is_held_out;
}

std::vector<GenreStyle> styles_of(Genre genre, WrittenCorpusPlan::Families families) {
    std::vector<GenreStyle> chosen;
    for (const GenreStyle& style : genre_styles()) {
        if (style.genre == genre && is_among(style, families)) {
            chosen.push_back(style);
        }
    }
    return chosen;
}

/// Our own generator's salsa, maqsum and house: sounds that no soundfont has (darbuka, oud).
WrittenPiece own_piece(Genre genre, double seconds, Dice& dice) {
    MusicPlan plan;
    plan.style = genre == Genre::salsa   ? Style::salsa
                 : genre == Genre::belly ? Style::maqsum
                                         : Style::house;
    const double bpm = genre == Genre::salsa   ? dice.uniform(150.0, 215.0)
                       : genre == Genre::belly ? dice.uniform(80.0, 145.0)
                                               : dice.uniform(112.0, 132.0);
    plan.tempo = {{0.0, bpm}};
    plan.seconds = seconds;
    plan.channels = 1;
    plan.rate = SampleRate(SoundfontPlayer::kRate);
    plan.seed = static_cast<std::uint64_t>(dice.whole(1, 1'000'000));
    WrittenPiece piece{"own " + std::string(name_of(plan.style)), genre, {}, {}};
    if (auto music = generate(plan)) {
        piece.samples = std::move(music->samples);
    }
    return piece;
}

/// No drums, and strings, winds, choirs or soft synthesizers in a free tempo for the rest.
void make_orchestral(Score& score, Dice& dice) {
    std::erase_if(score.notes, [](const ScoreNote& note) { return note.channel == kDrumChannel; });
    score.has_drums = false;
    score.is_expressive = true;
    std::array<int, 16> programs{};
    for (int& program : programs) {
        program =
            dice.pick({40, 42, 46, 48, 49, 52, 53, 60, 68, 71, 73, 88, 89, 91, 92, 95, 24, 0});
    }
    for (ScoreNote& note : score.notes) {
        note.program = programs[static_cast<std::size_t>(note.channel)];
    }
}

/// A piano in bars of three may play a waltz.
bool is_in_three(const Score& score) {
    return *std::max_element(score.bar_position.begin(), score.bar_position.end()) == 3;
}

/// Music to no dance of ours, and what is no music.
WrittenPiece other_piece(const WrittenCorpusPlan& plan, Dice& dice) {
    const double kind = dice.uniform();
    if (kind < 0.12) {
        return {"people",
                Genre::unknown,
                {},
                noise_of_people(SoundfontPlayer::kRate, plan.seconds, dice)};
    }
    if (kind < 0.22) {
        return {"no pulse", Genre::unknown, notes_without_pulse(plan.seconds, dice), {}};
    }
    if (kind < 0.34) {
        Score score = keyboard_score(kBeats, dice);
        for (int tries = 0; is_in_three(score) && tries < 20; ++tries) {
            score = keyboard_score(kBeats, dice);
        }
        return {"piano", Genre::unknown, perform(score, plan.seconds, dice), {}};
    }
    const auto styles = styles_of(Genre::unknown, WrittenCorpusPlan::Families::all);
    const GenreStyle& style = dice.pick<GenreStyle>(styles);
    Score score = arrange(style, kBeats, dice);
    if (kind < 0.46) {
        make_orchestral(score, dice);
        return {"orchestra", Genre::unknown, perform(score, plan.seconds, dice), {}};
    }
    return {std::string(style.style->name), Genre::unknown, perform(score, plan.seconds, dice), {}};
}

OrientalScales scales_of(const WrittenCorpusPlan& plan) {
    return plan.edition == WrittenCorpusPlan::Edition::first ? OrientalScales::semitones
                                                             : OrientalScales::quarter_tones;
}

/// Takes the melody out of a performance.
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

/// Plays with a soundfont; of the second edition an oud of ours may play an oriental melody.
std::vector<float> play_piece(const WrittenCorpusPlan& plan,
                              WrittenPiece& piece,
                              SoundfontPlayer& player,
                              const PlayerRoom& room,
                              Dice& dice) {
    std::vector<OudNote> melody;
    if (plan.edition != WrittenCorpusPlan::Edition::first && piece.genre == Genre::belly &&
        dice.chance(0.5)) {
        melody = take_melody(piece.performance);
    }
    std::vector<float> samples = player.play(piece.performance, room);
    if (melody.empty()) {
        return samples;
    }
    std::vector<float> oud = play_oud(melody, SoundfontPlayer::kRate, samples.size());
    add_room(SoundfontPlayer::kRate, 0.3, 0.4 * room.level, oud, dice);
    const auto level = static_cast<float>(dice.uniform(0.2, 0.8));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = (samples[i] + level * oud[i]) / (1.0F + level);
    }
    return samples;
}

WrittenPiece draw_piece(const WrittenCorpusPlan& plan, Genre genre, Dice& dice) {
    if (genre == Genre::unknown) {
        return other_piece(plan, dice);
    }
    const bool is_ours = genre == Genre::salsa || genre == Genre::belly || genre == Genre::house;
    if (is_ours && plan.families != WrittenCorpusPlan::Families::held_out && dice.chance(0.1)) {
        return own_piece(genre, plan.seconds, dice);
    }
    const auto styles = styles_of(genre, plan.families);
    const GenreStyle& style = dice.pick<GenreStyle>(styles);
    return {std::string(style.style->name),
            genre,
            perform(arrange(style, kBeats, dice, scales_of(plan)), plan.seconds, dice),
            {}};
}

Expected<HeardPiece> make_piece(const WrittenCorpusPlan& plan, int number) {
    Dice dice(plan.seed, static_cast<std::uint64_t>(number));
    // What is none of the dances is of more kinds than any dance: two pieces a round.
    const auto genre = static_cast<Genre>(std::min(number % (kGenreCount + 1), kGenreCount - 1));
    WrittenPiece piece = draw_piece(plan, genre, dice);
    for (int tries = 0;
         piece.samples.empty() && piece.performance.seconds < kShortest && tries < 20;
         ++tries) {
        piece = draw_piece(plan, genre, dice);
    }
    const auto& soundfont = dice.pick<std::filesystem::path>(plan.soundfonts);
    if (piece.samples.empty()) {
        const PlayerRoom room = dice.chance(0.5)
                                    ? PlayerRoom{dice.uniform(0.1, 0.9), dice.uniform(0.1, 0.6)}
                                    : PlayerRoom{};
        auto player = SoundfontPlayer::open(soundfont);
        if (!player) {
            return fail(player.error());
        }
        piece.samples = play_piece(plan, piece, *player, room, dice);
    }
    if (plan.augmentation == WrittenCorpusPlan::Augmentation::on) {
        SoundEffects effects = plan.effects;
        if (plan.edition == WrittenCorpusPlan::Edition::first) {
            effects.leave_out(SoundEffect::codec);
            effects.leave_out(SoundEffect::resampling);
        }
        if (auto done = augment_for_genre(SoundfontPlayer::kRate, piece.samples, dice, effects);
            !done) {
            return fail(done.error());
        }
    }
    HeardPiece heard;
    heard.name = piece.name + " " + std::to_string(number);
    heard.group = piece.name + "/" + soundfont.stem().string();
    heard.genre = piece.genre;
    heard.kind = plan.families == WrittenCorpusPlan::Families::held_out
                     ? HeardPiece::Kind::written_held_out
                     : HeardPiece::Kind::written;
    if (auto done =
            hear_piece(piece.samples, SampleRate(SoundfontPlayer::kRate), plan.hearing, heard);
        !done) {
        return fail(done.error());
    }
    return heard;
}

}  // namespace

Expected<std::vector<HeardPiece>> read_beats_corpus(const std::filesystem::path& file,
                                                    WrittenCorpusPlan::Families families) {
    auto corpus = load_corpus(file);
    if (!corpus) {
        return fail(corpus.error());
    }
    const auto is_in_three_beats = [](const TrainingExcerpt& excerpt) {
        return std::all_of(excerpt.beats.begin(), excerpt.beats.end(), [](const auto& beat) {
            return beat.bar_position <= 3;
        });
    };
    std::vector<HeardPiece> pieces;
    for (TrainingExcerpt& excerpt : *corpus) {
        const auto style = genre_of_style(excerpt.style);
        const bool is_kept = style && is_among(*style, families) &&
                             !(excerpt.family == "piano" && is_in_three_beats(excerpt));
        if (!is_kept) {
            continue;
        }
        HeardPiece& piece = pieces.emplace_back();
        piece.name = excerpt.style + " of the beat tracker's";
        piece.group = excerpt.style + "/beats";
        piece.genre = style->genre;
        piece.kind = HeardPiece::Kind::written;
        piece.mel = std::move(excerpt.mel);
    }
    return pieces;
}

Expected<std::vector<HeardPiece>> write_corpus(const WrittenCorpusPlan& plan) {
    const auto count = static_cast<std::size_t>(plan.pieces);
    std::vector<Expected<HeardPiece>> made(count, fail("not made"));
    run_parallel(count, plan.threads, [&](std::size_t number) {
        made[number] = make_piece(plan, plan.first + static_cast<int>(number));
    });
    std::vector<HeardPiece> pieces;
    for (Expected<HeardPiece>& piece : made) {
        if (!piece) {
            return fail(piece.error());
        }
        pieces.push_back(std::move(*piece));
    }
    return pieces;
}

}  // namespace raks::audio
