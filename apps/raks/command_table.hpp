#pragma once

#include <memory>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/terminal/command_table.hpp"
#include "apps/terminal/say.hpp"
#include "engine/setup/settings.hpp"

namespace raks::apps {

/// The commands of `raks`. Arguments with settings begin with what the settings files say.
class RaksCommands : public CommandTable {
 public:
    /// `settings`: read from the files; options are parsed over them.
    explicit RaksCommands(engine::Settings settings)
        : CommandTable("raks: an avatar that dances to what it hears", "raks"),
          settings_(std::move(settings)) {
        add_talk_options(app());
    }

    /// As CommandTable::add; arguments that have settings get those of the files first.
    template <typename Arguments>
    Command<Arguments> add(CLI::App& parent,
                           const char* name,
                           const char* help,
                           ExitCode (*run)(const Arguments&)) {
        auto command = CommandTable::add(parent, name, help, run);
        add_talk_options(*command.app);
        if constexpr (requires { command.arguments->settings; }) {
            command.arguments->settings = settings_;
            command.app->callback([this, arguments = command.arguments, run] {
                chosen_settings_ = {arguments, &arguments->settings};
                choose([arguments, run] { return run(*arguments); });
            });
        }
        return command;
    }

    /// Settings of the command that was asked for; null where it has none.
    [[nodiscard]] const engine::Settings* chosen_settings() const noexcept {
        return chosen_settings_.get();
    }

 private:
    // -q and -v stand before or behind the command.
    static void add_talk_options(CLI::App& app) {
        app.add_flag_callback(
            "-q,--quiet", [] { set_talk(Talk::quiet); }, "say only what went wrong");
        app.add_flag_callback(
            "-v,--verbose", [] { set_talk(Talk::verbose); }, "say more");
    }

    engine::Settings settings_;
    std::shared_ptr<const engine::Settings> chosen_settings_;
};

/// Adds play, live, render, dance, dances, sheet, stick and synth.
void add_dancing_commands(RaksCommands& table);
/// Adds analyze, avatar, eval, bench and devices.
void add_measuring_commands(RaksCommands& table);
/// Adds train, which starts another program.
void add_training_commands(RaksCommands& table);
/// Adds capture, which starts another program.
void add_capture_commands(RaksCommands& table);

/// Adds --figures, which several commands have.
void add_figures_option(CLI::App& app, engine::Settings& settings);
/// Adds --audio-system, which several commands have.
void add_audio_system_option(CLI::App& app, engine::Settings& settings);
/// Adds --dynamics, which several commands have.
void add_dynamics_option(CLI::App& app, engine::Settings& settings);
/// Adds --generator, which several commands have.
void add_generator_option(CLI::App& app, engine::Settings& settings);

}  // namespace raks::apps
