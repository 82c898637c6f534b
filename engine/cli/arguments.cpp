#include "engine/cli/arguments.hpp"

#include <cstdio>
#include <map>
#include <memory>
#include <utility>

#include "engine/dance_files.hpp"
#include "engine/picture.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace raks::cli {
namespace {

constexpr const char* kVersion = "0.1.0";

constexpr const char* kExamples =
    "raks: an avatar that dances to what it hears\n"
    "\n"
    "  raks live                          dance to what this computer plays, or to a microphone\n"
    "  raks play song.mp3                 play a file and dance to it\n"
    "  raks render song.mp3 -o out.mp4    write a video of the dance\n"
    "\n"
    "raks --help lists all commands.\n";

constexpr const char* kGeneratorHelp = "trajectories, or frames: the paper's, for comparison";

void add_figures_option(CLI::App& app, engine::Settings& settings) {
    app.add_option("--figures", settings.figures, "learnt as angles or positions of the joints");
}

void add_formation_option(CLI::App& app, engine::Settings& settings) {
    app.add_option(
        "--formation", settings.formation, "solo, couple, unison, canon or free (three dancers)");
}

/// The options of DESIGN 6 that play, live and render share.
void add_picture_options(CLI::App& app, engine::Settings& settings) {
    app.add_option("--dance", settings.dance, "the dance to keep to, or auto");
    add_figures_option(app, settings);
    add_formation_option(app, settings);
    app.add_option("--generator", settings.generator, kGeneratorHelp);
    app.add_option("--seed", settings.seed, "same seed, same dance");
    app.add_option("--theme", settings.theme, "stage, workshop_dark or studio_light");
    app.add_option("--camera", settings.camera, "wide, portrait, front or side");
    app.add_option("--size", settings.size, "picture size, such as 1280x720");
    app.add_option("--fps", settings.fps, "pictures a second");
    app.add_option("--quality", settings.quality, "auto, fast or high");
    app.add_option("--view", settings.view, "skin, stick or auto");
    app.add_flag("--overlay,!--no-overlay", settings.overlay, "beat, tempo and levels on top");
    app.add_option("--latency-offset",
                   settings.latency_offset_ms,
                   "milliseconds added to the latency that the device reports");
}

void add_section_options(CLI::App& app, Section& section) {
    app.add_option("--start", section.start, "seconds into the file")
        ->check(CLI::NonNegativeNumber);
    app.add_option_function<double>(
           "--duration",
           [&section](const double& seconds) { section.duration = seconds; },
           "seconds; to the end when not given")
        ->check(CLI::PositiveNumber);
}

template <typename Methods>  // one or several
void add_beat_option(CLI::App& app, Methods& method) {
    const std::map<std::string, FileBeatMethod> names = {
        {"pointer", FileBeatMethod::pointer},
        {"paper", FileBeatMethod::paper},
        {"paper-whole", FileBeatMethod::paper_whole},
    };
    app.add_option("--beat",
                   method,
                   "tracker: pointer, or the paper's method, streaming (paper) or with the whole "
                   "file before it (paper-whole)")
        ->transform(CLI::CheckedTransformer(names))
        ->allow_extra_args(false)
        ->option_text("pointer|paper|paper-whole");
}

/// The first fault of the settings: a value out of range, or a name that nothing has.
std::string fault_of(const engine::Settings& settings) {
    if (const auto faults = engine::validate(settings); !faults.empty()) {
        return faults.front();
    }
    if (const auto look = engine::read_look(settings); !look) {
        return look.error().message;
    }
    if (const auto checked = engine::check_dance(settings.dance); !checked) {
        return checked.error().message;
    }
    if (const auto checked = engine::check_fallback_dance(settings.fallback_dance); !checked) {
        return checked.error().message;
    }
    return {};
}

/// One command: where its arguments live and what runs it.
template <typename Arguments>
struct Command {
    CLI::App* app = nullptr;
    std::shared_ptr<Arguments> arguments;
};

class Parser {
 public:
    explicit Parser(const engine::Settings& settings) : settings_(settings) {
        app_.require_subcommand(0, 1);
        app_.set_version_flag("--version", std::string("raks ") + kVersion);
        app_.failure_message([](const CLI::App*, const CLI::Error& error) {
            return fmt::format("raks: {} (raks --help shows what there is)\n", error.what());
        });
        add_play();
        add_live();
        add_devices();
        add_render();
        add_analyze();
        add_eval();
        add_dance();
        add_train();
        add_sheet();
        add_stick();
        add_synth();
        add_bench();
        add_config();
    }

