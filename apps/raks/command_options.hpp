#pragma once

#include <initializer_list>
#include <optional>
#include <vector>

#include "apps/raks/commands.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/settings_table.hpp"

namespace CLI {
/// Of CLI11, whose header is large.
class App;
}  // namespace CLI

/// Options that several commands of `raks` share. What they name must outlive the parsing.
namespace raks::apps {

inline constexpr const char* kMotionHelp =
    "clip to perform instead of a dance: X.vrma, X.glb, X.glb#NAME of several, X.bvh, X.vmd, ...";

/// Adds the options of these settings, in this order.
void add_setting_options(CLI::App& app,
                         engine::Settings& settings,
                         std::initializer_list<engine::SettingField> fields);
/// Adds the options of all settings that the command has by the table, in its order, those of the
/// sound last. Those that were added before are left as they are: their place, help or check is
/// another.
void add_setting_options(CLI::App& app,
                         engine::Settings& settings,
                         engine::SettingCommands command);

/// Adds --as-live.
void add_as_live_option(CLI::App& app, bool& is_as_live);
/// Adds an option for each row of the table of outputs; several of one kind may be told.
void add_output_options(CLI::App& app, std::vector<engine::OutputWish>& wishes);
/// Adds where pictures go. Behind the options of settings: an --overlay given by hand is meant for
/// the outputs, too.
void add_video_options(CLI::App& app,
                       VideoArguments& video,
                       const std::vector<engine::OutputWish>& outputs,
                       const engine::Settings& settings);
/// Adds who else may ask for actions.
void add_remote_options(CLI::App& app, RemoteArguments& remote);
/// Adds --now-playing.
void add_player_option(CLI::App& app, std::optional<bool>& now_playing);
/// Adds how the window opens.
void add_window_options(CLI::App& app, WindowWish& window);
/// Adds --start and --duration.
void add_section_options(CLI::App& app, Section& section);
/// Adds a clip instead of a dance, and when it is performed.
void add_motion_options(CLI::App& app, MotionWish& motion);
/// The same in a window, where the camera's file goes with the clip, and is nothing without it.
void add_live_motion_options(CLI::App& app, MotionWish& motion);

}  // namespace raks::apps
