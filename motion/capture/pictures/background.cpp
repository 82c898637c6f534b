#include "motion/capture/pictures/background.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using Grey = BackgroundFollower::Grey;
using Pyramid = BackgroundFollower::Pyramid;

constexpr int kSmallWidth = 320;   // about; of the longer side
constexpr int kRadius = 4;         // of a piece, small pixels
constexpr int kPieceColumns = 10;  // cells of the picture, each of which may give a piece
constexpr int kPieceRows = 8;
constexpr int kLooked = 3;             // every so many pixels a corner is looked for
constexpr float kLeastCorner = 20.0F;  // grey levels squared: mean over a piece, weaker direction
constexpr int kSteps = 8;              // of Gauss and Newton at each level
constexpr double kLeastStep = 0.02;    // small pixels
constexpr float kLeastLikeness = 0.8F;
constexpr double kAgreed = 0.6;  // small pixels between a piece and the common move
constexpr std::size_t kFewestAgreed = 8;
constexpr double kMostlyAgreed = 0.5;  // of the pieces that were found again
constexpr double kLeastSpread = 0.25;  // of the picture's width or height that they cover

double square_of(const glm::dvec2& v) { return glm::dot(v, v); }

Grey small_grey(const PictureView& picture, int shrink) {
    Grey grey{picture.width / shrink, picture.height / shrink, {}};
    grey.values.reserve(static_cast<std::size_t>(grey.width) *
                        static_cast<std::size_t>(grey.height));
    const auto share = 1.0F / (3.0F * static_cast<float>(shrink * shrink));
    for (int y = 0; y < grey.height; ++y) {
        for (int x = 0; x < grey.width; ++x) {
            int sum = 0;
            for (int row = 0; row < shrink; ++row) {
                const std::uint8_t* const pixels = picture.at(x * shrink, y * shrink + row);
                for (int i = 0; i < 3 * shrink; ++i) {
                    sum += pixels[i];
                }
            }
            grey.values.push_back(share * static_cast<float>(sum));
        }
    }
    return grey;
}

Grey half_of(const Grey& grey) {
    Grey half{grey.width / 2, grey.height / 2, {}};
    half.values.reserve(grey.values.size() / 4);
    const auto width = static_cast<std::size_t>(grey.width);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const float* const at = grey.values.data() + 2 * static_cast<std::size_t>(y) * width +
                                    2 * static_cast<std::size_t>(x);
            half.values.push_back(0.25F * (at[0] + at[1] + at[width] + at[width + 1]));
        }
    }
    return half;
}

Pyramid pyramid_of(const PictureView& picture, int shrink) {
    Pyramid levels;
    levels[0] = small_grey(picture, shrink);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        levels[i] = half_of(levels[i - 1]);
    }
    return levels;
}

// A piece and its slopes lie in the picture.
bool holds_piece(const Grey& grey, const glm::dvec2& middle) {
    constexpr double kMargin = kRadius + 2.0;
    return middle.x >= kMargin && middle.y >= kMargin && middle.x < grey.width - kMargin &&
           middle.y < grey.height - kMargin;
}

/// What a piece looks like, and how that changes with its place.
struct PieceModel {
    static constexpr std::size_t kSide = 2 * kRadius + 1;
    static constexpr std::size_t kPixels = kSide * kSide;
    std::array<float, kPixels> values{};  // without their mean
    std::array<float, kPixels> slope_x{};
    std::array<float, kPixels> slope_y{};
    float xx = 0.0F;  // sums of products of slopes
    float xy = 0.0F;
    float yy = 0.0F;

    // The mean square of the slopes in the direction in which they are least.
    [[nodiscard]] float corner() const {
        const float half = 0.5F * (xx + yy);
        const float apart = std::hypot(0.5F * (xx - yy), xy);
        return (half - apart) / static_cast<float>(kPixels);
    }
};

template <typename See>
void for_each_pixel(const glm::dvec2& middle, const See& see) {
    std::size_t i = 0;
    for (int y = -kRadius; y <= kRadius; ++y) {
        for (int x = -kRadius; x <= kRadius; ++x) {
            see(i++, middle.x + x, middle.y + y);
        }
    }
}

void take_mean_away(std::array<float, PieceModel::kPixels>& values) {
    float sum = 0.0F;
    for (const float value : values) {
        sum += value;
    }
    for (float& value : values) {
        value -= sum / static_cast<float>(values.size());
    }
}

std::array<float, PieceModel::kPixels> pixels_of(const Grey& grey, const glm::dvec2& middle) {
    std::array<float, PieceModel::kPixels> values{};
    for_each_pixel(middle, [&](std::size_t i, double x, double y) { values[i] = grey.at(x, y); });
    take_mean_away(values);
    return values;
}

