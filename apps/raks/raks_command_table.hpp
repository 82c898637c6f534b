#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
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

    /// As CommandTable::add; arguments that have settings get those of the files first. Whatever
    /// the command does with them, avatars and label files that are named must be there.
    template <typename Arguments>
    Command<Arguments> add(CLI::App& parent,
                           const char* name,
                           const char* help,
                           ExitCode (*run)(const Arguments&)) {
        auto command = CommandTable::add(parent, name, help, run);
        add_talk_options(*command.app);
        if constexpr (requires { command.arguments->settings; }) {
            command.arguments->settings = settings_;
        }
        command.app->callback([this, command, run] {
            if constexpr (requires { command.arguments->settings; }) {
                note_options(*command.app, command.arguments->settings);
                chosen_settings_ = {command.arguments, &command.arguments->settings};
            }
            const bool has_avatars = command.app->get_option_no_throw("--avatar") != nullptr;
            choose([arguments = command.arguments, has_avatars, run] {
                auto checked = check_files(*arguments, has_avatars);
                return checked ? run(*arguments) : ExitCode(fail(std::move(checked.error())));
            });
        });
        return command;
    }

    /// Settings of the command that was asked for; null where it has none.
    [[nodiscard]] const engine::Settings* chosen_settings() const noexcept {
        return chosen_settings_.get();
    }

 private:
    // Those that options name. `has_avatars`: settings name some, too.
    template <typename Arguments>
    [[nodiscard]] static Expected<void> check_files(Arguments& arguments, bool has_avatars) {
        if constexpr (requires { arguments.options.labels; }) {
            return check_labels(arguments.options.labels);
        } else if constexpr (requires { arguments.settings; }) {
            if (!has_avatars) {
                return {};
            }
            replace_missing_avatars(arguments.settings);
            return check_avatars(arguments.settings);
        }
        return {};
    }
    // Which settings the command line has set.
    static void note_options(const CLI::App& app, engine::Settings& settings);
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

/// Adds completion.
void add_completion_command(RaksCommands& table);
/// Prints what may stand next on a command line (apps/terminal/completion.hpp).
[[nodiscard]] ExitCode print_candidates(RaksCommands& table, const std::vector<std::string>& words);

/// Replaces this process by a program of ours that lies beside it; returns only when that fails.
[[nodiscard]] ExitCode become(const char* name,
                              const std::string& command,
                              const std::vector<std::string>& arguments);

}  // namespace raks::apps
