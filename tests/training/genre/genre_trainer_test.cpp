#include "training/genre/genre_trainer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "audio/evaluate/genre_folder.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/support/damaged_file.hpp"
#include "tests/support/dances.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kClasses = 3;  // two dances, then none

/// Sound tells the two dances apart and hears none of them as the first; rhythm tells what is none
/// and knows nothing of the dances.
std::vector<WindowScore> two_experts() {
    const CounterRandom random(3);
    std::vector<WindowScore> scores;
    std::uint64_t draw = 0;
    for (std::size_t i = 0; i < 240; ++i) {
        WindowScore& score = scores.emplace_back();
        score.piece = i;
        score.truth = i % kClasses;
        score.window = 3;
        const std::size_t sounds_like = score.truth == 2 ? 0 : score.truth;
        for (std::size_t c = 0; c < kClasses; ++c) {
            const bool is_none = score.truth == 2;
            score.sound[c] =
                static_cast<float>((c == sounds_like ? 1.5 : 0.0) + 0.5 * random.normal(draw++));
            score.rhythm[c] =
                static_cast<float>(((c == 2) == is_none ? 1.5 : 0.0) + 0.5 * random.normal(draw++));
        }
        normalize_logs(std::span(score.sound).first(kClasses));
        normalize_logs(std::span(score.rhythm).first(kClasses));
    }
    return scores;
}

double share_right(const std::vector<WindowScore>& scores,
                   const GenreFusion& fusion,
                   GenreEvidence evidence) {
    const auto right = std::count_if(scores.begin(), scores.end(), [&](const auto& score) {
        const auto logs = fuse(score, fusion, evidence, kClasses);
        return static_cast<std::size_t>(std::max_element(logs.begin(), logs.begin() + kClasses) -
                                        logs.begin()) == score.truth;
    });
    return static_cast<double>(right) / static_cast<double>(scores.size());
}

TEST(GenreFusion, listens_to_each_expert_for_what_it_knows) {
    const auto scores = two_experts();
    const GenreFusion fusion = fit_fusion(scores, 3, kClasses, GenreEvidence::fused);
    EXPECT_GT(fusion.dances.sound, 2.0F * fusion.none.sound);
    EXPECT_GT(share_right(scores, fusion, GenreEvidence::fused), 0.95);
    for (const auto evidence : {GenreEvidence::sound, GenreEvidence::rhythm}) {
        const GenreFusion alone = fit_fusion(scores, 3, kClasses, evidence);
        EXPECT_LT(share_right(scores, alone, evidence), 0.8);
    }
}

TEST(GenreFusion, chances_add_up_to_one_and_offsets_raise_their_class) {
    const auto scores = two_experts();
    GenreFusion fusion{{.mfcc = 0.5F}, {.mfcc = 0.5F}, {}};
    const auto before = fuse(scores[0], fusion, GenreEvidence::fused, kClasses);
    double sum = 0.0;
    for (std::size_t c = 0; c < kClasses; ++c) {
        sum += std::exp(static_cast<double>(before[c]));
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    fusion.offsets[1] = 1.0F;
    EXPECT_GT(fuse(scores[0], fusion, GenreEvidence::fused, kClasses)[1], before[1]);
}

TEST(GenreFusion, without_windows_of_this_length_the_default_weights_stay) {
    const GenreFusion fusion = fit_fusion({}, 3, kClasses, GenreEvidence::sound);
    EXPECT_EQ(fusion.dances.sound, 1.0F);
    EXPECT_EQ(fusion.dances.rhythm, 0.0F);
    EXPECT_EQ(fusion.offsets, GenreScores::Values{});
}

namespace fs = std::filesystem;

/// A piece whose first cepstra and features lie about its genre's own places.
/// Different for each genre of these tests, 0 to 6.
std::uint64_t number_of(const std::string& genre) {
    return genre == "salsa" ? 0 : genre == "belly" ? 1 : genre == "rock" ? 4 : 6;
}

PieceFeatures made_piece(const std::string& genre, int number, double spread = 0.6) {
    PieceFeatures piece;
    piece.name = genre + std::to_string(number);
    piece.group = "artist " + std::to_string(number % 7);
    piece.genre = genre;
    const CounterRandom random(number_of(genre) + 1, static_cast<std::uint64_t>(number));
    const double place = 2.0 * static_cast<double>(number_of(genre));
    std::uint64_t draw = 0;
    for (int frame = 0; frame < 620; ++frame) {
        MfccVector& vector = piece.frames.emplace_back();
        for (float& value : vector) {
            value = static_cast<float>(random.normal(draw++));
        }
        vector[0] += static_cast<float>(place);
        vector[3] -= static_cast<float>(place);
        const std::size_t loud = 5 * static_cast<std::size_t>(number_of(genre));
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
            WindowFeatures& window = piece.windows.emplace_back();
            window.segments = segments;
            window.end_frame = end;
            for (float& value : window.features) {
                value = static_cast<float>(spread * random.normal(draw++));
            }
            const std::size_t own = 8 * static_cast<std::size_t>(number_of(genre));
            for (std::size_t i = own; i < own + 8; ++i) {
                window.features[i] += 1.5F;
            }
        }
    }
    return piece;
}

