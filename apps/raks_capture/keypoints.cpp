// `raks capture keypoints`: finds the joints of a dancer without markers in all films.
#include "motion/capture/keypoints/keypoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "apps/raks_capture/keypoint_files.hpp"
#include "apps/raks_capture/keypoint_search.hpp"
#include "apps/raks_capture/taken_keypoints.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"
#include "engine/setup/settings.hpp"
#include "motion/capture/keypoints/keypoint_doubts.hpp"
#include "motion/capture/keypoints/still_camera.hpp"

namespace raks::apps {
namespace {

constexpr std::size_t kPreviewEvery = 3;
constexpr std::string_view kPreviewMark = "-preview";  // behind the network's name
constexpr std::size_t kMostKeypointBytes = std::size_t{1} << 30U;

/// Which network finds joints.
struct ChosenNetwork {
    Path file;
    bool is_other = false;  ///< full, where lite is asked for and is not there
};

// Where a network of this name lies.
Expected<Path> shipped_network(std::string_view name) {
    return engine::data_path(fmt::format("models/pretrained/blazepose_{}.pose", name));
}

Expected<ChosenNetwork> choose_network(const KeypointArguments& arguments) {
    const std::string name = arguments.is_preview && arguments.network == "full"
                                 ? std::string("lite")
                                 : arguments.network;
    if (name != "lite" && name != "full" && name != "heavy") {
        return ChosenNetwork{name};
    }
    const auto file = shipped_network(name);
    if (file) {
        return ChosenNetwork{*file};
    }
    if (arguments.is_preview && arguments.network == "full") {
        const auto full = shipped_network("full");
        return full ? Expected<ChosenNetwork>({*full, true}) : fail(full.error());
    }
    return name == "full"
               ? fail(file.error())
               : fail(fmt::format("the network {0} is not installed: npm pack "
                                  "@mediapipe/pose@0.5.1675469404, unpack it, scripts/"
                                  "convert_pose.py package . {0} (in Raks' sources), then "
                                  "--pose-model blazepose_{0}.pose",
                                  name));
}

// The films of the cameras. Errors: none.
Expected<std::vector<CameraFilm>> films_with_dancer(const CapturePlan& plan) {
    std::vector<CameraFilm> films;
    for (const PlannedCamera& camera : plan.cameras) {
        if (camera.film.empty()) {
            return fail(fmt::format("{}: camera {} has no film = \"...\"",
                                    plan.file("capture.toml").string(),
                                    camera.name));
        }
        films.push_back({camera.name, plan.file(camera.film), 0, 0});
    }
    return films;
}

// What was found before in a film, unless that is older than the film or of another network; by a
// whole search where a preview is asked for is good, too.
std::optional<capture::KeypointFilm> found_before(const CapturePlan& plan,
                                                  const CameraFilm& film,
                                                  const std::string& network) {
    const Path file = keypoint_file(plan, film.camera);
    if (state_of({"keypoints", {}, {film.path}, {file}}) != StepState::up_to_date) {
        return std::nullopt;
    }
    const auto text = read_text_file(file, kMostKeypointBytes);
    auto kept = text ? capture::read_keypoints(*text, file.string()) : fail(text.error());
    const bool is_preview = network.ends_with(kPreviewMark);
    const bool is_same = kept && (kept->network == network ||
                                  (is_preview && !kept->network.ends_with(kPreviewMark)));
    return is_same ? std::optional(std::move(*kept)) : std::nullopt;
}

/// Finds and keeps the joints of all films, side by side.
class KeypointRun {
 public:
    KeypointRun(const CapturePlan& plan, std::vector<CameraFilm> films, capture::PoseModels models)
        : plan_(plan),
          films_(std::move(films)),
          models_(std::move(models)),
          done_(films_.size(), 0.0) {}

    // Errors: the first one, by the order of the cameras; other films are gone on with.
    Expected<std::vector<capture::KeypointFilm>> run(std::size_t every, int threads) {
        std::vector<Expected<capture::KeypointFilm>> results(films_.size(), fail("not searched"));
        run_parallel(films_.size(), threads, [&](std::size_t i) { results[i] = search(i, every); });
        std::vector<capture::KeypointFilm> seen;
        for (Expected<capture::KeypointFilm>& result : results) {
            if (!result) {
                return fail(std::move(result.error()));
            }
            seen.push_back(std::move(*result));
        }
        return seen;
    }

