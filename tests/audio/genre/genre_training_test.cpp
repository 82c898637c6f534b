#include "audio/genre/training/genre_trainer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

#include "audio/genre/training/arrangement.hpp"
#include "audio/genre/training/genre_augmentation.hpp"
#include "audio/genre/training/genre_styles.hpp"
#include "audio/genre/training/music_folder.hpp"
#include "audio/genre/training/sound_damage.hpp"
#include "audio/io/lossy_codec.hpp"
#include "base/file.hpp"
#include "base/random.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

/// A piece whose first cepstra and features lie about its genre's own places.
HeardPiece made_piece(Genre genre, int number, double spread = 0.6) {
    HeardPiece piece;
    piece.name = std::string(name_of(genre)) + std::to_string(number);
    piece.group = "artist " + std::to_string(number % 7);
    piece.genre = genre;
    const CounterRandom random(static_cast<std::uint64_t>(genre) + 1,
                               static_cast<std::uint64_t>(number));
    const double place = 2.0 * static_cast<double>(genre);
    std::uint64_t draw = 0;
    for (int frame = 0; frame < 620; ++frame) {
        MfccVector& vector = piece.frames.emplace_back();
        for (float& value : vector) {
            value = static_cast<float>(random.normal(draw++));
        }
        vector[0] += static_cast<float>(place);
        vector[3] -= static_cast<float>(place);
        const std::size_t loud = 5 * static_cast<std::size_t>(genre);
        for (std::size_t band = 0; band < BarPatterns::kMelBands; ++band) {
            const bool is_loud = band >= loud && band < loud + 5;
            piece.mel.push_back(static_cast<float>((is_loud ? 8.0 : 1.0) + random.uniform(draw++)));
        }
    }
    for (int end = 100; end <= 600; end += 100) {
        for (const int segments : kGenreWindows) {
            if (segments * BarPatterns::kSegmentHops > end) {
                continue;
            }
            HeardWindow& window = piece.windows.emplace_back();
            window.segments = segments;
            window.end_frame = end;
            for (float& value : window.features) {
                value = static_cast<float>(spread * random.normal(draw++));
            }
            const std::size_t own = 8 * static_cast<std::size_t>(genre);
            for (std::size_t i = own; i < own + 8; ++i) {
                window.features[i] += 1.5F;
            }
        }
    }
    return piece;
}

std::vector<HeardPiece> made_pieces(int each) {
    std::vector<HeardPiece> pieces;
    for (const Genre genre : {Genre::salsa, Genre::belly, Genre::rock, Genre::unknown}) {
        for (int i = 0; i < each; ++i) {
            pieces.push_back(made_piece(genre, i));
        }
    }
    return pieces;
}

