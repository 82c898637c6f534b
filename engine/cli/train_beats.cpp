// The program raks-train-beats, that `raks train beats` starts: it alone needs FluidSynth and a
// BLAS, which the dancing program should not load.
#include <cstdio>
#include <filesystem>

#include "audio/beat/network/network_file.hpp"
#include "audio/beat/training/corpus.hpp"
#include "audio/beat/training/train_network.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace {

using namespace raks;

constexpr const char* kAttribution =
    "Weights learnt from rendered MIDI: Google's Groove MIDI Dataset (CC-BY-4.0), Freedoom "
    "(BSD-3-Clause), OpenScore Lieder (CC0-1.0) and patterns of our own; soundfonts under MIT.";

struct Options {
    audio::CorpusPlan corpus;
    std::filesystem::path corpus_file;
    audio::NetworkPlan network;
    std::filesystem::path output;
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("pack", options.corpus.pack, "folder of MIDI files with index.tsv")->required();
    app.add_option("--soundfont", options.corpus.soundfonts, "SF2 or SF3; several: one is drawn")
        ->required();
    app.add_option("--corpus", options.corpus_file, "keep the rendered music here between runs");
    app.add_option("--excerpts", options.corpus.excerpts, "pieces of 22 s to render")
        ->check(CLI::Range(16, 100'000));
    app.add_option("--corpus-seed", options.corpus.seed, "same seed, same music");
    app.add_option("--units", options.network.units, "of each layer")->check(CLI::Range(4, 128));
    app.add_option("--layers", options.network.layers)->check(CLI::Range(1, 3));
    app.add_option("--lookahead", options.network.lookahead, "hops of 10 ms")
        ->check(CLI::Range(0, 10));
    app.add_option("--steps", options.network.steps, "batches of 24 x 10 s")
        ->check(CLI::Range(10, 1'000'000));
    app.add_option("--seed", options.network.seed, "of weights and batches");
    app.add_option("--threads", options.network.threads)->check(CLI::Range(1, 64));
    app.add_option("-o,--out", options.output, "X.json")->required();
}

Expected<std::vector<audio::TrainingExcerpt>> corpus_of(const Options& options) {
    if (!options.corpus_file.empty() && std::filesystem::exists(options.corpus_file)) {
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

Expected<void> run(const Options& options, const std::string& command) {
    const auto corpus = corpus_of(options);
    if (!corpus) {
        return fail(corpus.error());
    }
    const audio::NetworkNotes notes{command, kAttribution};
    // What was learnt so far lies in the file, should this be stopped.
    Expected<void> saved;
    const auto report = [&](const audio::NetworkProgress& progress,
                            const audio::BeatNetwork& network) {
        std::fprintf(stderr,
                     "step %5d of %d   loss %.4f   validation %.4f\n",
                     progress.step,
                     progress.steps,
                     progress.training_loss,
                     progress.validation_loss);
        saved = audio::save_network(network, notes, options.output);
    };
    audio::train_network(*corpus, options.network, report);
    return saved;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("learns to hear beats from rendered music", "raks train beats");
    add_options(app, options);
    CLI11_PARSE(app, argc, argv);
    options.corpus.threads = options.network.threads;
    std::string command = "raks train beats";
    for (int i = 1; i < argc; ++i) {
        command += ' ' + std::filesystem::path(argv[i]).filename().string();
    }
    if (const auto done = run(options, command); !done) {
        std::fprintf(stderr, "raks: %s\n", done.error().message.c_str());
        return 1;
    }
    return 0;
}
