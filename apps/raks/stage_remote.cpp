// What the stage tells pages and others who ask for actions, and what it does for them.
#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "apps/raks/stage_loop.hpp"
#include "base/printable.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/themes.hpp"
#include "render/scene/camera.hpp"

namespace raks::apps {
namespace {

// A person's own avatars are files: others get their names alone.
std::string avatar_word(const std::string& name) {
    return name == engine::kMannequinName ? name
                                          : printable(std::filesystem::path(name).stem().string());
}

}  // namespace

// With every picture.
void StageLoop::serve_remote() {
    for (const std::string& line : remote_->carry_out(*actions_)) {
        say(line);
    }
    if (const auto line = remote_->follow_link(*graph_, graph_->stage().music)) {
        say(*line);
    }
    if (remote_->wants_state(HostClock::now())) {
        remote_->publish(state_for_remote());
    }
}

engine::RemoteState StageLoop::state_for_remote() {
    const engine::StageState& stage = graph_->stage();
    engine::RemoteState state = heard_state(*graph_, stage.music, *outputs_, *dances_);
    const motion::DancerStatus& dancer = stage.dancer;
    state.source = printable(source_name());
    state.song = players_->song();
    if (dancer.is_dancing) {
        state.dance = dances_->name_of(dancer.dance);
        state.figure =
            std::string(dancer.figure.data(), strnlen(dancer.figure.data(), dancer.figure.size()));
    }
    state.keeps_figure = live_actions_.keeps_figure();
    state.formation = formations_->name();
    if (window_) {
        state.camera = window_->camera_name();
        state.theme = window_->scene().theme->name;
        state.avatar = avatar_word(window_->avatar_name());
    }
    return state;
}

engine::RemoteChoices StageLoop::choices_for_remote() const {
    engine::RemoteChoices choices;
    for (std::size_t number = 0; number < dances_->size(); ++number) {
        choices.dances.emplace_back(dances_->name_of(static_cast<DanceId>(number)));
    }
    choices.formations.assign(motion::kFormationNames.begin(), motion::kFormationNames.end());
    if (!window_) {
        return choices;
    }
    const auto cameras = render::camera_names();
    choices.cameras.emplace_back(engine::kDirector);
    choices.cameras.insert(choices.cameras.end(), cameras.begin(), cameras.end());
    choices.themes = engine::theme_names();
    choices.avatars.emplace_back(engine::kMannequinName);
    if (const auto files = engine::list_avatars()) {
        for (const std::filesystem::path& file : *files) {
            choices.avatars.push_back(avatar_word(file.string()));
        }
    }
    return choices;
}

}  // namespace raks::apps
