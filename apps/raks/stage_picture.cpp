// What the stage loop draws, in the window and elsewhere, and what the overlay says.
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/say.hpp"
#include "render/avatar/avatar.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// "--osc studio:9000   412 sent, 3 lost (nobody listens there; it is sent on)"
std::string in_words(const engine::OutputStatus& status) {
    std::string words = fmt::format("{}   {} sent", status.name, status.sent);
    if (status.dropped > 0) {
        words += fmt::format(", {} lost", status.dropped);
    }
    // The line begins with the place.
    if (const std::size_t place = status.trouble.find(": "); place != std::string::npos) {
        words += fmt::format(" ({})", status.trouble.substr(place + 2));
    }
    return words;
}

}  // namespace

void StageLoop::draw_headless() {
    if (studio_) {
        change_clothes(shown_moment(graph_->stage(), graph_->moment_at(HostClock::now())));
        if (const auto changed = studio_->avatar_change.go_on(studio_->drawing); !changed) {
            say(changed.error().message);
        }
        const render::Camera preset = framed(
            engine::camera_for(engine::preset_of(studio_->camera), studio_->drawing.bodies.size()));
        tell_look(studio_->drawing.bodies);
        draw_elsewhere({studio_->drawing, studio_->scene, {studio_->camera, preset}});
    }
}

/// Once a picture: where the dance chooses what the mannequin wears.
void StageLoop::change_clothes(const engine::ShownMoment& shown) {
    const auto costume = dress_->next(shown, *dances_);
    if (!costume) {
        return;
    }
    if (window_) {
        window_->dress(*costume);
    } else {
        studio_->avatar_change.dress(*costume);
    }
}

void StageLoop::draw_elsewhere(const engine::WindowView& given) {
    engine::WindowView view = given;
    view.performance = performance_.get();
    const FilmedStage::Describe describe = [this](const engine::ShownMoment& shown,
                                                  render::OverlayState& overlay) {
        describe_moment(shown, *dances_, overlay);
        this->describe(graph_->stage(), overlay);
    };
    if (video_) {
        video_->draw(*graph_, view, describe);
    }
    if (const auto drawn = recording_.draw(
            *graph_, view, options_.video.has_overlay ? describe : FilmedStage::Describe());
        !drawn) {
        say("recording ended: " + drawn.error().message);
    }
}

// A camera preset is made for one or two dancers.
render::Camera StageLoop::framed(render::Camera preset) const {
    preset.zoom(engine::distance_for(formation_));
    return preset;
}

// Who is told of poses wears what is seen.
void StageLoop::tell_look(const engine::DancerBodies& bodies) {
    if (!outputs_->want_poses()) {
        return;
    }
    engine::OutputLook look{.avatars = {}, .face = bodies.habits()};
    for (const engine::DancerBodies::Builds& builds : bodies.wardrobe()) {
        look.avatars.push_back(builds.front().avatar);
    }
    outputs_->wear(look);
}

// One stage and one moment for all dancers: they must not be drawn at different times.
void StageLoop::draw(const engine::WindowPicture& picture, render::OverlayState& overlay) {
    // Whoever is seen: an avatar may have been taken over meanwhile.
    formations_->ask_for_bodies(picture.bodies.dance_bodies());
    tell_look(picture.bodies);
    const engine::StageState& stage = graph_->stage();
    const StreamTime moment = graph_->moment_at(picture.seen_at);
    const engine::ShownMoment danced = shown_moment(stage, moment);
    change_clothes(danced);
    const engine::ShownMoment shown = performance_ ? performance_->at(danced) : danced;
    staging_.set_picture(
        static_cast<float>(picture.target.width) / static_cast<float>(picture.target.height),
        picture.bodies.size());
    follow_stage(staging_, stage);
    engine::CameraChoice choice = picture.camera;
    if (const auto camera =
            performance_ ? performance_->camera(picture.bodies.size()) : std::nullopt) {
        picture.scene.camera = *camera;
        choice.is_held = true;
    }
    staging_.set(picture.scene, choice, {.time = moment}, shown.danced.tracks);
    // Where an output has drawn this moment in this size, it is drawn once.
    if (!video_ || !video_->show(picture.target, moment)) {
        draw_moment(shown, picture.renderer, picture.bodies, picture.scene, picture.target);
    }
    describe_moment(shown, *dances_, overlay);
    describe(stage, overlay);
    // In the window alone: who sees it may come in.
    overlay.code = remote_->code_for_phones();
}