GenreTrainingPlan small_plan() {
    GenreTrainingPlan plan;
    plan.mfcc = {
        .states = 1, .mixtures = 2, .frames = 2'000, .iterations = 2, .similarity_rounds = 1};
    plan.rhythm.parts.clear();
    plan.rhythm.units = 8;
    plan.rhythm.steps = 200;
    plan.rhythm.rate = 5e-3;
    plan.sound.parts.clear();
    plan.sound.steps = 100;
    plan.network.units = 8;
    plan.network.layers = 1;
    plan.network.tuning_steps = 30;
    plan.network.tuning_rate = 2e-2;
    plan.folds = 3;
    return plan;
}

TEST(GenreTraining, tells_made_up_genres_apart_by_artists_never_heard) {
    const std::vector<HeardPiece> pieces = made_pieces(7);
    const std::vector<Genre> genres = genres_of(pieces);
    ASSERT_EQ(genres, (std::vector<Genre>{Genre::salsa, Genre::belly, Genre::rock}));
    int folds = 0;
    const auto scores =
        cross_validate(pieces, genres, small_plan(), [&](int done, int) { folds = done; });
    ASSERT_TRUE(scores) << scores.error().message;
    EXPECT_EQ(folds, 3);
    for (const GenreEvidence evidence : {GenreEvidence::mfcc,
                                         GenreEvidence::mfcc_similarity,
                                         GenreEvidence::rhythm,
                                         GenreEvidence::sound,
                                         GenreEvidence::network,
                                         GenreEvidence::fused}) {
        const GenreFusion fusion = fit_fusion(*scores, 3, 4, evidence);
        std::vector<WindowScore::Values> logs;
        for (const WindowScore& score : *scores) {
            logs.push_back(fuse(score, fusion, evidence, 4));
        }
        const std::vector<std::size_t> asked = {0, 1, 2};
        const GenreTally result = tally(*scores, logs, 3, genres, asked);
        EXPECT_GT(result.macro_recall, 0.9) << static_cast<int>(evidence);
        EXPECT_EQ(result.pieces, (std::vector<std::size_t>{7, 7, 7, 7}));
    }
}

TEST(GenreTraining, the_same_plan_gives_the_same_bits_for_any_number_of_threads) {
    const std::vector<HeardPiece> pieces = made_pieces(3);
    std::vector<const HeardPiece*> all;
    for (const HeardPiece& piece : pieces) {
        all.push_back(&piece);
    }
    GenreTrainingPlan plan = small_plan();
    plan.rhythm.steps = plan.sound.steps = 20;
    const auto one = train_genres(all, genres_of(pieces), plan);
    plan.mfcc.threads = 4;
    const auto four = train_genres(all, genres_of(pieces), plan);
    ASSERT_TRUE(one && four);
    EXPECT_EQ(one->rhythm.hidden_weights, four->rhythm.hidden_weights);
    EXPECT_EQ(one->mfcc[1].means, four->mfcc[1].means);
    EXPECT_TRUE(validate(*one)) << validate(*one).error().message;
}

TEST(GenreTraining, a_silent_piece_has_no_scores) {
    const std::vector<HeardPiece> pieces = made_pieces(2);
    std::vector<const HeardPiece*> all;
    for (const HeardPiece& piece : pieces) {
        all.push_back(&piece);
    }
    GenreTrainingPlan plan = small_plan();
    plan.rhythm.steps = plan.sound.steps = 5;
    const auto model = train_genres(all, genres_of(pieces), plan);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(score_piece(*model, HeardPiece{}, 0).empty());
    EXPECT_EQ(score_piece(*model, pieces[0], 0).size(), pieces[0].windows.size());
}

TEST(GenreTraining, too_little_sound_for_a_model_is_said) {
    const std::vector<HeardPiece> pieces = made_pieces(1);
    std::vector<const HeardPiece*> all = {&pieces[0]};
    GenreTrainingPlan plan = small_plan();
    plan.mfcc.frames = 50;
    const auto model = train_genres(all, genres_of(std::span(pieces).first(1)), plan);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().message,
              "salsa: 50 frames of sound, fewer than the 156 parameters of its model; add music or "
              "lower --states and --mixtures");
}

TEST(GenreTraining, pieces_read_back_and_cut_ones_are_refused) {
    const fs::path folder = fs::temp_directory_path() / "raks-genre-pieces-test";
    fs::create_directories(folder);
    const std::vector<HeardPiece> pieces = {made_piece(Genre::belly, 1)};
    const fs::path file = folder / "a.pieces";
    ASSERT_TRUE(save_pieces(pieces, file));
    const auto read = load_pieces(file);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->size(), 1U);
    EXPECT_EQ(read->front().frames, pieces.front().frames);
    EXPECT_EQ(read->front().windows.size(), pieces.front().windows.size());
    const auto bytes = read_file(file);
    ASSERT_TRUE(bytes);
    const CounterRandom random(5);
    for (std::uint64_t i = 0; i < 60; ++i) {
        const std::size_t size =
            i < 30 ? static_cast<std::size_t>(i) : random.below(i, bytes->size());
        ASSERT_TRUE(write_file(file, std::string_view(*bytes).substr(0, size)));
        const auto cut = load_pieces(file);
        // Cut right behind the name of the format it holds nothing.
        EXPECT_TRUE(!cut || cut->empty()) << size;
    }
    fs::remove_all(folder);
}

