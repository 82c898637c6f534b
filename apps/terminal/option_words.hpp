#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// What the table of an option says of it, as manual pages and completion need it.
namespace raks::apps {

/// Its names as they are typed: "-o", "--out"; "--calm", "--no-calm". None: it is positional.
[[nodiscard]] std::vector<std::string> names_of(const CLI::Option& option);
/// Whether a word follows it, or is it.
[[nodiscard]] bool has_value(const CLI::Option& option);
/// The words that it may be, where those are all: "rgba", "y4m". None: any.
[[nodiscard]] std::vector<std::string> choices_of(const CLI::Option& option);
/// What stands for its value in a text: "TEXT", "FILE".
[[nodiscard]] std::string placeholder_of(const CLI::Option& option);
/// "1..240"; empty: no range is checked.
[[nodiscard]] std::string range_of(const CLI::Option& option);

/// The options of a command that a person may use, and what it takes without a name, each in order.
[[nodiscard]] std::vector<const CLI::Option*> options_of(const CLI::App& command);
[[nodiscard]] std::vector<const CLI::Option*> positionals_of(const CLI::App& command);
/// The commands below it that a person may use, in order.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& command);
/// "raks avatar list".
[[nodiscard]] std::string full_name(const CLI::App& command);

}  // namespace raks::apps
