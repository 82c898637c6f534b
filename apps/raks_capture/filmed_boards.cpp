#include "apps/raks_capture/filmed_boards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/films/film_reader.hpp"
#include "engine/films/numbered_pictures.hpp"
#include "motion/capture/calibration/board_detection.hpp"

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

// Says which pictures of one film are looked at, and as which moments.
class Steps {
 public:
    Steps(const engine::FilmInfo& info,
          const std::filesystem::path& path,
          const std::string& name,
          const BoardSearch& search) {
        constexpr double kUsualRate = 30.0;
        const double rate = info.pictures_per_second > 0.0 ? info.pictures_per_second : kUsualRate;
        every_ = search.every;
        const auto pictures = engine::list_numbered_pictures(path);
        if (info.format == "pictures" && pictures) {
            // Every picture was chosen by hand; its moment is its number, whatever the first one
            // is.
            every_ = 1.0 / kUsualRate;
            clock_.offset = static_cast<double>(pictures->front().number) * every_;
            near_ = 0.5 * every_;
            return;
        }
        near_ = 0.5 / rate;
        for (const capture::Clock& clock : search.clocks) {
            if (clock.camera == name) {
                clock_ = clock;
            }
        }
    }

    // None: this picture is not looked at.
    std::optional<std::size_t> moment_of(double seconds) {
        const double time = clock_.capture_time(seconds);
        const double step = std::round(time / every_);
        if (step < 0.0 || std::abs(time - step * every_) > near_ * 1.001) {
            return std::nullopt;
        }
        const auto moment = static_cast<std::size_t>(step);
        if (last_ && *last_ >= moment) {
            return std::nullopt;
        }
        last_ = moment;
        return moment;
    }

 private:
    double every_ = 0.5;
    double near_ = 0.0;
    capture::Clock clock_;
    std::optional<std::size_t> last_;
};

// Why a camera never saw the board.
std::string why_unseen(const PlannedCamera& camera,
                       const capture::Board& board,
                       const capture::GreyPicture& last,
                       std::size_t pictures) {
    const std::string head = fmt::format("camera \"{}\": {} shows no board in {} pictures",
                                         camera.name,
                                         camera.calibration.string(),
                                         pictures);
    const std::string_view guess = capture::guess_dictionary(last);
    return guess.empty() || guess == board.dictionary
               ? head + ": is it the board that capture.toml says, large and sharp enough?"
               : fmt::format("{}, but markers of {}: is that its dictionary?", head, guess);
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
    auto film = engine::FilmReader::open(plan.file(camera.calibration),
                                         {.is_stop_requested = search.is_stop_requested});
    if (!film) {
        return fail(std::move(film.error()));
    }
    const engine::FilmInfo& info = (*film)->info();
    boards.cameras.push_back({camera.name, info.width, info.height, {}});
    Steps steps(info, plan.file(camera.calibration), camera.name, search);
    std::size_t pictures = 0;
    std::size_t found = 0;
    std::size_t foreign = 0;
    std::vector<std::uint8_t> grey;
    while (true) {
        const auto picture = (*film)->next();
        if (!picture) {
            return fail(picture.error());
        }
        if (!*picture) {
            break;
        }
        const auto moment = steps.moment_of((*picture)->seconds);
        if (!moment) {
            continue;
        }
        ++pictures;
        grey = grey_of(**picture);
        capture::BoardView view =
            capture::find_board({(*picture)->width, (*picture)->height, grey}, plan.board);
        foreign += view.foreign_markers > 0 ? 1U : 0U;
        if (view.corners.size() >= capture::kFewestBoardCorners) {
            ++found;
            boards.sightings.push_back({index, *moment, std::move(view.corners)});
        }
        const double share =
            std::min(1.0, (*picture)->seconds / info.claimed_seconds.value_or(60.0));
        search.on_progress((static_cast<double>(index) + share) /
                           static_cast<double>(plan.cameras.size()));
    }
    boards.pictures.push_back(pictures);
    if (!(*film)->warning().empty()) {
        boards.warnings.push_back((*film)->warning());
    }
    // By chance a picture of a room has one of a thousand markers, too.
    const bool is_other_board = 2 * foreign > std::max<std::size_t>(found, 1);
    const std::string doubt = fmt::format(
        "camera \"{}\": {} shows markers of {} that a board of {} x {} does not have, "
        "in {} of {} pictures: are columns and rows right?",
        camera.name,
        camera.calibration.string(),
        plan.board.dictionary,
        plan.board.columns,
        plan.board.rows,
        foreign,
        pictures);
    if (is_other_board && found == 0) {
        return fail(doubt);
    }
    if (is_other_board) {
        boards.warnings.push_back(doubt);
    }
    if (found == 0) {
        const capture::GreyPicture last{info.width, info.height, grey};
        return fail(why_unseen(camera, plan.board, last, pictures));
    }
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