// The parts of the overlay that a moment does not know: source, place, latency and counters.
void StageLoop::describe(const engine::StageState& stage, render::OverlayState& overlay) {
    if (has_ended()) {
        overlay.message = graph_->playback()->player().can_seek()
                              ? "the end   (Space: once more, Q: quit)"
                              : "the end   (Q: quit)";
    }
    if (!graph_->trouble().empty()) {
        // Stays as long as it is so. Nothing is heard, so that no music state says the level.
        overlay.message = graph_->trouble();
        overlay.level_dbfs = graph_->analysis().level_dbfs(HostClock::now());
    }
    if (performance_) {
        overlay.dance = performance_->name();
        overlay.figure = "clip";
        overlay.figure_count = 0;
    }
    overlay.source = source_name();
    overlay.genre_teller = source_.teller;
    overlay.has_keys = true;
    overlay.duration = source_.duration;
    if (const engine::Playback* const playback = graph_->playback()) {
        overlay.position = playback->position_seconds();
        overlay.is_paused = playback->is_paused() || has_ended();
        overlay.volume = live_actions_.volume();
        overlay.latency_ms = to_seconds(graph_->heard_after()) * 1e3;
        // With an input the latency is that of the analysis: nothing is played.
    } else {
        describe_song(overlay);
        describe_silence(stage, overlay);
        overlay.latency_ms = to_seconds(graph_->analysis().taken_until() - stage.music.time) * 1e3;
    }
    const engine::LiveCounters counters = graph_->counters();
    overlay.drops = counters.dropped_states;
    overlay.xruns = counters.xruns;
    overlay.late = counters.underruns;
    describe_targets(overlay);
}

// A number that changes with every picture could not be read.
void StageLoop::describe_targets(render::OverlayState& overlay) {
    constexpr Nanos kShownFor = std::chrono::milliseconds(500);
    if (const HostTime now = HostClock::now(); now >= targets_shown_until_) {
        targets_shown_until_ = now + kShownFor;
        targets_.clear();
        const std::vector<engine::OutputStatus> all = outputs_->status();
        lost_before_.resize(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            targets_.push_back({in_words(all[i]), all[i].dropped > lost_before_[i]});
            lost_before_[i] = all[i].dropped;
        }
    }
    if (!remote_->link_words().empty()) {
        targets_.resize(lost_before_.size());
        targets_.push_back({remote_->link_words(), false});
    }
    overlay.targets = targets_;
}

void StageLoop::describe_song(render::OverlayState& overlay) {
    playing_ = players_->title();
    overlay.song = playing_;
    overlay.is_paused = !playing_.empty() && players_->is_paused();
}

// Who hears nothing wants to know what is listened to.
void StageLoop::describe_silence(const engine::StageState& stage, render::OverlayState& overlay) {
    constexpr Nanos kPatience = std::chrono::seconds(3);
    const HostTime now = HostClock::now();
    if (!stage.music.is_silent) {
        silent_since_.reset();
        return;
    }
    silent_since_ = silent_since_.value_or(now);
    if (now - *silent_since_ > kPatience && overlay.message.empty()) {
        silence_ = "nothing is heard from " + graph_->device().name + "   (F2: another source)";
        overlay.message = silence_;
    }
}

}  // namespace raks::apps
