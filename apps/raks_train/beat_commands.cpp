// The options of `raks train beats`.
#include <functional>
#include <memory>
#include <string>

#include "apps/raks_train/train_command_table.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/option_checks.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

// Adds the options. Returns a function that checks them together, which the parser cannot; to be
// called once they are read.
std::function<void()> add_options(CLI::App& app, TrainBeatsArguments& options) {
    auto* average = app.add_option(
        "--average", options.averaged, "no training: the mean of these networks' weights");
    auto* together = app.add_option(
        "--together", options.ensembled, "no training: averages the outputs of these networks");
    app.add_option(
           "--trust", options.trust, "how far the networks are trusted; below 1: less sure beats")
        ->check(in_range(0.1, 10.0))
        ->needs(together);
    auto* pack = app.add_option("pack", options.corpus.pack, "folder of MIDI files with index.tsv");
    auto* soundfont = app.add_option("--soundfont",
                                     options.corpus.soundfonts,
                                     "soundfont, SF2 or SF3; with several, most pieces mix them");
    app.add_option("--corpus", options.corpus_file, "keep the rendered music here between runs");
    app.add_option(
        "--also", options.more_files, "more music that --corpus kept, to learn from, too");
    app.add_option("--excerpts", options.corpus.excerpts, "pieces of 22 s to render")
        ->check(in_range(16, 100'000));
    app.add_flag("--with-machines",
                 options.corpus.with_machines,
                 "more electronic music, as machines play it, and wider tempi");
    app.add_flag("--with-metres",
                 options.corpus.with_metres,
                 "compound and additive metres, triplets, loud off-beats, slow music");
    app.add_option("--corpus-seed", options.corpus.seed, "same seed, same music");
    app.add_option("--leave-out", options.left_out, "families of music not to learn from");
    auto* from = app.add_option("--from", options.start, "X.json: go on from these weights");
    app.add_option("--units", options.network.units, "units of each layer")
        ->check(in_range(4, 128));
    app.add_option("--layers", options.network.layers)->check(in_range(1, 3));
    app.add_option(
           "--lookahead", options.network.lookahead, "how far it hears ahead, in hops of 10 ms")
        ->check(in_range(0, 10));
    app.add_option("--steps", options.network.steps, "training steps, each a batch of 24 x 10 s")
        ->check(in_range(10, 1'000'000));
    app.add_option("--rate", options.network.rate, "highest learning rate")
        ->check(in_range(1e-5, 0.1));
    app.add_option("--cuts",
                   options.network.cut_chance,
                   "chance that 10 s are cut together from two pieces")
        ->check(in_range(0.0, 1.0));
    app.add_option("--seed", options.network.seed, "seed of weights and batches");
    app.add_option("--threads", options.network.threads)->check(in_range(1, 64));
    app.add_option("--bar-steps",
                   options.bar_steps,
                   "beats stay as they are: batches of 48 x 96 beats to learn bars from")
        ->check(in_range(10, 1'000'000))
        ->needs(from);
    app.add_option("--pulse-steps",
                   options.pulse_steps,
                   "beats stay as they are: batches of 48 x 64 beats to learn the metre from")
        ->check(in_range(10, 1'000'000))
        ->needs(from);
    auto* judge = app.add_option("--judge",
                                 options.judged,
                                 "beats stay as they are: folders of annotated music, as of "
                                 "--write, to learn from how sure a beat is");
    judge->needs(from);
    auto* out = app.add_option("-o,--out", options.output, "X.json");
    auto* write =
        app.add_option("--write",
                       options.music_folder,
                       "no training: write the music with its beats into this new folder, for "
                       "`raks eval beats`");
    out->excludes(write);
    average->excludes(write);
    together->excludes(write);
    together->excludes(average);
    // Without training only networks are needed; with it a pack of MIDI files and a soundfont.
    return [average, together, judge, pack, soundfont, out, write] {
        if (average->count() + together->count() + judge->count() == 0 &&
            (pack->count() == 0 || soundfont->count() == 0)) {
            throw CLI::RequiredError("pack and --soundfont, or --average, --together or --judge");
        }
        if (out->count() + write->count() == 0) {
            throw CLI::RequiredError("--out or --write");
        }
    };
}

}  // namespace

void add_train_beats(CommandTable& table, const std::string& command) {
    auto options = std::make_shared<TrainBeatsArguments>();
    CLI::App& app = *table.app().add_subcommand("beats", "learn to track beats from MIDI files");
    const auto check = add_options(app, *options);
    app.callback([&table, options, check, command] {
        check();
        table.choose([options, command] { return train_beats(*options, command); });
    });
}

}  // namespace raks::apps
