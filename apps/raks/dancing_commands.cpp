#include <cstdint>
#include <string>

#include "apps/clips/body_options.hpp"
#include "apps/clips/joint_options.hpp"
#include "apps/raks/command_options.hpp"
#include "apps/raks/preset_option.hpp"
#include "apps/raks/raks_command_table.hpp"
#include "apps/terminal/option_checks.hpp"

namespace raks::apps {
namespace {

using engine::Settings;

// Each add_ function below adds one command with its options.
void add_play(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "play", "play files and dance to them", play);
    add_preset_option(*app, a->settings, &a->video, &a->outputs);
    app->add_option("files",
                    a->files,
                    "music files, folders, playlists (.m3u, .pls, .xspf), - for a pipe; none: "
                    "music that Raks makes");
    app->add_flag(
        "--shuffle", a->is_shuffled, "play the files in a mixed order; same seed, same order");
    app->add_flag("--repeat", a->repeats, "begin again after the last file");
    app->add_flag("--quit", a->quits, "close the window after the last file");
    add_setting_options(
        *app,
        a->settings,
        {&Settings::output, &Settings::audio_system, &Settings::buffer_ms, &Settings::volume});
    app->add_flag("--headless", a->is_headless, "no window");
    app->add_flag("--no-sound", a->is_soundless, "no loudspeaker: paced by the clock");
    add_window_options(*app, a->window);
    add_live_motion_options(*app, a->motion);
    add_as_live_option(*app, a->is_as_live);
    add_section_options(*app, a->section);
    add_setting_options(*app, a->settings, engine::kPlay);
    add_output_options(*app, a->outputs);
    add_remote_options(*app, a->remote);
    add_player_option(*app, a->now_playing);
    add_video_options(*app, a->video, a->outputs, a->settings);
}

// What the desktop's icon starts.
void add_open(RaksCommands& table) {
    auto [app, a] = table.add(table.app(),
                              "open",
                              "open the window: dance to files, or to what this computer plays",
                              open);
    add_preset_option(*app, a->settings, &a->video, &a->outputs);
    app->add_option("files", a->files, "music files, folders, playlists; none: listen");
    add_setting_options(*app,
                        a->settings,
                        {&Settings::device,
                         &Settings::output,
                         &Settings::audio_system,
                         &Settings::buffer_ms,
                         &Settings::volume});
    add_window_options(*app, a->window);
    add_live_motion_options(*app, a->motion);
    add_setting_options(*app, a->settings, engine::kPlay);
    add_output_options(*app, a->outputs);
    add_remote_options(*app, a->remote);
    add_player_option(*app, a->now_playing);
    add_video_options(*app, a->video, a->outputs, a->settings);
}

void add_live(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "live", "listen to an input and dance to it", live);
    add_preset_option(*app, a->settings, &a->video, &a->outputs);
    add_setting_options(
        *app, a->settings, {&Settings::device, &Settings::audio_system, &Settings::buffer_ms});
    // The arguments are captured by their pointer: they outlive the parsing.
    app->add_option_function<double>(
           "--duration",
           [arguments = a](const double& seconds) { arguments->duration = seconds; },
           "seconds to listen; until stopped when not given")
        ->check(in_range(kShortestSeconds, kLongestSeconds));
    app->add_flag("--headless", a->is_headless, "no window");
    auto* const bare = app->add_flag(
        "--no-avatar", a->has_no_avatar, "nobody dances: no window, only beats for other programs");
    add_window_options(*app, a->window);
    add_live_motion_options(*app, a->motion);
    add_setting_options(*app, a->settings, engine::kLive);
    add_output_options(*app, a->outputs);
    add_remote_options(*app, a->remote);
    add_player_option(*app, a->now_playing);
    add_video_options(*app, a->video, a->outputs, a->settings);
    for (const char* const option : {"--video-out", "--record", "--motion"}) {
        bare->excludes(app->get_option(option));
    }
}

