#include "apps/raks/commands.hpp"

#include <system_error>

#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/setup/presets.hpp"

namespace raks::apps {

ExitCode config(const ConfigArguments& arguments) {
    // `path` and `init` do not read the settings: they work with a faulty file, too.
    const Path path = engine::user_settings_path();
    if (path.empty() && arguments.action != "show") {
        return fail(
            "there is no place for your settings: set HOME or XDG_CONFIG_HOME to a folder of "
            "yours");
    }
    if ((arguments.with_origins || !arguments.preset.empty()) && arguments.action != "show") {
        return fail("--origin and --preset belong to raks config show");
    }
    if (arguments.action == "path") {
        print_text(printable(path.string(), std::string::npos) + "\n");
        return kExitDone;
    }
    if (arguments.action == "init") {
        std::error_code error;
        // Never over what a person has written.
        if (std::filesystem::exists(path, error)) {
            return fail(path.string() + ": is there already; edit it, or remove it first");
        }
        if (auto made = make_folders(path.parent_path()); !made) {
            return fail(made.error());
        }
        if (auto written = write_file(path, engine::to_toml({})); !written) {
            return fail(written.error());
        }
        print_text(printable(path.string(), std::string::npos) + "\n");
        return kExitDone;
    }
    // "show": all values that apply, defaults too.
    auto settings = engine::load_settings();
    if (!settings) {
        return fail(settings.error());
    }
    for (const std::string& note : settings->notes) {
        say(note);
    }
    if (!arguments.preset.empty()) {
        const auto preset = engine::load_preset(arguments.preset);
        if (!preset) {
            return fail(preset.error());
        }
        for (const std::string& note : preset->notes) {
            say(note);
        }
        engine::apply_preset(*preset, settings->settings);
    }
    print_text(engine::to_toml(
        settings->settings,
        arguments.with_origins ? engine::TomlComments::origins : engine::TomlComments::help));
    return kExitDone;
}

}  // namespace raks::apps
