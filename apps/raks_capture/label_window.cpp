#include "apps/raks_capture/label_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <variant>

#include "apps/raks_capture/camera_views.hpp"
#include "apps/raks_capture/film_pictures.hpp"
#include "apps/raks_capture/label_checks.hpp"
#include "apps/raks_capture/label_pane.hpp"
#include "apps/raks_capture/label_proposals.hpp"
#include "apps/raks_capture/label_spots.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"
#include "render/panes/pane_window.hpp"

namespace raks::apps {
namespace {

constexpr double kFarthestPicture = 1e6;

using capture::MarkerLabel;

// How many pictures a second a camera takes; 0: that cannot be told.
double picture_rate(const CameraFilm& film, const capture::SeenFilm* seen) {
    if (!film.path.empty()) {
        const auto reader = open_film(film, {});
        return reader ? (*reader)->info().pictures_per_second : 0.0;
    }
    const double seconds = seen != nullptr && seen->pictures.size() > 1
                               ? seen->pictures.back().time - seen->pictures.front().time
                               : 0.0;
    return seconds > 0.0 ? static_cast<double>(seen->pictures.size() - 1) / seconds : 0.0;
}

// By camera: the picture of the first moment at which all film, as near as their rates say; without
// a clock the first.
std::vector<std::size_t> pictures_of_one_moment(const LabelWork& work) {
    const double start = capture::common_start(work.clocks);
    std::vector<std::size_t> pictures;
    for (const CameraFilm& film : films_by_camera(work.plan)) {
        std::size_t& number = pictures.emplace_back(0);
        const auto clock = std::find_if(work.clocks.begin(),
                                        work.clocks.end(),
                                        [&](const auto& one) { return one.camera == film.camera; });
        if (clock != work.clocks.end()) {
            const double rate = picture_rate(film, film_of(work.seen, film.camera));
            number = static_cast<std::size_t>(
                std::lround(std::clamp(clock->camera_time(start) * rate, 0.0, kFarthestPicture)));
        }
    }
    return pictures;
}

/// What the window shows; keeps the session and what is made from it.
class LabelContent : public render::PaneContent {
 public:
    explicit LabelContent(const LabelWork& work)
        : work_(work),
          pictures_(films_by_camera(work.plan)),
          spots_(work.markers.colours().size()),
          session_(label_session(
              camera_names(work.plan), work.markers, work.labels, pictures_of_one_moment(work))) {
        if (work.clocks.empty() && work.plan.cameras.size() > 1 && work.labels.empty()) {
            view_.message =
                "The clocks are not known yet: after raks capture sync this window begins "
                "with pictures of one moment";
        }
    }

    void draw(const render::PaneFrame& frame) override {
        look();
        const std::vector<LabelWish> wishes = label_pane(frame, session_, view_);
        for (const LabelWish& wish : wishes) {
            std::visit([this](const auto& one) { fulfil(one); }, wish);
        }
    }
    bool is_moving() override { return pictures_.take_news(); }
    bool may_close() override {
        if (session_.labels.is_saved() || is_warned_) {
            return true;
        }
        is_warned_ = true;
        view_.message = "Not saved: S saves, Q once more closes without";
        return false;
    }
    [[nodiscard]] bool is_finished() const override { return is_finished_; }

 private:
    [[nodiscard]] const PlannedCamera& camera() const {
        return work_.plan.cameras[session_.camera];
    }

    void fulfil(const LabelAction& action) {
        apply(action, session_);
        const bool is_step = !std::holds_alternative<MoveLabel>(action);
        is_stale_ = is_stale_ || is_step;
        if (is_step) {
            view_.message.clear();
            is_warned_ = false;
        }
        if (std::holds_alternative<ShowCamera>(action)) {
            view_.zoom = {};
        }
    }
    void fulfil(const SetLabelZoom& zoom) { view_.zoom = zoom.zoom; }
    void fulfil(const SetLabelRow& row) { view_.first_row = row.first_row; }
    void fulfil(const CloseLabels& /*wish*/) { is_finished_ = may_close(); }
    void fulfil(const SaveLabels& /*wish*/) {
        const auto written =
            write_file(work_.plan.file("labels.tsv"), capture::labels_text(session_.labels.now()));
        if (!written) {
            view_.message = written.error().message;
            return;
        }
        session_.labels.mark_saved();
        const auto doubts = check_labels(session_.labels.now(), known());
        view_.message = "Saved" + (!doubts           ? "; " + doubts.error().message
                                   : doubts->empty() ? std::string()
                                                     : "; " + doubts->front());
    }

    [[nodiscard]] LabelledCapture known() const {
        return {work_.plan,
                work_.markers,
                work_.rig.cameras.empty() ? nullptr : &work_.rig,
                work_.seen.films.empty() ? nullptr : &work_.seen,
                work_.clocks};
    }

    // Brings the picture and its spots up to what the session looks at.
    void look() {
        if (camera().film.empty()) {
            look_at_spots();
        } else {
            look_at_film();
        }
        if (std::exchange(is_stale_, false)) {
            propose();
        }
    }

    void stay_within(std::size_t count) {
        if (count > 0 && session_.picture() >= count) {
            apply(ShowPicture{count - 1}, session_);
            view_.message = fmt::format("{} has {} pictures", camera().name, count);
            is_stale_ = true;
        }
    }