void add_render(RaksCommands& table) {
    auto [app, a] =
        table.add(table.app(), "render", "write a video of the dance to a file", render);
    add_preset_option(*app, a->settings);
    app->add_option("file", a->input, "music file; none: music that Raks makes");
    app->add_option("-o,--out", a->output, "X.mp4, X.mkv, X.webm, X.avi, or a folder for .png")
        ->required();
    auto* const alpha =
        app->add_flag("--alpha",
                      a->has_alpha,
                      "nothing behind the dance, and the film keeps it: X.mov, X.webm or a folder");
    add_motion_options(*app, a->motion);
    add_as_live_option(*app, a->is_as_live);
    add_section_options(*app, a->section);
    // A window's overlay is a setting, a film has it only when asked for.
    a->settings.overlay = false;
    add_setting_options(*app, a->settings, engine::kRender);
    app->get_option("--fps")->check([](const std::string& word) {
        double fps = 1.0;
        return CLI::detail::lexical_cast(word, fps) && fps == 0.0
                   ? "0 is as many pictures a second as a monitor shows, and a film needs 1 to 240"
                   : "";
    });
    alpha->excludes(app->get_option("--backdrop"));
}

void add_dance(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "dance", "write the dance to a file as motion", dance);
    add_preset_option(*app, a->settings);
    app->add_option("file", a->input, "music file")->required();
    app->add_option("-o,--out",
                    a->output,
                    "X.bvh, X.vrma, X.vmd, X.glb with the avatar; of several dancers X_1.bvh, ...")
        ->required();
    app->add_option_function<std::string>(
           "--legs",
           [arguments = a](const std::string& word) {
               arguments->legs = word == "fk" ? motion::MmdLegs::fk : motion::MmdLegs::ik;
           },
           "of X.vmd: ik, goals for the feet (the usual way), or fk, turns alone")
        ->check(one_of({"ik", "fk"}));
    app->add_option("--fps", a->fps, "poses a second")->check(in_range(1.0, 240.0));
    add_as_live_option(*app, a->is_as_live);
    // Who dances stands before what is danced.
    add_setting_options(*app,
                        a->settings,
                        {&Settings::formation,
                         &Settings::dancers,
                         &Settings::avatars,
                         &Settings::avatar_height,
                         &Settings::avatar_labels});
    add_setting_options(*app, a->settings, engine::kDance);
}

void add_dances(RaksCommands& table) {
    auto [app, a] = table.add(
        table.app(), "dances", "list the dances that there are, and where they lie", dances);
    app->add_flag("--json", a->as_json, "one JSON document");
}

void add_sheet(RaksCommands& table) {
    auto [app, a] =
        table.add(table.app(), "sheet", "draw a figure as a pose sheet, or film it", sheet);
    add_preset_option(*app, a->settings);
    app->add_option("-o,--out", a->output, "X.png; a film: X.mp4, X.mkv, X.webm, X.avi, a folder")
        ->required();
    auto* const motion = app->add_option("--motion", a->motion, kMotionHelp);
    add_arm_angle_option(*app, a->arm_angle)->needs(motion);
    app->add_option("--dance", a->settings.dance, "name, folder or written dance (X.toml)")
        ->excludes(motion);
    app->add_option("--figure", a->figure, "figure of the dance, such as basic; none: its first")
        ->excludes(motion);
    add_setting_options(*app, a->settings, {&Settings::figures, &Settings::generator});
    app->add_option("--bpm", a->bpm, "tempo danced to")->check(in_range(50.0, 230.0));
    // The settings' checks would report it, too; here the option is named.
    app->add_option("--seed", a->settings.seed, "same seed, same dance")
        ->check(CLI::NonNegativeNumber);
    app->add_option("--fps", a->settings.fps, "pictures a second of a film")
        ->check(CLI::Range(1.0, 240.0));
    // One dances, so that there is one avatar.
    app->add_option("--avatar",
                    a->settings.avatars,
                    "mannequin, a file (.vrm, .glb, .gltf, .3ds, .fbx, .dae, .obj), or one of raks "
                    "avatar list")
        ->expected(1)
        ->allow_extra_args(false);
    add_setting_options(*app, a->settings, engine::kSheet);
}

