#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "apps/terminal/program.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {

/// A command that was added: the parser of its options, and where they are stored.
template <typename Arguments>
struct Command {
    CLI::App* app = nullptr;  ///< owned by the parent command
    /// Filled while parsing; the caller binds options to its fields.
    std::shared_ptr<Arguments> arguments;
};

/// The commands of a program, and which of them the command line asked for. Threads: main.
class CommandTable {
 public:
    /// `description` and `name` of the program, for its help.
    CommandTable(const char* description, const char* name) : app_(description, name) {}

    /// The program's own parser, the parent of all commands.
    [[nodiscard]] CLI::App& app() noexcept { return app_; }

    /// Adds a command below `parent`; the caller adds its options. `run` is what chosen() returns
    /// when the command line asks for it.
    template <typename Arguments>
    Command<Arguments> add(CLI::App& parent,
                           const char* name,
                           const char* help,
                           ExitCode (*run)(const Arguments&)) {
        Command<Arguments> command{parent.add_subcommand(name, help),
                                   std::make_shared<Arguments>()};
        command.app->callback([this, arguments = command.arguments, run] {
            choose([arguments, run] { return run(*arguments); });
        });
        return command;
    }

    /// Notes what is to run; the last call counts.
    void choose(std::function<ExitCode()> run) { run_ = std::move(run); }
    /// What the command line asked for; empty: nothing.
    [[nodiscard]] const std::function<ExitCode()>& chosen() const noexcept { return run_; }

 private:
    CLI::App app_;
    std::function<ExitCode()> run_;
};

/// Bounds of options that take a time in seconds.
inline constexpr double kShortestSeconds = 0.001;
/// Four months.
inline constexpr double kLongestSeconds = 1e7;

}  // namespace raks::apps
