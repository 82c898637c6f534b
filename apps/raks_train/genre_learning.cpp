#include "apps/raks_train/genre_learning.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "apps/raks_train/genre_features.hpp"
#include "apps/reports/genre_page.hpp"
#include "apps/terminal/say.hpp"
#include "audio/evaluate/genre_scores.hpp"
#include "audio/genre/genre_file.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "base/pending_file.hpp"
#include "training/genre/genre_trainer.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Scores of all windows of these pieces, piece by piece; the order does not depend on the threads.
std::vector<audio::WindowScore> scores_of(const audio::GenreModel& model,
                                          std::span<const audio::PieceFeatures> pieces,
                                          int threads) {
    // Each piece has a place of its own, whichever thread scores it.
    std::vector<std::vector<audio::WindowScore>> parts(pieces.size());
    run_parallel(pieces.size(), threads, [&](std::size_t i) {
        parts[i] = audio::score_piece(model, pieces[i], i);
    });
    std::vector<audio::WindowScore> scores;
    for (auto& part : parts) {
        std::move(part.begin(), part.end(), std::back_inserter(scores));
    }
    return scores;
}

// Weights that an earlier run stored; null when the file is missing or of another size than this
// network's weights.
std::shared_ptr<const models::RecurrentNetwork> load_weights(
    const std::filesystem::path& path,
    std::size_t classes,
    const audio::NetworkTrainingPlan& plan) {
    auto network = std::make_shared<models::RecurrentNetwork>(models::RecurrentNetwork::Shape{
        audio::NetworkInput::kSize, plan.units, plan.layers, classes});
    const std::span<float> weights = network->parameters();
    const auto bytes = read_file(path, weights.size_bytes());
    if (!bytes || bytes->size() != weights.size_bytes()) {
        return nullptr;
    }
    std::memcpy(weights.data(), bytes->data(), bytes->size());
    return network;
}

// The network whose weights the cache holds under this name, or the one that `learn(report)`
// trains, which is then stored.
template <class Learn>
std::shared_ptr<const models::RecurrentNetwork> learnt_once(const GenreOptions& options,
                                                            const std::string& name,
                                                            std::size_t classes,
                                                            const Learn& learn) {
    const std::filesystem::path kept = options.cache / (name + ".weights");
    if (!options.cache.empty()) {
        if (auto known = load_weights(kept, classes, options.plan.network)) {
            return known;
        }
    }
    // Progress with the time left, by the mean time of a step so far.
    const auto start = std::chrono::steady_clock::now();
    const audio::ReportNetwork report = [&](const audio::NetworkTrainingProgress& now) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        say(fmt::format(
            "network: step {} of {}, loss {:.3f}, {:.3f} of pieces not learnt from, {:.0f} s left",
            now.step,
            now.steps,
            now.training_loss,
            now.validation_loss,
            spent.count() * (now.steps - now.step) / now.step));
    };
    auto network = std::make_shared<const models::RecurrentNetwork>(learn(report));
    // A cache that cannot be written costs the next run time and nothing else.
    if (!options.cache.empty()) {
        const auto weights = network->parameters();
        static_cast<void>(write_file(
            kept, {reinterpret_cast<const char*>(weights.data()), weights.size_bytes()}));
    }
    return network;
}

}  // namespace

