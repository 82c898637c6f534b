#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "apps/clips/body_options.hpp"
#include "apps/clips/joint_options.hpp"
#include "apps/raks/preset_option.hpp"
#include "apps/raks/raks_command_table.hpp"
#include "apps/terminal/option_checks.hpp"
#include "engine/remote/listen_place.hpp"
#include "engine/remote/osc_input.hpp"
#include "engine/remote/remote_server.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using engine::Settings;

constexpr const char* kMotionHelp =
    "clip to perform instead of a dance: X.vrma, X.glb, X.glb#NAME of several, X.bvh, X.vmd, ...";

// Several times, each with one value: what stands behind that is another argument. (The parser
// holds to that where nearly any number is allowed.)
void take_one_each_time(CLI::Option& option) {
    option.expected(1, CLI::detail::expected_max_vector_size - 1)->allow_extra_args(false);
}

void check_number_of_outputs(const std::string& option, std::size_t number) {
    if (number > engine::kMostOutputs) {
        throw CLI::ValidationError(option, fmt::format("at most {}", engine::kMostOutputs));
    }
}

// Names and ranges are checked with the settings, after parsing.
void add_setting_option(CLI::App& app, engine::Settings& settings, const engine::SettingRow& row) {
    const std::string name(row.option.name);
    const std::string help =
        row.option.help.empty() ? engine::help_of(row) : std::string(row.option.help);
    std::visit(
        [&](auto field) {
            auto& value = settings.*field;
            using Value = std::remove_reference_t<decltype(value)>;
            if constexpr (std::is_same_v<Value, bool>) {
                app.add_flag(name + ",!--no-" + name.substr(2), value, help);
            } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
                take_one_each_time(*app.add_option(name, value, help));
            } else {
                app.add_option(name, value, help);
            }
        },
        row.field);
}

void add_as_live_option(CLI::App& app, bool& is_as_live) {
    app.add_flag("--as-live",
                 is_as_live,
                 "analyze the music as it comes, as live does, and not all of it first");
}

// A row of the table of outputs each; several of one kind may be told.
void add_output_options(CLI::App& app, std::vector<engine::OutputWish>& wishes) {
    for (const engine::OutputKind& kind : engine::output_kinds()) {
        const std::string name = "--" + std::string(kind.option);
        auto* const option = app.add_option_function<std::vector<std::string>>(
            name,
            [&kind, &wishes, name](const std::vector<std::string>& targets) {
                check_number_of_outputs(name, targets.size());
                // Those of a preset.
                std::erase_if(wishes, [&](const auto& wish) { return wish.kind == &kind; });
                for (const std::string& target : targets) {
                    wishes.push_back({&kind, target});
                }
            },
            std::string(kind.help));
        take_one_each_time(*option);
        option->type_name(std::string(kind.target))->check([&kind](const std::string& target) {
            const auto checked = kind.check(target);
            return checked ? std::string() : checked.error().message;
        });
    }
}

// What would mix on standard output, or cannot be written, is wrong usage.
void check_video(const VideoArguments& video,
                 const std::vector<engine::OutputWish>& outputs,
                 const Settings& settings) {
    const auto on_stdout = std::count_if(video.wishes.begin(),
                                         video.wishes.end(),
                                         [](const auto& wish) { return wish.is_stdout(); });
    const auto lines = std::count_if(
        outputs.begin(), outputs.end(), [](const auto& wish) { return wish.target == "-"; });
    if (on_stdout + lines > 1) {
        throw CLI::ValidationError("--video-out", "only one output can go to standard output");
    }
    const bool is_y4m = std::any_of(video.wishes.begin(), video.wishes.end(), [](const auto& wish) {
        return wish.form == engine::PixelForm::y4m;
    });
    if (is_y4m && settings.backdrop == "transparent") {
        throw CLI::ValidationError("--video-form",
                                   "y4m has no alpha: give --backdrop a colour such as #00ff00");
    }
}

// --overlay given by hand is meant for the outputs, too.
void add_video_options(CLI::App& app,
                       VideoArguments& video,
                       const std::vector<engine::OutputWish>& outputs,
                       const Settings& settings) {
    auto* const targets_option = app.add_option_function<std::vector<std::string>>(
        "--video-out",
        [&video](const std::vector<std::string>& targets) {
            check_number_of_outputs("--video-out", targets.size());
            video.wishes.clear();  // those of a preset
            for (const std::string& target : targets) {
                video.wishes.push_back({.target = target});
            }
        },
        "the pictures go there, too: pipewire, pipewire:NAME, a pipe with a name, - for stdout");
    targets_option->type_name("TARGET");
    take_one_each_time(*targets_option);
    const CLI::Option* const form =
        app.add_option("--video-form", "pictures in a pipe: rgba (premultiplied) or y4m (no alpha)")
            ->check(one_of({"rgba", "y4m"}));
    app.add_option("--video-offset", video.offset_ms, "milliseconds, pictures later than the sound")
        ->check(in_range(-1000.0, 1000.0));
    app.add_option("--record", video.record, "film the show while it runs: X.mp4, X.mkv")
        ->type_name("FILE");
    const CLI::Option* const overlay = app.get_option("--overlay");
    app.parse_complete_callback([&video, &outputs, &settings, form, overlay] {
        video.has_overlay = overlay->count() > 0 && settings.overlay;
        if (form->count() > 0 && form->as<std::string>() == "y4m") {
            for (engine::VideoWish& wish : video.wishes) {
                wish.form = engine::PixelForm::y4m;
            }
        }
        check_video(video, outputs, settings);
    });
}

