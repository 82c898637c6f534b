// `raks train genre`.
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks_train/genre_learning.hpp"
#include "apps/raks_train/genre_material.hpp"
#include "apps/raks_train/installed_styles.hpp"
#include "apps/raks_train/kept_songs.hpp"
#include "apps/raks_train/tagger_learning.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/say.hpp"
#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/io/lossy_codec.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "training/genre/network_trainer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

std::string attribution_of(const GenreMaterial& material,
                           const RecordingOptions& recordings,
                           const WrittenMusicOptions& written) {
    std::set<std::string> credits;
    for (const audio::MusicFile& file : material.files) {
        if (!file.credit.empty() && (file.may_train || !recordings.trains_on_free_alone)) {
            credits.insert(file.credit);
        }
    }
    const char* const beats =
        written.beats_corpus.empty()
            ? ""
            : "Music of the beat network's training: Google's Groove MIDI Dataset (CC-BY-4.0), "
              "OpenScore Lieder (CC0-1.0), patterns of our own. ";
    return fmt::format("{}{}{}", material.written_with, beats, fmt::join(credits, "; "));
}

/// Pieces that the final model may learn from.
std::vector<const audio::PieceFeatures*> free_pieces(const RecordingOptions& recordings,
                                                     const GenreMaterial& material) {
    std::set<std::string> barred;
    for (const audio::MusicFile& file : material.files) {
        if (!file.may_train && recordings.trains_on_free_alone) {
            barred.insert(file.name);
        }
    }
    std::vector<const audio::PieceFeatures*> free;
    for (const audio::PieceFeatures& piece : material.pieces) {
        if (!barred.contains(piece.name)) {
            free.push_back(&piece);
        }
    }
    return free;
}

