#include <cstdio>
#include <optional>
#include <string>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/raks_command_table.hpp"
#include "apps/raks/version.hpp"
#include "apps/terminal/completion.hpp"
#include "apps/terminal/manual_page.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/device_stream.hpp"
#include "engine/setup/dance_files.hpp"

namespace raks::apps {
namespace {

// Printed when no command is given.
constexpr const char* kExamples =
    "raks: an avatar that dances to what it hears\n"
    "\n"
    "  raks live                          dance to what this computer plays, or to a microphone\n"
    "  raks play song.mp3                 play a file and dance to it\n"
    "  raks render song.mp3 -o out.mp4    write a video of the dance\n"
    "\n"
    "raks --help lists all commands.\n";

// The fault of a dance's name that is unknown; empty: none. A path is checked only when it is
// opened: learning from it takes time.
std::string fault_of_dances(engine::Settings settings) {
    if (is_dance_place(settings.dance)) {
        settings.dance = "auto";
    }
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return {};  // the command reports it, if it dances
    }
    const auto checked = engine::check_dances(settings, *catalogue);
    return checked ? std::string() : checked.error().message;
}

// The first fault of the settings: a value out of range, or a word that is unknown.
std::string fault_of(const engine::Settings& settings) {
    if (const auto faults = engine::validate(settings); !faults.empty()) {
        return faults.front();
    }
    return fault_of_dances(settings);
}

void add_config(RaksCommands& table) {
    auto [app, a] =
        table.add(table.app(), "config", "show, locate or create the settings file", config);
    app->add_flag("--origin", a->with_origins, "show: say where each value comes from");
    app->add_option("--preset", a->preset, "show: as with this preset")->type_name("NAME");
    app->add_option("action", a->action, "show, path or init")
        ->check(one_of({"show", "path", "init"}));
}

}  // namespace

void RaksCommands::note_options(const CLI::App& app, engine::Settings& settings) {
    for (const engine::SettingRow& row : engine::setting_rows()) {
        const CLI::Option* const option =
            row.option.name.empty() ? nullptr
                                    : app.get_option_no_throw(std::string(row.option.name));
        if (option != nullptr && option->count() > 0) {
            settings.origins.set(engine::full_name(row), {engine::SettingRank::option, {}, 0});
        }
    }
}

namespace {

// What is asked for by programs, not by people: the manual, when Raks is built; what may stand next
// on a command line, by shells.
std::optional<ExitCode> asked_of_tables(RaksCommands& table, int argc, char** argv) {
    if (const auto wish = manual_wish(argc, argv)) {
        return exit_code_of(write_manual(table.app(), wish->folder, wish->tree));
    }
    if (const auto words = words_to_complete(argc, argv)) {
        return print_candidates(table, *words);
    }
    return std::nullopt;
}

/// Parses the command line over the settings files. A wrong command line or setting is one line on
/// stderr and kExitUsage.
ParsedCommand parse_arguments(int argc, char** argv) {
    // The files first: options are parsed over what they say, and a fault of theirs is reported
    // below.
    const auto settings = engine::load_settings();
    RaksCommands table(settings.value_or(engine::LoadedSettings{}).settings);
    table.app().require_subcommand(0, 1);
    table.app().set_version_flag("-V,--version", version_text, "say what this program is");
    add_dancing_commands(table);
    add_measuring_commands(table);
    add_training_commands(table);
    add_capture_commands(table);
    add_config(table);
    add_completion_command(table);
    if (const auto asked = asked_of_tables(table, argc, argv)) {
        return {[asked] { return *asked; }, kExitDone};
    }
    // Help, version and wrong usage end here.
    if (const auto ended = read_usage(table.app(), argc, argv)) {
        return {nullptr, *ended};
    }
    if (!table.chosen()) {
        std::fputs(kExamples, stdout);
        return {nullptr, kExitDone};
    }
    // A faulty file must not prevent --help, nor `raks config`, which tells where the file lies.
    if (!settings && !table.app().got_subcommand("config")) {
        complain(settings.error().message);
        return {nullptr, kExitUsage};
    }
    // Checked after parsing, since file and options together make the values.
    if (table.chosen_settings() != nullptr) {
        for (const std::string& note : settings->notes) {
            say(note);
        }
        if (const std::string fault = fault_of(*table.chosen_settings()); !fault.empty()) {
            complain(fault);
            return {nullptr, kExitUsage};
        }
    }
    return {table.chosen(), kExitDone};
}

}  // namespace

}  // namespace raks::apps

// NOLINTNEXTLINE(bugprone-exception-escape): std::function takes these two words without allocating
int main(int argc, char** argv) {
    const auto parse = [argc, argv] {
        raks::apps::ParsedCommand command = raks::apps::parse_arguments(argc, argv);
        if (command.run) {
            raks::apps::silence_libraries();
        }
        return command;
    };
    // A dead audio device would make a usual exit hang: see end_process().
    raks::audio::end_process(raks::apps::run_program(parse));
}
