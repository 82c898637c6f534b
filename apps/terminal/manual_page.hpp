#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/terminal/manual_sources.hpp"
#include "base/expected.hpp"

#include <CLI/CLI.hpp>

/// Manual pages, made from the tables of commands when Raks is built.
namespace raks::apps {

/// The page of a command, with the commands below it in sections of their own.
[[nodiscard]] std::string manual_page(const CLI::App& command, const ManualSources& sources);

/// A page "raks-play.1" for each command, and one of the program. Where `program` is one command of
/// another one ("raks train") it has one page for all. Errors: those of the files.
[[nodiscard]] Expected<void> write_manual(const CLI::App& program,
                                          const std::filesystem::path& folder,
                                          const std::filesystem::path& tree);

/// What a program is asked for when it is built: PROGRAM --write-manual FOLDER TREE.
struct ManualWish {
    std::filesystem::path folder;  ///< of the pages
    std::filesystem::path tree;    ///< of the sources
};
[[nodiscard]] std::optional<ManualWish> manual_wish(int argc, const char* const* argv);

}  // namespace raks::apps