    ParsedCommand parse(int argc, char** argv) {
        try {
            app_.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            const int code = app_.exit(error);
            return {nullptr, code == 0 ? kExitDone : kExitUsage};
        }
        if (!run_) {
            std::fputs(kExamples, stdout);
            return {nullptr, kExitDone};
        }
        if (auto fault = settings_fault_ ? settings_fault_() : std::string(); !fault.empty()) {
            std::fprintf(stderr, "raks: %s\n", fault.c_str());
            return {nullptr, kExitUsage};
        }
        return {std::move(run_), kExitDone};
    }

 private:
    template <typename Arguments>
    Command<Arguments> add(CLI::App& parent,
                           const char* name,
                           const char* help,
                           ExitCode (*run)(const Arguments&)) {
        Command<Arguments> command{parent.add_subcommand(name, help),
                                   std::make_shared<Arguments>()};
        if constexpr (requires { command.arguments->settings; }) {
            command.arguments->settings = settings_;
        }
        command.app->callback([this, arguments = command.arguments, run] {
            run_ = [arguments, run] { return run(*arguments); };
            if constexpr (requires { arguments->settings; }) {
                settings_fault_ = [arguments]() -> std::string {
                    return fault_of(arguments->settings);
                };
            }
        });
        return command;
    }

    void add_play() {
        auto [app, a] = add(app_, "play", "play files and dance to them", play);
        app->add_option("files", a->files, "music files and folders; none: a salsa of our own");
        app->add_option("--output", a->settings.output, "loudspeaker: name, part of it, or number");
        app->add_option("--volume", a->settings.volume, "1 is the file's own level");
        app->add_flag("--headless", a->is_headless, "no window");
        app->add_flag("--no-sound", a->is_soundless, "no loudspeaker: paced by the clock");
        app->add_flag("--fullscreen", a->is_fullscreen, "fill the screen");
        add_section_options(*app, a->section);
        add_picture_options(*app, a->settings);
    }

    void add_live() {
        auto [app, a] = add(app_, "live", "listen to an input and dance to it", live);
        app->add_option("--device", a->settings.device, "input: name, part of it, or number");
        app->add_option_function<double>(
               "--duration",
               [arguments = a](const double& seconds) { arguments->duration = seconds; },
               "seconds to listen; until stopped when not given")
            ->check(CLI::PositiveNumber);
        app->add_flag("--headless", a->is_headless, "no window");
        app->add_flag("--fullscreen", a->is_fullscreen, "fill the screen");
        add_picture_options(*app, a->settings);
    }

    void add_devices() {
        auto [app, a] = add(app_, "devices", "list inputs and loudspeakers", devices);
        app->add_flag("--json", a->as_json, "one JSON document");
        app->add_flag("--has-output", a->asks_for_output, "print nothing; fail without one");
    }

    void add_render() {
        auto [app, a] = add(app_, "render", "write a video of the dance to a file", render);
        app->add_option("file", a->input, "music file; none: a salsa of our own");
        app->add_option("-o,--out", a->output, "X.mp4, X.avi, or a folder for .png")->required();
        add_section_options(*app, a->section);
        add_picture_options(*app, a->settings);
    }

    void add_analyze() {
        auto [app, a] = add(app_, "analyze", "tell beats, tempo and dance of a file", analyze);
        app->add_option("file", a->input, "music file")->required();
        app->add_flag("--json", a->as_json, "one JSON document");
        add_beat_option(*app, a->beat);
        auto* plot = app->add_option("--plot", a->plot, "X.svg: a picture of what was heard");
        app->add_option("--reference", a->reference, "beats to draw beside: seconds, bar position")
            ->needs(plot);
    }

