#include "apps/raks_capture/correct_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <utility>
#include <variant>

#include "apps/raks_capture/camera_views.hpp"
#include "apps/raks_capture/correct_pane.hpp"
#include "apps/raks_capture/film_pictures.hpp"
#include "apps/terminal/program.hpp"
#include "base/pending_file.hpp"
#include "base/time.hpp"
#include "motion/capture/markerless/followed_keypoints.hpp"
#include "render/panes/pane_window.hpp"

namespace raks::apps {
namespace {

using Edits = std::vector<capture::Edit>;

/// The picture of a film that was taken nearest to each moment.
class PictureTimes {
 public:
    // What a camera's network saw, or its spots; null: neither.
    PictureTimes(const capture::KeypointFilm* joints,
                 const capture::SeenFilm* spots,
                 const std::string& camera,
                 const std::vector<capture::Clock>& clocks) {
        const auto clock = std::find_if(clocks.begin(), clocks.end(), [&camera](const auto& one) {
            return one.camera == camera;
        });
        const auto add = [&](std::size_t number, double time) {
            numbers_.push_back(number);
            times_.push_back(clock != clocks.end() ? clock->capture_time(time) : time);
        };
        for (std::size_t i = 0; joints != nullptr && i < joints->pictures.size(); ++i) {
            add(joints->pictures[i].number, joints->pictures[i].time);
        }
        for (std::size_t i = 0; spots != nullptr && i < spots->pictures.size(); ++i) {
            add(i, spots->pictures[i].time);
        }
    }

    // Its number. None: the camera has no pictures.
    [[nodiscard]] std::optional<std::size_t> at(double time) const {
        if (times_.empty()) {
            return std::nullopt;
        }
        const auto after = std::lower_bound(times_.begin(), times_.end(), time);
        const auto index = static_cast<std::size_t>(after - times_.begin());
        const bool is_before = index == times_.size() ||
                               (index > 0 && time - times_[index - 1] < times_[index] - time);
        return numbers_[is_before ? index - 1 : index];
    }

 private:
    std::vector<std::size_t> numbers_;  // of the pictures in their film
    std::vector<double> times_;
};

/// One camera's picture as it was last given to the driver.
struct ViewPicture {
    std::shared_ptr<const engine::FilmPicture> picture;
    std::optional<render::PanePicture> texture;
};

/// What the window shows; keeps the session and what is made from it.
class CorrectContent : public render::PaneContent {
 public:
    CorrectContent(const CapturePlan& plan, const TrackingGiven& given, FollowedMarkers followed)
        : plan_(plan),
          given_(given),
          films_(films_by_camera(plan)),
          shown_(plan.cameras.size()),
          scene_{given.markers,
                 std::vector<CorrectView>(plan.cameras.size()),
                 {},
                 0,
                 false,
                 true,
                 {}} {
        session_.cameras = camera_names(plan);
        session_.tracks = std::move(followed.stages.smoothed);
        session_.is_of_joints = given.dancer.has_value();
        session_.edits = History<Edits>(given.edits);
        tracked_ = given.edits;
        shown_joints_ = std::move(followed.shown);
        for (std::size_t camera = 0; camera < session_.cameras.size(); ++camera) {
            const std::string& name = session_.cameras[camera];
            times_.emplace_back(given.dancer ? &given.dancer->films[camera] : nullptr,
                                film_of(given.seen, name),
                                name,
                                given.clocks);
        }
        for (std::size_t camera = 0; camera < shown_.size(); ++camera) {
            std::tie(scene_.views[camera].width, scene_.views[camera].height) =
                size_of_picture(session_.cameras[camera], given.rig, given.seen);
        }
    }

    void draw(const render::PaneFrame& frame) override {
        play();
        look();
        for (const CorrectWish& wish : correct_pane(frame, session_, scene_)) {
            std::visit([this](const auto& one) { fulfil(one); }, wish);
        }
    }
    bool is_moving() override {
        take_tracks();
        const bool has_news = films_.take_news();
        return has_news || session_.is_playing || scene_.is_tracking;
    }
    bool may_close() override {
        if (session_.edits.is_saved() || is_warned_) {
            return true;
        }
        is_warned_ = true;
        scene_.message = "Not saved: S saves, Q once more closes without";
        return false;
    }
    [[nodiscard]] bool is_finished() const override { return is_finished_; }

