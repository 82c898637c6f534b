// `raks train ...` runs the program raks-train, and `raks capture ...` raks-capture: both have
// libraries that dancing does not need.
#include <unistd.h>

#include <span>
#include <string>
#include <vector>

#include "apps/raks/raks_command_table.hpp"
#include "apps/terminal/say.hpp"

namespace raks::apps {
namespace {

/// A command of another program, as `raks --help` shows it.
struct OtherCommand {
    const char* name;
    const char* help;
};

void add_commands_of(RaksCommands& table,
                     CLI::App& parent,
                     const char* program,
                     std::span<const OtherCommand> commands) {
    parent.require_subcommand(1);
    for (const OtherCommand& other : commands) {
        CLI::App* command = parent.add_subcommand(other.name, other.help);
        // All words after the command are passed on unparsed, --help too.
        command->prefix_command();
        command->set_help_flag();
        command->callback([&table, command, program] {
            table.choose([program, name = command->get_name(), arguments = command->remaining()] {
                return become(program, name, arguments);
            });
        });
    }
}

}  // namespace

// A replaced process keeps terminal, signals and exit code.
ExitCode become(const char* name,
                const std::string& command,
                const std::vector<std::string>& arguments) {
    std::error_code problem;
    // Found beside the running file, not by PATH: both must be of the same build.
    const Path self = std::filesystem::read_symlink("/proc/self/exe", problem);
    std::string program = (self.parent_path() / name).string();
    std::vector<std::string> words = {command};
    words.insert(words.end(), arguments.begin(), arguments.end());
    // argv must be writable and end in a null pointer.
    std::vector<char*> argv = {program.data()};
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    let_libraries_speak();
    execv(program.c_str(), argv.data());
    // As installed there is PREFIX/share/raks beside PREFIX/bin, and a package of the program's
    // name.
    const bool is_installed =
        std::filesystem::exists(self.parent_path().parent_path() / "share/raks", problem);
    return fail(program + (is_installed
                               ? ": is not here; install the package " + std::string(name)
                               : ": is not built; scripts/build.sh learn, in the source tree of "
                                 "Raks, builds it"));
}

void add_training_commands(RaksCommands& table) {
    constexpr OtherCommand kCommands[] = {{"figure", "learn a dance figure from motion"},
                                          {"take", "make a dance of whole takes"},
                                          {"report", "show how figures are learnt"},
                                          {"beats", "learn to track beats from MIDI files"},
                                          {"genre", "learn to tell dances apart from music"}};
    CLI::App* train = table.app().add_subcommand("train", "learn from recordings");
    add_commands_of(table, *train, "raks-train", kCommands);
}

void add_capture_commands(RaksCommands& table) {
    constexpr OtherCommand kCommands[] = {
        {"run", "do every step that is missing or older than what it is made from"},
        {"simulate", "film a known dance with simulated cameras"},
        {"board", "draw the board that calibrates the cameras, to print"},
        {"calibrate",
         "find lenses and places of the cameras with a printed board, or by the dancer"},
        {"keypoints", "find the joints of a dancer without markers, in all films"},
        {"sync", "find how the clocks of the films differ, by their sound"},
        {"label", "tell which marker is where, in the first pictures"},
        {"track", "follow the markers through all films"},
        {"correct", "look at the tracks and put them right, in a window"},
        {"solve", "find the dancer's body and its dance in the tracks, or in anybody's points"},
        {"report", "show what came of a capture, as a page"},
        {"compare", "how far two motions of the same dance are apart"}};
    CLI::App* capture = table.app().add_subcommand("capture", "get a dance from several films");
    add_commands_of(table, *capture, "raks-capture", kCommands);
}

}  // namespace raks::apps
