#include "apps/raks/arguments.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/signals.hpp"
#include "audio/io/device_stream.hpp"

int main(int argc, char** argv) {
    // Signals are caught only when a command runs: parsing ends as usual.
    const auto parse = [argc, argv] {
        raks::apps::ParsedCommand command = raks::apps::parse_arguments(argc, argv);
        if (command.run) {
            raks::apps::catch_signals();
        }
        return command;
    };
    // A dead audio device would make a usual exit hang: see end_process().
    raks::audio::end_process(raks::apps::run_program(parse));
}