 private:
    void fulfil(const CorrectAction& action) {
        const bool is_of_positions =
            std::holds_alternative<BeginSwap>(action) || std::holds_alternative<FillMarker>(action);
        if (given_.dancer && is_of_positions) {
            scene_.message = "Swap and fill are for markers; exchange sides or hide here";
            return;
        }
        if (given_.angles && is_of_positions) {
            scene_.message = "Swap and fill are for the method of positions; drag or hide here";
            return;
        }
        apply(action, session_);
        if (!std::holds_alternative<HoldMarker>(action)) {
            scene_.message.clear();
            is_warned_ = false;
        }
    }
    void fulfil(const SetViewZoom& zoom) { scene_.views[zoom.camera].zoom = zoom.zoom; }
    void fulfil(const SetMarkerRow& row) { scene_.first_row = row.first_row; }
    void fulfil(const CloseEdits& /*wish*/) { is_finished_ = may_close(); }
    void fulfil(const TrackAgain& /*wish*/) {
        if (scene_.is_tracking) {
            return;
        }
        scene_.is_tracking = true;
        tracking_ = std::async(std::launch::async, [this, edits = session_.edits.now()] {
            return std::pair(track_with(given_, edits), edits);
        });
    }
    void fulfil(const SaveEdits& /*wish*/) {
        const auto written =
            write_file(plan_.file("edits.jsonl"), capture::edits_text(session_.edits.now()));
        if (written) {
            session_.edits.mark_saved();
        }
        scene_.message = written ? fmt::format("Saved {} edits; raks capture run goes on from here",
                                               session_.edits.now().size())
                                 : written.error().message;
    }

    void take_tracks() {
        if (!scene_.is_tracking ||
            tracking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            return;
        }
        scene_.is_tracking = false;
        auto [followed, edits] = tracking_.get();
        tracked_ = std::move(edits);
        if (!followed) {
            scene_.message = followed.error().message;
            return;
        }
        session_.tracks = std::move(followed->stages.smoothed);
        shown_joints_ = std::move(followed->shown);
        edited_.reset();
        scene_.message =
            fmt::format("Tracked again: {} stretches to look at", session_.tracks.flags.size());
    }

    // Frames go by the clock.
    void play() {
        const HostTime now = HostClock::now();
        const double seconds = to_seconds(now - std::exchange(last_, now));
        if (!session_.is_playing) {
            position_ = static_cast<double>(session_.frame);
            return;
        }
        // Whoever jumps while it plays goes on from there.
        if (session_.frame != static_cast<std::size_t>(position_)) {
            position_ = static_cast<double>(session_.frame);
        }
        constexpr double kLongest = 0.1;  // s; a slow picture makes it slower, not jump
        position_ += std::min(seconds, kLongest) * session_.tracks.frames_per_second;
        const std::size_t last = session_.tracks.frame_count - 1;
        session_.frame = std::min(static_cast<std::size_t>(position_), last);
        session_.is_playing = session_.frame < last;
    }

    // Brings views and curve up to the frame and marker that are looked at.
    void look() {
        if (shown_joints_ && (!edited_ || edited_by_ != session_.edits.now())) {
            edited_by_ = session_.edits.now();
            edited_ = shown_joints_;
            capture::apply_keypoint_edits(edited_by_, given_.rig, *edited_);
        }
        for (std::size_t camera = 0; camera < shown_.size(); ++camera) {
            look_at(camera);
        }
        scene_.errors.resize(session_.tracks.frame_count);
        for (std::size_t frame = 0; frame < scene_.errors.size(); ++frame) {
            const capture::MarkerPlace& place = session_.tracks.at(frame, session_.marker);
            scene_.errors[frame] = place.source == capture::PlaceSource::lost
                                       ? std::numeric_limits<double>::quiet_NaN()
                                       : 1000.0 * place.deviation;
        }
        scene_.is_tracked = session_.edits.now() == tracked_;
    }

