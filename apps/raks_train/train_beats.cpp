// `raks train beats`: renders a corpus and trains the networks of beats and bars.
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks_train/commands.hpp"
#include "apps/raks_train/installed_styles.hpp"
#include "apps/terminal/option_checks.hpp"
#include "audio/beat/network/network_file.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/pending_file.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_bars.hpp"
#include "training/beat/train_network.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

// Stored in the network's file: the licences of the material ask for it.
constexpr const char* kAttribution =
    "Weights learnt from rendered MIDI: Google's Groove MIDI Dataset (CC-BY-4.0), Freedoom "
    "(BSD-3-Clause), OpenScore Lieder (CC0-1.0) and patterns of our own; soundfonts under MIT.";

// Arguments of the command.
struct Options {
    audio::StyleBook styles;  // that the corpus is written in
    audio::CorpusPlan corpus;
    std::filesystem::path corpus_file;  // where the rendered corpus is kept; empty: nowhere
    std::vector<std::filesystem::path> more_files;  // further corpora that were kept
    std::vector<std::string> left_out;              // families of music
    std::filesystem::path start;                    // network to go on from
    std::vector<std::filesystem::path> averaged;    // networks whose weights' mean is taken
    std::vector<std::filesystem::path> ensembled;   // networks whose outputs are averaged
    float trust = 1.0F;          // factor on that average before the sigmoid; below 1: less sure
    audio::NetworkPlan network;  // how the network is trained
    int bar_steps = 0;           // 0: learns beats
    std::filesystem::path output;
    std::filesystem::path music_folder;  // for --write
};