 private:
    Expected<capture::KeypointFilm> search(std::size_t index, std::size_t every) {
        const CameraFilm& film = films_[index];
        if (auto kept = found_before(plan_, film, models_.name)) {
            show(index, 1.0);
            tell(fmt::format("camera {}: kept as it was found before", film.camera));
            return std::move(*kept);
        }
        KeypointOptions options;
        options.every = every;
        options.tell_progress = [this, index](std::size_t done, std::size_t all) {
            show(index, all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 0.0);
        };
        options.is_stop_requested = [] { return stop_signal().has_value(); };
        auto found = find_keypoints(film, models_, options);
        if (!found) {
            return fail(Error(std::move(found.error())).in("camera " + film.camera));
        }
        if (!found->warning.empty()) {
            tell(found->warning);
        }
        if (auto written = keep_keypoints(plan_, found->seen); !written) {
            return fail(std::move(written.error()));
        }
        show(index, 1.0);
        tell(fmt::format(
            "camera {}: {} pictures searched", film.camera, found->seen.pictures.size()));
        return std::move(found->seen);
    }

    void show(std::size_t index, double share) {
        const std::lock_guard lock(mutex_);
        done_[index] = std::min(share, 1.0);
        double sum = 0.0;
        for (const double one : done_) {
            sum += one;
        }
        progress_.show(sum / static_cast<double>(done_.size()));
    }
    void tell(const std::string& line) {
        const std::lock_guard lock(mutex_);
        say(line);
    }

    const CapturePlan& plan_;
    std::vector<CameraFilm> films_;
    capture::PoseModels models_;
    std::mutex mutex_;  // of what follows
    std::vector<double> done_;
    ProgressLine progress_{"finding joints"};
};

// Says what the cameras see. Errors: fewer than one (of one camera), or two, see a whole body.
ExitCode judge(const std::vector<capture::KeypointFilm>& seen) {
    std::size_t usable = 0;
    std::string unusable;
    for (const capture::KeypointFilm& film : seen) {
        const capture::KeypointShares shares = capture::keypoint_shares(film);
        const std::string why = capture::why_no_dance(shares);
        if (!why.empty()) {
            say(fmt::format("camera {}: {}", film.camera, why));
            unusable += (unusable.empty() ? "" : ", ") + film.camera;
            continue;
        }
        ++usable;
        for (const std::string& doubt : capture::keypoint_doubts(shares)) {
            say(fmt::format("camera {}: {}", film.camera, doubt));
        }
        if (const std::string moved = capture::why_not_still(film); !moved.empty()) {
            say(fmt::format("camera {} {}", film.camera, moved));
        }
    }
    const std::size_t needed = std::min<std::size_t>(seen.size(), 2);
    if (usable < needed) {
        return fail(fmt::format("a dance can be got from {} of {} films; {}",
                                usable,
                                seen.size(),
                                needed == 1 ? "film the whole body" : "two are needed"));
    }
    if (usable < seen.size()) {
        say(fmt::format("to go on without {}, take it out of capture.toml", unusable));
        return kExitPartly;
    }
    return kExitDone;
}

}  // namespace

ExitCode judge_kept_keypoints(const std::string& folder) {
    const auto plan = load_capture_plan(folder);
    const auto seen = plan ? load_keypoints(*plan) : fail(plan.error());
    return seen ? judge(*seen) : fail(seen.error());
}

ExitCode keypoints(const KeypointArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (plan && !arguments.taken.from.empty()) {
        const auto taken = take_keypoints(*plan, arguments.taken);
        return taken ? judge(*taken) : fail(taken.error());
    }
    auto films = plan ? films_with_dancer(*plan) : fail(plan.error());
    const auto network = films ? choose_network(arguments) : fail(films.error());
    const auto detector = network ? shipped_network("detector") : fail(network.error());
    auto models =
        detector ? capture::load_pose_models(*detector, network->file) : fail(detector.error());
    if (!models) {
        return fail(std::move(models.error()));
    }
    if (network->is_other) {
        say("the network lite is not installed: the preview takes full");
    }
    models->name += arguments.is_preview ? kPreviewMark : "";
    const int threads = arguments.threads > 0
                            ? arguments.threads
                            : static_cast<int>(std::thread::hardware_concurrency());
    KeypointRun run(*plan, std::move(*films), std::move(*models));
    const auto seen = run.run(arguments.is_preview ? kPreviewEvery : 1, threads);
    if (stop_signal()) {
        return exit_code_after_signals(kExitPartly);
    }
    return seen ? judge(*seen) : fail(seen.error());
}

}  // namespace raks::apps