    void look_at(std::size_t camera) {
        CorrectView& view = scene_.views[camera];
        const auto number = times_[camera].at(session_.tracks.time_of(session_.frame));
        const capture::SeenFilm* const film = film_of(given_.seen, session_.cameras[camera]);
        view.spots.clear();
        if (film != nullptr && number) {
            view.spots =
                spots_in_colours_of(film->pictures[*number], given_.seen.colours, given_.markers);
        }
        const auto rig_camera = given_.rig.index_of(session_.cameras[camera]);
        view.places.assign(session_.tracks.markers.size(), std::nullopt);
        for (std::size_t marker = 0; rig_camera && marker < view.places.size(); ++marker) {
            const capture::MarkerPlace& place = session_.tracks.at(session_.frame, marker);
            if (place.source != capture::PlaceSource::lost) {
                view.places[marker] =
                    capture::project(given_.rig.cameras[*rig_camera], place.place);
            }
        }
        if (edited_) {
            look_at_joints(camera);
        }
        if (number && !plan_.cameras[camera].film.empty()) {
            show_picture(camera, *number);
        }
    }

    // The joints as the network saw them, those that edits hide too; markers are at them.
    void look_at_joints(std::size_t camera) {
        CorrectView& view = scene_.views[camera];
        const auto& seen = shown_joints_->at(session_.frame, camera);
        const auto& edited = edited_->at(session_.frame, camera);
        view.skeleton.emplace();
        for (std::size_t i = 0; i < capture::kBodyPoints; ++i) {
            const bool is_hidden = edited[i].visibility <= 0.0 && seen[i].visibility > 0.0;
            const capture::Keypoint& shown = is_hidden ? seen[i] : edited[i];
            (*view.skeleton)[i] = {shown.pixel, shown.visibility, is_hidden};
        }
        view.placed.fill(std::nullopt);
        for (std::size_t marker = 0; marker < view.places.size(); ++marker) {
            const auto point = capture::body_point_named(session_.tracks.markers[marker]);
            const auto index = static_cast<std::size_t>(*point);
            view.placed[index] = view.places[marker];
            if (edited[index].visibility > 0.0) {
                view.places[marker] = edited[index].pixel;
            }
        }
    }

    void show_picture(std::size_t camera, std::size_t number) {
        films_.want(camera, number);
        const ShownPicture shown = films_.shown(camera);
        ViewPicture& kept = shown_[camera];
        CorrectView& view = scene_.views[camera];
        if (shown.picture != nullptr && shown.picture != kept.picture) {
            kept.picture = shown.picture;
            kept.texture.emplace(kept.picture->width, kept.picture->height, kept.picture->rgb);
            view.width = kept.picture->width;
            view.height = kept.picture->height;
        }
        view.picture = kept.texture ? &*kept.texture : nullptr;
        view.note = !shown.problem.empty()                               ? shown.problem
                    : shown.picture == nullptr || shown.number != number ? "reading the film ..."
                                                                         : "";
    }

    const CapturePlan& plan_;
    const TrackingGiven& given_;
    FilmPictures films_;
    std::vector<ViewPicture> shown_;   // by camera
    std::vector<PictureTimes> times_;  // by camera
    CorrectSession session_;
    CorrectScene scene_;
    Edits tracked_;  // that the tracks are by
    // Of joints: what the tracking shows, and the same after the edits as they are.
    std::optional<capture::KeypointTake> shown_joints_;
    std::optional<capture::KeypointTake> edited_;
    Edits edited_by_;
    HostTime last_{};
    double position_ = 0.0;   // frames, while playing
    bool is_warned_ = false;  // that edits are not saved
    bool is_finished_ = false;
    // Last: it waits for its end, which refers to the rest.
    std::future<std::pair<Expected<FollowedMarkers>, Edits>> tracking_;
};

}  // namespace

Expected<void> correct_in_window(const CapturePlan& plan, const TrackingGiven& given) {
    auto followed = track_with(given, given.edits);
    if (!followed) {
        return fail(std::move(followed.error()).in(plan.folder.string()));
    }
    auto window = render::PaneWindow::create(
        {.title = "Raks: correct " + plan.folder.string(),
         .max_fps = 60.0,
         .otherwise = "without a window write edits.jsonl by hand (docs/reference/files.md)"});
    if (!window) {
        return fail(std::move(window.error()));
    }
    CorrectContent content(plan, given, std::move(*followed));
    window->run(content, [] { return stop_signal().has_value(); });
    return {};
}

}  // namespace raks::apps
