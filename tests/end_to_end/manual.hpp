#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace raks::test {

/// A command that a document shows, as in `raks play song.mp3 --dance waltz`.
struct ManualCommand {
    std::string document;            ///< from the repository's root: "docs/using/dancer.md"
    int line = 0;                    ///< in it, from 1
    std::string section;             ///< the heading ("## ...") that it stands under
    std::vector<std::string> words;  ///< what follows `raks`
    /// In a block that starts with ```sh alone. Else (```sh no-run, an indented block, a span of
    /// code in the text) it needs what is not at hand, or is no whole command.
    bool is_run = false;

    /// "docs/using/dancer.md:29: raks train figure my.toml"
    [[nodiscard]] std::string said() const;
};

/// README.md, all of docs/ and of models/, from the repository's root, sorted.
std::vector<std::string> manual_documents();

/// All commands that a document shows, in order.
std::vector<ManualCommand> commands_of(const std::string& document);

/// The command as a test runs it: without window and loudspeaker, short, small pictures.
std::vector<std::string> without_window(std::vector<std::string> words);

/// Writes small files under the names that the manual uses: song.mp3, song.beats, album, excerpts,
/// music, my.toml, and what write_clips() writes.
void write_manual_files(const std::filesystem::path& folder);

/// A written dance with another name.
void write_dance(const std::filesystem::path& file, const std::string& name);
/// The same with its first figure alone, which is learnt in a third of the time.
void write_dance_of_one_figure(const std::filesystem::path& file, const std::string& name);

/// CLIPS with one clip, three repeats of a known dance, and the tables labels.tsv and counts.tsv.
void write_clips(const std::filesystem::path& folder);

}  // namespace raks::test
