#include "apps/raks_capture/keypoint_files.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/pending_file.hpp"

namespace raks::apps {

std::filesystem::path keypoint_file(const CapturePlan& plan, const std::string& camera) {
    return plan.file("keypoints") / (camera + ".csv");
}

Expected<void> keep_keypoints(const CapturePlan& plan, const capture::KeypointFilm& seen) {
    const std::filesystem::path file = keypoint_file(plan, seen.camera);
    std::error_code problem;
    std::filesystem::create_directories(file.parent_path(), problem);
    if (problem) {
        return fail(fmt::format("{}: {}", file.parent_path().string(), problem.message()));
    }
    return write_file(file, capture::keypoints_text(seen));
}

Expected<std::vector<capture::KeypointFilm>> load_keypoints(const CapturePlan& plan) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 30U;
    std::vector<capture::KeypointFilm> films;
    for (const PlannedCamera& camera : plan.cameras) {
        const std::filesystem::path file = keypoint_file(plan, camera.name);
        if (!is_there(file)) {
            return fail(fmt::format("{}: is not there; run raks capture keypoints {} first",
                                    file.string(),
                                    plan.folder.string()));
        }
        const auto text = read_text_file(file, kMostBytes);
        auto film = text ? capture::read_keypoints(*text, file.string()) : fail(text.error());
        if (!film) {
            return fail(film.error());
        }
        film->camera = camera.name;
        films.push_back(std::move(*film));
    }
    return films;
}

}  // namespace raks::apps
