#include "apps/raks_capture/drawn_boards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "apps/raks_capture/carried_board.hpp"
#include "base/dice.hpp"
#include "motion/capture/calibration/board_drawing.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::apps {
namespace {

constexpr int kSquarePixels = 48;  // of the board's own picture

// Shares of the light that they reflect.
constexpr double kWhite = 0.55;
constexpr double kBlack = 0.03;
constexpr double kBack = 0.18;
constexpr double kHall = 0.16;

std::uint8_t level_of(double light) {
    return static_cast<std::uint8_t>(
        std::lround(255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / 2.2)));
}

/// How the board lies in a view.
class BoardInView {
 public:
    BoardInView(const render::PinholeView& view, const capture::RigidMotion& world_from_board)
        : view_(view) {
        const glm::dmat3 rotation = view.rotation * world_from_board.rotation;
        const glm::dvec3 translation =
            view.rotation * world_from_board.translation + view.translation;
        is_front_ = glm::dot(rotation[2], translation) > 0.0;
        const glm::dmat3 to_pixel(
            {view.fx, 0.0, 0.0}, {0.0, view.fy, 0.0}, {view.cx, view.cy, 1.0});
        pixel_from_board_ = to_pixel * glm::dmat3(rotation[0], rotation[1], translation);
        board_from_pixel_ = glm::inverse(pixel_from_board_);
    }

    [[nodiscard]] bool is_front() const noexcept { return is_front_; }

    /// Where on the board a pixel of the view looks; metres.
    [[nodiscard]] glm::dvec2 on_board(double x, double y) const noexcept {
        const glm::dvec3 place = board_from_pixel_ * glm::dvec3(x, y, 1.0);
        return {place.x / place.z, place.y / place.z};
    }

    /// The pixels around a rectangle of the board; none where it is not wholly before the camera.
    [[nodiscard]] DrawnPart around(const glm::dvec2& low, const glm::dvec2& high) const {
        constexpr double kNearest = 0.1;  // metres
        const glm::dvec2 size(view_.width, view_.height);
        glm::dvec2 first(1e9);
        glm::dvec2 last(-1e9);
        for (const glm::dvec2 corner :
             {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)}) {
            const glm::dvec3 place = pixel_from_board_ * glm::dvec3(corner, 1.0);
            if (place.z < kNearest) {
                return {};
            }
            first = glm::min(first, glm::dvec2(place) / place.z);
            last = glm::max(last, glm::dvec2(place) / place.z);
        }
        first = glm::clamp(glm::floor(first), glm::dvec2(0.0), size);
        last = glm::clamp(glm::ceil(last) + 1.0, first, size);
        return {static_cast<int>(first.x),
                static_cast<int>(first.y),
                static_cast<int>(last.x - first.x),
                static_cast<int>(last.y - first.y)};
    }

 private:
    const render::PinholeView& view_;
    bool is_front_ = true;
    glm::dmat3 pixel_from_board_{1.0};
    glm::dmat3 board_from_pixel_{1.0};
};

/// A board that is carried about in a grey hall.
class DrawnBoard : public DrawnEvent {
 public:
    DrawnBoard(const CarriedBoard& way, const capture::Board& board, capture::BoardPicture picture)
        : way_(way), square_(board.square), picture_(std::move(picture)) {
        const double pixel = square_ / kSquarePixels;
        low_ = glm::dvec2(-picture_.margin * pixel);
        high_ = low_ + pixel * glm::dvec2(picture_.width, picture_.height);
        for (std::size_t i = 0; i < levels_.size(); ++i) {
            levels_[i] = level_of(static_cast<double>(i) / static_cast<double>(levels_.size() - 1));
        }
    }

    [[nodiscard]] Expected<std::span<const std::uint8_t>> aim(
        const render::PinholeView& view) override;
    [[nodiscard]] Expected<EventPicture> draw(double capture_time) override;

 private:
    [[nodiscard]] std::optional<double> light_of(const BoardInView& seen, double x, double y) const;
    void paint(const BoardInView& seen, int x, int y);
    void clear(const DrawnPart& part);

    const CarriedBoard& way_;
    double square_;
    capture::BoardPicture picture_;
    glm::dvec2 low_{};  // the printed sheet, on the board; metres
    glm::dvec2 high_{};
    std::array<std::uint8_t, 1024> levels_{};  // of light
    render::PinholeView view_;
    std::vector<std::uint8_t> empty_;
    std::vector<std::uint8_t> rgba_;
    DrawnPart last_;
    std::optional<capture::RigidMotion> shown_;  // where the board is in rgba_
};

// A wall that grows lighter towards the floor.
Expected<std::span<const std::uint8_t>> DrawnBoard::aim(const render::PinholeView& view) {
    view_ = view;
    empty_.clear();
    for (int y = 0; y < static_cast<int>(view.height); ++y) {
        const std::uint8_t level = level_of(kHall * (0.8 + 0.4 * y / view.height));
        for (int x = 0; x < static_cast<int>(view.width); ++x) {
            empty_.insert(empty_.end(), {level, level, level, 255});
        }
    }
    rgba_ = empty_;
    last_ = {};
    shown_.reset();
    return std::span<const std::uint8_t>(empty_);
}

