#include "apps/raks/stage_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include "apps/terminal/progress.hpp"
#include "apps/terminal/say.hpp"
#include "apps/terminal/signals.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/show/camera_moves.hpp"
#include "render/overlay/key_bindings.hpp"
#include "render/video/png.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using AnalyzerKind = audio::AnalyzerCommand::Kind;
using DancerKind = motion::DancerCommand::Kind;

constexpr Nanos kMessageTime = std::chrono::seconds(4);
constexpr Nanos kHeadlessNap = std::chrono::milliseconds(20);
constexpr float kVolumeStep = 0.05F;
constexpr double kFpsShare = 0.05;

void nap(Nanos span) {
    timespec time{};
    time.tv_nsec = span.count();
    clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
}

/// raks-20260131-235959.png, with a number behind it when that is there already.
std::string screenshot_name() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    const std::string stem = fmt::format("raks-{:04}{:02}{:02}-{:02}{:02}{:02}",
                                         local.tm_year + 1900,
                                         local.tm_mon + 1,
                                         local.tm_mday,
                                         local.tm_hour,
                                         local.tm_min,
                                         local.tm_sec);
    std::string name = stem + ".png";
    std::error_code error;
    for (int i = 2; std::filesystem::exists(name, error); ++i) {
        name = fmt::format("{}-{}.png", stem, i);
    }
    return name;
}

}  // namespace

std::string level_meter(float dbfs) {
    constexpr int kWidth = 20;
    constexpr float kLowest = -60.0F;
    const float share = std::clamp((dbfs - kLowest) / -kLowest, 0.0F, 1.0F);
    const auto bars = static_cast<std::size_t>(std::lround(share * kWidth));
    return fmt::format("[{:<{}}] {:6.1f} dBFS", std::string(bars, '#'), kWidth, dbfs);
}

Expected<StageLoop> StageLoop::create(const engine::Settings& settings, const Options& options) {
    const auto look = engine::read_look(settings);
    if (!look) {
        return fail(look.error());
    }
    StageLoop loop(settings, options);
    loop.volume_ = static_cast<float>(settings.volume);
    if (options.is_headless) {
        return loop;
    }
    auto window = render::Window::create({.title = "Raks",
                                          .width = look->size.width,
                                          .height = look->size.height,
                                          .is_fullscreen = options.is_fullscreen,
                                          .samples = 0,
                                          .max_fps = settings.fps});
    if (!window) {
        return fail(window.error());
    }
    loop.window_.emplace(std::move(*window));
    auto show = engine::Show::create(*look, settings.overlay);
    if (!show) {
        return fail(show.error());
    }
    loop.show_.emplace(std::move(*show));
    if (const std::string notice = loop.show_->notice(); !notice.empty()) {
        loop.say(notice);
    }
    return loop;
}

void StageLoop::say(const std::string& line) {
    apps::say(line);
    message_ = line;
    message_until_ = HostClock::now() + kMessageTime;
}

StageEnd StageLoop::run(engine::LiveGraph& graph,
                        const std::string& source,
                        std::optional<double> duration) {
    wish_.reset();
    ProgressLine status(source);
    if (engine::Playback* playback = graph.playback()) {
        playback->set_volume(volume_);
    }
    for (;;) {
        if (const auto line = graph.watch(HostClock::now())) {
            say(*line);
        }
        if (window_) {
            handle_events(graph);
            draw(graph, source, duration);
        } else {
            status.show(fmt::format("{} {:5.1f} BPM",
                                    level_meter(graph.analysis().level_dbfs()),
                                    graph.stage().music.grid.tempo.bpm()));
            nap(kHeadlessNap);
        }
        if (const auto end = end_of(graph)) {
            return *end;
        }
    }
}

std::optional<StageEnd> StageLoop::end_of(engine::LiveGraph& graph) const {
    if (stop_signal() || (window_ && window_->should_close())) {
        return StageEnd::quit;
    }
    if (wish_) {
        return wish_;
    }
    // To the end of what is heard, not of what was handed over.
    const StreamTime heard = graph.moment_at(HostClock::now());
    if (options_.seconds && to_seconds(heard) >= *options_.seconds) {
        return StageEnd::finished;
    }
    engine::Playback* playback = graph.playback();
    if (playback != nullptr && playback->is_finished()) {
        return StageEnd::finished;
    }
    return std::nullopt;
}

void StageLoop::handle_events(engine::LiveGraph& graph) {
    for (const render::WindowEvent& event : window_->poll_events()) {
        if (const auto* key = std::get_if<KeyEvent>(&event)) {
            if (const auto action = render::action_of(*key)) {
                act(*action, *key, graph);
            }
        } else if (const auto* drag = std::get_if<render::MouseDragEvent>(&event)) {
            engine::move_camera(show_->scene().camera, *drag);
        } else if (const auto* scroll = std::get_if<render::ScrollEvent>(&event)) {
            engine::move_camera(show_->scene().camera, *scroll);
        }
    }
}

