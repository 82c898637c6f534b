// The program raks-train, started by `raks train`. It is a program of its own since it alone needs
// a BLAS, which the dancing program should not load.
#include <filesystem>
#include <string>

#include "apps/raks_train/train_command_table.hpp"
#include "apps/terminal/asked_of_table.hpp"
#include "apps/terminal/program.hpp"

namespace {

using namespace raks::apps;

// The command line as it is stored in models: paths without their folders, which say nothing
// elsewhere.
std::string kept_command(int argc, char** argv) {
    std::string command = "raks train";
    for (int i = 1; i < argc; ++i) {
        command += ' ' + Path(argv[i]).filename().string();
    }
    return command;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): before run_program() nothing large is made
int main(int argc, char** argv) {
    CommandTable table("learn dance figures, beats and genres", "raks train");
    return run_program([&table, argc, argv]() -> ParsedCommand {
        table.app().require_subcommand(1);
        const std::string command = kept_command(argc, argv);
        add_train_figure(table);
        add_train_take(table);
        add_train_report(table);
        add_train_beats(table, command);
        add_train_genre(table, command);
        if (const auto code = asked_of_table(table.app(), argc, argv)) {
            return {nullptr, *code};
        }
        if (const auto ended = read_usage(table.app(), argc, argv)) {
            return {nullptr, *ended};
        }
        return {table.chosen(), kExitDone};
    });
}