std::optional<double> DrawnBoard::light_of(const BoardInView& seen, double x, double y) const {
    const glm::dvec2 place = seen.on_board(x, y);
    if (place.x < low_.x || place.y < low_.y || place.x >= high_.x || place.y >= high_.y) {
        return std::nullopt;
    }
    if (!seen.is_front()) {
        return kBack;
    }
    const glm::dvec2 at = (place - low_) * (kSquarePixels / square_);
    const auto column = std::min(static_cast<int>(at.x), picture_.width - 1);
    const auto row = std::min(static_cast<int>(at.y), picture_.height - 1);
    const std::uint8_t ink =
        picture_.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.width) +
                        static_cast<std::size_t>(column)];
    return kBlack + (kWhite - kBlack) * ink / 255.0;
}

// Four points of a pixel.
void DrawnBoard::paint(const BoardInView& seen, int x, int y) {
    const auto pixel = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) +
                            static_cast<std::size_t>(x));
    const double hall = std::pow(empty_[pixel] / 255.0, 2.2);
    double light = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double right = i % 2 == 0 ? -0.25 : 0.25;
        const double down = i / 2 == 0 ? -0.25 : 0.25;
        light += 0.25 * light_of(seen, x + right, y + down).value_or(hall);
    }
    const auto step = static_cast<std::size_t>(light * static_cast<double>(levels_.size() - 1));
    std::fill_n(rgba_.begin() + static_cast<std::ptrdiff_t>(pixel), 3, levels_[step]);
}

void DrawnBoard::clear(const DrawnPart& part) {
    for (int row = part.y; row < part.y + part.height; ++row) {
        const auto first =
            4 *
            (static_cast<std::ptrdiff_t>(row) * static_cast<std::ptrdiff_t>(view_.width) + part.x);
        std::copy_n(empty_.begin() + first, 4 * part.width, rgba_.begin() + first);
    }
}

Expected<EventPicture> DrawnBoard::draw(double capture_time) {
    const capture::RigidMotion place = way_.place_at(capture_time);
    if (shown_ && shown_->rotation == place.rotation && shown_->translation == place.translation) {
        return EventPicture{rgba_, last_};  // held still
    }
    shown_ = place;
    const BoardInView seen(view_, place);
    clear(last_);
    last_ = seen.around(low_, high_);
    for (int y = last_.y; y < last_.y + last_.height; ++y) {
        for (int x = last_.x; x < last_.x + last_.width; ++x) {
            paint(seen, x, y);
        }
    }
    return EventPicture{rgba_, last_};
}

// People who talk and clap: noise in syllables of any length and loudness, which nothing repeats.
std::vector<float> voices(double seconds, std::uint64_t seed) {
    constexpr int kRate = 48'000;
    Dice dice(seed, 501);
    std::vector<float> sound;
    const auto count = static_cast<std::size_t>(seconds * kRate);
    while (sound.size() < count) {
        const bool is_clap = dice.chance(0.1);
        const double length = is_clap ? 0.02 : dice.log_uniform(0.05, 0.4);
        const double loudness = is_clap ? 0.5 : dice.log_uniform(0.005, 0.15);
        const double smooth = is_clap ? 0.0 : dice.uniform(0.3, 0.9);
        double last = 0.0;
        for (int i = 0; i < static_cast<int>(length * kRate); ++i) {
            last = smooth * last + (1.0 - smooth) * dice.normal(loudness);
            sound.push_back(static_cast<float>(last));
        }
    }
    return sound;
}

}  // namespace

Expected<BoardFilms> draw_board_films(const capture::Rig& rig,
                                      const capture::Board& board,
                                      std::span<const capture::Clock> clocks,
                                      const std::filesystem::path& folder,
                                      const DrawnFilmOptions& options) {
    auto picture = capture::draw_board(board, kSquarePixels);
    if (!picture) {
        return fail(std::move(picture.error()));
    }
    const CarriedBoard way(rig, board, options.seed);
    DrawnBoard event(way, board, std::move(*picture));
    const std::vector<float> sound = voices(way.seconds() + 1.0, options.seed);
    DrawnFilmOptions filmed = options;
    filmed.music = sound;
    const auto pictures =
        static_cast<std::size_t>(std::floor(way.seconds() * options.frames_per_second));
    BoardFilms films{{}, way.floor_time()};
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        const capture::Camera& camera = rig.cameras[i];
        films.films.push_back(folder / (camera.name + "_board" + options.ending));
        if (auto written =
                film_event(event, {camera, clocks[i], i, pictures}, films.films.back(), filmed);
            !written) {
            return fail(std::move(written.error()));
        }
    }
    return films;
}

}  // namespace raks::apps