void add_stick(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "stick", "play a motion clip as a stick figure", stick);
    app->add_option("file", a->input, "a motion file, or a written dance X.toml")->required();
    auto* const other = app->add_option("other", a->other, "a second motion, compared with it");
    app->add_option(
        "-o,--out",
        a->output,
        "no window: X.png, front and side views; a film X.mp4, X.avi, X.mkv, X.webm, or "
        "a folder of pictures");
    app->add_flag("--side-by-side", a->is_side_by_side, "two motions apart, not overlaid")
        ->needs(other);
    app->add_option("--align", a->align, "what is done to the second: none, rigid, hips or both")
        ->check(one_of({"none", "rigid", "hips", "both"}))
        ->needs(other);
    app->add_option("--shift", a->shift, "seconds by which the second begins later")
        ->check(in_range(-86400.0, 86400.0))
        ->needs(other);
    app->add_option("--rate", a->rate, "how fast it plays: -2 to 4, 1 as recorded")
        ->check(in_range(-2.0, 4.0));
    app->add_flag("--names", a->has_names, "names of points or joints over the picture");
    app->add_flag("--trails", a->has_trails, "where they were in the last second");
    app->add_option("--edges", a->edges, "which points are joined: X.txt, body25, coco or auto");
    app->add_option("--figure", a->figure, "figure of the dance");
    app->add_option("--tempo", a->bpm, "BPM to dance it at")->check(in_range(30.0, 300.0));
    app->add_option("--fps", a->fps, "frames a second, when the file is wrong")
        ->check(in_range(1.0, 1000.0));
    app->add_option("--skeleton", a->skeleton, "X.asf of a clip that is .amc");
    add_body_options(*app, a->body);
    app->add_flag("--json", a->as_json, "what was found of the clip, as one JSON document");
    app->add_option_function<std::int64_t>(
           "--frame",
           [arguments = a](const std::int64_t& frame) {
               arguments->frame = static_cast<std::size_t>(frame);
           },
           "stand at this frame; with -o draw it alone")
        // As a whole number with a sign: a negative frame is refused instead of wrapped around.
        ->check(in_range<std::int64_t>(0, 1'000'000'000));
    add_joint_options(*app, a->joints, "the clip");
    auto* const counts =
        app->add_option("--counts", a->counts, "X.tsv: beats of takes; FILE may be their folder");
    app->add_option("--strips", a->strips, "FOLDER: pictures of each take's beats, eight a row")
        ->needs(counts);
    auto* const edit =
        app->add_flag("--edit", a->edits, "set the beats of one take right in a window");
    edit->needs(counts);
    auto* const music =
        app->add_option("--music", a->music, "song that the take was danced to")->needs(edit);
    app->add_option("--offset", a->offset, "seconds of the song at the clip's first frame")
        ->check(in_range(-86400.0, 86400.0))
        ->needs(music);
    app->add_option("--write-joints", a->joints_output, "X.toml: write what is found, to mend it");
    add_setting_options(*app, a->settings, {&Settings::theme});
    app->add_option("--camera", a->settings.camera, "wide, portrait, front, side, back or top");
    app->add_option("--size", a->settings.size, "size of the window or film, such as 1280x720");
    add_setting_options(*app, a->settings, {&Settings::quality});
}

void add_synth(RaksCommands& table) {
    auto [app, a] = table.add(table.app(), "synth", "write music that Raks makes itself", synth);
    app->add_option(
        "style",
        a->style,
        "a dance, or montuno, maqsum, four-on-the-floor, backbeat, boom-bap, oom-pah-pah, drums, "
        "clicks; none: the first dance's");
    app->add_option("-o,--out", a->output, "X.wav")->required();
    app->add_option("--beats", a->beats, "X.beats: when each beat falls, and its place in the bar");
    app->add_option(
        "--form",
        a->form,
        "steady; song: sections drawn from the seed; or sections and their beats, such as "
        "full:32,breakdown:16,stop:4,drop:32,ending:8");
    app->add_option("--events", a->events, "X.events: when sections begin, stop and end");
    app->add_option("--bpm", a->bpm, "tempo; else the usual one of the style")
        ->check(in_range(50.0, 230.0));
    app->add_option("--duration", a->seconds, "seconds")->check(in_range(1.0, 3600.0));
    app->add_option("--seed", a->seed, "same seed, same music")
        ->check(in_range<std::int64_t>(0, 9'000'000'000'000'000));
}

}  // namespace

void add_dancing_commands(RaksCommands& table) {
    add_open(table);
    add_play(table);
    add_live(table);
    add_render(table);
    add_dance(table);
    add_dances(table);
    add_sheet(table);
    add_stick(table);
    add_synth(table);
}

}  // namespace raks::apps
