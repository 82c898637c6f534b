#include "apps/raks_capture/taken_keypoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "apps/raks_capture/film_detections.hpp"
#include "apps/raks_capture/keypoint_files.hpp"
#include "base/file.hpp"
#include "base/suggest.hpp"
#include "engine/setup/settings.hpp"
#include "motion/capture/keypoints/foreign_keypoints.hpp"

namespace raks::apps {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kMostTakenBytes = std::size_t{1} << 30U;
constexpr std::size_t kMostPictureBytes = std::size_t{1} << 24U;  // of one file of OpenPose

/// One --from.
struct TakenCamera {
    const PlannedCamera* camera = nullptr;
    Path path;
};

Expected<TakenCamera> parse_from(const CapturePlan& plan, const std::string& from) {
    const std::size_t cut = from.find('=');
    if (cut == std::string::npos || cut + 1 == from.size()) {
        return fail(fmt::format("--from {} must be CAMERA=PATH", from));
    }
    const std::string name = from.substr(0, cut);
    std::vector<std::string_view> names;
    for (const PlannedCamera& camera : plan.cameras) {
        if (camera.name == name) {
            return TakenCamera{&camera, from.substr(cut + 1)};
        }
        names.push_back(camera.name);
    }
    return fail(unknown_name("camera", name, names));
}

// Size and rate as they are said, else as the film has them.
Expected<capture::ForeignFilm> facts_of(const CapturePlan& plan,
                                        const TakenKeypoints& taken,
                                        const PlannedCamera& camera) {
    capture::ForeignFilm facts{camera.name, 0, 0, taken.pictures_per_second, {}};
    if (!taken.size.empty()) {
        const auto size = engine::parse_size(taken.size);
        if (!size) {
            return fail(Error(size.error()).in("--size"));
        }
        facts.width = size->width;
        facts.height = size->height;
    }
    if (!camera.film.empty() && (facts.width == 0 || facts.pictures_per_second == 0.0)) {
        const auto reader = open_film({camera.name, plan.file(camera.film), 0, 0}, {});
        if (!reader) {
            return fail(reader.error());
        }
        const engine::FilmInfo& info = (*reader)->info();
        if (facts.width == 0) {
            facts.width = info.width;
            facts.height = info.height;
        }
        if (facts.pictures_per_second == 0.0) {
            facts.pictures_per_second = info.pictures_per_second;
        }
    }
    if (facts.width == 0 || !(facts.pictures_per_second > 0.0)) {
        return fail(fmt::format(
            "camera {} has no film that says it: say --size WIDTHxHEIGHT and --fps", camera.name));
    }
    return facts;
}

Expected<capture::KeypointFilm> read_openpose_folder(const Path& folder,
                                                     const capture::ForeignFilm& facts) {
    const auto listed = list_folder(folder);
    if (!listed) {
        return fail(listed.error());
    }
    capture::OpenPoseReader reader(facts);
    bool has_any = false;
    for (const Path& file : *listed) {
        if (file.extension() != ".json") {
            continue;
        }
        const auto text = read_text_file(file, kMostPictureBytes);
        auto added = text ? reader.add(*text, file.string()) : fail(text.error());
        if (!added) {
            return fail(std::move(added.error()));
        }
        has_any = true;
    }
    return has_any ? Expected<capture::KeypointFilm>(reader.take())
                   : fail(folder.string() + ": has no .json files, as OpenPose writes them");
}

Expected<capture::KeypointFilm> read_taken(const Path& path, const capture::ForeignFilm& facts) {
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem)) {
        return read_openpose_folder(path, facts);
    }
    const auto text = read_text_file(path, kMostTakenBytes);
    if (!text) {
        return fail(text.error());
    }
    if (text->starts_with("# raks-keypoints")) {
        auto film = capture::read_keypoints(*text, path.string());
        if (film) {
            film->camera = facts.camera;
        }
        return film;
    }
    return capture::read_foreign_table(*text, path.string(), facts);
}

Expected<capture::PointNameMap> load_point_names(const Path& file) {
    if (file.empty()) {
        return capture::PointNameMap{};
    }
    const auto text = read_text_file(file, kMostPictureBytes);
    return text ? capture::read_point_names(*text, file.string()) : fail(text.error());
}

}  // namespace

Expected<std::vector<capture::KeypointFilm>> take_keypoints(const CapturePlan& plan,
                                                            const TakenKeypoints& taken) {
    const auto names = load_point_names(taken.map);
    if (!names) {
        return fail(names.error());
    }
    std::vector<capture::KeypointFilm> films;
    for (const std::string& from : taken.from) {
        const auto one = parse_from(plan, from);
        auto facts = one ? facts_of(plan, taken, *one->camera) : fail(one.error());
        if (!facts) {
            return fail(facts.error());
        }
        const bool is_twice = std::any_of(films.begin(), films.end(), [&](const auto& film) {
            return film.camera == one->camera->name;
        });
        if (is_twice) {
            return fail(fmt::format("--from is there twice for camera {}", one->camera->name));
        }
        facts->names = *names;
        auto film = read_taken(one->path, *facts);
        if (!film) {
            return fail(film.error());
        }
        films.push_back(std::move(*film));
    }
    for (const capture::KeypointFilm& film : films) {
        if (auto kept = keep_keypoints(plan, film); !kept) {
            return fail(std::move(kept.error()));
        }
    }
    return films;
}

}  // namespace raks::apps