    void add_eval() {
        CLI::App* eval = app_.add_subcommand("eval", "measure beats, genre and dance");
        eval->require_subcommand(1);
        auto [app, a] = add(*eval, "beats", "score the beat tracker", eval_beats);
        app->add_option("folder", a->corpus, "index.tsv, NAME.beats, NAME.ogg")->required();
        app->add_flag("--json", a->as_json, "one JSON document");
        app->add_flag("--each", a->asks_for_each, "a row for each excerpt");
        app->add_option("--class", a->category, "only excerpts of this class");
        app->add_option("--out", a->output, "folder for NAME.beats and NAME.pred as heard");
        app->add_option("--peers", a->peers, "folder of NAME.beats, or a folder per tracker")
            ->allow_extra_args(false);
        app->add_option("--network", a->network, "X.json for the pointer, or none: onsets alone");
        app->add_option("--leave-class-out",
                        a->left_out,
                        "folder of CLASS.json: networks that were trained without that class");
        add_beat_option(*app, a->methods);
        add_eval_dance(*eval);
        add_eval_genre(*eval);
    }

    void add_eval_genre(CLI::App& eval) {
        auto [app, a] = add(eval, "genre", "measure how dances are told apart", eval_genre);
        app->add_option("folder", a->folder, "of music: one folder a genre")->required();
        app->add_option("--groups", a->groups, "table of its clips: clip, genre, artist, label");
        app->add_option("--model", a->model, "X.json instead of the one that comes with Raks");
        app->add_option("--labels", a->labels, "only clips with one of these labels, such as AB");
        app->add_flag(
            "--damage", a->with_damage, "also quieter, low-passed, with noise, in a room");
        app->add_option("--threads", a->threads)->check(CLI::Range(1, 64));
        app->add_flag("--json", a->as_json, "one JSON document");
    }

    void add_eval_dance(CLI::App& eval) {
        auto [app, a] = add(eval, "dance", "measure the dancer on generated music", eval_dance);
        app->add_flag("--json", a->as_json, "one JSON document");
        app->add_option("--role", a->role, "lead or follow")
            ->check(CLI::IsMember({"lead", "follow"}));
        app->add_option("--dance", a->settings.dance, "the dance to measure");
        add_figures_option(*app, a->settings);
        app->add_option("--generator", a->settings.generator, kGeneratorHelp);
        app->add_option("--formation", a->settings.formation, "solo or couple")
            ->check(CLI::IsMember({"solo", "couple"}));
        app->add_option("--seed", a->settings.seed, "same seed, same dance");
        app->add_option("--trial", a->trials, "only this one, such as salsa-180")
            ->allow_extra_args(false);
        auto* clips = app->add_option("--clips", a->clips, "folder of people's clips, TAKE.bvh");
        auto* labels =
            app->add_option("--labels", a->labels, "TSV: take, role, start, end, figure, ...");
        clips->needs(labels);
        labels->needs(clips);
        app->add_option("--counts", a->counts, "TSV: when each count falls")->needs(clips);
        app->add_option("--faults", a->faults, "TSV: stretches that the capture got wrong")
            ->needs(clips);
        app->add_option("--fps", a->fps, "frames a second of the clips, when they are wrong")
            ->check(CLI::Range(1.0, 1000.0));
        app->add_option("--scale", a->scale, "metres per unit of the clips")
            ->check(CLI::Range(1e-4, 10.0));
    }

    void add_dance() {
        auto [app, a] = add(app_, "dance", "write the dance to a file as motion", dance);
        app->add_option("file", a->input, "music file")->required();
        app->add_option("-o,--out", a->output, "X.bvh; of several dancers X_1.bvh, X_2.bvh, ...")
            ->required();
        app->add_option("--fps", a->fps, "poses a second")->check(CLI::Range(1.0, 240.0));
        add_formation_option(*app, a->settings);
        app->add_option("--dance", a->settings.dance, "the dance to keep to, or auto");
        add_figures_option(*app, a->settings);
        app->add_option("--generator", a->settings.generator, kGeneratorHelp);
        app->add_option("--seed", a->settings.seed, "same seed, same dance");
    }