PieceModel model_of(const Grey& grey, const glm::dvec2& middle) {
    PieceModel piece;
    piece.values = pixels_of(grey, middle);
    for_each_pixel(middle, [&](std::size_t i, double x, double y) {
        piece.slope_x[i] = 0.5F * (grey.at(x + 1.0, y) - grey.at(x - 1.0, y));
        piece.slope_y[i] = 0.5F * (grey.at(x, y + 1.0) - grey.at(x, y - 1.0));
        piece.xx += piece.slope_x[i] * piece.slope_x[i];
        piece.xy += piece.slope_x[i] * piece.slope_y[i];
        piece.yy += piece.slope_y[i] * piece.slope_y[i];
    });
    return piece;
}

// Correlation of what is seen with the piece; [-1, 1].
float likeness_of(const PieceModel& piece, const std::array<float, PieceModel::kPixels>& seen) {
    float product = 0.0F;
    float own = 1e-6F;
    float other = 1e-6F;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        product += piece.values[i] * seen[i];
        own += piece.values[i] * piece.values[i];
        other += seen[i] * seen[i];
    }
    return product / std::sqrt(own * other);
}

// The piece of the first picture at `middle` in another one, from a first guess on; nothing: it
// leaves the picture, or has no corner at this level.
std::optional<glm::dvec2> follow_piece(const Grey& first,
                                       const Grey& now,
                                       const glm::dvec2& middle,
                                       glm::dvec2 place) {
    if (!holds_piece(first, middle)) {
        return std::nullopt;
    }
    const PieceModel piece = model_of(first, middle);
    const float determinant = piece.xx * piece.yy - piece.xy * piece.xy;
    if (piece.corner() < 0.1F * kLeastCorner || determinant <= 0.0F) {
        return std::nullopt;
    }
    for (int step = 0; step < kSteps; ++step) {
        if (!holds_piece(now, place)) {
            return std::nullopt;
        }
        const auto seen = pixels_of(now, place);
        float x = 0.0F;
        float y = 0.0F;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const float error = piece.values[i] - seen[i];
            x += error * piece.slope_x[i];
            y += error * piece.slope_y[i];
        }
        const glm::dvec2 by(static_cast<double>((piece.yy * x - piece.xy * y) / determinant),
                            static_cast<double>((piece.xx * y - piece.xy * x) / determinant));
        place += by;
        if (square_of(by) < kLeastStep * kLeastStep) {
            break;
        }
    }
    return holds_piece(now, place) ? std::optional(place) : std::nullopt;
}

// Down the pyramid; levels at which the piece is too near the edge are left out.
std::optional<glm::dvec2> find_piece(const Pyramid& first,
                                     const Pyramid& now,
                                     const glm::dvec2& middle,
                                     glm::dvec2 place) {
    for (std::size_t level = first.size(); level-- > 0;) {
        const double scale = 1.0 / static_cast<double>(1U << level);
        // The middle of the first pixel lies at 0, so that halves begin half a pixel later.
        const auto down = [scale](const glm::dvec2& at) { return (at + 0.5) * scale - 0.5; };
        const auto found = follow_piece(first[level], now[level], down(middle), down(place));
        if (found) {
            place = (*found + 0.5) / scale - 0.5;
        } else if (level == 0) {
            return std::nullopt;
        }
    }
    const bool is_alike =
        likeness_of(model_of(first[0], middle), pixels_of(now[0], place)) >= kLeastLikeness;
    return is_alike ? std::optional(place) : std::nullopt;
}

/// A piece, from the middle of the picture, and where it is now.
struct FoundPiece {
    glm::dvec2 first;
    glm::dvec2 now;
};

/// A turn, growth and move of the whole: now = (x a - y b, x b + y a) + move.
struct CommonMove {
    double a = 1.0;
    double b = 0.0;
    glm::dvec2 move{};

    [[nodiscard]] glm::dvec2 of(const glm::dvec2& at) const {
        return glm::dvec2(a * at.x - b * at.y, b * at.x + a * at.y) + move;
    }
};

// The one that fits pieces best, by least squares (Umeyama 1991). Precondition: two or more.
CommonMove common_move(const std::vector<FoundPiece>& pieces) {
    const auto count = static_cast<double>(pieces.size());
    glm::dvec2 first{};
    glm::dvec2 now{};
    for (const FoundPiece& piece : pieces) {
        first += piece.first / count;
        now += piece.now / count;
    }
    double along = 0.0;
    double across = 0.0;
    double square = 1e-9;
    for (const FoundPiece& piece : pieces) {
        const glm::dvec2 from = piece.first - first;
        const glm::dvec2 to = piece.now - now;
        along += glm::dot(from, to);
        across += from.x * to.y - from.y * to.x;
        square += square_of(from);
    }
    CommonMove found{along / square, across / square, {}};
    found.move = now - found.of(first);
    return found;
}

std::vector<FoundPiece> agreeing(const std::vector<FoundPiece>& pieces, const CommonMove& move) {
    std::vector<FoundPiece> agreed;
    std::copy_if(
        pieces.begin(), pieces.end(), std::back_inserter(agreed), [&](const FoundPiece& piece) {
            return square_of(move.of(piece.first) - piece.now) < kAgreed * kAgreed;
        });
    return agreed;
}

