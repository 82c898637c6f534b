#include "apps/raks/command_options.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "apps/clips/body_options.hpp"
#include "apps/terminal/command_table.hpp"
#include "apps/terminal/option_checks.hpp"
#include "engine/remote/listen_place.hpp"
#include "engine/remote/osc_input.hpp"
#include "engine/remote/remote_server.hpp"
#include "engine/setup/settings_table.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using engine::Settings;

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

void add_as_live_option(CLI::App& app, bool& is_as_live) {
    app.add_flag("--as-live",
                 is_as_live,
                 "analyze the music as it comes, as live does, and not all of it first");
}

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

void add_live_motion_options(CLI::App& app, MotionWish& motion) {
    add_motion_options(app, motion);
    app.get_option("--camera-motion")->needs(app.get_option("--motion"));
}

}  // namespace raks::apps