TEST(GenreTraining, folders_and_tables_name_what_is_wrong) {
    const fs::path folder = fs::temp_directory_path() / "raks-genre-folder-test";
    fs::remove_all(folder);
    fs::create_directories(folder / "latin");
    EXPECT_EQ(list_music(folder).error().message,
              folder.string() + ": holds no folder of music; it needs one a genre");
    ASSERT_TRUE(write_file(folder / "latin" / "a.wav", "x"));
    const auto files = list_music(folder);
    ASSERT_TRUE(files);
    EXPECT_EQ(files->front().genre, Genre::salsa);
    fs::create_directories(folder / "polka");
    ASSERT_TRUE(write_file(folder / "polka" / "a.wav", "x"));
    EXPECT_EQ(list_music(folder).error().message,
              folder.string() +
                  ": folder 'polka' must be named salsa (latin), belly (mideast), "
                  "house (electronic), hiphop, rock, waltz or other");
    const fs::path table = folder / "index.tsv";
    ASSERT_TRUE(write_file(table, "clip\tgenre\tartist\na.wav\tlatin\n"));
    EXPECT_EQ(list_music(folder, table).error().message,
              table.string() + ": line 2: 2 columns, the first line has 3");
    ASSERT_TRUE(write_file(table, "clip\tartist\n"));
    EXPECT_EQ(list_music(folder, table).error().message,
              table.string() + ": line 1 names no column 'genre'");
    ASSERT_TRUE(write_file(table, "clip\tgenre\ttrain_ok\na.wav\twaltz\tno\n"));
    const auto listed = list_music(folder, table);
    ASSERT_TRUE(listed);
    EXPECT_FALSE(listed->front().may_train);
    EXPECT_EQ(listed->front().genre, Genre::waltz);
    fs::remove_all(folder);
}

TEST(GenreTraining, the_same_file_under_two_genres_is_said) {
    const fs::path folder = fs::temp_directory_path() / "raks-genre-twins-test";
    fs::remove_all(folder);
    for (const char* const genre : {"salsa", "rock"}) {
        fs::create_directories(folder / genre);
        ASSERT_TRUE(write_file(folder / genre / "a.wav", "the same"));
    }
    ASSERT_TRUE(write_file(folder / "rock" / "b.wav", "the same"));
    const auto files = list_music(folder);
    ASSERT_TRUE(files);
    EXPECT_EQ(check_distinct(*files).error().message,
              (folder / "rock" / "a.wav").string() + " and " +
                  (folder / "salsa" / "a.wav").string() +
                  " are the same file under two genres; remove one");
    fs::remove(folder / "salsa" / "a.wav");
    EXPECT_TRUE(check_distinct(*list_music(folder))) << "twice under one genre is only a waste";
    fs::remove_all(folder);
}

TEST(GenreTraining, every_genre_has_rhythms_to_learn_and_one_to_leave_out) {
    for (int i = 0; i < static_cast<int>(Genre::unknown); ++i) {
        int kept = 0;
        int left_out = 0;
        for (const GenreStyle& style : genre_styles()) {
            if (style.genre == static_cast<Genre>(i)) {
                ++(style.use == GenreStyle::Use::always ? kept : left_out);
            }
        }
        EXPECT_GE(kept, 3) << i;
        EXPECT_GE(left_out, 1) << i;
    }
}

TEST(GenreTraining, arrangements_are_playable_and_repeatable) {
    for (std::size_t i = 0; i < genre_styles().size(); ++i) {
        const GenreStyle& style = genre_styles()[i];
        Dice dice(3, i);
        Dice again(3, i);
        const Score score = arrange(style, 32, dice);
        EXPECT_EQ(score.notes.size(), arrange(style, 32, again).notes.size());
        EXPECT_FALSE(score.notes.empty()) << style.style->name;
        for (const ScoreNote& note : score.notes) {
            ASSERT_TRUE(note.beat >= 0.0 && note.key >= 0 && note.key < 128 && note.program >= 0 &&
                        note.program < 128 && note.channel >= 0 && note.channel < 16)
                << style.style->name << " key " << note.key;
        }
    }
}

