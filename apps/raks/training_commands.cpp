// `raks train ...` runs the program raks-train, which has libraries that dancing does not need.
#include <unistd.h>

#include <string>
#include <vector>

#include "apps/raks/command_table.hpp"
#include "apps/terminal/say.hpp"

namespace raks::apps {
namespace {

// Replaces this process by raks-train, which lies beside this program; returns only when that
// fails. A replaced process keeps terminal, signals and exit code.
ExitCode become_trainer(const std::string& command, const std::vector<std::string>& arguments) {
    std::error_code problem;
    // Found beside the running file, not by PATH: both must be of the same build.
    const Path self = std::filesystem::read_symlink("/proc/self/exe", problem);
    std::string program = (self.parent_path() / "raks-train").string();
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
    return fail({program + ": is not there; it is installed with raks and has to lie beside it"});
}

}  // namespace

void add_training_commands(RaksCommands& table) {
    struct Trainer {
        const char* name;
        const char* help;
    };
    constexpr Trainer kTrainers[] = {{"figure", "learn a dance figure from motion"},
                                     {"report", "show how figures are learnt"},
                                     {"beats", "learn to track beats from MIDI files"},
                                     {"genre", "learn to tell dances apart from music"}};
    CLI::App* train = table.app().add_subcommand("train", "learn from recordings");
    train->require_subcommand(1);
    for (const Trainer& trainer : kTrainers) {
        CLI::App* command = train->add_subcommand(trainer.name, trainer.help);
        // All words after the command are passed on unparsed, --help too.
        command->prefix_command();
        command->set_help_flag();
        command->callback([&table, command] {
            table.choose([name = command->get_name(), arguments = command->remaining()] {
                return become_trainer(name, arguments);
            });
        });
    }
}

}  // namespace raks::apps
