#include "apps/grid/grid_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>

#include "apps/grid/grid_pane.hpp"
#include "apps/grid/take_figure.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "base/time.hpp"
#include "engine/live/clip_sound.hpp"
#include "render/avatar/avatar.hpp"
#include "render/gl/offscreen.hpp"
#include "render/panes/pane_picture.hpp"
#include "render/panes/pane_window.hpp"
#include "render/pose_sheet.hpp"
#include "render/renderer.hpp"
#include "training/cells/grid_music.hpp"

namespace raks::apps {
namespace {

/// A body beside the large one as it was drawn last.
struct DrawnStill {
    double time = 0.0;
    int width = 0;  // pixels
    int height = 0;
    std::optional<render::PanePicture> picture;
};

/// What the window shows; keeps the session and saves it.
class GridContent : public render::PaneContent {
 public:
    GridContent(EditedTake take, render::Renderer renderer, render::Scene scene)
        : take_(std::move(take)),
          figure_(take_.take.clip),
          renderer_(std::move(renderer)),
          scene_(std::move(scene)),
          session_(grid_session(take_.grid, figure_.seconds())) {
        session_.is_new = take_.is_new;
        view_.cues = &take_.take.cues;
        view_.repeats = &take_.repeats;
        view_.frame = 1.0 / take_.take.clip.frames_per_second;
        view_.to = std::min(kFirstRange, session_.seconds);
        if (take_.is_new) {
            view_.message = take_.song ? "The song's beats, as its analysis heard them; is it laid "
                                         "right over the take? - and = move it, M takes its beats"
                                       : "A proposal from motion alone: right in about half of the "
                                         "cases. Tap along, or set it right";
        }
        scene_.view = render::View::stick;
        if (take_.song) {
            open_song();
        }
    }
    GridContent(const GridContent&) = delete;             // the view refers to the take
    GridContent& operator=(const GridContent&) = delete;  // likewise

    void draw(const render::PaneFrame& frame) override {
        // Before keys are taken up: a tap is meant for the moment that is now.
        advance();
        draw_bodies(frame);
        for (const GridWish& wish : grid_pane(frame, session_, view_)) {
            std::visit([this](const auto& one) { fulfil(one); }, wish);
        }
    }
    bool is_moving() override {
        advance();
        return view_.is_playing;
    }
    bool may_close() override {
        apply(EndTaps{}, session_);
        if (session_.is_saved() || is_warned_) {
            return true;
        }
        is_warned_ = true;
        view_.message = "Not saved: S saves, Q once more closes without";
        return false;
    }
    [[nodiscard]] bool is_finished() const override { return is_finished_; }

 private:
    static constexpr double kFirstRange = 10.0;  // seconds

    void open_song() {
        view_.song = &take_.song->music;
        view_.offset = take_.song->offset;
        auto sound = engine::ClipSound::open(take_.song->file);
        if (sound) {
            sound_ = std::move(*sound);
        } else {
            view_.message = "No sound: " + sound.error().message;
        }
    }

    // Plays on by the clock, and to where the song is heard.
    void advance() {
        constexpr double kLongest = 1.0;  // seconds; longer the window was covered or stopped
        const HostTime now = HostClock::now();
        const double passed = to_seconds(now - std::exchange(advanced_, now));
        const double step = sound_step();
        if (!view_.is_playing) {
            return;
        }
        view_.now += std::min(passed, kLongest) * view_.rate + step;
        view_.now = std::clamp(view_.now, 0.0, session_.seconds);
        if (view_.now >= session_.seconds) {
            fulfil(PlayOrRest{});
        }
        follow_now();
    }

    // Seconds by which the clip goes where the song is heard.
    double sound_step() {
        if (!sound_) {
            return 0.0;
        }
        const double place = view_.now + view_.offset;
        const bool sounds = view_.is_playing && view_.rate == 1.0 && place >= 0.0 &&
                            place < take_.song->music.music.duration;
        const double step = sound_->follow(std::max(place, 0.0), sounds);
        if (sound_->is_lost()) {
            view_.message = "The loudspeaker is gone: it plays on without sound";
            sound_.reset();
        }
        return sounds ? step : 0.0;
    }

    // The lanes show the moment that is looked at; while it plays with room before it.
    void follow_now() {
        const double span = view_.to - view_.from;
        const bool is_near_end = view_.is_playing && view_.now > view_.to - 0.05 * span;
        if (view_.now >= view_.from && view_.now <= view_.to && !is_near_end) {
            return;
        }
        const double before = view_.is_playing ? 0.1 : 0.5;
        view_.from = std::clamp(view_.now - before * span, 0.0, session_.seconds - span);
        view_.to = view_.from + span;
    }

    void draw_bodies(const render::PaneFrame& frame) {
        const GridLayout layout = grid_layout(frame.area, view_.song != nullptr);
        const auto stills = grid_stills(session_.shown(), view_.now);
        view_.stills.assign(stills.size(), nullptr);
        stills_.resize(stills.size());
        for (std::size_t place = 0; place < stills.size(); ++place) {
            if (stills[place]) {
                view_.stills[place] = still(
                    stills_[place], frame.target_of(layout.stills[place]), stills[place]->time);
            }
        }
        draw_body(view_.now, 4.4F, frame.target_of(layout.figure));
    }