double rms_of(const std::vector<float>& samples) {
    double sum = 0.0;
    for (const float sample : samples) {
        sum += static_cast<double>(sample) * static_cast<double>(sample);
    }
    return std::sqrt(sum / static_cast<double>(samples.size()));
}

TEST(SoundDamage, does_what_it_says) {
    constexpr int kRate = 16'000;
    const auto tone = [](double hertz) {
        std::vector<float> samples(16'000);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            samples[i] =
                static_cast<float>(std::sin(2.0 * M_PI * hertz * static_cast<double>(i) / kRate));
        }
        return samples;
    };
    std::vector<float> quiet = tone(500.0);
    ASSERT_TRUE(damage(Damage::quieter_12_db, kRate, quiet));
    EXPECT_NEAR(rms_of(quiet), std::sqrt(0.5) * std::pow(10.0, -0.6), 1e-3);
    std::vector<float> low = tone(1'000.0);
    std::vector<float> high = tone(7'000.0);
    ASSERT_TRUE(damage(Damage::low_pass_4_khz, kRate, low));
    ASSERT_TRUE(damage(Damage::low_pass_4_khz, kRate, high));
    EXPECT_NEAR(rms_of(low), std::sqrt(0.5), 0.01);
    EXPECT_LT(rms_of(high), 0.03);
    std::vector<float> noisy = tone(500.0);
    ASSERT_TRUE(damage(Damage::noise_10_db, kRate, noisy));
    const std::vector<float> clean = tone(500.0);
    for (std::size_t i = 0; i < noisy.size(); ++i) {
        noisy[i] -= clean[i];
    }
    EXPECT_NEAR(20.0 * std::log10(rms_of(clean) / rms_of(noisy)), 10.0, 0.2);
    std::vector<float> room(16'000);
    room[0] = 1.0F;
    ASSERT_TRUE(damage(Damage::room_600_ms, kRate, room));
    const auto energy = [&](std::size_t from, std::size_t to) {
        return rms_of({room.begin() + static_cast<std::ptrdiff_t>(from),
                       room.begin() + static_cast<std::ptrdiff_t>(to)});
    };
    // 60 dB in 0.6 s: 30 dB between two spans 0.3 s apart.
    EXPECT_NEAR(20.0 * std::log10(energy(800, 3'200) / energy(5'600, 8'000)), 30.0, 2.0);
}

std::vector<float> clicks_and_tone(int rate, double seconds) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double at = static_cast<double>(i) / rate;
        const double since = std::fmod(at, 0.25);
        samples[i] = static_cast<float>(0.2 * std::sin(2.0 * M_PI * 440.0 * at) +
                                        0.6 * std::exp(-since * 60.0) *
                                            std::sin(2.0 * M_PI * 1'800.0 * since));
    }
    return samples;
}

/// By how many samples `b` lies behind `a`: where they agree best, and how well (1: the same).
std::pair<int, double> shift_between(const std::vector<float>& a, const std::vector<float>& b) {
    std::pair<int, double> best{0, -1.0};
    constexpr int kMost = 3'000;
    for (int shift = -kMost; shift <= kMost; ++shift) {
        double product = 0.0;
        double power_a = 1e-9;
        double power_b = 1e-9;
        for (std::size_t i = kMost; i + kMost < a.size(); i += 3) {
            const auto x = static_cast<double>(a[i]);
            const auto y =
                static_cast<double>(b[static_cast<std::size_t>(static_cast<int>(i) + shift)]);
            product += x * y;
            power_a += x * x;
            power_b += y * y;
        }
        const double likeness = product / std::sqrt(power_a * power_b);
        best = likeness > best.second ? std::pair{shift, likeness} : best;
    }
    return best;
}

TEST(SoundDamage, lossy_codecs_keep_length_and_time_and_repeat) {
    for (const int rate : {44'100, 32'000, 48'000}) {
        const std::vector<float> clean = clicks_and_tone(rate, 0.8);
        for (const LossyCodec codec : {LossyCodec::mp3, LossyCodec::opus}) {
            for (const int bits : {24'000, 64'000}) {
                std::vector<float> coded = clean;
                ASSERT_TRUE(pass_lossy_codec(codec, rate, bits, coded));
                std::vector<float> again = clean;
                ASSERT_TRUE(pass_lossy_codec(codec, rate, bits, again));
                EXPECT_EQ(coded, again);
                ASSERT_EQ(coded.size(), clean.size());
                const auto [shift, likeness] = shift_between(clean, coded);
                EXPECT_LT(std::abs(shift), rate / 1'000) << rate << ' ' << bits << ' ' << likeness;
                EXPECT_GT(likeness, 0.9) << rate << ' ' << bits;
                EXPECT_NE(coded, clean);
            }
        }
    }
}

TEST(SoundDamage, mp3_of_24_kbit_takes_the_treble) {
    constexpr int kRate = 44'100;
    std::vector<float> high(static_cast<std::size_t>(kRate));
    std::vector<float> low = high;
    for (std::size_t i = 0; i < high.size(); ++i) {
        const double at = 2.0 * M_PI * static_cast<double>(i) / kRate;
        high[i] = static_cast<float>(0.5 * std::sin(14'000.0 * at));
        low[i] = static_cast<float>(0.5 * std::sin(500.0 * at));
    }
    ASSERT_TRUE(damage(Damage::mp3_24_kbit, kRate, high));
    ASSERT_TRUE(damage(Damage::mp3_24_kbit, kRate, low));
    EXPECT_LT(rms_of(high), 0.02);
    EXPECT_NEAR(rms_of(low), 0.5 / std::sqrt(2.0), 0.03);
}

TEST(SoundDamage, a_codec_survives_odd_sounds) {
    for (const LossyCodec codec : {LossyCodec::mp3, LossyCodec::opus}) {
        for (const std::size_t size : {0U, 1U, 575U, 1'153U}) {
            std::vector<float> samples(size, 0.5F);
            ASSERT_TRUE(pass_lossy_codec(codec, 44'100, 32'000, samples));
            EXPECT_EQ(samples.size(), size);
        }
    }
    std::vector<float> samples(1'000, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(pass_lossy_codec(LossyCodec::mp3, 44'100, 64'000, samples));
    EXPECT_LT(rms_of(samples), 1e-3);
    EXPECT_FALSE(pass_lossy_codec(LossyCodec::opus, 44'100, 5'000'000, samples));
}

TEST(SoundDamage, effects_that_are_left_out_do_not_happen) {
    constexpr int kRate = 16'000;
    const std::vector<float> clean = clicks_and_tone(kRate, 0.5);
    SoundEffects none;
    SoundEffects gain_alone;
    for (std::size_t i = 0; i < std::size(kSoundEffectNames); ++i) {
        none.leave_out(static_cast<SoundEffect>(i));
        if (static_cast<SoundEffect>(i) != SoundEffect::gain) {
            gain_alone.leave_out(static_cast<SoundEffect>(i));
        }
    }
    int changed = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        std::vector<float> samples = clean;
        Dice dice(1, seed);
        ASSERT_TRUE(augment_for_genre(kRate, samples, dice, none));
        EXPECT_EQ(samples, clean);
        Dice others(2, seed);
        ASSERT_TRUE(augment_for_genre(kRate, samples, others, gain_alone));
        const float gain = samples[100] / clean[100];
        for (std::size_t i = 0; i < samples.size(); i += 97) {
            ASSERT_NEAR(samples[i], gain * clean[i], 1e-5F);
        }
        std::vector<float> altered = clean;
        Dice all(3, seed);
        ASSERT_TRUE(augment_for_genre(kRate, altered, all));
        ASSERT_EQ(altered.size(), clean.size());
        ASSERT_LT(rms_of(altered), 10.0);
        changed += altered != clean ? 1 : 0;
    }
    EXPECT_EQ(changed, 30);
}

}  // namespace
}  // namespace raks::audio
