#include "apps/raks_capture/filmed_boards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/films/film_reader.hpp"
#include "engine/films/numbered_pictures.hpp"
#include "motion/capture/calibration/board_detection.hpp"
#include "motion/capture/calibration/lying_board.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

// The luma of ITU-R BT.601, as OpenCV takes it.
std::vector<std::uint8_t> grey_of(const engine::FilmPicture& picture) {
    std::vector<std::uint8_t> grey;
    grey.reserve(picture.rgb.size() / 3);
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
        const unsigned luma =
            299U * picture.rgb[i] + 587U * picture.rgb[i + 1] + 114U * picture.rgb[i + 2];
        grey.push_back(static_cast<std::uint8_t>((luma + 500U) / 1000U));
    }
    return grey;
}

// Which pictures of one film, or between which, are looked at as which moments.
class Steps {
 public:
    Steps(const engine::FilmInfo& info,
          const std::filesystem::path& path,
          const capture::Clock& clock,
          double every) {
        constexpr double kUsualRate = 30.0;
        const double rate = info.pictures_per_second > 0.0 ? info.pictures_per_second : kUsualRate;
        const auto pictures = engine::list_numbered_pictures(path);
        if (info.format == "pictures" && pictures) {
            // Every picture was chosen by hand; its moment is its number, whatever the first one
            // is.
            every_ = 1.0 / kUsualRate;
            clock_.offset = static_cast<double>(pictures->front().number) * every_;
            near_ = 0.5 * every_;
            return;
        }
        every_ = every;
        clock_ = clock;
        longest_gap_ = 2.5 / rate;
    }

    // A moment, and how far it lies on the way from a picture to the next, (0, 1].
    struct Step {
        std::size_t moment = 0;
        double share = 1.0;
    };

    // The step that lies behind the picture before and not behind this one. None: neither is
    // looked at.
    std::optional<Step> step_at(double seconds) {
        const double time = clock_.capture_time(seconds);
        const std::optional<double> before = std::exchange(before_, time);
        const double step = std::floor((time + near_) / every_);
        const double moment = step * every_;
        if (step < 0.0 || (last_ && *last_ >= static_cast<std::size_t>(step))) {
            return std::nullopt;
        }
        if (time - moment <= near_) {
            last_ = static_cast<std::size_t>(step);
            return Step{*last_, 1.0};
        }
        if (!before || moment < *before || time - *before > longest_gap_) {
            return std::nullopt;
        }
        last_ = static_cast<std::size_t>(step);
        return Step{*last_, (moment - *before) / (time - *before)};
    }

 private:
    double every_ = 0.5;
    double near_ = 1e-3;         // a picture within this is of the moment itself; seconds
    double longest_gap_ = 0.25;  // between pictures of which one knows what was between; seconds
    capture::Clock clock_;
    std::optional<double> before_;
    std::optional<std::size_t> last_;
};

// What is between two pictures of a board.
struct BetweenPictures {
    std::vector<capture::BoardCorner> corners;  // at the moment, of those that both show
    bool is_still_enough = true;                // else nobody knows where it was at the moment
};

BetweenPictures between(const std::vector<capture::BoardCorner>& before,
                        const std::vector<capture::BoardCorner>& after,
                        double share,
                        int width) {
    const double farthest = width / 150.0;  // pixels
    BetweenPictures result;
    double way = 0.0;
    for (const capture::BoardCorner& corner : after) {
        const auto same = std::find_if(before.begin(), before.end(), [&](const auto& other) {
            return other.corner == corner.corner;
        });
        if (same != before.end()) {
            const glm::dvec2 shift = corner.pixel - same->pixel;
            way += glm::length(shift);
            result.corners.push_back({corner.corner, same->pixel + share * shift});
        }
    }
    result.is_still_enough = way <= farthest * static_cast<double>(result.corners.size());
    return result;
}

// Markers that make another board: by chance a picture of a room, or of a board seen from the edge,
// has one of a thousand or two.
constexpr std::size_t kForeignBoard = 3;

// What was seen in one film.
struct Look {
    std::size_t pictures = 0;  // moments that were looked at
    std::size_t found = 0;
    std::size_t moving = 0;          // moments at which the board was carried too quickly
    std::size_t foreign = 0;         // pictures with markers of another board
    std::vector<std::uint8_t> last;  // picture that was looked at
};

// Why a camera never saw the board.
std::string why_unseen(const PlannedCamera& camera,
                       const capture::Board& board,
                       const engine::FilmInfo& info,
                       const Look& look) {
    const std::string head = fmt::format("camera \"{}\": {} shows no board in {} pictures",
                                         camera.name,
                                         camera.calibration.string(),
                                         look.pictures);
    if (look.moving > 0) {
        return fmt::format("{}, but in {} one that moves: hold it still for a second at each place",
                           head,
                           look.moving);
    }
    const std::string_view guess = capture::guess_dictionary({info.width, info.height, look.last});
    return guess.empty() || guess == board.dictionary
               ? head + ": is it the board that capture.toml says, large and sharp enough?"
               : fmt::format("{}, but markers of {}: is that its dictionary?", head, guess);
}

