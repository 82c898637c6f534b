#include "apps/raks/preset_option.hpp"

#include <string>

#include "apps/terminal/say.hpp"
#include "engine/setup/presets.hpp"

#include <CLI/CLI.hpp>

namespace raks::apps {
namespace {

void use_preset(const std::string& name, engine::Settings& settings, VideoArguments* video) {
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
}

}  // namespace

void add_preset_option(CLI::App& app, engine::Settings& settings, VideoArguments* video) {
    app.add_option_function<std::string>(
           "--preset",
           [&settings, video](const std::string& name) { use_preset(name, settings, video); },
           "look and dances that were saved under a name; options beside it win")
        ->type_name("NAME");
}

}  // namespace raks::apps
