#include "apps/raks/arguments.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/signals.hpp"
#include "audio/io/device_stream.hpp"

int main(int argc, char** argv) {
    const auto parse = [argc, argv] {
        raks::apps::ParsedCommand command = raks::apps::parse_arguments(argc, argv);
        if (command.run) {
            raks::apps::catch_signals();
        }
        return command;
    };
    raks::audio::end_process(raks::apps::run_program(parse));
}