    void look_at_spots() {
        const capture::SeenFilm* const film = film_of(work_.seen, camera().name);
        stay_within(film != nullptr ? film->pictures.size() : 1);
        texture_.reset();
        picture_.reset();
        view_.picture = nullptr;
        view_.is_loading = false;
        std::tie(view_.width, view_.height) = size_of_picture(camera().name, work_.rig, work_.seen);
    }

    void look_at_film() {
        const ShownPicture at_end = pictures_.shown(session_.camera);
        stay_within(at_end.count.value_or(0));
        pictures_.want(session_.camera, session_.picture());
        const ShownPicture shown = pictures_.shown(session_.camera);
        view_.is_loading = shown.picture == nullptr || shown.number != session_.picture();
        if (!shown.problem.empty() && !shown.count) {
            view_.message = shown.problem;
        }
        if (shown.picture != nullptr && shown.picture != picture_) {
            picture_ = shown.picture;
            texture_.emplace(picture_->width, picture_->height, picture_->rgb);
            std::tie(view_.width, view_.height) = std::pair(picture_->width, picture_->height);
            seconds_[{camera().name, shown.number}] = picture_->seconds;
            is_stale_ = true;
        }
        view_.picture = texture_ ? &*texture_ : nullptr;
    }

    // The capture's time of a picture, where it is known.
    [[nodiscard]] std::optional<double> moment_of(const std::string& name,
                                                  std::size_t picture) const {
        const auto clock = std::find_if(work_.clocks.begin(),
                                        work_.clocks.end(),
                                        [&](const auto& one) { return one.camera == name; });
        if (clock == work_.clocks.end()) {
            return std::nullopt;
        }
        const auto read = seconds_.find({name, picture});
        if (read != seconds_.end()) {
            return clock->capture_time(read->second);
        }
        const capture::SeenFilm* const film = film_of(work_.seen, name);
        return film != nullptr && picture < film->pictures.size()
                   ? std::optional(clock->capture_time(film->pictures[picture].time))
                   : std::nullopt;
    }

    [[nodiscard]] bool is_of_this_moment(const MarkerLabel& label) const {
        const auto here = moment_of(camera().name, session_.picture());
        const auto there = moment_of(label.camera, label.picture);
        return here && there ? std::abs(*here - *there) <= kOneMoment
                             : label.picture == session_.picture();
    }

    [[nodiscard]] std::vector<capture::Detection> spots_of_picture() {
        const std::vector<std::size_t> classes = work_.markers.classes();
        std::vector<capture::Detection> spots;
        if (picture_ != nullptr && !view_.is_loading) {
            std::vector<ColourExample> examples;
            for (std::size_t marker = 0; marker < classes.size(); ++marker) {
                if (const MarkerLabel* const label = session_.label_of(marker)) {
                    examples.push_back({classes[marker], label->pixel});
                }
            }
            spots = spots_.find({picture_->width, picture_->height, picture_->rgb}, examples);
        }
        const capture::SeenFilm* const film = film_of(work_.seen, camera().name);
        if (spots.empty() && film != nullptr && session_.picture() < film->pictures.size()) {
            spots = spots_in_colours_of(
                film->pictures[session_.picture()], work_.seen.colours, work_.markers);
        }
        return spots;
    }

    void propose() {
        const std::vector<capture::Detection> spots = spots_of_picture();
        const auto here = work_.rig.index_of(camera().name);
        std::vector<OtherLabel> others;
        for (const MarkerLabel& label : session_.labels.now()) {
            const auto there = work_.rig.index_of(label.camera);
            const auto marker = work_.markers.index_of(label.marker);
            if (here && there && marker && is_of_this_moment(label)) {
                others.push_back({*there, *marker, label.pixel});
            }
        }
        ProposalInput input{
            work_.markers, spots, {}, here ? &work_.rig : nullptr, here.value_or(0), others};
        for (std::size_t marker = 0; marker < work_.markers.markers.size(); ++marker) {
            const MarkerLabel* const label = session_.label_of(marker);
            input.labelled.push_back(label != nullptr ? std::optional(label->pixel) : std::nullopt);
        }
        view_.proposals = propose_labels(input);
    }

    const LabelWork& work_;
    FilmPictures pictures_;
    LabelSpots spots_;
    LabelSession session_;
    LabelView view_;
    std::shared_ptr<const engine::FilmPicture> picture_;  // that the texture shows; null: none
    std::optional<render::PanePicture> texture_;
    std::map<std::pair<std::string, std::size_t>, double> seconds_;  // of pictures that were read
    bool is_stale_ = true;    // proposals are to be made anew
    bool is_warned_ = false;  // that labels are not saved
    bool is_finished_ = false;
};

}  // namespace

Expected<void> label_in_window(const LabelWork& work) {
    const bool has_film = std::any_of(
        work.plan.cameras.begin(), work.plan.cameras.end(), [](const PlannedCamera& camera) {
            return !camera.film.empty();
        });
    if (!has_film && work.seen.films.empty()) {
        return fail(work.plan.folder.string() +
                    ": nothing to label: capture.toml names no film, and detections.csv is not "
                    "there");
    }
    auto window =
        render::PaneWindow::create({.title = "Raks: label " + work.plan.folder.string(),
                                    .max_fps = 60.0,
                                    .otherwise = "label without a window: --labels LABELS.tsv"});
    if (!window) {
        return fail(std::move(window.error()));
    }
    LabelContent content(work);
    window->run(content, [] { return stop_signal().has_value(); });
    return {};
}

}  // namespace raks::apps
