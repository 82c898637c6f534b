#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "engine/cli/commands.hpp"
#include "engine/settings.hpp"

#include <CLI/CLI.hpp>

namespace raks::cli {

/// One command: where its arguments live and what runs it.
template <typename Arguments>
struct Command {
    CLI::App* app = nullptr;
    std::shared_ptr<Arguments> arguments;
};

/// The commands of the program, and the one that the command line asked for.
class CommandTable {
 public:
    /// `settings`: what the files say; options are laid over them.
    explicit CommandTable(engine::Settings settings) : settings_(std::move(settings)) {}

    [[nodiscard]] CLI::App& app() noexcept { return app_; }

    /// A command under `parent`, whose options the caller adds; `run` is chosen when it is asked
    /// for.
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
            if constexpr (requires { arguments->settings; }) {
                chosen_settings_ = {arguments, &arguments->settings};
            }
            choose([arguments, run] { return run(*arguments); });
        });
        return command;
    }

    void choose(std::function<ExitCode()> run) { run_ = std::move(run); }
    /// What was asked for; empty: nothing.
    [[nodiscard]] const std::function<ExitCode()>& chosen() const noexcept { return run_; }
    /// Its settings; null where it has none.
    [[nodiscard]] const engine::Settings* chosen_settings() const noexcept {
        return chosen_settings_.get();
    }

 private:
    engine::Settings settings_;
    CLI::App app_{"raks: an avatar that dances to what it hears", "raks"};
    std::function<ExitCode()> run_;
    std::shared_ptr<const engine::Settings> chosen_settings_;
};

/// play, live, render, dance, sheet, stick, synth.
void add_dancing_commands(CommandTable& table);
/// analyze, eval, bench, devices.
void add_measuring_commands(CommandTable& table);
/// train.
void add_training_commands(CommandTable& table);

/// Options of several commands.
void add_figures_option(CLI::App& app, engine::Settings& settings);
void add_generator_option(CLI::App& app, engine::Settings& settings);

inline constexpr double kShortestSeconds = 0.001;
inline constexpr double kLongestSeconds = 1e7;  // four months

}  // namespace raks::cli
