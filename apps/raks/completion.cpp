// What completion knows beside the tables of commands: names of dances, avatars and devices,
// endings of music and motion. `raks completion SHELL` prints the script that asks for it.
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/completion_scripts.hpp"
#include "apps/raks/raks_command_table.hpp"
#include "apps/terminal/completion.hpp"
#include "apps/terminal/option_checks.hpp"
#include "apps/terminal/option_words.hpp"
#include "audio/io/devices.hpp"
#include "engine/setup/dance_catalogue.hpp"
#include "engine/setup/play_list.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/themes.hpp"
#include "motion/skeleton/formats/motion_format.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

void add_endings(std::span<const std::string_view> endings, Candidates& candidates) {
    candidates.has_files = true;
    candidates.endings.insert(candidates.endings.end(), endings.begin(), endings.end());
}

void add_dances(Candidates& candidates) {
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return;
    }
    for (const engine::CatalogueEntry& entry : catalogue->entries()) {
        candidates.words.push_back({entry.info.name, entry.info.title});
    }
}

void add_avatars(Candidates& candidates) {
    candidates.words.push_back({std::string(engine::kMannequinName), "comes with Raks"});
    for (const Path& file : engine::list_avatars().value_or(std::vector<Path>())) {
        candidates.words.push_back({file.stem().string(), file.string()});
    }
    candidates.endings.clear();
    add_endings(render::model_endings(), candidates);
}

void add_themes(Candidates& candidates) {
    for (std::string& name : engine::theme_names()) {
        candidates.words.push_back({std::move(name), ""});
    }
    candidates.endings = {".toml"};
    candidates.has_files = true;
}

void add_devices(bool are_inputs, Candidates& candidates) {
    const auto system = audio::AudioSystem::open();
    if (!system) {
        return;
    }
    for (const audio::AudioDevice& device : system->devices()) {
        if ((are_inputs ? device.input_channels : device.output_channels) > 0) {
            candidates.words.push_back({device.name, device.host_api});
        }
    }
}

void add_words_of_setting(const std::string& name, Candidates& candidates) {
    for (const engine::SettingRow& row : engine::setting_rows()) {
        if (row.option.name == name) {
            for (const std::string_view word : row.words.all()) {
                candidates.words.push_back({std::string(word), ""});
            }
        }
    }
}

// What the table of options cannot say of a value.
void add_known(const CLI::Option& option, Candidates& candidates) {
    const std::string name =
        option.get_positional() ? option.get_name(true) : names_of(option).back();
    const std::string& help = option.get_description();
    const auto speaks_of = [&help](const char* what) {
        return help.find(what) != std::string::npos;
    };
    add_words_of_setting(name, candidates);
    if (name == "--dance" || name == "style") {
        add_dances(candidates);
    } else if (name == "--avatar" || name == "--from" || name == "model") {
        add_avatars(candidates);
    } else if (name == "--theme") {
        add_themes(candidates);
    } else if (name == "--device" || name == "--output") {
        add_devices(name == "--device", candidates);
        return;
    } else if (speaks_of("music file")) {
        add_endings(engine::music_endings(), candidates);
    } else if (speaks_of("motion") || speaks_of("clip")) {
        add_endings(motion::motion_endings(), candidates);
    }
    if (candidates.words.empty() && placeholder_of(option) == "TEXT") {
        candidates.has_files = true;
    }
}

ExitCode print_script(const CompletionArguments& arguments) {
    for (const auto& [shell, script] : completion_scripts()) {
        if (shell == arguments.shell) {
            print_json(script);
        }
    }
    return kExitDone;
}

}  // namespace

void add_completion_command(RaksCommands& table) {
    auto [app, a] = table.add(
        table.app(), "completion", "print what makes a shell complete our words", print_script);
    app->add_option("shell", a->shell, "bash, zsh or fish")
        ->required()
        ->check(one_of({"bash", "zsh", "fish"}));
}

ExitCode print_candidates(RaksCommands& table, const std::vector<std::string>& words) {
    // The options of `raks train figure` are known to raks-train alone.
    if (words.size() > 2 && (words[0] == "train" || words[0] == "capture")) {
        const std::vector<std::string> inner(words.begin() + 1, words.end());
        return become(("raks-" + words[0]).c_str(), "--complete", inner);
    }
    print_json(text_of(complete(table.app(), words, add_known)));
    return kExitDone;
}

}  // namespace raks::apps
