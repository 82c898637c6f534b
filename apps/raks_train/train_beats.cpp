// `raks train beats`: renders a corpus and trains the networks of beats and bars.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks_train/installed_styles.hpp"
#include "apps/raks_train/judged_beats.hpp"
#include "apps/raks_train/train_commands.hpp"
#include "apps/terminal/say.hpp"
#include "audio/beat/network/network_file.hpp"
#include "audio/music/styles/style_book.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/analyzer_setup.hpp"
#include "training/beat/corpus.hpp"
#include "training/beat/train_bars.hpp"
#include "training/beat/train_network.hpp"
#include "training/beat/train_pulses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::apps {
namespace {

// Stored in the network's file: the licences of the material ask for it.
constexpr const char* kAttribution =
    "Weights learnt from rendered MIDI: Google's Groove MIDI Dataset (CC-BY-4.0), Freedoom "
    "(BSD-3-Clause), OpenScore Lieder (CC0-1.0) and patterns of our own; soundfonts FluidR3 GM and "
    "MuseScore General (MIT), OPL-3 FM 128M (CC-BY-SA-4.0).";

// A beat that is told as sure and is wrong does more harm than a right one told as doubtful.
constexpr double kWrongCounts = 1.4;

// The corpus of --corpus where that file exists, else rendered from the pack and stored there.
Expected<std::vector<audio::TrainingExcerpt>> first_corpus_of(const TrainBeatsArguments& options) {
    std::error_code ignored;
    if (!options.corpus_file.empty() && std::filesystem::exists(options.corpus_file, ignored)) {
        return audio::load_corpus(options.corpus_file);
    }
    say(fmt::format("playing {} pieces of music to learn from", options.corpus.excerpts));
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
Expected<std::vector<audio::TrainingExcerpt>> corpus_of(const TrainBeatsArguments& options) {
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
                             const TrainBeatsArguments& options,
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
    say(fmt::format("step {:5} of {}   loss {:.4f}   validation {:.4f}",
                    progress.step,
                    progress.steps,
                    progress.training_loss,
                    progress.validation_loss));
}

// Trains a part beside the networks of --from, which stay as they are. `train` takes a plan and a
// report, `set` puts the part where it belongs; `nothing`: why no part came of the music.
template <typename Part, typename Plan, typename Train, typename Set>
Expected<void> learn_part(const TrainBeatsArguments& options,
                          const audio::NetworkNotes& notes,
                          int steps,
                          const char* nothing,
                          const Train& train,
                          const Set& set) {
    audio::BeatNetwork network = *options.network.start;
    Plan plan;
    plan.steps = steps;
    plan.seed = options.network.seed;
    plan.threads = options.network.threads;
    // Stays where nothing is reported, as there was nothing to learn from.
    Expected<void> saved = fail(nothing);
    // Every report saves the file: an interrupted training leaves the last state.
    train(plan, [&](const audio::NetworkProgress& progress, const Part& part) {
        print_progress(progress);
        set(network, std::make_shared<const Part>(part));
        saved = audio::save_network(network, notes, options.output);
    });
    return saved;
}

// The bar network learns from what the beat network of --from computes.
Expected<void> learn_bars(const TrainBeatsArguments& options,
                          const std::vector<audio::TrainingExcerpt>& corpus,
                          const audio::NetworkNotes& notes) {
    return learn_part<audio::BarNetwork, audio::BarPlan>(
        options,
        notes,
        options.bar_steps,
        "no piece of this music has bars to learn from",
        [&](const audio::BarPlan& plan, const auto& report) {
            audio::train_bars(corpus, options.network.start, plan, report);
        },
        [](audio::BeatNetwork& network, auto bars) { network.set_bars(std::move(bars)); });
}

Expected<void> learn_pulses(const TrainBeatsArguments& options,
                            const std::vector<audio::TrainingExcerpt>& corpus,
                            const audio::NetworkNotes& notes) {
    return learn_part<audio::PulseNetwork, audio::PulsePlan>(
        options,
        notes,
        options.pulse_steps,
        "no piece of this music has even beats to learn from",
        [&](const audio::PulsePlan& plan, const auto& report) {
            audio::train_pulses(corpus, plan, report);
        },
        [](audio::BeatNetwork& network, auto pulses) { network.set_pulses(std::move(pulses)); });
}

// Learns how sure a beat is from annotated music; the networks of --from stay as they are.
Expected<void> learn_confidence(const TrainBeatsArguments& options,
                                const audio::NetworkNotes& notes) {
    // BeatNet is heard beside them, as where the program dances.
    const auto network = engine::load_beat_network(options.start);
    if (!network) {
        return fail(network.error());
    }
    const auto judged = judge_beats_of(options.judged, *network);
    if (!judged) {
        return fail(judged.error());
    }
    const auto right = std::count_if(
        judged->begin(), judged->end(), [](const auto& beat) { return beat.is_right; });
    say(fmt::format("{} beats, {} of them right", judged->size(), right));
    audio::BeatNetwork result = **network;
    result.set_confidence(audio::fit_confidence(*judged, kWrongCounts));
    return audio::save_network(result, notes, options.output);
}

// The command: its cheap variants first, then the training.
Expected<void> run(TrainBeatsArguments& options, const std::string& command) {
    // Averaging and joining networks need no music, and so no styles.
    const bool needs_music =
        options.averaged.empty() && options.ensembled.empty() && options.judged.empty();
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
    if (!options.judged.empty()) {
        return learn_confidence(options, notes);
    }
    if (!options.start.empty()) {
        auto start = audio::load_network(options.start);
        if (!start) {
            return fail(start.error());
        }
        // A compound network is several networks that were trained apart; going on would train only
        // one.
        if (!(*start)->others().empty() && options.bar_steps == 0 && options.pulse_steps == 0) {
            return fail(options.start.string() +
                        ": holds several networks, which learn apart; only --bar-steps and "
                        "--pulse-steps go on");
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
    if (options.pulse_steps > 0) {
        return learn_pulses(options, *corpus, notes);
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

ExitCode train_beats(TrainBeatsArguments arguments, const std::string& command) {
    // One option for rendering and training.
    arguments.corpus.threads = arguments.network.threads;
    return exit_code_of(run(arguments, command));
}

}  // namespace raks::apps
