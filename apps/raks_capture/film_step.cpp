#include "apps/raks_capture/film_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <system_error>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "apps/raks_capture/film_detections.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"

namespace raks::apps {
namespace {

std::vector<CameraFilm> films_of_plan(const CapturePlan& plan, const capture::Rig& rig) {
    std::vector<CameraFilm> films;
    for (const PlannedCamera& camera : plan.cameras) {
        if (!camera.film.empty()) {
            const auto index = rig.index_of(camera.name);
            const capture::Lens lens = index ? rig.cameras[*index].lens : capture::Lens{};
            films.push_back({camera.name, plan.file(camera.film), lens.width, lens.height});
        }
    }
    return films;
}

// Whether what was found in these films is as new as they are, by the times of the files.
bool is_up_to_date(const CapturePlan& plan,
                   std::span<const CameraFilm> films,
                   const std::filesystem::path& found) {
    CaptureStep step;
    step.inputs = {plan.file("labels.tsv")};
    step.outputs = {found};
    for (const CameraFilm& film : films) {
        step.inputs.push_back(film.path);
    }
    if (!plan.markers.empty()) {
        step.inputs.push_back(plan.file(plan.markers));
    }
    return state_of(step) == StepState::up_to_date;
}

/// The spots of one camera, kept until those of all are there: a run that was ended goes on with
/// the next camera.
class KeptSpots {
 public:
    KeptSpots(const CapturePlan& plan,
              const std::vector<CameraFilm>& films,
              capture::ChromaForm form,
              std::vector<std::string> colours)
        : plan_(plan), films_(films), form_(form), colours_(std::move(colours)) {}

    /// Those that are as new as their films, and can be read.
    [[nodiscard]] std::vector<capture::SeenFilm> load() const {
        std::vector<capture::SeenFilm> kept;
        for (std::size_t i = 0; i < films_.size(); ++i) {
            const std::filesystem::path path = file(i);
            if (!is_there(path) || !is_up_to_date(plan_, std::span(&films_[i], 1), path)) {
                continue;
            }
            const auto text = read_text_file(path, kMostBytes);
            auto read = text ? capture::read_observations(*text, path.string()) : fail("");
            if (read && read->films.size() == 1 && read->films.front().camera == films_[i].camera) {
                put_in_order(*read);
                kept.push_back(std::move(read->films.front()));
            }
        }
        return kept;
    }
    [[nodiscard]] Expected<void> keep(std::size_t camera, const capture::SeenFilm& film) const {
        return write_file(file(camera), capture::observations_text({colours_, {film}}));
    }
    /// Once detections.csv has them all.
    void remove() const {
        for (std::size_t i = 0; i < films_.size(); ++i) {
            std::error_code problem;
            std::filesystem::remove(file(i), problem);
        }
    }

 private:
    static constexpr std::size_t kMostBytes = std::size_t{1} << 30U;

    [[nodiscard]] std::filesystem::path file(std::size_t camera) const {
        return plan_.file(fmt::format(
            "spots_{}{}.csv", camera + 1, form_ == capture::ChromaForm::crcb ? "_crcb" : ""));
    }
    // A table numbers its colours as they come.
    void put_in_order(capture::Observations& read) const {
        std::vector<std::size_t> now;
        for (const std::string& name : read.colours) {
            now.push_back(static_cast<std::size_t>(
                std::find(colours_.begin(), colours_.end(), name) - colours_.begin()));
        }
        for (capture::SeenPicture& picture : read.films.front().pictures) {
            for (capture::Detection& spot : picture.detections) {
                spot.colour = now[spot.colour];
            }
        }
    }

    const CapturePlan& plan_;
    const std::vector<CameraFilm>& films_;
    capture::ChromaForm form_;
    std::vector<std::string> colours_;
};

}  // namespace

Expected<capture::Observations> seen_by_cameras(const CapturePlan& plan,
                                                const capture::Rig& rig,
                                                const capture::MarkerSet& markers,
                                                const std::vector<capture::MarkerLabel>& labels,
                                                capture::ChromaForm form) {
    const std::vector<CameraFilm> films = films_of_plan(plan, rig);
    if (films.empty() || is_up_to_date(plan, films, plan.file("detections.csv"))) {
        return load_observations(plan);
    }
    const KeptSpots spots(plan, films, form, markers.colours());
    const std::vector<capture::SeenFilm> kept = spots.load();
    ProgressLine progress("finding the markers");
    DetectionOptions options;
    options.form = form;
    options.kept = kept;
    std::vector<double> shares(films.size());
    options.tell_progress = [&](std::size_t camera, std::size_t done, std::size_t all) {
        shares[camera] =
            all > 0 ? std::min(static_cast<double>(done) / static_cast<double>(all), 1.0) : 0.0;
        progress.show(std::accumulate(shares.begin(), shares.end(), 0.0) /
                      static_cast<double>(films.size() - kept.size()));
    };
    options.take_film = [&](std::size_t camera, const capture::SeenFilm& film) {
        progress.reached(fmt::format("markers found in the film of camera \"{}\" ({} pictures)",
                                     printable(film.camera),
                                     film.pictures.size()));
        return spots.keep(camera, film);
    };
    options.is_stop_requested = [] { return stop_signal().has_value(); };
    auto found = detect_in_films(films, markers, labels, options);
    if (!found) {
        return fail(std::move(found.error()));
    }
    for (const std::string& doubt : found->doubts) {
        say(doubt);
    }
    if (auto written =
            write_file(plan.file("detections.csv"), capture::observations_text(found->seen));
        !written) {
        return fail(std::move(written.error()));
    }
    spots.remove();
    return std::move(found->seen);
}

}  // namespace raks::apps
