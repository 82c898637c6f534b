#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "apps/terminal/exit_code.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {

/// One command: where its arguments live and what runs it.
template <typename Arguments>
struct Command {
    CLI::App* app = nullptr;
    std::shared_ptr<Arguments> arguments;
};

/// The commands of a program, and the one that the command line asked for.
class CommandTable {
 public:
    CommandTable(const char* description, const char* name) : app_(description, name) {}

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
        command.app->callback([this, arguments = command.arguments, run] {
            choose([arguments, run] { return run(*arguments); });
        });
        return command;
    }

    void choose(std::function<ExitCode()> run) { run_ = std::move(run); }
    /// What was asked for; empty: nothing.
    [[nodiscard]] const std::function<ExitCode()>& chosen() const noexcept { return run_; }

 private:
    CLI::App app_;
    std::function<ExitCode()> run_;
};

inline constexpr double kShortestSeconds = 0.001;
inline constexpr double kLongestSeconds = 1e7;  // four months

}  // namespace raks::apps