// Markers that the board does not have: it is another board, or a doubt.
Expected<void> check_board_is_planned(const capture::Board& board,
                                      const PlannedCamera& camera,
                                      const Look& look,
                                      std::vector<std::string>& warnings) {
    if (2 * look.foreign <= std::max<std::size_t>(look.found, 1)) {
        return {};
    }
    std::string doubt = fmt::format(
        "camera \"{}\": {} shows markers of {} that a board of {} x {} does not have, "
        "in {} of {} pictures: are columns and rows right?",
        camera.name,
        camera.calibration.string(),
        board.dictionary,
        board.columns,
        board.rows,
        look.foreign,
        look.pictures);
    if (look.found == 0) {
        return fail(std::move(doubt));
    }
    warnings.push_back(std::move(doubt));
    return {};
}

// The board at a moment that lies at a picture or between it and the one before.
std::vector<capture::BoardCorner> board_at(double share,
                                           const std::optional<engine::FilmPicture>& before,
                                           const engine::FilmPicture& after,
                                           const capture::Board& board,
                                           bool is_on_floor,
                                           Look& look) {
    const auto find = [&](const engine::FilmPicture& picture) {
        look.last = grey_of(picture);
        const capture::GreyPicture grey{picture.width, picture.height, look.last};
        capture::BoardView view =
            is_on_floor ? capture::find_lying_board(grey, board) : capture::BoardView();
        if (!view.is_found()) {
            view = capture::find_board(grey, board);
        }
        look.foreign += view.foreign_markers >= kForeignBoard ? 1U : 0U;
        return view.corners.size() >= capture::kFewestBoardCorners
                   ? std::move(view.corners)
                   : std::vector<capture::BoardCorner>();
    };
    ++look.pictures;
    std::vector<capture::BoardCorner> corners = find(after);
    if (share < 1.0 && before && !corners.empty()) {
        BetweenPictures both = between(find(*before), corners, share, after.width);
        look.moving += both.is_still_enough ? 0U : 1U;
        corners = both.is_still_enough && both.corners.size() >= capture::kFewestBoardCorners
                      ? std::move(both.corners)
                      : std::vector<capture::BoardCorner>();
    }
    look.found += corners.empty() ? 0U : 1U;
    return corners;
}

Expected<capture::Clock> clock_of(const PlannedCamera& camera, const BoardSearch& search) {
    if (search.clocks.empty()) {
        return capture::Clock{camera.name, 0.0, 0.0, 1.0};
    }
    const auto found =
        std::find_if(search.clocks.begin(), search.clocks.end(), [&](const capture::Clock& clock) {
            return clock.camera == camera.name;
        });
    return found != search.clocks.end()
               ? Expected<capture::Clock>(*found)
               : fail(fmt::format("camera \"{}\": the clocks of the calibration films say nothing "
                                  "of it; set it by hand: raks capture sync --boards --offsets",
                                  camera.name));
}

Expected<void> look_at(const CapturePlan& plan,
                       std::size_t index,
                       const BoardSearch& search,
                       FilmedBoards& boards) {
    const PlannedCamera& camera = plan.cameras[index];
    if (camera.calibration.empty()) {
        return fail(fmt::format(
            "camera \"{}\" has no calibration film: name it in capture.toml, calibration = \"...\"",
            camera.name));
    }
    const auto clock = clock_of(camera, search);
    auto film = engine::FilmReader::open(plan.file(camera.calibration),
                                         {.is_stop_requested = search.is_stop_requested});
    if (!clock || !film) {
        return fail(clock ? std::move(film.error()) : clock.error());
    }
    const engine::FilmInfo& info = (*film)->info();
    boards.cameras.push_back({camera.name, info.width, info.height, {}});
    Steps steps(info, plan.file(camera.calibration), *clock, search.every);
    Look look;
    std::optional<engine::FilmPicture> before;
    while (true) {
        auto picture = (*film)->next();
        if (!picture) {
            return fail(picture.error());
        }
        if (!*picture) {
            break;
        }
        if (const auto step = steps.step_at((*picture)->seconds)) {
            auto corners = board_at(step->share,
                                    before,
                                    **picture,
                                    plan.board,
                                    step->moment == search.floor_moment,
                                    look);
            if (!corners.empty()) {
                boards.sightings.push_back({index, step->moment, std::move(corners)});
            }
            const double share =
                std::min(1.0, (*picture)->seconds / info.claimed_seconds.value_or(60.0));
            search.on_progress((static_cast<double>(index) + share) /
                               static_cast<double>(plan.cameras.size()));
        }
        before = std::move(*picture);
    }
    boards.pictures.push_back(look.pictures);
    if (!(*film)->warning().empty()) {
        boards.warnings.push_back((*film)->warning());
    }
    if (auto checked = check_board_is_planned(plan.board, camera, look, boards.warnings);
        !checked) {
        return checked;
    }
    if (look.found == 0) {
        return fail(why_unseen(camera, plan.board, info, look));
    }
    search.on_camera(camera.name, look.found);
    return {};
}

}  // namespace

Expected<FilmedBoards> find_filmed_boards(const CapturePlan& plan, const BoardSearch& search) {
    FilmedBoards boards;
    for (std::size_t i = 0; i < plan.cameras.size(); ++i) {
        if (auto looked = look_at(plan, i, search, boards); !looked) {
            return fail(std::move(looked.error()));
        }
    }
    return boards;
}

}  // namespace raks::apps