std::vector<std::shared_ptr<const models::RecurrentNetwork>> written_networks(
    const GenreOptions& options,
    const GenreMaterial& material,
    const std::vector<std::string>& genres) {
    std::vector<const audio::PieceFeatures*> pieces;
    std::vector<std::size_t> classes;
    const auto hash_with = [](std::span<const float> values, std::uint64_t hash) {
        return hash_of({reinterpret_cast<const char*>(values.data()), values.size_bytes()}, hash);
    };
    // Hash of the written music's features: the cached weights belong to exactly that music.
    std::uint64_t music = hash_of("");
    for (const audio::PieceFeatures& piece : material.pieces) {
        pieces.push_back(&piece);
        classes.push_back(audio::class_of(piece.genre, genres));
        // Recordings are in the list, too, but this training leaves them out.
        if (!piece.is_recorded()) {
            music = hash_with(piece.mel, music);
        }
    }
    // Each network is trained with a start and draws of its own.
    std::vector<std::shared_ptr<const models::RecurrentNetwork>> networks;
    for (int number = 0; number < options.plan.network.networks; ++number) {
        const audio::NetworkTrainingPlan plan =
            options.plan.network.of_network(static_cast<std::size_t>(number));
        // A network that goes on from given weights depends on those, too.
        const std::uint64_t learnt_from =
            plan.starts.empty() ? music : hash_with(plan.starts.front()->parameters(), music);
        // All that the training depends on stands in the name; one class more is "unknown".
        const std::string run = fmt::format("network-{}-{}x{}-{}-{}-{}-{:016x}{}",
                                            genres.size() + 1,
                                            plan.layers,
                                            plan.units,
                                            plan.written_steps,
                                            pieces.size(),
                                            plan.seed,
                                            learnt_from,
                                            without(options.augmentation.effects));
        auto learnt = learnt_once(options, run, genres.size() + 1, [&](const auto& report) {
            return audio::train_on_written(pieces, classes, genres.size() + 1, plan, report);
        });
        // Branches go on from the trained weights; the mean of their weights replaces them. Stored
        // apart, so that the number of branches can change without training anew.
        if (plan.branches > 1) {
            const std::string name = fmt::format("{}-{}x{}", run, plan.branches, plan.branch_steps);
            learnt = learnt_once(options, name, genres.size() + 1, [&](const auto& report) {
                return audio::average_branches(*learnt, pieces, classes, plan, report);
            });
        }
        networks.push_back(std::move(learnt));
    }
    return networks;
}

namespace {

// Features of recordings after each kind of damage, one kind after the other.
struct DamagedMusic {
    std::vector<audio::PieceFeatures> pieces;
    std::vector<audio::Damage> damages;  // of each piece
};

// Features of the damaged recordings, of those alone that the undamaged material has: a file that
// was left out there must not be judged.
DamagedMusic extract_damaged(const GenreOptions& options,
                             const GenreMaterial& material,
                             const audio::FeaturePlan& feature_plan) {
    std::set<std::string> known;
    for (const audio::PieceFeatures& piece : material.pieces) {
        if (piece.is_recorded()) {
            known.insert(piece.name);
        }
    }
    DamagedMusic music;
    // Damage 0 is none.
    for (std::size_t number = 1; number < std::size(audio::kDamageNames); ++number) {
        const auto damage = static_cast<audio::Damage>(number);
        for (audio::FeatureUnit& unit :
             extract_recordings(material.files, options, feature_plan, damage)) {
            // A damage may fail for one recording: the others are judged all the same.
            if (!unit.fault.empty()) {
                say(fmt::format("not judged with {}: {}", audio::kDamageNames[number], unit.fault));
            }
            for (audio::PieceFeatures& piece : unit.pieces) {
                if (known.contains(piece.name)) {
                    music.pieces.push_back(std::move(piece));
                    music.damages.push_back(damage);
                }
            }
        }
    }
    return music;
}

// Names of the recordings that do not count in the tables: those whose label is not among
// options.judged_labels.
std::set<std::string> unjudged(const GenreOptions& options, const GenreMaterial& material) {
    std::set<std::string> names;
    for (const audio::MusicFile& file : material.files) {
        const std::string& labels = options.validation.judged_labels;
        if (!labels.empty() && labels.find(file.label) == std::string::npos) {
            names.insert(file.name);
        }
    }
    return names;
}

}  // namespace