    void add_train() {
        CLI::App* train = app_.add_subcommand("train", "learn from recordings");
        train->require_subcommand(1);
        auto [app, a] = add(*train, "figure", "learn a dance figure from motion", train_figure);
        app->add_option("clips", a->clips, "BVH files, a folder of them, or a written X.toml")
            ->required();
        app->add_option("--labels", a->labels, "TSV: take, role, start, end, figure, ...");
        auto* counts = app->add_option("--counts", a->counts, "TSV: when each count falls");
        auto* music =
            app->add_option("--music", a->music, "music danced to: its beats are the counts");
        music->excludes(counts);
        app->add_option("--offset", a->offset, "seconds of the music at a clip's first frame")
            ->needs(music);
        app->add_option("--faults", a->faults, "TSV: stretches that the capture got wrong");
        app->add_option("--figure", a->figure, "which label, or figure of a dance, to learn");
        app->add_option("--dance", a->dance, "the dance that it belongs to");
        app->add_option("--role", a->role, "lead or follow")
            ->check(CLI::IsMember({"lead", "follow"}));
        app->add_option("--features", a->features, "of the joints: angles or positions")
            ->check(CLI::IsMember({"angles", "positions"}));
        app->add_option("--split", a->split, "only labels of this split");
        app->add_option("--min-confidence", a->min_confidence, "only labels at least so sure")
            ->check(CLI::Range(0.0, 1.0));
        app->add_option("--fps", a->fps, "frames a second, when the file is wrong")
            ->check(CLI::Range(1.0, 1000.0));
        app->add_option("--scale", a->scale, "metres per unit of the file")
            ->check(CLI::Range(1e-4, 10.0));
        app->add_option("--states", a->states, "states of each part")->check(CLI::Range(2, 96));
        app->add_option("--iterations", a->iterations, "of Baum-Welch")->check(CLI::Range(0, 100));
        app->add_option("--covariance", a->covariance, "of the states: tied, full or diagonal")
            ->check(CLI::IsMember({"tied", "full", "diagonal"}));
        app->add_option("--start", a->start, "where states lie before Baum-Welch: flat, segmental")
            ->check(CLI::IsMember({"flat", "segmental"}));
        app->add_option("--source", a->source, "cmu: the model acknowledges mocap.cs.cmu.edu")
            ->check(CLI::IsMember({"cmu"}));
        app->add_option("-o,--out", a->output, "X.json; of a dance also a folder")->required();

        add_train_report(*train);

        // A program of its own reads what follows: it needs libraries that dancing does not.
        CLI::App* beats = train->add_subcommand("beats", "learn to hear beats from MIDI files");
        beats->prefix_command();
        beats->set_help_flag();
        beats->callback([this, beats] {
            run_ = [arguments = beats->remaining()] { return train_beats(arguments); };
        });
        CLI::App* genre = train->add_subcommand("genre", "learn to tell dances apart from music");
        genre->prefix_command();
        genre->set_help_flag();
        genre->callback([this, genre] {
            run_ = [arguments = genre->remaining()] { return train_genre(arguments); };
        });
    }

    void add_train_report(CLI::App& train) {
        auto [app, a] = add(train, "report", "show how figures are learnt", train_report);
        app->add_option("clips", a->clips, "BVH files, or a folder of them")->required();
        app->add_option("--labels", a->labels, "TSV: take, role, start, end, figure, ...")
            ->required();
        app->add_option("--counts", a->counts, "TSV: when each count falls");
        app->add_option("--faults", a->faults, "TSV: stretches that the capture got wrong");
        app->add_option("--figure", a->figures, "one or several; several are also told apart");
        app->add_option("--dance", a->dance, "the dance that they belong to");
        app->add_option("--role", a->role, "lead, follow or both")
            ->check(CLI::IsMember({"lead", "follow", "both"}));
        app->add_option("--features", a->features, "of the joints: angles or positions")
            ->check(CLI::IsMember({"angles", "positions"}));
        app->add_option("--split", a->split, "learn only from labels of this split");
        app->add_option("--test-split", a->test_split, "tell figures apart in this split, too");
        app->add_option("--min-confidence", a->min_confidence, "learn only from labels as sure")
            ->check(CLI::Range(0.0, 1.0));
        app->add_option("--test-confidence", a->test_confidence, "the same of --test-split")
            ->check(CLI::Range(0.0, 1.0));
        app->add_option("--fps", a->fps, "frames a second, when the file is wrong")
            ->check(CLI::Range(1.0, 1000.0));
        app->add_option("--scale", a->scales, "metres per unit of the file: lead's, follow's")
            ->expected(1, 2)
            ->check(CLI::Range(1e-4, 10.0));
        app->add_option("--most-states", a->most_states, "tried: from 2 to this")
            ->check(CLI::Range(2, 64));
        app->add_option("--states", a->states, "of the models that tell figures apart")
            ->check(CLI::Range(2, 64));
        app->add_option("--iterations", a->iterations, "of Baum-Welch")->check(CLI::Range(0, 100));
        app->add_option("--threads", a->threads, "0: all cores; the page is the same for any")
            ->check(CLI::Range(0, 256));
        app->add_option("-o,--out", a->output, "X.html")->required();
    }