// Adds the options. Returns a function that checks them together, which the parser cannot; to be
// called once they are read.
std::function<void()> add_options(CLI::App& app, Options& options) {
    auto* average = app.add_option(
        "--average", options.averaged, "no training: the mean of these networks' weights");
    auto* together = app.add_option(
        "--together", options.ensembled, "no training: averages the outputs of these networks");
    app.add_option("--trust", options.trust, "in what they say; below 1: less sure")
        ->check(in_range(0.1, 10.0))
        ->needs(together);
    auto* pack = app.add_option("pack", options.corpus.pack, "folder of MIDI files with index.tsv");
    auto* soundfont = app.add_option(
        "--soundfont", options.corpus.soundfonts, "SF2 or SF3; several: mostly bands of all");
    app.add_option("--corpus", options.corpus_file, "keep the rendered music here between runs");
    app.add_option("--also", options.more_files, "more music that --corpus kept: learnt from, too");
    app.add_option("--excerpts", options.corpus.excerpts, "pieces of 22 s to render")
        ->check(in_range(16, 100'000));
    app.add_flag("--with-machines",
                 options.corpus.with_machines,
                 "more electronic music, as machines play it, and wider tempi");
    app.add_option("--corpus-seed", options.corpus.seed, "same seed, same music");
    app.add_option("--leave-out", options.left_out, "families of music not to learn from");
    auto* from = app.add_option("--from", options.start, "X.json: go on from these weights");
    app.add_option("--units", options.network.units, "of each layer")->check(in_range(4, 128));
    app.add_option("--layers", options.network.layers)->check(in_range(1, 3));
    app.add_option("--lookahead", options.network.lookahead, "hops of 10 ms")
        ->check(in_range(0, 10));
    app.add_option("--steps", options.network.steps, "batches of 24 x 10 s")
        ->check(in_range(10, 1'000'000));
    app.add_option("--rate", options.network.rate, "of learning, at its highest")
        ->check(in_range(1e-5, 0.1));
    app.add_option("--cuts", options.network.cut_chance, "chance that a chunk has two pieces")
        ->check(in_range(0.0, 1.0));
    app.add_option("--seed", options.network.seed, "of weights and batches");
    app.add_option("--threads", options.network.threads)->check(in_range(1, 64));
    app.add_option("--bar-steps",
                   options.bar_steps,
                   "beats stay as they are: batches of 48 x 96 beats to learn bars from")
        ->check(in_range(10, 1'000'000))
        ->needs(from);
    auto* out = app.add_option("-o,--out", options.output, "X.json");
    auto* write = app.add_option("--write",
                                 options.music_folder,
                                 "no training: the music with its beats into this new folder, for "
                                 "`raks eval beats`");
    out->excludes(write);
    average->excludes(write);
    together->excludes(write);
    together->excludes(average);
    // Without training only networks are needed; with it a pack of MIDI files and a soundfont.
    return [average, together, pack, soundfont, out, write] {
        if (average->count() + together->count() == 0 &&
            (pack->count() == 0 || soundfont->count() == 0)) {
            throw CLI::RequiredError("pack and --soundfont, or --average or --together");
        }
        if (out->count() + write->count() == 0) {
            throw CLI::RequiredError("--out or --write");
        }
    };
}

// The corpus of --corpus where that file exists, else rendered from the pack and stored there.
Expected<std::vector<audio::TrainingExcerpt>> first_corpus_of(const Options& options) {
    std::error_code ignored;
    if (!options.corpus_file.empty() && std::filesystem::exists(options.corpus_file, ignored)) {
        return audio::load_corpus(options.corpus_file);
    }
    std::fprintf(stderr, "raks: rendering %d pieces\n", options.corpus.excerpts);
    auto corpus = audio::make_corpus(options.corpus);
    if (corpus && !options.corpus_file.empty()) {
        if (auto saved = audio::save_corpus(*corpus, options.corpus_file); !saved) {
            return fail(saved.error());
        }
    }
    return corpus;
}

// The first corpus followed by those of --also. They are appended, so that every 16th excerpt of
// the whole is kept for validation.
Expected<std::vector<audio::TrainingExcerpt>> corpus_of(const Options& options) {
    auto corpus = first_corpus_of(options);
    if (!corpus) {
        return corpus;
    }
    for (const std::filesystem::path& path : options.more_files) {
        auto more = audio::load_corpus(path);
        if (!more) {
            return more;
        }
        corpus->insert(corpus->end(),
                       std::make_move_iterator(more->begin()),
                       std::make_move_iterator(more->end()));
    }
    return corpus;
}

// Empties the excerpts of these families; they keep their places, so that the same excerpts stay in
// validation. Errors: a family that the corpus does not have.
Expected<void> leave_out(const std::vector<std::string>& families,
                         std::vector<audio::TrainingExcerpt>& corpus) {
    for (const std::string& family : families) {
        bool is_known = false;
        std::set<std::string> known;
        for (audio::TrainingExcerpt& excerpt : corpus) {
            known.insert(excerpt.family);
            if (excerpt.family == family) {
                is_known = true;
                excerpt.mel.clear();
                excerpt.beats.clear();
            }
        }
        if (!is_known) {
            return fail(fmt::format(
                "--leave-out: no family '{}'; there are {}", family, fmt::join(known, ", ")));
        }
    }
    return {};
}

// Loads the networks of these files and writes what `make` makes of them.
template <class Make>
Expected<void> write_made_of(const std::vector<std::filesystem::path>& files,
                             const Make& make,
                             const Options& options,
                             const audio::NetworkNotes& notes) {
    std::vector<std::shared_ptr<const audio::BeatNetwork>> networks;
    for (const std::filesystem::path& path : files) {
        auto network = audio::load_network(path);
        if (!network) {
            return fail(network.error());
        }
        networks.push_back(std::move(*network));
    }
    const Expected<audio::BeatNetwork> made = make(networks);
    if (!made) {
        return fail("network " + made.error().message);
    }
    return audio::save_network(*made, notes, options.output);
}

void print_progress(const audio::NetworkProgress& progress) {
    std::fprintf(stderr,
                 "step %5d of %d   loss %.4f   validation %.4f\n",
                 progress.step,
                 progress.steps,
                 progress.training_loss,
                 progress.validation_loss);
}

// Trains the bar network on what the beat network of --from computes; that network's beats stay as
// they are.
Expected<void> learn_bars(const Options& options,
                          const std::vector<audio::TrainingExcerpt>& corpus,
                          const audio::NetworkNotes& notes) {
    audio::BeatNetwork network = *options.network.start;
    audio::BarPlan plan;
    plan.steps = options.bar_steps;
    plan.seed = options.network.seed;
    plan.threads = options.network.threads;
    // Stays when no piece has bars, since then nothing is reported.
    Expected<void> saved = fail("no piece of this corpus tells bars");
    // Every report saves the file: an interrupted training leaves the last state.
    const auto report = [&](const audio::NetworkProgress& progress, const audio::BarNetwork& bars) {
        print_progress(progress);
        network.set_bars(std::make_shared<const audio::BarNetwork>(bars));
        saved = audio::save_network(network, notes, options.output);
    };
    audio::train_bars(corpus, options.network.start, plan, report);
    return saved;
}

// The command: its cheap variants first, then the training.
Expected<void> run(Options& options, const std::string& command) {
    // Averaging and joining networks need no music, and so no styles.
    const bool needs_music = options.averaged.empty() && options.ensembled.empty();
    if (needs_music) {
        auto styles = load_installed_styles();
        if (!styles) {
            return fail(styles.error());
        }
        options.styles = std::move(*styles);
        options.corpus.styles = &options.styles;
    }
    // --write only renders: nothing is trained.
    if (!options.music_folder.empty()) {
        return audio::write_music_folder(options.corpus, options.music_folder);
    }
    const audio::NetworkNotes notes{command, kAttribution};
    std::vector<std::filesystem::path> inputs = options.corpus.soundfonts;
    // Inputs must not be written over by the output.
    inputs.push_back(options.corpus_file);
    inputs.insert(inputs.end(), options.more_files.begin(), options.more_files.end());
    if (auto checked = check_output(options.output, inputs); !checked) {
        return checked;
    }
    if (!options.averaged.empty()) {
        return write_made_of(options.averaged, audio::average, options, notes);
    }
    if (!options.ensembled.empty()) {
        const auto make = [&](const auto& networks) {
            return audio::together(networks, options.trust);
        };
        return write_made_of(options.ensembled, make, options, notes);
    }
    if (!options.start.empty()) {
        auto start = audio::load_network(options.start);
        if (!start) {
            return fail(start.error());
        }
        // A compound network is several networks that were trained apart; going on would train only
        // one.
        if (!(*start)->others().empty() && options.bar_steps == 0) {
            return fail(options.start.string() +
                        ": holds several networks, which learn apart; only --bar-steps goes on");
        }
        options.network.start = std::move(*start);
    }
    auto corpus = corpus_of(options);
    if (!corpus) {
        return fail(corpus.error());
    }
    if (auto done = leave_out(options.left_out, *corpus); !done) {
        return done;
    }
    if (options.bar_steps > 0) {
        return learn_bars(options, *corpus, notes);
    }
    // Every report saves the file: an interrupted training leaves the last state.
    Expected<void> saved;
    const auto report = [&](const audio::NetworkProgress& progress,
                            const audio::BeatNetwork& network) {
        print_progress(progress);
        saved = audio::save_network(network, notes, options.output);
    };
    // `report` saves the network: what is returned is not needed.
    audio::train_network(*corpus, options.network, report);
    return saved;
}

}  // namespace

void add_train_beats(CommandTable& table, const std::string& command) {
    auto options = std::make_shared<Options>();
    CLI::App& app = *table.app().add_subcommand("beats", "learn to track beats from MIDI files");
    const auto check = add_options(app, *options);
    app.callback([&table, options, check, command] {
        check();
        // One option for rendering and training.
        options->corpus.threads = options->network.threads;
        table.choose([options, command] { return exit_code_of(run(*options, command)); });
    });
}

}  // namespace raks::apps