Expected<std::vector<audio::WindowScore>> validate_by_group(
    const GenreOptions& options,
    const GenreMaterial& material,
    const audio::FeaturePlan& feature_plan,
    const std::vector<std::string>& genres) {
    const std::vector<audio::PieceFeatures>& pieces = material.pieces;
    // Damaged recordings are scored by the same models as the undamaged ones, in the same folds.
    const DamagedMusic damaged = options.validation.judges_damage
                                     ? extract_damaged(options, material, feature_plan)
                                     : DamagedMusic{};
    const auto scores =
        audio::cross_validate(pieces, damaged.pieces, genres, options.plan, [](int done, int all) {
            say(fmt::format("validation: fold {} of {}", done, all));
        });
    if (!scores) {
        return fail(scores.error());
    }
    // Scores are divided by what they are used for: the undamaged ones fit the final fusion, and
    // the tables are of recordings by kind of damage.
    const std::set<std::string> left_out = unjudged(options, material);
    std::vector<audio::WindowScore> undamaged;
    std::map<audio::Damage, std::vector<audio::WindowScore>> recorded;
    for (const audio::WindowScore& score : *scores) {
        // Damaged pieces are numbered after the undamaged ones.
        const bool is_damaged = score.piece >= pieces.size();
        const std::size_t number = is_damaged ? score.piece - pieces.size() : score.piece;
        const audio::PieceFeatures& piece = is_damaged ? damaged.pieces[number] : pieces[number];
        if (!is_damaged) {
            undamaged.push_back(score);
        }
        if (piece.kind == audio::PieceFeatures::Kind::recorded && !left_out.contains(piece.name)) {
            recorded[is_damaged ? damaged.damages[number] : audio::Damage::none].push_back(score);
        }
    }
    // With written music alone there are no tables by artist.
    if (recorded.empty()) {
        return undamaged;
    }
    // Genres with too few recordings are not judged.
    const auto asked = enough_recordings(pieces, genres);
    // The fusions are fitted to undamaged scores alone, as those of the finished model are.
    const FoldFusions fusions(undamaged, genres.size() + 1, options.threads);
    for (const auto& [damage, judged_scores] : recorded) {
        const JudgedScores judged{judged_scores, fusions, nullptr, options.validation.pair};
        // The page shows the undamaged recordings.
        const bool is_clean = damage == audio::Damage::none;
        GenrePage page =
            page_of(is_clean ? "recordings, by artist"
                             : fmt::format("recordings, by artist, {}",
                                           audio::kDamageNames[static_cast<std::size_t>(damage)]),
                    judged,
                    genres,
                    asked);
        // The tables go to stdout for every damage.
        print_page(page, asked);
        if (is_clean && !options.validation.report.empty()) {
            page.files = judged_files(pieces, judged, genres, asked);
            if (auto saved = write_file(options.validation.report, draw_genre_page(page)); !saved) {
                return fail(saved.error());
            }
        }
    }
    return undamaged;
}

Expected<void> test_on_written(const GenreOptions& options,
                               const audio::FeaturePlan& feature_plan,
                               const audio::GenreModel& model) {
    using Families = audio::WrittenCorpusPlan::Families;
    // One test: written pieces without augmentation, scored by the model and printed.
    const auto test = [&](const std::string& name,
                          const auto& soundfonts,
                          Families families,
                          std::uint64_t seed) -> Expected<void> {
        auto pieces = written(options,
                              feature_plan,
                              name,
                              {.soundfonts = soundfonts,
                               .families = families,
                               .pieces = options.written_test.pieces,
                               .seed = seed,
                               .augmentation = audio::WrittenCorpusPlan::Augmentation::off,
                               .feature_plan = {}});
        if (!pieces) {
            return fail(pieces.error());
        }
        // All genres: written music has enough of each.
        const auto asked = all_genres(model.genres.size());
        const auto scores = scores_of(model, *pieces, options.threads);
        const FoldFusions fusions(scores, model.classes(), options.threads);
        print_page(
            page_of(name, {scores, fusions, &model, options.validation.pair}, model.genres, asked),
            asked);
        return {};
    };
    // Seeds beyond those of training: pieces that were never written before.
    const std::uint64_t seed = options.seed + 500;
    // Families of arrangements that training left out have a test of their own.
    const Families known = options.written.leaves_out_families ? Families::always : Families::all;
    if (auto ok =
            test("written, new seeds, soundfonts heard", options.written.soundfonts, known, seed);
        !ok) {
        return ok;
    }
    if (options.written.leaves_out_families) {
        if (auto ok = test("written, rhythms never heard",
                           options.written.soundfonts,
                           Families::held_out,
                           seed + 1);
            !ok) {
            return ok;
        }
    }
    // Sounds that training never used: does the model know the music or its soundfonts?
    if (!options.written_test.soundfonts.empty()) {
        return test(
            "written, soundfont never heard", options.written_test.soundfonts, known, seed + 2);
    }
    return {};
}

