#include "apps/raks_capture/film_step.hpp"

#include <algorithm>
#include <utility>

#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "apps/raks_capture/film_detections.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/pending_file.hpp"

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

// Whether the films are to be looked at, by the times of the files.
bool is_to_be_done(const CapturePlan& plan, const std::vector<CameraFilm>& films) {
    CaptureStep step;
    step.inputs = {plan.file("labels.tsv")};
    step.outputs = {plan.file("detections.csv")};
    for (const CameraFilm& film : films) {
        step.inputs.push_back(film.path);
    }
    if (!plan.markers.empty()) {
        step.inputs.push_back(plan.file(plan.markers));
    }
    return state_of(step) != StepState::up_to_date;
}

}  // namespace

Expected<capture::Observations> seen_by_cameras(const CapturePlan& plan,
                                                const capture::Rig& rig,
                                                const capture::MarkerSet& markers,
                                                const std::vector<capture::MarkerLabel>& labels,
                                                capture::ChromaForm form) {
    const std::vector<CameraFilm> films = films_of_plan(plan, rig);
    if (films.empty() || !is_to_be_done(plan, films)) {
        return load_observations(plan);
    }
    ProgressLine progress("finding the markers");
    DetectionOptions options;
    options.form = form;
    options.tell_progress = [&](std::size_t camera, std::size_t done, std::size_t all) {
        const double share =
            all > 0 ? std::min(static_cast<double>(done) / static_cast<double>(all), 1.0) : 0.0;
        progress.show((static_cast<double>(camera) + share) / static_cast<double>(films.size()));
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
    return std::move(found->seen);
}

}  // namespace raks::apps
