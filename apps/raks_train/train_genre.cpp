// `raks train genre`.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks_train/commands.hpp"
#include "apps/raks_train/genre_adding.hpp"
#include "apps/raks_train/genre_learning.hpp"
#include "apps/raks_train/genre_material.hpp"
#include "apps/raks_train/installed_styles.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/say.hpp"
#include "audio/beat/network/network_file.hpp"
#include "audio/genre/genre_file.hpp"
#include "audio/genre/genre_scorer.hpp"
#include "audio/io/lossy_codec.hpp"
#include "base/file.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "training/genre/network_outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

void add_options(CLI::App& app, GenreOptions& options) {
    app.add_option("folder", options.folder, "of music: one folder a genre");
    app.add_option("--groups",
                   options.index,
                   "table of the folder's clips: clip, genre; artist, label, train_ok if known");
    app.add_option("-o,--out", options.output, "X.json");
    app.add_option(
           "--synthesize", options.synthesize, "pieces of music to write, play and learn from")
        ->check(in_range(0, 100'000));
    app.add_option(
           "--edition",
           options.edition,
           "of the written music; 1: without quarter tones, oud and lossy codecs; 2: without "
           "bands of several soundfonts; 3: without sounds drawn for each piece")
        ->check(in_range(1, 4));
    app.add_option(
        "--soundfont", options.soundfonts, "SF2 or SF3 to play it with; one is drawn a piece");
    app.add_option("--test-soundfont",
                   options.test_soundfonts,
                   "report how music played with these is heard; not learnt from");
    app.add_option("--test-pieces", options.test_pieces, "of each kind of written test; 0: none")
        ->check(in_range(0, 10'000));
    app.add_option("--beats-corpus",
                   options.beats_corpus,
                   "music that `raks train beats --corpus` kept: the network learns from it, too");
    app.add_option("--cache", options.cache, "folder that keeps what was heard between runs");
    app.add_option("--add-to",
                   options.add_to,
                   "MODEL.json: learn the folder's genres beside those it knows, from the sample "
                   "that was kept of their music");
    app.add_option("--samples",
                   options.sample_kilobytes,
                   "kB a genre that are kept of the music beside the model, for --add-to; 0: none")
        ->check(in_range(0, static_cast<int>(audio::kMostSampleBytes / 1'000)));
    app.add_option("--shard",
                   options.share_text,
                   "i/n: hear share i of n into -o FILE, for `raks train genre merge`");
    app.add_option("--report", options.report, "X.html: how recordings are told apart, by artist");
    app.add_option("--leave-out", options.left_out, "genres not to learn");
    app.add_flag("--leave-out-families",
                 options.leaves_out_families,
                 "do not learn from one or two rhythms a genre, but test with them");
    app.add_flag("--free-only",
                 options.trains_on_free_alone,
                 "learn only from clips whose train_ok is yes (validation uses all)");
    app.add_option("--labels",
                   options.judged_labels,
                   "judge by clips with one of these labels alone (AB: not those whose genre is a "
                   "guess); learns from all");
    app.add_flag("--damage",
                 options.judges_damage,
                 "validate with recordings in noise, a room and so on, too: what each costs");
    app.add_flag("--no-validation", options.skips_validation, "keep the default fusion");
    app.add_flag("--strict", options.is_strict, "a file that cannot be read is an error");
    app.add_flag("--no-energy", options.leaves_out_energy, "without C0 and its derivatives");
    app.add_option(
           "--altered", options.altered, "damaged copies of each recording to learn from; 0: none")
        ->check(in_range(0, 50));
    app.add_option("--without",
                   options.left_out_effects,
                   "what is not to happen to music: " +
                       fmt::format("{}", fmt::join(audio::kSoundEffectNames, ", ")))
        ->check(one_of({std::begin(audio::kSoundEffectNames), std::end(audio::kSoundEffectNames)}));
    app.add_option("--states", options.plan.mfcc.states, "of each genre's HMM")
        ->check(in_range(1, 16));
    app.add_option("--mixtures", options.plan.mfcc.mixtures, "Gaussians a state")
        ->check(in_range(1, 64));
    app.add_option(
           "--similarity", options.plan.mfcc.similarity_rounds, "rounds of inter-genre similarity")
        ->check(in_range(0, 5));
    app.add_option("--units", options.plan.rhythm.units, "of the rhythm network")
        ->check(in_range(2, 128));
    app.add_option("--steps", options.plan.rhythm.steps, "of its training")
        ->check(in_range(10, 1'000'000));
    app.add_option("--networks",
                   options.plan.network.networks,
                   "recurrent networks that learn each by itself and are heard together")
        ->check(in_range(1, static_cast<int>(audio::GenreScorer::kMostNetworks)));
    app.add_option(
           "--network-units", options.plan.network.units, "of each layer of the recurrent network")
        ->check(in_range(4, 128));
    app.add_option("--network-steps",
                   options.plan.network.written_steps,
                   "of its training on written music: batches of 24 x 10 s")
        ->check(in_range(1, 1'000'000));
    app.add_option("--network-branches",
                   options.plan.network.branches,
                   "runs that go on from there by themselves; the mean of their weights is taken")
        ->check(in_range(0, 100));
    app.add_option("--branch-steps", options.plan.network.branch_steps, "of each of them")
        ->check(in_range(1, 1'000'000));
    app.add_option("--tuning-steps",
                   options.plan.network.tuning_steps,
                   "more of them with recordings among it")
        ->check(in_range(0, 1'000'000));
    app.add_option("--network-recorded-share",
                   options.plan.network.recorded_share,
                   "of what these are drawn from")
        ->check(in_range(0.0, 1.0));
    app.add_option("--recorded-share",
                   options.plan.rhythm.recorded_share,
                   "of what is drawn, where there are recordings and written music")
        ->check(in_range(0.0, 1.0));
    app.add_option("--folds", options.plan.folds)->check(in_range(2, 20));
    app.add_option("--seed", options.seed, "same seed, same model");
    app.add_option("--threads", options.threads)->check(in_range(1, 64));
}

std::string attribution_of(const GenreMaterial& material, const GenreOptions& options) {
    std::set<std::string> credits;
    for (const audio::MusicFile& file : material.files) {
        if (!file.credit.empty() && (file.may_train || !options.trains_on_free_alone)) {
            credits.insert(file.credit);
        }
    }
    const char* const beats =
        options.beats_corpus.empty()
            ? ""
            : "Music of the beat network's training: Google's Groove MIDI Dataset (CC-BY-4.0), "
              "OpenScore Lieder (CC0-1.0), patterns of our own. ";
    return fmt::format("{}{}{}", material.written_with, beats, fmt::join(credits, "; "));
}

/// Pieces that the final model may learn from.
std::vector<const audio::PieceFeatures*> free_pieces(const GenreOptions& options,
                                                     const GenreMaterial& material) {
    std::set<std::string> barred;
    for (const audio::MusicFile& file : material.files) {
        if (!file.may_train && options.trains_on_free_alone) {
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

/// Which effects may happen; says it once where FFmpeg cannot encode.
void choose_effects(GenreOptions& options) {
    for (const std::string& name : options.left_out_effects) {
        const auto* const known = std::find(
            std::begin(audio::kSoundEffectNames), std::end(audio::kSoundEffectNames), name);
        options.effects.leave_out(
            static_cast<audio::SoundEffect>(known - std::begin(audio::kSoundEffectNames)));
    }
    for (const auto codec : {audio::LossyCodec::mp3, audio::LossyCodec::opus}) {
        std::vector<float> silence(4'410);
        const auto passed = audio::pass_lossy_codec(codec, 44'100, 64'000, silence);
        if (!passed && options.effects.has(audio::SoundEffect::codec)) {
            say(passed.error().message + "; goes on without lossy codecs");
            options.effects.leave_out(audio::SoundEffect::codec);
        }
    }
}

/// What can be known to be wrong before hours of work; makes the cache's folder.
Expected<void> check_options(GenreOptions& options) {
    if (!options.share_text.empty()) {
        auto share = audio::parse_shard_number(options.share_text);
        if (!share) {
            return fail(share.error());
        }
        options.share = *share;
    }
    if (options.output.empty() && !(options.share_text.empty() && options.add_to.empty())) {
        return fail("--shard and --add-to need -o FILE: where to keep what they make");
    }
    if (options.judges_damage && (options.folder.empty() || options.skips_validation)) {
        return fail("--damage needs a folder of recordings and the validation: it is a part of it");
    }
    if (!options.output.empty()) {
        std::vector<std::filesystem::path> inputs = options.shards;
        inputs.insert(inputs.end(), options.soundfonts.begin(), options.soundfonts.end());
        inputs.insert(inputs.end(), {options.index, options.beats_corpus});
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
    choose_effects(options);
    if (!options.effects.has(audio::SoundEffect::room)) {
        options.plan.network.room_chance = 0.0;
    }
    if (!options.effects.has(audio::SoundEffect::band)) {
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
    if (!options.skips_validation) {
        auto scores = validate_by_group(options, *material, feature_plan, genres);
        if (!scores) {
            return fail(scores.error());
        }
        held_out = std::move(*scores);
    }
    const std::clock_t validated = std::clock();
    const auto pieces = free_pieces(options, *material);
    auto model = audio::train_genres(pieces, genres, options.plan);
    if (!model) {
        return fail(model.error());
    }
    std::fprintf(stderr,
                 "raks: learnt in %.1f s of computing, after %.1f s to learn from written music "
                 "and to validate\n",
                 static_cast<double>(std::clock() - validated) / CLOCKS_PER_SEC,
                 static_cast<double>(validated - start) / CLOCKS_PER_SEC);
    audio::calibrate(held_out, *model);
    model->made_with = command;
    model->attribution = attribution_of(*material, options);
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
    const bool is_tested = options.synthesize > 0 && options.test_pieces > 0;
    return is_tested ? test_on_written(options, feature_plan, *model) : Expected<void>{};
}

Expected<void> run(GenreOptions& options, const std::string& command) {
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    options.dances = catalogue->list();
    options.pair = catalogue->pair();
    if (auto checked = check_options(options); !checked) {
        return checked;
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
    if (options.synthesize > 0 || !options.beats_corpus.empty()) {
        auto styles = load_installed_styles();
        if (!styles) {
            return fail(styles.error());
        }
        options.styles = std::move(*styles);
    }
    const audio::FeaturePlan feature_plan{*network, options.plan.features.cepstral_mean};
    if (!options.share_text.empty()) {
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

void add_train_genre(CommandTable& table, const std::string& command) {
    auto options = std::make_shared<GenreOptions>();
    CLI::App& app = *table.app().add_subcommand("genre", "learn to tell dances apart from music");
    add_options(app, *options);
    CLI::App* const merge = app.add_subcommand("merge", "learn from the shards of --shard");
    merge->fallthrough();
    merge->add_option("shards", options->shards, "of all shares")->required();
    app.callback([&table, options, command] {
        spread_options(*options);
        table.choose([options, command] { return exit_code_of(run(*options, command)); });
    });
}

}  // namespace raks::apps
