#include "apps/raks/kept_window.hpp"

#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/show/avatar_files.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;
using engine::SettingRank;
using engine::Settings;

// Paths that hold wherever the program is started next. Names that no file of text could hold are
// not kept.
std::optional<std::vector<std::string>> kept_avatars(const std::vector<std::string>& names) {
    std::vector<std::string> kept;
    for (const std::string& name : names) {
        std::error_code error;
        const std::string path = name == engine::kMannequinName
                                     ? name
                                     : fs::absolute(name, error).lexically_normal().string();
        if (error || printable(path, std::string::npos) != path) {
            return std::nullopt;
        }
        kept.push_back(path);
    }
    return kept.empty() ? std::nullopt : std::optional(std::move(kept));
}

using Choose = Expected<audio::DeviceChoice> (*)(std::span<const audio::AudioDevice>,
                                                 std::string_view);

Expected<audio::DeviceChoice> device_of(const audio::AudioSystem& system,
                                        Settings& settings,
                                        std::string Settings::*field,
                                        Choose choose) {
    auto choice = choose(system.devices(), settings.*field);
    if (!choice && may_be_gone(settings, field)) {
        say_detail(printable(settings.*field) + " is not there now");
        settings.*field = {};
        choice = choose(system.devices(), {});
    }
    return choice;
}

}  // namespace

KeptWindow KeptWindow::recall(Settings& settings) {
    KeptWindow kept;
    kept.is_open_ = true;
    if (engine::origin_of(settings, &Settings::size).rank > SettingRank::window) {
        if (const auto size = engine::parse_size(settings.size)) {
            kept.set_size_ = *size;
        }
    }
    const auto loaded = engine::load_window_memory();
    if (!loaded) {
        complain(loaded.error().message + "; the window opens as if it were the first time");
        return kept;
    }
    for (const std::string& note : loaded->notes) {
        say(note);
    }
    kept.may_write_ = loaded->notes.empty();
    kept.before_ = kept.now_ = loaded->memory;
    engine::apply_window_memory(*loaded, settings);
    replace_missing_avatars(settings);
    return kept;
}

void KeptWindow::place(render::WindowOptions& options) const {
    if (!set_size_ && now_.size) {
        options.width = now_.size->width;
        options.height = now_.size->height;
    }
    if (const auto& place = now_.place) {
        render::WindowPlace& where = options.place.emplace();
        where.x = place->x;
        where.y = place->y;
        where.width = options.width;
        where.height = options.height;
        where.monitor = place->monitor;
        where.monitor_x = place->monitor_x;
        where.monitor_y = place->monitor_y;
    }
}

void KeptWindow::close(const engine::WindowLoop& window) {
    if (!is_open_ || !may_write_) {
        return;
    }
    if (const auto place = window.place()) {
        now_.place = engine::WindowMemory::Place{
            place->x, place->y, place->monitor, place->monitor_x, place->monitor_y};
        // A size for this run alone is not that of the next.
        if (const engine::PictureSize size{place->width, place->height}; size != set_size_) {
            now_.size = size;
        }
    }
    if (auto avatars = kept_avatars(window.chosen_avatars())) {
        now_.avatars = std::move(avatars);
    }
    if (now_ == before_) {
        return;
    }
    if (const auto saved = engine::save_window_memory(now_); !saved) {
        say_detail(saved.error().message + "; the window is not remembered");
    }
}

Expected<audio::DeviceChoice> input_of(const audio::AudioSystem& system, Settings& settings) {
    return device_of(system, settings, &Settings::device, audio::choose_input);
}

Expected<audio::DeviceChoice> output_of(const audio::AudioSystem& system, Settings& settings) {
    return device_of(system, settings, &Settings::output, audio::choose_output);
}

}  // namespace raks::apps