void StageLoop::act(render::Action action, const KeyEvent& key, engine::LiveGraph& graph) {
    using render::Action;
    engine::Playback* playback = graph.playback();
    const auto seek_by = [&](double seconds) {
        if (playback != nullptr) {
            playback->seek(playback->position_seconds() + seconds);
        }
    };
    const auto change_volume = [&](float by) {
        volume_ = std::clamp(volume_ + by, 0.0F, 1.0F);
        if (playback != nullptr) {
            playback->set_volume(volume_);
        }
    };
    switch (action) {
        case Action::pause:
            if (playback != nullptr) {
                playback->set_paused(!playback->is_paused());
            }
            break;
        case Action::seek_back:
            seek_by(-render::kSeekSeconds);
            break;
        case Action::seek_forward:
            seek_by(render::kSeekSeconds);
            break;
        case Action::seek_back_far:
            seek_by(-render::kSeekFarSeconds);
            break;
        case Action::seek_forward_far:
            seek_by(render::kSeekFarSeconds);
            break;
        case Action::next_file:
            wish_ = StageEnd::next_file;
            break;
        case Action::volume_up:
            change_volume(kVolumeStep);
            break;
        case Action::volume_down:
            change_volume(-kVolumeStep);
            break;
        case Action::tap_tempo:
            graph.command(AnalyzerKind::tap);
            break;
        case Action::half_tempo:
            graph.command(AnalyzerKind::half_tempo);
            break;
        case Action::double_tempo:
            graph.command(AnalyzerKind::double_tempo);
            break;
        case Action::next_figure:
            graph.command(DancerKind::next_figure);
            break;
        case Action::select_figure:
            graph.command(DancerKind::select_figure, render::figure_of(key.key));
            break;
        case Action::keep_figure:
            keeps_figure_ = !keeps_figure_;
            graph.command(DancerKind::lock_figure, keeps_figure_ ? 1.0 : 0.0);
            say(keeps_figure_ ? "keeping to this figure (K lets go)" : "figures as they come");
            break;
        case Action::next_dance:
            select_next_dance(graph);
            break;
        case Action::toggle_figure_view:
            show_->toggle_view();
            break;
        case Action::reset_camera:
            show_->reset_camera();
            break;
        case Action::toggle_overlay:
            show_->toggle_overlay();
            break;
        case Action::toggle_fullscreen:
            window_->toggle_fullscreen();
            break;
        case Action::screenshot:
            wants_screenshot_ = true;
            break;
        case Action::toggle_help:
            show_->toggle_help();
            break;
        case Action::quit:
            wish_ = StageEnd::quit;
            break;
    }
}

/// The next dance after the selected one, in the order of the genres; after the last as heard.
void StageLoop::select_next_dance(engine::LiveGraph& graph) {
    if (settings_.dance != "auto") {
        say(fmt::format("keeping to {}: start without --dance for the others", settings_.dance));
        return;
    }
    const std::vector<std::string> known = engine::known_dances();
    auto next = static_cast<int>(selected_dance_);
    do {
        next = (next + 1) % kGenreCount;
        selected_dance_ = static_cast<Genre>(next);
    } while (selected_dance_ != Genre::unknown &&
             std::find(known.begin(), known.end(), name_of(selected_dance_)) == known.end());
    graph.command(DancerKind::select_dance, next);
    say(selected_dance_ == Genre::unknown
            ? "the dance that is heard"
            : fmt::format("dancing {} (D: another dance)", name_of(selected_dance_)));
}

void StageLoop::draw(engine::LiveGraph& graph,
                     const std::string& source,
                     std::optional<double> duration) {
    const HostTime now = HostClock::now();
    // A picture drawn now is on the screen about one refresh later.
    const Nanos until_seen = nanos_from_seconds(1.0 / window_->refresh_rate());
    const engine::StageState& stage = graph.stage();
    const StreamTime moment = graph.moment_at(now + until_seen);

    render::OverlayState info;
    info.source = source;
    info.duration = duration;
    if (engine::Playback* playback = graph.playback()) {
        info.position = playback->position_seconds();
        info.is_paused = playback->is_paused();
        info.volume = volume_;
        info.latency_ms = to_seconds(graph.output_latency()) * 1e3;
    } else {
        info.latency_ms = to_seconds(graph.analysis().taken_until() - stage.music.time) * 1e3;
    }
    const engine::LiveCounters counters = graph.counters();
    info.drops = counters.dropped_states;
    info.xruns = counters.xruns;
    info.late = counters.underruns;
    info.fps = fps_;
    if (now < message_until_) {
        info.message = message_;
    }
    std::array<motion::Pose, motion::Ensemble::kMost> poses;
    for (std::size_t i = 0; i < stage.dancers; ++i) {
        poses[i] = stage.tracks[i].at(moment);
    }
    show_->draw({stage.music, stage.dancer, std::span(poses).first(stage.dancers), moment},
                info,
                window_->frame(),
                window_->content_scale());
    if (std::exchange(wants_screenshot_, false)) {
        save_screenshot();
    }
    window_->present();
    const double seconds = to_seconds(HostClock::now() - last_picture_);
    last_picture_ = HostClock::now();
    fps_ += kFpsShare * (1.0 / std::max(seconds, 1e-3) - fps_);
}

void StageLoop::save_screenshot() {
    const render::FrameTarget frame = window_->frame();
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(frame.width) *
                                   static_cast<std::size_t>(frame.height) * 4);
    const std::string name = screenshot_name();
    auto done = render::read_rgba(frame, rgba);
    if (done) {
        done = render::write_png(name, frame.width, frame.height, rgba);
    }
    say(done ? "screenshot saved: " + name : done.error().message);
}

}  // namespace raks::apps
