#include <cstdint>
#include <map>
#include <string>

#include "apps/clips/body_options.hpp"
#include "apps/clips/joint_options.hpp"
#include "apps/raks/command_options.hpp"
#include "apps/raks/raks_command_table.hpp"
#include "apps/terminal/option_checks.hpp"

namespace raks::apps {
namespace {

using engine::Settings;

// Adds --beat to a command that takes one method, or several by repeating it.
template <typename Methods>
void add_beat_option(CLI::App& app, Methods& method) {
    const std::map<std::string, FileBeatMethod> names = {
        {"pointer", FileBeatMethod::pointer},
        {"whole", FileBeatMethod::whole},
        {"paper", FileBeatMethod::paper},
        {"paper-whole", FileBeatMethod::paper_whole},
    };
    // allow_extra_args(false): the word after the method is the file, not another method.
    app.add_option("--beat",
                   method,
                   "tracker: pointer, or the paper's method, both streaming; whole and paper-whole "
                   "have the whole file before them")
        ->transform(CLI::CheckedTransformer(names))
        ->allow_extra_args(false)
        ->option_text("pointer|whole|paper|paper-whole");
}

// Each add_ function below adds one command with its options.
void add_devices(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "devices", "list inputs and loudspeakers", devices);
    add_setting_options(*app, a->settings, {&Settings::audio_system});
    auto* const json = app->add_flag("--json", a->as_json, "one JSON document");
    app->add_flag("--levels", a->has_levels, "listen to all inputs for a third of a second")
        ->needs(json);
    app->add_flag(
        "--has-output", a->asks_for_output, "print nothing; fail where there is no loudspeaker");
}

// What a person says of a model's file.
void add_model_options(CLI::App& app, std::string& model, engine::AvatarOptions& options) {
    app.add_option("model", model, "file, or name of one of `raks avatar list`")->required();
    app.add_option("--labels", options.labels, "file that says which nodes are its bones");
}

void add_height_option(CLI::App& app, engine::AvatarOptions& options) {
    app.add_option_function<float>(
           "--height",
           [&options](const float& height) { options.height = height; },
           "metres that it is tall; else as its file has it")
        ->check(in_range(0.01F, 10.0F));
}

void add_avatar_pose(RaksCommands& table, CLI::App& avatar) {
    auto [app, a] =
        table.add(avatar, "pose", "write a model in a posture, or moved by a clip", avatar_pose);
    add_model_options(*app, a->model, a->options);
    add_height_option(*app, a->options);
    auto* const pose =
        app->add_option("--pose", a->pose, "posture: FILE.json, or FILE.json#NAME of several");
    auto* const motion = app->add_option(
        "--motion", a->motion, "clip: X.vrma, X.glb, X.glb#NAME of several, X.bvh, ...");
    pose->excludes(motion);
    add_joint_options(*app, a->joints, "the clip", motion);
    add_arm_angle_option(*app, a->arm_angle)->needs(motion);
    app->add_option("--time", a->time, "seconds into the clip, or all")->needs(motion);
    app->add_option("-o,--out", a->output, "X.png: a picture; X.obj: the mesh; X.tsv: joints")
        ->required();
}

void add_avatar_export(RaksCommands& table, CLI::App& avatar) {
    auto [app, a] =
        table.add(avatar, "export", "write a model as VRM 1.0, GLB, 3DS or OBJ", avatar_export);
    app->add_option("output", a->output, "X.vrm, X.glb, X.3ds or X.obj")->required();
    app->add_option(
        "--from", a->model, "file, or name of one of `raks avatar list`; else the mannequin");
    app->add_option("--labels", a->options.labels, "file that says which nodes are its bones");
    add_height_option(*app, a->options);
    app->add_option("--title", a->title, "what it is called; else as its file has it");
    app->add_option("--author", a->authors, "whose work it is; one each time")
        ->allow_extra_args(false);
    app->add_option("--licence", a->licence, "its licence, in words or by its address");
}

// `avatar` itself does nothing: one of its commands must follow.
void add_avatar(RaksCommands& table) {
    CLI::App* avatar = table.app().add_subcommand("avatar", "list avatars, look into their files");
    avatar->require_subcommand(1);
    auto [list, l] = table.add(*avatar, "list", "list the avatars that there are", avatar_list);
    list->add_flag("--json", l->as_json, "one JSON document");
    auto [show, s] = table.add(*avatar, "show", "tell what is in the file of a model", avatar_show);
    add_model_options(*show, s->model, s->options);
    add_height_option(*show, s->options);
    show->add_option("--expression", s->expression, "what a face does: happy=1,blink=0.6");
    show->add_option("--thumbnail", s->thumbnail, "X.png: a picture of it");
    show->add_flag("--json", s->as_json, "one JSON document");
    add_avatar_pose(table, *avatar);
    add_avatar_export(table, *avatar);
}

void add_xbody(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "xbody", "look at a model and its bones", xbody);
    add_model_options(*app, a->model, a->options);
    add_height_option(*app, a->options);
    auto* const motion = app->add_option(
        "--motion", a->motion, "clip: X.vrma, X.glb, X.glb#NAME of several, X.bvh, ...");
    add_joint_options(*app, a->joints, "the clip", motion);
    add_arm_angle_option(*app, a->arm_angle)->needs(motion);
    app->add_option_function<std::int64_t>(
           "--frame",
           [arguments = a](const std::int64_t& frame) {
               arguments->frame = static_cast<std::size_t>(frame);
           },
           "frame of the clip, from 0")
        // As a whole number with a sign: a negative frame is refused instead of wrapped around.
        ->check(in_range<std::int64_t>(0, 1'000'000'000))
        ->needs(motion);
    app->add_option("--view", a->view, "front, side, back or top")
        ->check(one_of({"front", "side", "back", "top"}));
    app->add_option("--size", a->size, "size of the window or picture, such as 1280x720");
    app->add_flag("--names", a->has_names, "names of the bones that a figure needs, beside them");
    auto* const output = app->add_option(
        "-o,--out",
        a->output,
        "instead of a window: X.png, a film (.mp4, .avi, .mkv, .webm), or a folder of pictures");
    app->add_option("--rate", a->rate, "how fast a film plays: -2 to 4, 1 as recorded")
        ->check(in_range(-2.0, 4.0))
        ->needs(output);
}

void add_calibrate(RaksCommands& table) {
    auto [app, a] = table.add(table.app(),
                              "calibrate",
                              "measure how late a loudspeaker is heard, and keep it",
                              calibrate);
    auto* const loop =
        app->add_flag("--loop", a->by_loop, "clicks, heard by a microphone or through a cable");
    auto* const tap =
        app->add_flag("--tap", a->by_taps, "clicks, to which you tap a key")->excludes(loop);
    app->add_flag("--forget", a->forgets, "measure nothing: forget what is kept")
        ->excludes(loop)
        ->excludes(tap);
    app->parse_complete_callback([arguments = a] {
        if (!arguments->by_loop && !arguments->by_taps && !arguments->forgets) {
            throw CLI::RequiredError("--loop, --tap or --forget");
        }
    });
    add_setting_options(*app, a->settings, {&Settings::output});
    app->add_option("--device", a->settings.device, "microphone: name, part of it, or number");
    add_setting_options(*app, a->settings, {&Settings::audio_system});
}

void add_analyze(RaksCommands& table) {
    auto [app, a] =
        table.add(table.app(), "analyze", "tell beats, tempo and dance of files", analyze);
    app->add_option("files", a->inputs, "music files, folders, playlists, - for a pipe")
        ->required();
    app->add_flag("--json", a->as_json, "one JSON document");
    add_setting_options(*app, a->settings, {&Settings::tagger, &Settings::ignore_tags});
    add_beat_option(*app, a->beat);
    app->add_flag_callback(
        "--whole",
        [arguments = a] { arguments->beat = FileBeatMethod::whole; },
        "with the whole file before it, as play and render dance to it");
    auto* plot = app->add_option("--plot", a->plot, "X.svg: a picture of the analysis");
    app->add_option("--reference", a->reference, "beats to draw beside: seconds, bar position")
        ->needs(plot);
}

void add_eval_dance(RaksCommands& table, CLI::App& eval) {
    auto [app, a] = table.add(eval, "dance", "measure the dancer on generated music", eval_dance);
    app->add_flag("--json", a->as_json, "one JSON document");
    add_named_option(*app, "--role", a->role, motion::kRoleNames, "lead or follow");
    app->add_option("--dance", a->settings.dance, "the dance to measure");
    add_setting_options(
        *app, a->settings, {&Settings::figures, &Settings::generator, &Settings::dynamics});
    app->add_option("--formation", a->settings.formation, "solo or couple")
        ->check(one_of({"solo", "couple"}));
    add_setting_options(*app, a->settings, {&Settings::seed});
    auto* const trial =
        app->add_option("--trial", a->trials, "only this trial, such as drums-120 or dynamics")
            ->allow_extra_args(false);
    app->add_option(
           "--against", a->against, "music files: how dances to them follow their loudness")
        ->excludes(trial);
    auto* clips = app->add_option(
        "--clips", a->clips, "folder of people's clips, TAKE.bvh or of another format");
    auto* labels =
        app->add_option("--labels", a->labels, "TSV: take, role, start, end, figure, ...");
    // Clips are useless without labels, and labels without clips.
    clips->needs(labels);
    labels->needs(clips);
    app->add_option("--counts", a->counts, "TSV: when each count falls")->needs(clips);
    app->add_option("--faults", a->faults, "TSV: stretches that the capture got wrong")
        ->needs(clips);
    app->add_option("--fps", a->fps, "frames a second of the clips, when they are wrong")
        ->check(in_range(1.0, 1000.0));
    app->add_option("--scale", a->scale, "metres per unit of the clips")
        ->check(in_range(1e-4, 10.0));
    add_joint_options(*app, a->joints, "the clips", clips);
}

void add_eval_avatar(RaksCommands& table, CLI::App& eval) {
    auto [app, a] = table.add(eval, "avatar", "measure how avatars wear dances", eval_avatar);
    app->add_option("models", a->models, "files, or names of `raks avatar list`")->required();
    app->add_option("--dance", a->settings.dance, "only this dance; else all");
    add_setting_options(*app, a->settings, {&Settings::seed});
    app->add_flag("--json", a->as_json, "one JSON document");
}

void add_eval_genre(RaksCommands& table, CLI::App& eval) {
    auto [app, a] = table.add(eval, "genre", "measure how dances are told apart", eval_genre);
    app->add_option("folder", a->folder, "folder of music, with one folder for each genre")
        ->required();
    app->add_option("--groups", a->groups, "table of its clips: clip, genre, artist, label");
    app->add_option("--model", a->model, "X.json instead of the one that comes with Raks");
    app->add_option("--labels", a->labels, "only clips with one of these labels, such as AB");
    app->add_flag("--damage",
                  a->with_damage,
                  "also with damaged sound: quieter, low-passed, with noise, in a room");
    add_named_option(*app,
                     "--tagger",
                     a->tagger,
                     engine::kTaggerUseNames,
                     "on, or off: the decision is judged without the music tagger");
    app->add_option("--plot", a->plots, "folder for NAME.svg: what each part thinks over time");
    app->add_option("--threads", a->threads)->check(in_range(1, 64));
    app->add_flag("--json", a->as_json, "one JSON document");
}

void add_eval_music(RaksCommands& table, CLI::App& eval) {
    auto [app, a] =
        table.add(eval, "music", "measure how stops, drops and endings are told", eval_music);
    auto* folder = app->add_option("folder", a->folder, "NAME.events, NAME.ogg; else own songs");
    app->add_option("--tolerance", a->tolerance, "seconds within which an annotated event is found")
        ->check(in_range(0.05, 5.0))
        ->needs(folder);
    app->add_flag("--each", a->asks_for_each, "what was missed and wrongly told in each song");
    app->add_option("--seed", a->seed, "seed of the first song of each style")
        ->check(in_range(0, 1'000'000'000));
    app->add_option("--songs", a->songs, "songs of each style")->check(in_range(1, 1000));
    app->add_option("--duration", a->seconds, "seconds of a song")->check(in_range(20.0, 3600.0));
    app->add_flag("--json", a->as_json, "one JSON document");
}

// `eval` itself does nothing: one of its commands must follow.
void add_eval(RaksCommands& table) {
    CLI::App* eval =
        table.app().add_subcommand("eval", "measure beats, genre, music, dance and avatars");
    eval->require_subcommand(1);
    auto [app, a] = table.add(*eval, "beats", "score the beat tracker", eval_beats);
    app->add_option("folder", a->corpus, "index.tsv, NAME.beats, NAME.ogg")->required();
    app->add_flag("--json", a->as_json, "one JSON document");
    app->add_flag("--each", a->asks_for_each, "a row for each excerpt");
    app->add_option("--class", a->category, "only excerpts of this class");
    app->add_option("--out", a->output, "folder for NAME.beats and NAME.pred: beats as announced");
    app->add_option("--peers", a->peers, "folder of NAME.beats, or a folder per tracker")
        ->allow_extra_args(false);
    app->add_option("--network", a->network, "X.json for the pointer, or none: onsets alone");
    app->add_option("--leave-class-out",
                    a->left_out,
                    "folder of CLASS.json: networks that were trained without that class");
    add_beat_option(*app, a->methods);
    add_eval_avatar(table, *eval);
    add_eval_dance(table, *eval);
    add_eval_genre(table, *eval);
    add_eval_music(table, *eval);
}

void add_bench(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "bench", "measure this machine", bench);
    app->add_option("what", a->what, "latency, analysis, motion, render, avatar, train or capture")
        ->required()
        ->check(one_of({"latency", "analysis", "motion", "render", "avatar", "train", "capture"}));
    app->add_option(
        "model", a->model, "model for avatar: file, or name of one of `raks avatar list`");
    app->parse_complete_callback([arguments = a] {
        if ((arguments->what == "avatar") == arguments->model.empty()) {
            throw CLI::RequiredError(arguments->model.empty() ? "MODEL of `raks bench avatar`"
                                                              : "avatar, before a model");
        }
    });
    app->add_flag("--json", a->as_json, "one JSON document");
    app->add_option("--duration", a->seconds, "seconds of music")->check(in_range(5.0, 3600.0));
    app->add_flag("--held", a->is_held, "latency: beats are tapped, and the tempo is held");
}

}  // namespace

void add_measuring_commands(RaksCommands& table) {
    add_devices(table);
    add_avatar(table);
    add_xbody(table);
    add_calibrate(table);
    add_analyze(table);
    add_eval(table);
    add_bench(table);
}

}  // namespace raks::apps