constexpr std::array<std::string_view, 3> kOrder = {"salsa", "belly", "rock"};

std::vector<PieceFeatures> made_pieces(int each) {
    std::vector<PieceFeatures> pieces;
    for (const char* const genre : {"salsa", "belly", "rock", ""}) {
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
    const std::vector<PieceFeatures> pieces = made_pieces(7);
    const std::vector<std::string> genres = genres_of(pieces, kOrder);
    ASSERT_EQ(genres, (std::vector<std::string>{"salsa", "belly", "rock"}));
    int folds = 0;
    const auto scores =
        cross_validate(pieces, {}, genres, small_plan(), [&](int done, int) { folds = done; });
    ASSERT_TRUE(scores) << scores.error().message;
    EXPECT_EQ(folds, 3);
    for (const GenreEvidence evidence : {GenreEvidence::mfcc,
                                         GenreEvidence::mfcc_similarity,
                                         GenreEvidence::rhythm,
                                         GenreEvidence::sound,
                                         GenreEvidence::network,
                                         GenreEvidence::fused}) {
        const GenreFusion fusion = fit_fusion(*scores, 3, 4, evidence);
        std::vector<GenreScores::Values> logs;
        for (const WindowScore& score : *scores) {
            logs.push_back(fuse(score, fusion, evidence, 4));
        }
        const std::vector<std::size_t> asked = {0, 1, 2};
        const GenreTally result = tally(*scores, logs, 3, genres, asked, {});
        EXPECT_GT(result.macro_recall, 0.9) << static_cast<int>(evidence);
        EXPECT_EQ(result.pieces, (std::vector<std::size_t>{7, 7, 7, 7}));
    }
}

TEST(GenreTraining, damaged_copies_are_judged_by_models_that_heard_neither_them_nor_their_artist) {
    std::vector<PieceFeatures> pieces = made_pieces(3);
    const std::vector<std::string> genres = genres_of(pieces, kOrder);
    GenreTrainingPlan plan = small_plan();
    plan.rhythm.steps = plan.sound.steps = 5;
    const auto unheard = [](int, int) {};
    const auto alone = cross_validate(pieces, {}, genres, plan, unheard);
    const auto both = cross_validate(pieces, pieces, genres, plan, unheard);
    ASSERT_TRUE(alone && both);
    const auto order = [](const WindowScore& a, const WindowScore& b) { return a.piece < b.piece; };
    auto scores = *both;
    std::stable_sort(scores.begin(), scores.end(), order);
    auto expected = *alone;
    std::stable_sort(expected.begin(), expected.end(), order);
    ASSERT_EQ(scores.size(), 2 * expected.size());
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const WindowScore& one = expected[i % expected.size()];
        const bool is_damaged = i >= expected.size();
        EXPECT_EQ(scores[i].piece, one.piece + (is_damaged ? pieces.size() : 0));
        EXPECT_EQ(scores[i].fold, one.fold);
        EXPECT_EQ(scores[i].mfcc, one.mfcc);
        EXPECT_EQ(scores[i].rhythm, one.rhythm);
        EXPECT_EQ(scores[i].network, one.network);
    }
}