namespace {

// How a sample names the features that it was computed with.
std::string text_of(const audio::FeaturePlan& feature_plan, const audio::GenreFeatures& features) {
    return fmt::format("{:016x}", feature_key(feature_plan, features));
}

}  // namespace

Expected<GenreBase> load_base(const std::filesystem::path& model) {
    auto loaded = audio::load_genre(model);
    if (!loaded) {
        return fail(loaded.error());
    }
    // The sample lies beside the model under a name made from the model's.
    const std::filesystem::path beside = audio::samples_path(model);
    std::error_code ignored;
    if (!std::filesystem::exists(beside, ignored)) {
        return fail(fmt::format(
            "{}: is not there: what {} was learnt from was not kept; train it again with all its "
            "music",
            beside.string(),
            model.filename().string()));
    }
    // The sample stands in for the music of the old genres in the training.
    auto samples = audio::load_samples(beside);
    if (!samples) {
        return fail(samples.error());
    }
    // A sample of other genres would label its pieces wrongly.
    if (samples->genres != (*loaded)->genres) {
        return fail(fmt::format("{}: is of another model than {}; train it again",
                                beside.string(),
                                model.filename().string()));
    }
    return GenreBase{std::move(*loaded), std::move(*samples)};
}

Expected<void> check_features(const GenreBase& base,
                              const std::filesystem::path& model,
                              const audio::FeaturePlan& feature_plan) {
    // Features of two kinds in one training would separate the genres by their kind.
    if (base.samples.feature_key != text_of(feature_plan, base.model->features)) {
        return fail(audio::samples_path(model).string() +
                    ": was made with other features or another beat network than this program "
                    "has; train the model again");
    }
    return {};
}

void keep_known(const GenreBase& base,
                const std::set<std::string>& renewed,
                audio::GenreModel& model) {
    // Genres are matched by name: the new model may number them otherwise.
    for (std::size_t i = 0; i < model.genres.size(); ++i) {
        const std::size_t known = audio::class_of(model.genres[i], base.model->genres);
        if (known < base.model->genres.size() && !renewed.contains(model.genres[i])) {
            model.mfcc[i] = base.model->mfcc[known];
        }
    }
}

Expected<void> keep_samples(const GenreOptions& options,
                            const audio::FeaturePlan& feature_plan,
                            std::span<const std::string> genres,
                            std::span<const audio::PieceFeatures* const> pieces) {
    if (options.sample_kilobytes == 0 || options.output.empty()) {
        return {};
    }
    // The option is in kilobytes of 1,000 bytes.
    const auto bytes = static_cast<std::size_t>(options.sample_kilobytes) * 1'000;
    const audio::GenreSamples samples{text_of(feature_plan, options.plan.features),
                                      {genres.begin(), genres.end()},
                                      options.plan.written_networks,
                                      audio::sample_pieces(pieces, genres, bytes, options.seed)};
    return audio::save_samples(samples, audio::samples_path(options.output));
}

}  // namespace raks::apps
