#include "apps/raks/preset_option.hpp"

#include <string>
#include <utility>
#include <vector>

#include "apps/terminal/say.hpp"
#include "engine/setup/presets.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

void use_told(const std::vector<std::string>& targets, std::vector<engine::OutputWish>& told) {
    for (const std::string& target : targets) {
        if (auto wish = engine::parse_output_wish(target)) {
            told.push_back(std::move(*wish));
        } else {
            complain(wish.error().message + "; it is not told of the music");
        }
    }
}

void use_preset(const std::string& name,
                engine::Settings& settings,
                VideoArguments* video,
                std::vector<engine::OutputWish>* told) {
    if (const std::string unknown = engine::why_unknown_preset(name); !unknown.empty()) {
        throw CLI::ValidationError("--preset", unknown);
    }
    const auto loaded = engine::load_preset(name);
    if (!loaded) {
        complain(loaded.error().message + "; nothing of this preset is used");
        return;
    }
    for (const std::string& note : loaded->notes) {
        say(note);
    }
    engine::apply_preset(*loaded, settings);
    if (video != nullptr && loaded->preset.outputs) {
        for (const std::string& target : *loaded->preset.outputs) {
            video->wishes.push_back({.target = target});
        }
    }
    if (told != nullptr && loaded->preset.told) {
        use_told(*loaded->preset.told, *told);
    }
}

}  // namespace

void add_preset_option(CLI::App& app,
                       engine::Settings& settings,
                       VideoArguments* video,
                       std::vector<engine::OutputWish>* told) {
    app.add_option_function<std::string>(
           "--preset",
           [&settings, video, told](const std::string& name) {
               use_preset(name, settings, video, told);
           },
           "look and dances that were saved under a name; options beside it win")
        ->type_name("NAME");
}

}  // namespace raks::apps