// Who else may ask for actions.
void add_remote_options(CLI::App& app, RemoteArguments& remote) {
    app.add_option(
           "--osc-in", remote.osc_in, "OSC asks for actions: PORT of this machine, ADDRESS:PORT")
        ->type_name("PORT")
        ->check([](const std::string& place) {
            const auto checked = engine::check_osc_input(place);
            return checked ? std::string() : checked.error().message;
        });
    app.add_option("--midi-in", remote.midi_in, "a MIDI controller whose name holds NAME asks")
        ->type_name("NAME")
        ->check([](const std::string& name) { return name.empty() ? "it is empty" : ""; });
    app.add_flag("--link", remote.follows_link, "beats are those of Ableton Link's session");
    auto* const server =
        app.add_flag("--remote", remote.has_server, "HTTP and a page for phones ask for actions");
    app.add_option("--remote-address", remote.address, "where it listens: ADDRESS, ADDRESS:PORT")
        ->type_name("ADDRESS")
        ->needs(server)
        ->check([](const std::string& place) {
            const auto parsed = engine::parse_listen_place(place, engine::RemoteServer::kUsualPort);
            return parsed ? std::string() : parsed.error().message;
        });
    const std::string help = "what opens the page from elsewhere: new at every start, or keep";
    app.add_option_function<std::string>(
           "--remote-token",
           [&remote](const std::string& word) { remote.keeps_token = word == "keep"; },
           help)
        ->needs(server)
        ->check(one_of({"new", "keep"}));
}

// A function, since neither yes nor no is a third value.
void add_player_option(CLI::App& app, std::optional<bool>& now_playing) {
    app.add_flag_function(
        "--now-playing,!--no-now-playing",
        [&now_playing](std::int64_t count) { now_playing = count > 0; },
        "players on this computer say what they play; on with a monitor");
}

void add_window_options(CLI::App& app, WindowWish& window) {
    app.add_flag("--fullscreen", window.is_fullscreen, "fill the screen");
    app.add_flag("--borderless", window.is_borderless, "a window without title and frame");
    app.add_flag("--on-top", window.is_on_top, "a window over all others");
}

// --start and --duration, which play and render share.
void add_section_options(CLI::App& app, Section& section) {
    app.add_option("--start", section.start, "seconds into the file")
        ->check(in_range(0.0, kLongestSeconds));
    // A function, since an optional has no value to parse into.
    app.add_option_function<double>(
           "--duration",
           [&section](const double& seconds) { section.duration = seconds; },
           "seconds; to the end when not given")
        ->check(in_range(kShortestSeconds, kLongestSeconds));
}

// A clip instead of a dance, and when it is performed.
void add_motion_options(CLI::App& app, MotionWish& motion) {
    auto* const clip = app.add_option("--motion", motion.file, kMotionHelp);
    app.add_option_function<std::string>(
           "--sync",
           [&motion](const std::string& word) {
               motion.sync = word == "song" ? engine::ClipSync::song : engine::ClipSync::beat;
           },
           "the clip goes by the song that it was made for, or by any music's beat: song or beat")
        ->check(one_of({engine::kClipSyncNames.begin(), engine::kClipSyncNames.end()}))
        ->needs(clip);
    app.add_option_function<double>(
           "--offset",
           [&motion](const double& seconds) { motion.offset = seconds; },
           "seconds of the song at the clip's first pose")
        ->check(in_range(-kLongestSeconds, kLongestSeconds))
        ->needs(clip);
    auto* const loop =
        app.add_flag("--loop", motion.loops, "the clip begins again at its end")->needs(clip);
    app.add_flag("--no-loop", motion.does_not_loop, "the clip is performed once")
        ->needs(clip)
        ->excludes(loop);
    add_arm_angle_option(app, motion.arm_angle)->needs(clip);
    app.add_option("--camera-motion", motion.camera, "X.vmd that moves the camera")
        ->type_name("FILE");
}

// In a window the camera's file goes with the clip, and is nothing without it.
void add_live_motion_options(CLI::App& app, MotionWish& motion) {
    add_motion_options(app, motion);
    app.get_option("--camera-motion")->needs(app.get_option("--motion"));
}

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

void add_setting_options(CLI::App& app,
                         engine::Settings& settings,
                         std::initializer_list<engine::SettingField> fields) {
    for (const engine::SettingField field : fields) {
        add_setting_option(app, settings, engine::row_of(field));
    }
}

void add_setting_options(CLI::App& app,
                         engine::Settings& settings,
                         engine::SettingCommands command) {
    for (const bool is_of_sound : {false, true}) {
        for (const engine::SettingRow& row : engine::setting_rows()) {
            if ((row.option.commands & command) != 0 && (row.section == "audio") == is_of_sound &&
                app.get_option_no_throw(std::string(row.option.name)) == nullptr) {
                add_setting_option(app, settings, row);
            }
        }
    }
}

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
