// The program raks-capture, started by `raks capture`. It is a program of its own since it alone
// needs OpenCV and Ceres, which the dancing program should not load.
#include <memory>

#include "apps/raks_capture/capture_command_table.hpp"
#include "apps/terminal/asked_of_table.hpp"
#include "apps/terminal/program.hpp"

int main(int argc, char** argv) {
    using namespace raks::apps;
    std::unique_ptr<CommandTable> table;  // made where exceptions become errors
    return run_program([&table, argc, argv]() -> ParsedCommand {
        table = std::make_unique<CommandTable>("get a dance from several films", "raks capture");
        add_commands(*table);
        if (const auto code = asked_of_table(table->app(), argc, argv)) {
            return {nullptr, *code};
        }
        if (const auto ended = read_usage(table->app(), argc, argv)) {
            return {nullptr, *ended};
        }
        return {table->chosen(), kExitDone};
    });
}
