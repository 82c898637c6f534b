// The options of `raks train genre`.
#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "apps/raks_train/genre_options.hpp"
#include "apps/raks_train/train_command_table.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/option_checks.hpp"
#include "audio/genre/genre_scorer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

void add_options(CLI::App& app, RecordingOptions& recordings) {
    app.add_option("folder", recordings.folder, "folder of music, with one folder for each genre");
    app.add_option(
        "--groups",
        recordings.index,
        "table of the folder's clips: clip, genre; artist, group, label, train_ok if known");
    app.add_option("--leave-out", recordings.left_out_genres, "genres not to learn");
    app.add_flag("--free-only",
                 recordings.trains_on_free_alone,
                 "learn only from clips whose train_ok is yes (validation uses all)");
    app.add_flag("--strict", recordings.is_strict, "a file that cannot be read is an error");
}

void add_options(CLI::App& app, WrittenMusicOptions& written) {
    app.add_option("--synthesize", written.pieces, "pieces of music to write, play and learn from")
        ->check(in_range(0, 100'000));
    app.add_option(
           "--edition",
           written.edition,
           "edition of the written music; 1: without quarter tones, oud and lossy codecs; 2: "
           "without bands of several soundfonts; 3: without sounds drawn for each piece")
        ->check(in_range(1, 4));
    app.add_option(
        "--soundfont", written.soundfonts, "SF2 or SF3 to play it with; one is drawn a piece");
    app.add_option("--beats-corpus",
                   written.beats_corpus,
                   "music that `raks train beats --corpus` kept: the network learns from it, too");
    app.add_flag("--leave-out-families",
                 written.leaves_out_families,
                 "do not learn from one or two rhythms a genre, but test with them");
}

void add_options(CLI::App& app, WrittenTestOptions& test) {
    app.add_option("--test-soundfont",
                   test.soundfonts,
                   "report the scores of music played with these; not learnt from");
    app.add_option("--test-pieces", test.pieces, "pieces of each kind of written test; 0: none")
        ->check(in_range(0, 10'000));
}

// `name`: one of kSoundEffectNames.
audio::SoundEffect sound_effect_of(const std::string& name) {
    const auto* const known =
        std::find(std::begin(audio::kSoundEffectNames), std::end(audio::kSoundEffectNames), name);
    return static_cast<audio::SoundEffect>(known - std::begin(audio::kSoundEffectNames));
}

void add_options(CLI::App& app, AugmentationOptions& augmentation) {
    app.add_option("--altered",
                   augmentation.copies,
                   "damaged copies of each recording to learn from; 0: none")
        ->check(in_range(0, 50));
    app.add_option_function<std::vector<std::string>>(
           "--without",
           [&effects = augmentation.effects](const std::vector<std::string>& names) {
               for (const std::string& name : names) {
                   effects.leave_out(sound_effect_of(name));
               }
           },
           fmt::format("damage that is not done to the music: {}",
                       fmt::join(audio::kSoundEffectNames, ", ")))
        ->check(one_of({std::begin(audio::kSoundEffectNames), std::end(audio::kSoundEffectNames)}));
}

void add_options(CLI::App& app, ValidationOptions& validation) {
    app.add_option(
        "--report", validation.report, "X.html: how recordings are told apart, by artist");
    app.add_option("--labels",
                   validation.judged_labels,
                   "judge by clips with one of these labels alone (AB: not those whose genre is a "
                   "guess); learns from all");
    app.add_flag("--damage",
                 validation.judges_damage,
                 "validate with recordings in noise, a room and so on, too: what each costs");
    app.add_flag("--no-validation", validation.is_skipped, "keep the default fusion");
}

/// The HMMs on MFCC and the networks on bar patterns.
void add_options(CLI::App& app, audio::MfccTrainingPlan& mfcc, audio::PatternTrainingPlan& rhythm) {
    app.add_option("--states", mfcc.states, "states of each genre's hidden Markov model")
        ->check(in_range(1, 16));
    app.add_option("--mixtures", mfcc.mixtures, "Gaussians of each state")->check(in_range(1, 64));
    app.add_option("--similarity", mfcc.similarity_rounds, "rounds of inter-genre similarity")
        ->check(in_range(0, 5));
    app.add_option("--units", rhythm.units, "units of the rhythm network")->check(in_range(2, 128));
    app.add_option("--steps", rhythm.steps, "steps of its training")
        ->check(in_range(10, 1'000'000));
    app.add_option("--recorded-share",
                   rhythm.recorded_share,
                   "share of recordings, where there are recordings and written music")
        ->check(in_range(0.0, 1.0));
}

void add_options(CLI::App& app, audio::NetworkTrainingPlan& network) {
    app.add_option("--networks",
                   network.networks,
                   "recurrent networks that learn each by itself; their scores are averaged")
        ->check(in_range(1, static_cast<int>(audio::GenreScorer::kMostNetworks)));
    app.add_option("--network-units", network.units, "units of each layer of the recurrent network")
        ->check(in_range(4, 128));
    app.add_option("--network-steps",
                   network.written_steps,
                   "steps of its training on written music, each a batch of 24 x 10 s")
        ->check(in_range(1, 1'000'000));
    app.add_option("--network-branches",
                   network.branches,
                   "runs that go on from there, each by itself; the mean of their weights is taken")
        ->check(in_range(0, 100));
    app.add_option("--branch-steps", network.branch_steps, "steps of each of those runs")
        ->check(in_range(1, 1'000'000));
    app.add_option(
           "--tuning-steps", network.tuning_steps, "more steps, with recordings among the music")
        ->check(in_range(0, 1'000'000));
    app.add_option(
           "--network-recorded-share", network.recorded_share, "share of recordings in those steps")
        ->check(in_range(0.0, 1.0));
}

// Declares the command line that fills `options`, which must outlive the parsing.
void add_options(CLI::App& app, GenreOptions& options) {
    add_options(app, options.recordings);
    app.add_option("-o,--out", options.output, "X.json");
    add_options(app, options.written);
    add_options(app, options.written_test);
    app.add_option("--cache", options.cache, "folder that keeps features between runs");
    app.add_option("--add-to",
                   options.add_to,
                   "MODEL.json: learn the folder's genres beside those it knows, from the sample "
                   "that was kept of their music");
    app.add_flag("--add",
                 options.adds_kept,
                 "learn from the songs whose dance you kept (key U of play), too; without a folder "
                 "and --add-to they adapt what the music tagger says of the dances, in the model "
                 "of --tagger-for or the one that comes with Raks");
    app.add_option("--tagger-for",
                   options.tagger_for,
                   "MODEL.json: fit only what the music tagger says of its dances to the folder's "
                   "music; -o is the model with it");
    app.add_option("--samples",
                   options.sample_kilobytes,
                   "kB of each genre's music that are kept beside the model, for --add-to; 0: none")
        ->check(in_range(0, static_cast<int>(audio::kMostSampleBytes / 1'000)));
    app.add_option("--shard",
                   options.shards.share_text,
                   "i/n: compute share i of n into -o FILE, for `raks train genre merge`");
    add_options(app, options.augmentation);
    add_options(app, options.validation);
    app.add_flag("--no-energy",
                 options.leaves_out_energy,
                 "learn without the loudness of each frame (C0 and its derivatives)");
    add_options(app, options.plan.mfcc, options.plan.rhythm);
    add_options(app, options.plan.network);
    app.add_option("--folds", options.plan.folds)->check(in_range(2, 20));
    app.add_option("--seed", options.seed, "same seed, same model");
    app.add_option("--threads", options.threads)->check(in_range(1, 64));
}

}  // namespace

void add_train_genre(CommandTable& table, const std::string& command) {
    auto options = std::make_shared<GenreOptions>();
    CLI::App& app = *table.app().add_subcommand("genre", "learn to tell dances apart from music");
    add_options(app, *options);
    CLI::App* const merge = app.add_subcommand("merge", "learn from the shards of --shard");
    merge->fallthrough();
    merge->add_option("shards", options->shards.merged, "files of all shares")->required();
    app.callback([&table, options, command] {
        table.choose([options, command] { return train_genre(*options, command); });
    });
}

}  // namespace raks::apps