/// Leaves lossy codecs out, and says so, where FFmpeg cannot encode.
void leave_out_missing_codecs(AugmentationOptions& augmentation) {
    for (const auto codec : {audio::LossyCodec::mp3, audio::LossyCodec::opus}) {
        std::vector<float> silence(4'410);
        const auto passed = audio::pass_lossy_codec(codec, 44'100, 64'000, silence);
        if (!passed && augmentation.effects.has(audio::SoundEffect::codec)) {
            say(passed.error().message + "; goes on without lossy codecs");
            augmentation.effects.leave_out(audio::SoundEffect::codec);
        }
    }
}

/// What can be known to be wrong before hours of work; makes the cache's folder.
Expected<void> check_options(GenreOptions& options) {
    if (!options.shards.share_text.empty()) {
        auto share = audio::parse_shard_number(options.shards.share_text);
        if (!share) {
            return fail(share.error());
        }
        options.shards.share = *share;
    }
    if (options.output.empty() && !(options.shards.share_text.empty() && options.add_to.empty() &&
                                    options.tagger_for.empty() && !options.adds_kept)) {
        return fail(
            "--shard, --add, --add-to and --tagger-for need -o FILE: where to keep what they make");
    }
    if (options.adds_kept && !options.recordings.folder.empty() && !options.tagger_for.empty()) {
        return fail(
            "--add with --tagger-for adapts to the songs that you kept alone: name no folder");
    }
    if (options.validation.judges_damage &&
        (options.recordings.folder.empty() || options.validation.is_skipped)) {
        return fail("--damage needs a folder of recordings and the validation: it is a part of it");
    }
    if (!options.output.empty()) {
        std::vector<std::filesystem::path> inputs = options.shards.merged;
        inputs.insert(
            inputs.end(), options.written.soundfonts.begin(), options.written.soundfonts.end());
        inputs.insert(inputs.end(), {options.recordings.index, options.written.beats_corpus});
        if (auto checked = check_output(options.output, inputs); !checked) {
            return checked;
        }
    }
    if (!options.cache.empty()) {
        std::error_code error;
        std::filesystem::create_directories(options.cache, error);
        if (error) {
            return fail(options.cache.string() +
                        ": no folder can be made here: " + error.message());
        }
    }
    leave_out_missing_codecs(options.augmentation);
    if (!options.augmentation.effects.has(audio::SoundEffect::room)) {
        options.plan.network.room_chance = 0.0;
    }
    if (!options.augmentation.effects.has(audio::SoundEffect::band)) {
        options.plan.network.muffled_chance = 0.0;
    }
    return {};
}

/// Learns, and keeps the model and its sample. `base`: what is added to, or none.
Expected<void> learn(GenreOptions& options,
                     const audio::FeaturePlan& feature_plan,
                     const GenreBase* base,
                     const std::string& command) {
    auto material = gather(options, feature_plan);
    if (!material) {
        return fail(material.error());
    }
    std::set<std::string> renewed;
    for (const audio::PieceFeatures& piece : material->pieces) {
        renewed.insert(piece.genre);
    }
    if (base != nullptr) {
        const auto& kept = base->samples.pieces;
        material->pieces.insert(material->pieces.begin(), kept.begin(), kept.end());
    }
    const std::clock_t start = std::clock();
    const std::vector<std::string> genres =
        audio::genres_of(material->pieces, options.dances->names());
    options.plan.written_networks =
        base != nullptr
            ? audio::with_outputs(base->samples.written_networks, base->samples.genres, genres)
            : written_networks(options, *material, genres);
    std::vector<audio::WindowScore> held_out;
    if (!options.validation.is_skipped) {
        auto scores = validate_by_group(options, *material, feature_plan, genres);
        if (!scores) {
            return fail(scores.error());
        }
        held_out = std::move(*scores);
    }
    const std::clock_t validated = std::clock();
    const auto pieces = free_pieces(options.recordings, *material);
    auto model = audio::train_genres(pieces, genres, options.plan);
    if (!model) {
        return fail(model.error());
    }
    say(
        fmt::format("learnt in {:.1f} s of computing, after {:.1f} s to learn from written music "
                    "and to validate",
                    static_cast<double>(std::clock() - validated) / CLOCKS_PER_SEC,
                    static_cast<double>(validated - start) / CLOCKS_PER_SEC));
    audio::calibrate(held_out, *model);
    model->made_with = command;
    model->attribution = attribution_of(*material, options.recordings, options.written);
    if (base != nullptr) {
        keep_known(*base, renewed, *model);
        model->fusion = held_out.empty() ? base->model->fusion : model->fusion;
        model->made_with = base->model->made_with + "; " + command;
        const std::string& known = base->model->attribution;
        const bool are_both = !known.empty() && !model->attribution.empty();
        model->attribution = known + (are_both ? "; " : "") + model->attribution;
    }
    if (!options.output.empty()) {
        if (auto saved = audio::save_genre(*model, options.output); !saved) {
            return saved;
        }
        if (auto saved = keep_samples(options, feature_plan, genres, pieces); !saved) {
            return saved;
        }
    }
    const bool is_tested = options.written.pieces > 0 && options.written_test.pieces > 0;
    return is_tested ? test_on_written(options, feature_plan, *model) : Expected<void>{};
}

/// `skipped`: how many songs that a person kept cannot be learnt from.
Expected<void> run(GenreOptions& options, const std::string& command, std::size_t& skipped) {
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    options.dances = catalogue->list();
    options.validation.pair = catalogue->pair();
    if (auto checked = check_options(options); !checked) {
        return checked;
    }
    if (options.adds_kept) {
        auto kept = kept_songs(*options.dances);
        if (!kept) {
            return fail(kept.error());
        }
        options.recordings.kept = std::move(kept->files);
        skipped = kept->skipped;
    }
    if (options.adds_kept && options.recordings.folder.empty() && options.add_to.empty() &&
        options.written.pieces == 0) {
        const auto left_out = adapt_to_kept(options, command);
        skipped += left_out.value_or(0);
        return left_out ? Expected<void>() : fail(left_out.error());
    }
    if (!options.tagger_for.empty()) {
        return learn_tagger(options, command);
    }
    auto network = engine::load_beat_network();
    if (!network) {
        return fail(network.error());
    }
    options.plan.network.starts = {*network};
    for (const auto& other : (*network)->others()) {
        options.plan.network.starts.push_back(other);
    }
    std::optional<GenreBase> base;
    if (!options.add_to.empty()) {
        auto loaded = load_base(options.add_to);
        if (!loaded) {
            return fail(loaded.error());
        }
        base = std::move(*loaded);
        options.plan.features = base->model->features;
    }
    if (options.written.pieces > 0 || !options.written.beats_corpus.empty()) {
        auto styles = load_installed_styles();
        if (!styles) {
            return fail(styles.error());
        }
        options.written.styles = std::move(*styles);
    }
    const audio::FeaturePlan feature_plan{*network, options.plan.features.cepstral_mean};
    if (!options.shards.share_text.empty()) {
        return write_shard(options, feature_plan, command);
    }
    if (base) {
        if (auto fits = check_features(*base, options.add_to, feature_plan); !fits) {
            return fits;
        }
    }
    return learn(options, feature_plan, base ? &*base : nullptr, command);
}

/// What several stages share of what was asked for.
void spread_options(GenreOptions& options) {
    options.plan.mfcc.threads = options.plan.network.threads = options.threads;
    options.plan.mfcc.seed = options.plan.rhythm.seed = options.plan.sound.seed =
        options.plan.network.seed = options.seed;
    options.plan.mfcc.recorded_share = options.plan.sound.recorded_share =
        options.plan.rhythm.recorded_share;
    if (options.leaves_out_energy) {
        options.plan.features.energy = audio::GenreFeatures::Energy::left_out;
    }
}

}  // namespace

ExitCode train_genre(GenreOptions options, const std::string& command) {
    spread_options(options);
    std::size_t skipped = 0;
    ExitCode code = exit_code_of(run(options, command, skipped));
    if (!code || *code != kExitDone || skipped == 0) {
        return code;
    }
    say(fmt::format("{} kept songs skipped", skipped));
    return kExitPartly;
}

}  // namespace raks::apps