TEST(GenreTraining, the_same_plan_gives_the_same_bits_for_any_number_of_threads) {
    const std::vector<PieceFeatures> pieces = made_pieces(3);
    std::vector<const PieceFeatures*> all;
    all.reserve(pieces.size());
    for (const PieceFeatures& piece : pieces) {
        all.push_back(&piece);
    }
    GenreTrainingPlan plan = small_plan();
    plan.rhythm.steps = plan.sound.steps = 20;
    const auto one = train_genres(all, genres_of(pieces, kOrder), plan);
    plan.mfcc.threads = 4;
    const auto four = train_genres(all, genres_of(pieces, kOrder), plan);
    ASSERT_TRUE(one && four);
    EXPECT_EQ(one->rhythm.hidden_weights, four->rhythm.hidden_weights);
    EXPECT_EQ(one->mfcc[1].means, four->mfcc[1].means);
    EXPECT_TRUE(validate(*one)) << validate(*one).error().message;
}

TEST(GenreTraining, branches_give_the_mean_of_the_weights_of_their_runs) {
    std::vector<PieceFeatures> made = made_pieces(3);
    std::vector<const PieceFeatures*> pieces;
    std::vector<std::size_t> classes;
    for (std::size_t i = 0; i < made.size(); ++i) {
        made[i].kind = PieceFeatures::Kind::written;
        pieces.push_back(&made[i]);
        classes.push_back(i / 3);
    }
    const auto unheard = [](const NetworkTrainingProgress&) {};
    NetworkTrainingPlan plan = small_plan().network;
    plan.written_steps = 2;
    plan.branch_steps = 2;
    const models::RecurrentNetwork start = train_on_written(pieces, classes, 4, plan, unheard);
    const auto branched = [&](int branches, std::uint64_t seed) {
        plan.branches = branches;
        plan.seed = seed;
        return average_branches(start, pieces, classes, plan, unheard);
    };
    // A run's draws come from the seed and its number.
    const models::RecurrentNetwork first = branched(1, 1);
    const models::RecurrentNetwork second = branched(1, 1'001);
    const models::RecurrentNetwork mean = branched(2, 1);
    EXPECT_FALSE(std::equal(
        first.parameters().begin(), first.parameters().end(), second.parameters().begin()));
    for (std::size_t i = 0; i < mean.parameters().size(); ++i) {
        EXPECT_FLOAT_EQ(mean.parameters()[i],
                        0.5F * first.parameters()[i] + 0.5F * second.parameters()[i]);
    }
}

TEST(GenreTraining, networks_begin_in_turn_with_draws_of_their_own) {
    NetworkTrainingPlan plan;
    plan.networks = 3;
    for (int i = 0; i < 2; ++i) {
        plan.starts.push_back(
            std::make_shared<const models::RecurrentNetwork>(models::RecurrentNetwork::Shape{}));
    }
    EXPECT_EQ(plan.of_network(0).seed, plan.seed);
    EXPECT_NE(plan.of_network(1).seed, plan.of_network(2).seed);
    EXPECT_EQ(plan.of_network(1).starts.front(), plan.starts[1]);
    EXPECT_EQ(plan.of_network(2).starts.front(), plan.starts[0]);
}

TEST(GenreTraining, a_silent_piece_has_no_scores) {
    const std::vector<PieceFeatures> pieces = made_pieces(2);
    std::vector<const PieceFeatures*> all;
    all.reserve(pieces.size());
    for (const PieceFeatures& piece : pieces) {
        all.push_back(&piece);
    }
    GenreTrainingPlan plan = small_plan();
    plan.rhythm.steps = plan.sound.steps = 5;
    const auto model = train_genres(all, genres_of(pieces, kOrder), plan);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(score_piece(*model, PieceFeatures{}, 0).empty());
    EXPECT_EQ(score_piece(*model, pieces[0], 0).size(), pieces[0].windows.size());
}

TEST(GenreTraining, too_little_sound_for_a_model_is_said) {
    const std::vector<PieceFeatures> pieces = made_pieces(1);
    std::vector<const PieceFeatures*> all = {&pieces[0]};
    GenreTrainingPlan plan = small_plan();
    plan.mfcc.frames = 50;
    const auto model = train_genres(all, genres_of(std::span(pieces).first(1), kOrder), plan);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().message,
              "salsa: 50 frames of sound, fewer than the 156 parameters of its model; add music or "
              "lower --states and --mixtures");
}