// Those that agree with the move of two of them, whichever two most agree with.
std::vector<FoundPiece> most_agreeing(const std::vector<FoundPiece>& pieces) {
    constexpr double kFarApart = 30.0;  // small pixels: of two that tell a size
    std::vector<FoundPiece> best;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t k = i + 1; k < pieces.size(); ++k) {
            if (square_of(pieces[i].first - pieces[k].first) < kFarApart * kFarApart) {
                continue;
            }
            auto agreed = agreeing(pieces, common_move({pieces[i], pieces[k]}));
            if (agreed.size() > best.size()) {
                best = std::move(agreed);
            }
        }
    }
    return best;
}

// They do not lie in one corner, where a passer-by may be.
bool are_spread(const std::vector<FoundPiece>& pieces, const Grey& picture) {
    glm::dvec2 least(1e9);
    glm::dvec2 greatest(-1e9);
    for (const FoundPiece& piece : pieces) {
        least = glm::min(least, piece.first);
        greatest = glm::max(greatest, piece.first);
    }
    return greatest.x - least.x >= kLeastSpread * picture.width &&
           greatest.y - least.y >= kLeastSpread * picture.height;
}

}  // namespace

float BackgroundFollower::Grey::at(double x, double y) const noexcept {
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    const auto right = static_cast<float>(x - static_cast<double>(column));
    const auto down = static_cast<float>(y - static_cast<double>(row));
    const auto stride = static_cast<std::size_t>(width);
    const float* const pixel = values.data() + row * stride + column;
    const float above = pixel[0] + right * (pixel[1] - pixel[0]);
    const float below = pixel[stride] + right * (pixel[stride + 1] - pixel[stride]);
    return above + down * (below - above);
}

// The clearest corner of each cell.
void BackgroundFollower::choose_pieces(const std::optional<PictureBounds>& dancer) {
    const Grey& grey = first_[0];
    const auto is_dancer = [&](const glm::dvec2& at) {
        const glm::dvec2 pixel = at * static_cast<double>(shrink_);
        return dancer && pixel.x >= dancer->least.x && pixel.y >= dancer->least.y &&
               pixel.x <= dancer->greatest.x && pixel.y <= dancer->greatest.y;
    };
    for (int cell = 0; cell < kPieceColumns * kPieceRows; ++cell) {
        const int column = cell % kPieceColumns;
        const int row = cell / kPieceColumns;
        float clearest = kLeastCorner;
        std::optional<glm::dvec2> found;
        for (int y = row * grey.height / kPieceRows; y < (row + 1) * grey.height / kPieceRows;
             y += kLooked) {
            for (int x = column * grey.width / kPieceColumns;
                 x < (column + 1) * grey.width / kPieceColumns;
                 x += kLooked) {
                const glm::dvec2 middle(x, y);
                if (!holds_piece(grey, middle) || is_dancer(middle)) {
                    continue;
                }
                const float corner = model_of(grey, middle).corner();
                if (corner > clearest) {
                    clearest = corner;
                    found = middle;
                }
            }
        }
        if (found) {
            pieces_.push_back(*found);
        }
    }
}

std::optional<BackgroundPlace> BackgroundFollower::look(
    const PictureView& picture, const std::optional<PictureBounds>& dancer) {
    const bool is_first = first_[0].values.empty();
    if (is_first) {
        shrink_ = std::max(1, std::max(picture.width, picture.height) / kSmallWidth);
        first_ = pyramid_of(picture, shrink_);
        choose_pieces(dancer);
        if (pieces_.size() < kFewestAgreed) {
            first_ = {};  // a later picture may show more
            pieces_.clear();
            return std::nullopt;
        }
        return BackgroundPlace{};
    }
    const Pyramid now = pyramid_of(picture, shrink_);
    const glm::dvec2 centre = 0.5 * glm::dvec2(first_[0].width - 1, first_[0].height - 1);
    std::vector<FoundPiece> found;
    for (const glm::dvec2& piece : pieces_) {
        const glm::dvec2 from = piece - centre;
        const glm::dvec2 guess = centre + last_.size * from + last_.move;
        if (const auto place = find_piece(first_, now, piece, guess)) {
            found.push_back({from, *place - centre});
        }
    }
    std::vector<FoundPiece> agreed = most_agreeing(found);
    if (agreed.size() < kFewestAgreed || !are_spread(agreed, first_[0]) ||
        static_cast<double>(agreed.size()) < kMostlyAgreed * static_cast<double>(found.size())) {
        return std::nullopt;
    }
    agreed = agreeing(found, common_move(agreed));
    const CommonMove move = common_move(agreed);
    last_ = {move.move, std::hypot(move.a, move.b)};
    return BackgroundPlace{last_.move * static_cast<double>(shrink_), last_.size};
}

}  // namespace raks::capture