    void add_sheet() {
        auto [app, a] = add(app_, "sheet", "draw a figure as a pose sheet", sheet);
        app->add_option("-o,--out", a->output, "X.png")->required();
        app->add_option("--dance", a->settings.dance, "salsa, belly, house, hiphop, rock or waltz");
        app->add_option("--figure", a->figure, "of the dance, such as basic; none: its first");
        add_figures_option(*app, a->settings);
        app->add_option("--generator", a->settings.generator, kGeneratorHelp);
        app->add_option("--bpm", a->bpm, "tempo danced to")->check(CLI::Range(50.0, 230.0));
        app->add_option("--theme", a->settings.theme, "stage, workshop_dark or studio_light");
        app->add_option("--view", a->settings.view, "skin, stick or auto");
        app->add_option("--quality", a->settings.quality, "auto, fast or high");
    }

    void add_stick() {
        auto [app, a] = add(app_, "stick", "play a motion clip as a stick figure", stick);
        app->add_option("file", a->input, "X.bvh, or a written dance X.toml")->required();
        app->add_option("-o,--out", a->output, "X.png: front and side views, no window");
        app->add_option("--figure", a->figure, "figure of the dance");
        app->add_option("--tempo", a->bpm, "BPM to dance it at")->check(CLI::Range(30.0, 300.0));
        app->add_option("--fps", a->fps, "frames a second, when the file is wrong")
            ->check(CLI::Range(1.0, 1000.0));
        app->add_option("--scale", a->scale, "metres per unit of the file")
            ->check(CLI::Range(1e-4, 10.0));
        app->add_option_function<std::int64_t>(
               "--frame",
               [arguments = a](const std::int64_t& frame) {
                   arguments->frame = static_cast<std::size_t>(frame);
               },
               "stand at this frame; with -o draw it alone")
            ->check(CLI::NonNegativeNumber);
        app->add_option("--theme", a->settings.theme, "stage, workshop_dark or studio_light");
        app->add_option("--size", a->settings.size, "of the window, such as 1280x720");
        app->add_option("--quality", a->settings.quality, "auto, fast or high");
    }

    void add_synth() {
        auto [app, a] = add(app_, "synth", "write music of our own generator", synth);
        app->add_option(
            "style", a->style, "salsa, maqsum, house, rock, hiphop, waltz, drums or clicks");
        app->add_option("-o,--out", a->output, "X.wav")->required();
        app->add_option("--bpm", a->bpm, "tempo")->check(CLI::Range(50.0, 230.0));
        app->add_option("--duration", a->seconds, "seconds")->check(CLI::Range(1.0, 3600.0));
        app->add_option("--seed", a->seed, "same seed, same music")->check(CLI::NonNegativeNumber);
    }

    void add_bench() {
        auto [app, a] = add(app_, "bench", "measure this machine", bench);
        app->add_option("what", a->what, "latency, analysis, motion, render or train")
            ->required()
            ->check(CLI::IsMember({"latency", "analysis", "motion", "render", "train"}));
        app->add_flag("--json", a->as_json, "one JSON document");
        app->add_option("--duration", a->seconds, "seconds of music")
            ->check(CLI::Range(5.0, 3600.0));
    }

    void add_config() {
        auto [app, a] = add(app_, "config", "show, locate or create the settings file", config);
        app->add_option("action", a->action, "show, path or init")
            ->check(CLI::IsMember({"show", "path", "init"}));
    }

    engine::Settings settings_;
    CLI::App app_{"raks: an avatar that dances to what it hears", "raks"};
    std::function<ExitCode()> run_;
    std::function<std::string()> settings_fault_;
};

}  // namespace

ParsedCommand parse_arguments(int argc, char** argv) {
    auto settings = engine::load_settings();
    if (!settings) {
        std::fprintf(stderr, "raks: %s\n", settings.error().message.c_str());
        return {nullptr, kExitUsage};
    }
    Parser parser(*settings);
    return parser.parse(argc, argv);
}

}  // namespace raks::cli