TEST(GenreTraining, pieces_read_back_and_cut_ones_are_refused) {
    const raks::test::TemporaryFolder folder;
    const std::vector<PieceFeatures> pieces = {made_piece("belly", 1)};
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
        raks::test::write_damaged(file, std::string_view(*bytes).substr(0, size));
        const auto cut = load_pieces(file);
        // Cut right behind the name of the format it holds nothing.
        EXPECT_TRUE(!cut || cut->empty()) << size;
    }
}

TEST(GenreTraining, folders_and_tables_name_what_is_wrong) {
    const raks::test::TemporaryFolder temporary;
    const fs::path& folder = temporary.path();
    fs::create_directories(folder / "latin");
    EXPECT_EQ(list_music(folder, *raks::test::shipped_dances()).error().message,
              folder.string() + ": holds no folder of music; it needs one a genre");
    ASSERT_TRUE(write_file(folder / "latin" / "a.wav", "x"));
    const auto files = list_music(folder, *raks::test::shipped_dances());
    ASSERT_TRUE(files);
    EXPECT_EQ(files->front().genre, "salsa");
    fs::create_directories(folder / "no_such_dance");
    ASSERT_TRUE(write_file(folder / "no_such_dance" / "a.wav", "x"));
    const auto refused = list_music(folder, *raks::test::shipped_dances());
    ASSERT_FALSE(refused);
    const std::string& fault = refused.error().message;
    EXPECT_TRUE(fault.starts_with(
        folder.string() +
        ": folder 'no_such_dance' must be named salsa (latin), belly (mideast), "))
        << fault;
    EXPECT_TRUE(fault.ends_with(" or other")) << fault;
    const fs::path table = folder / "index.tsv";
    ASSERT_TRUE(write_file(table, "clip\tgenre\tartist\na.wav\tlatin\n"));
    EXPECT_EQ(list_music(folder, table, *raks::test::shipped_dances()).error().message,
              table.string() + ": line 2: 2 columns, the first line has 3");
    ASSERT_TRUE(write_file(table, "clip\tartist\n"));
    EXPECT_EQ(list_music(folder, table, *raks::test::shipped_dances()).error().message,
              table.string() + ": line 1 names no column 'genre'");
    ASSERT_TRUE(write_file(table, "clip\tgenre\ttrain_ok\na.wav\twaltz\tno\n"));
    const auto listed = list_music(folder, table, *raks::test::shipped_dances());
    ASSERT_TRUE(listed);
    EXPECT_FALSE(listed->front().may_train);
    EXPECT_EQ(listed->front().genre, "waltz");
    ASSERT_TRUE(write_file(table,
                           "clip\tgenre\tartist\ttitle\tgroup\n"
                           "a.wav\twaltz\tAnna\tOne\ta game\n"));
    const auto grouped = list_music(folder, table, *raks::test::shipped_dances());
    ASSERT_TRUE(grouped);
    EXPECT_EQ(grouped->front().group, "a game");
    EXPECT_EQ(grouped->front().credit, "Anna, One") << "who made it, not where it is from";
}

TEST(GenreTraining, the_same_file_under_two_genres_is_said) {
    const raks::test::TemporaryFolder temporary;
    const fs::path& folder = temporary.path();
    for (const char* const genre : {"salsa", "rock"}) {
        fs::create_directories(folder / genre);
        ASSERT_TRUE(write_file(folder / genre / "a.wav", "the same"));
    }
    ASSERT_TRUE(write_file(folder / "rock" / "b.wav", "the same"));
    const auto files = list_music(folder, *raks::test::shipped_dances());
    ASSERT_TRUE(files);
    EXPECT_EQ(check_distinct(*files).error().message,
              (folder / "rock" / "a.wav").string() + " and " +
                  (folder / "salsa" / "a.wav").string() +
                  " are the same file under two genres; remove one");
    fs::remove(folder / "salsa" / "a.wav");
    EXPECT_TRUE(check_distinct(*list_music(folder, *raks::test::shipped_dances())))
        << "twice under one genre is only a waste";
}

}  // namespace

}  // namespace raks::audio
