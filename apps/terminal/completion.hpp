#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// What may stand next on a command line, for the completion of shells. The scripts of the shells
/// (packaging/completion) ask `PROGRAM --complete WORD...` and know nothing of commands themselves.
namespace raks::apps {

/// One word that may stand there.
struct Candidate {
    std::string word;
    std::string help;  ///< what it is, for shells that show it
};

/// All that may stand there. The shell keeps what begins as the word that is being typed.
struct Candidates {
    std::vector<Candidate> words;
    bool has_files = false;            ///< files, too, and folders on the way to them
    bool has_folders = false;          ///< folders, too
    std::vector<std::string> endings;  ///< of the files: ".mp3"; none: any
};

/// Adds what is known of a value beside the table: names of dances, of devices.
using KnownValues = std::function<void(const CLI::Option& option, Candidates& candidates)>;

/// `words`: what was typed behind the program's name; the last is the one that is being typed, and
/// may be empty. Of "--option=" the values are given without it.
[[nodiscard]] Candidates complete(const CLI::App& program,
                                  std::span<const std::string> words,
                                  const KnownValues& known);

/// The first line says what files there may be: "words" (none), "folders", "files", or
/// "files .mp3 .wav"; each further line is a word, a tab and what it is.
[[nodiscard]] std::string text_of(const Candidates& candidates);

/// The words behind PROGRAM --complete; none: the program is asked for something else.
[[nodiscard]] std::optional<std::vector<std::string>> words_to_complete(int argc,
                                                                        const char* const* argv);

}  // namespace raks::apps
