#include "audio/genre/training/written_corpus.hpp"

#include <algorithm>
#include <string>

#include "audio/beat/training/keyboard_scores.hpp"
#include "audio/beat/training/non_music.hpp"
#include "audio/beat/training/performance.hpp"
#include "audio/beat/training/soundfont_player.hpp"
#include "audio/genre/training/arrangement.hpp"
#include "audio/genre/training/genre_augmentation.hpp"
#include "audio/genre/training/genre_styles.hpp"
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

std::vector<GenreStyle> styles_of(Genre genre, WrittenCorpusPlan::Families families) {
    std::vector<GenreStyle> chosen;
    for (const GenreStyle& style : genre_styles()) {
        const bool is_held_out = style.use == GenreStyle::Use::held_out;
        const bool fits = families == WrittenCorpusPlan::Families::all ||
                          (families == WrittenCorpusPlan::Families::held_out) == is_held_out;
        if (style.genre == genre && fits) {
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
    if (kind < 0.38) {
        return {
            "piano", Genre::unknown, perform(keyboard_score(kBeats, dice), plan.seconds, dice), {}};
    }
    const auto styles = styles_of(Genre::unknown, WrittenCorpusPlan::Families::all);
    const GenreStyle& style = dice.pick<GenreStyle>(styles);
    return {std::string(style.style->name),
            Genre::unknown,
            perform(arrange(style, kBeats, dice), plan.seconds, dice),
            {}};
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
            perform(arrange(style, kBeats, dice), plan.seconds, dice),
            {}};
}

Expected<HeardPiece> make_piece(const WrittenCorpusPlan& plan, int number) {
    Dice dice(plan.seed, static_cast<std::uint64_t>(number));
    const auto genre = static_cast<Genre>(number % kGenreCount);
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
        piece.samples = player->play(piece.performance, room);
    }
    if (plan.augmentation == WrittenCorpusPlan::Augmentation::on) {
        augment_for_genre(SoundfontPlayer::kRate, piece.samples, dice);
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