    // The picture of a moment in a place, drawn where it is another one than before.
    const render::PanePicture* still(DrawnStill& drawn,
                                     const render::FrameTarget& box,
                                     double time) {
        const bool is_same = drawn.picture && drawn.time == time && drawn.width == box.width &&
                             drawn.height == box.height;
        if (is_same || box.width < 1 || box.height < 1) {
            return drawn.picture ? &*drawn.picture : nullptr;
        }
        auto target = render::OffscreenTarget::create(
            {.width = box.width, .height = box.height, .samples = renderer_.samples()});
        if (!target) {
            return nullptr;
        }
        draw_body(time, 4.7F, target->frame());
        const auto pixels =
            static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height);
        std::vector<std::uint8_t> rgba(4U * pixels);
        if (!target->read_rgba(rgba)) {
            return nullptr;
        }
        std::vector<std::uint8_t> rgb;
        rgb.reserve(3U * pixels);
        for (std::size_t i = 0; i < rgba.size(); i += 4) {
            rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
        }
        drawn.time = time;
        drawn.width = box.width;
        drawn.height = box.height;
        drawn.picture.emplace(box.width, box.height, rgb);
        return &*drawn.picture;
    }

    void draw_body(double time, float distance, const render::FrameTarget& target) {
        const motion::Pose pose = figure_.at(time);
        scene_.camera = render::PoseSheetConfig::default_cameras().front();
        scene_.camera.distance = distance;
        scene_.camera.pan_to(pose.hips_position);
        renderer_.draw(scene_, pose, target);
    }

    void fulfil(const GridAction& action) {
        apply(action, session_);
        if (!std::holds_alternative<HoldBeat>(action)) {
            view_.message.clear();
            is_warned_ = false;
        }
    }
    void fulfil(const SeekTo& seek) {
        view_.now = seek.time;
        follow_now();
    }
    void fulfil(const PlayOrRest& /*wish*/) {
        apply(EndTaps{}, session_);
        const bool is_at_end = view_.now >= session_.seconds;
        view_.is_playing = !view_.is_playing && session_.seconds > 0.0;
        if (view_.is_playing && is_at_end) {
            view_.now = 0.0;
        }
        advanced_ = HostClock::now();
    }
    void fulfil(const PlayAt& wish) { view_.rate = wish.rate; }
    void fulfil(const ShowRange& range) {
        view_.from = range.from;
        view_.to = range.to;
    }
    void fulfil(const MoveSong& move) {
        // What lies later over the clip begins at an earlier place of the song.
        view_.offset = std::round(1000.0 * (view_.offset - move.by)) / 1000.0;
        view_.message.clear();
    }
    void fulfil(const TakeSong& /*wish*/) {
        motion::DancedMusic music = take_.song->music.music;
        music.offset = view_.offset;
        fulfil(GridAction(
            ReplaceBeats{motion::grid_of_music(session_.take, take_.take.cues, music).beats}));
        view_.message = "The song's beats, as its analysis heard them; U takes them back";
    }
    void fulfil(const SaveGrid& /*wish*/) {
        apply(EndTaps{}, session_);
        if (session_.beats.now().empty()) {
            view_.message = "There is no beat to save";
            return;
        }
        std::vector<motion::TakeGrid> grids = take_.table.grids;
        const auto own = std::find_if(grids.begin(), grids.end(), [this](const auto& grid) {
            return grid.take == session_.take;
        });
        if (own == grids.end()) {
            grids.push_back({session_.take, session_.beats.now()});
        } else {
            own->beats = session_.beats.now();
        }
        const auto written = write_file(take_.file, motion::grids_text(grids, take_.table.remarks));
        if (!written) {
            view_.message = written.error().message;
            return;
        }
        take_.table.grids = std::move(grids);
        session_.mark_saved();
        is_warned_ = false;
        view_.message = fmt::format(
            "Saved {} beats to {}", session_.beats.now().size(), printable(take_.file.string()));
    }
    void fulfil(const CloseGrid& /*wish*/) { is_finished_ = may_close(); }

    EditedTake take_;
    TakeFigure figure_;
    render::Renderer renderer_;
    render::Scene scene_;
    GridSession session_;
    GridView view_;
    std::vector<DrawnStill> stills_;            // by the layout's stills
    std::unique_ptr<engine::ClipSound> sound_;  // of the song; null: none is heard
    HostTime advanced_ = HostClock::now();
    bool is_warned_ = false;  // that beats are not saved
    bool is_finished_ = false;
};

}  // namespace

Expected<void> edit_in_window(EditedTake take,
                              const engine::Look& look,
                              const std::function<bool()>& is_stop_requested) {
    auto window = render::PaneWindow::create({.title = "Raks: beats of " + take.take.clip.name,
                                              .width = look.size.width,
                                              .height = look.size.height,
                                              .max_fps = 60.0,
                                              .otherwise = "draw them: --strips FOLDER"});
    if (!window) {
        return fail(std::move(window.error()));
    }
    auto renderer =
        render::Renderer::create(*look.avatars.front().avatar, {.quality = look.quality});
    if (!renderer) {
        return fail(std::move(renderer.error()));
    }
    GridContent content(std::move(take), std::move(*renderer), look.scene);
    window->run(content, is_stop_requested);
    return {};
}

}  // namespace raks::apps
