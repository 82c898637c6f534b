#include "motion/capture/pictures/marker_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "motion/capture/pictures/waist.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kMostModels = 64;
constexpr int kLevelBits = 2;  // grey levels that a cell of the RGB cube spans in each channel
constexpr int kCellBits = 8 - kLevelBits;
constexpr int kCells = 1 << kCellBits;
constexpr double kMostWandering = 0.2;  // standard deviations, of a mean before cells are told anew
constexpr double kLeastWeight = 0.2;    // of a pixel at the gate
constexpr std::uint8_t kMayBe = 128;    // of a mark, beside the colour
constexpr double kDarkestShade = 8.0;   // luma of a pixel that may have a colour
constexpr double kSensorNoise = 1.5;    // grey levels of Cr and Cb, sd

// The variance that the sensor's noise gives the normalised chroma of a pixel of this luma.
double noise2_of(double luma, ChromaForm form) noexcept {
    const double scale = form == ChromaForm::crcb ? 0.0 : 100.0 / (luma + 8.0);
    return kSensorNoise * kSensorNoise * scale * scale;
}

// Whether what is burnt out has the hue of a colour: it is paler, white at last.
bool has_hue(const glm::dvec2& chroma, const ColourModel& model) noexcept {
    constexpr double kPalestHue = 0.3;
    constexpr double kSameHue = 0.95;
    const double length = glm::length(chroma);
    const double full = glm::length(model.mean);
    return length > kPalestHue * full && length < 1.2 * full &&
           glm::dot(chroma, model.mean) > kSameHue * length * full;
}

// The cell of the RGB cube that a pixel lies in.
std::size_t cell_of(const std::uint8_t* rgb) noexcept {
    const unsigned red = rgb[0] >> kLevelBits;
    const unsigned green = rgb[1] >> kLevelBits;
    const unsigned blue = rgb[2] >> kLevelBits;
    return (red << (2 * kCellBits)) + (green << kCellBits) + blue;
}

std::size_t pixel_index(const PictureView& picture, int x, int y) noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
           static_cast<std::size_t>(x);
}

SearchWindow within(const PictureView& picture, const SearchWindow& window) {
    return {
        {std::max(window.low.x, 0), std::max(window.low.y, 0)},
        {std::min(window.high.x, picture.width - 1), std::min(window.high.y, picture.height - 1)}};
}

// Adds the pixels that have some of the spot on both sides and above and below: highlights are
// burnt out and tell no colour.
void fill_holes(std::vector<glm::ivec2>& pixels, const glm::ivec2& low, const glm::ivec2& high) {
    const int width = high.x - low.x + 1;
    const int height = high.y - low.y + 1;
    const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (cells > 4 * pixels.size() + 64) {
        return;  // no disc
    }
    constexpr int kNone = 1 << 30;
    struct Reach {
        int low = kNone;
        int high = -kNone;
        void add(int at) {
            low = std::min(low, at);
            high = std::max(high, at);
        }
    };
    std::vector<Reach> rows(static_cast<std::size_t>(height));
    std::vector<Reach> columns(static_cast<std::size_t>(width));
    std::vector<std::uint8_t> is_in(cells);
    const auto cell = [&](int x, int y) {
        return static_cast<std::size_t>(y - low.y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x - low.x);
    };
    for (const glm::ivec2& pixel : pixels) {
        rows[static_cast<std::size_t>(pixel.y - low.y)].add(pixel.x);
        columns[static_cast<std::size_t>(pixel.x - low.x)].add(pixel.y);
        is_in[cell(pixel.x, pixel.y)] = 1;
    }
    for (int y = low.y; y <= high.y; ++y) {
        const Reach row = rows[static_cast<std::size_t>(y - low.y)];
        for (int x = row.low; x <= row.high; ++x) {
            const Reach column = columns[static_cast<std::size_t>(x - low.x)];
            if (is_in[cell(x, y)] == 0 && y > column.low && y < column.high) {
                pixels.emplace_back(x, y);
            }
        }
    }
}

}  // namespace

// Pixels of one colour that touch.
struct MarkerFinder::Blob {
    std::size_t colour = 0;
    glm::ivec2 low{};
    glm::ivec2 high{};
};

Expected<MarkerFinder> MarkerFinder::create(std::vector<ColourModel> models,
                                            const FinderOptions& options) {
    if (models.empty() || models.size() > kMostModels) {
        return fail(
            fmt::format("{} colours of markers; must be 1 to {}", models.size(), kMostModels));
    }
    return MarkerFinder(std::move(models), options);
}

MarkerFinder::MarkerFinder(std::vector<ColourModel> models, const FinderOptions& options)
    : models_(std::move(models)), options_(options) {
    fill_candidates();
}

// Whether a colour may lie in a cell of the RGB cube, also once its mean has wandered: each
// colour's ellipse against the box around the cell's chroma, which is greatest and least at its
// corners. Most pixels of a picture are told from this alone.
void MarkerFinder::fill_candidates() {
    const ChromaForm form = models_.front().form;
    candidates_.assign(std::size_t{kCells} * kCells * kCells, 0);
    means_.clear();
    for (const ColourModel& model : models_) {
        means_.push_back(model.mean);
    }
    for (int cell = 0; cell < kCells * kCells * kCells; ++cell) {
        std::uint8_t low[3]{};
        std::uint8_t high[3]{};
        for (int channel = 0; channel < 3; ++channel) {
            const int at = cell >> (kCellBits * (2 - channel)) & (kCells - 1);
            low[channel] = static_cast<std::uint8_t>(at << kLevelBits);
            high[channel] = static_cast<std::uint8_t>(low[channel] + (1 << kLevelBits) - 1);
        }
        candidates_[static_cast<std::size_t>(cell)] =
            form == ChromaForm::normalised && is_burnt_out(high) ? 1 : may_have_colour(low, high);
    }
}

std::uint8_t MarkerFinder::may_have_colour(const std::uint8_t* low,
                                           const std::uint8_t* high) const noexcept {
    const ChromaForm form = models_.front().form;
    if (form == ChromaForm::normalised && LumaChroma::of(high).y < kDarkestShade) {
        return 0;
    }
    glm::dvec2 least(1e9);
    glm::dvec2 most(-1e9);
    for (unsigned corner = 0; corner < 8; ++corner) {
        const std::uint8_t rgb[3] = {(corner & 1U) != 0 ? high[0] : low[0],
                                     (corner & 2U) != 0 ? high[1] : low[1],
                                     (corner & 4U) != 0 ? high[2] : low[2]};
        const glm::dvec2 chroma = plain_chroma(LumaChroma::of(rgb), form);
        least = glm::min(least, chroma);
        most = glm::max(most, chroma);
    }
    const glm::dvec2 middle = 0.5 * (least + most);
    const glm::dvec2 half = 0.5 * (most - least);
    const double noise2 = noise2_of(std::max(LumaChroma::of(low).y, kDarkestShade), form);
    const bool is_near = std::any_of(models_.begin(), models_.end(), [&](const ColourModel& model) {
        // No chroma of the cell is nearer to the mean than the middle less the way to it.
        const double way =
            std::sqrt(std::max(model.distance2(model.mean + half, noise2),
                               model.distance2(model.mean + glm::dvec2(half.x, -half.y), noise2)));
        return std::sqrt(model.distance2(middle, noise2)) - way <=
               std::sqrt(options_.gate) + kMostWandering;
    });
    return is_near ? 1 : 0;
}

void MarkerFinder::adapt_colour(std::size_t colour, const glm::dvec2& seen_mean, double rate) {
    adapt(models_[colour], seen_mean, rate);
    if (models_[colour].distance2(means_[colour]) > kMostWandering * kMostWandering) {
        fill_candidates();
    }
}

// The nearest colour in whose gate the pixel lies, and whether it only may be of it.
std::uint8_t MarkerFinder::mark_of(const std::uint8_t* rgb) const noexcept {
    const ChromaForm form = models_.front().form;
    const LumaChroma pixel = LumaChroma::of(rgb);
    const glm::dvec2 chroma = plain_chroma(pixel, form);
    const bool is_burnt = form == ChromaForm::normalised && is_burnt_out(rgb);
    if (form == ChromaForm::normalised && pixel.y < kDarkestShade) {
        return 0;
    }
    const bool is_sure = form == ChromaForm::crcb || (pixel.y >= kDarkestLuma && !is_burnt);
    const double noise2 = noise2_of(pixel.y, form);
    double nearest = options_.gate;
    std::uint8_t mark = 0;
    for (std::size_t i = 0; i < models_.size(); ++i) {
        const ColourModel& model = models_[i];
        // Burnt out, a colour may have become any paler one.
        const double distance2 = is_burnt && has_hue(chroma, model)
                                     ? 0.5 * options_.gate
                                     : model.distance2(chroma, noise2);
        if (distance2 < nearest) {
            nearest = distance2;
            const bool is_in = is_sure && model.distance2(chroma) < options_.gate;
            mark = static_cast<std::uint8_t>((i + 1) | (is_in ? 0U : kMayBe));
        }
    }
    return mark;
}

void MarkerFinder::classify(const PictureView& picture, const SearchWindow& window) {
    for (int y = window.low.y; y <= window.high.y; ++y) {
        const std::uint8_t* rgb = picture.at(window.low.x, y);
        std::uint8_t* mark = &map_[pixel_index(picture, window.low.x, y)];
        for (int x = window.low.x; x <= window.high.x; ++x, rgb += 3, ++mark) {
            *mark = candidates_[cell_of(rgb)] != 0 ? mark_of(rgb) : 0;
        }
    }
}

// Puts the pixels that touch into pixels_ and takes them off the map.
MarkerFinder::Blob MarkerFinder::take_blob(const PictureView& picture, int x, int y) {
    const auto mark = static_cast<std::uint8_t>(map_[pixel_index(picture, x, y)] & ~kMayBe);
    Blob blob{.colour = mark - std::size_t{1}, .low = {x, y}, .high = {x, y}};
    pixels_.assign(1, {x, y});
    map_[pixel_index(picture, x, y)] = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const glm::ivec2 from = pixels_[i];
        blob.low = {std::min(blob.low.x, from.x), std::min(blob.low.y, from.y)};
        blob.high = {std::max(blob.high.x, from.x), std::max(blob.high.y, from.y)};
        for (int to_y = std::max(from.y - 1, 0); to_y <= std::min(from.y + 1, picture.height - 1);
             ++to_y) {
            for (int to_x = std::max(from.x - 1, 0);
                 to_x <= std::min(from.x + 1, picture.width - 1);
                 ++to_x) {
                std::uint8_t& here = map_[pixel_index(picture, to_x, to_y)];
                if ((here & ~kMayBe) == mark) {
                    here = 0;
                    pixels_.emplace_back(to_x, to_y);
                }
            }
        }
    }
    return blob;
}

// One spot of a blob, or two where it has a waist.
void MarkerFinder::add_spots(const PictureView& picture,
                             const Blob& blob,
                             std::vector<Spot>& spots) const {
    const ColourModel& model = models_[blob.colour];
    const auto waist = options_.is_splitting ? waist_of(pixels_) : std::nullopt;
    struct Sum {
        glm::dvec2 pixel{};
        double weight = 0.0;
        glm::dvec2 chroma{};
        double tellers = 0.0;  // of a colour
        double area = 0.0;
    };
    Sum sums[2];
    for (const glm::ivec2& pixel : pixels_) {
        const glm::dvec2 place(pixel);
        Sum& sum = sums[waist && glm::dot(place, waist->direction) >= waist->at ? 1 : 0];
        double weight = 1.0;  // of what the colour is not told from
        const std::uint8_t* const rgb = picture.at(pixel.x, pixel.y);
        if (const auto chroma = chroma_of(rgb, model.form)) {
            const double noise2 = noise2_of(LumaChroma::of(rgb).y, model.form);
            const double distance2 = model.distance2(*chroma, noise2);
            weight = std::clamp(2.0 - 2.0 * distance2 / options_.gate, kLeastWeight, 1.0);
            if (distance2 < options_.gate) {
                sum.chroma += *chroma;
                sum.tellers += 1.0;
            }
        }
        sum.pixel += weight * place;
        sum.weight += weight;
        sum.area += 1.0;
    }
    for (const Sum& sum : sums) {
        if (sum.area >= options_.least_area && sum.tellers > 0.0) {
            spots.push_back({.detection = {.pixel = sum.pixel / sum.weight,
                                           .colour = blob.colour,
                                           .area = sum.area},
                             .mean_chroma = sum.chroma / sum.tellers});
        }
    }
}

void MarkerFinder::collect(const PictureView& picture,
                           const SearchWindow& window,
                           std::vector<Spot>& spots) {
    for (int y = window.low.y; y <= window.high.y; ++y) {
        for (int x = window.low.x; x <= window.high.x; ++x) {
            const std::uint8_t mark = map_[pixel_index(picture, x, y)];
            if (mark == 0 || mark >= kMayBe) {  // a spot begins where the colour is sure
                continue;
            }
            const Blob blob = take_blob(picture, x, y);
            const auto area = static_cast<double>(pixels_.size());
            if (area >= options_.least_area && area <= options_.greatest_area) {
                fill_holes(pixels_, blob.low, blob.high);
                add_spots(picture, blob, spots);
            }
        }
    }
}

std::vector<Spot> MarkerFinder::find(const PictureView& picture) {
    const SearchWindow whole{{0, 0}, {picture.width - 1, picture.height - 1}};
    return find(picture, std::span(&whole, 1));
}

std::vector<Spot> MarkerFinder::find(const PictureView& picture,
                                     std::span<const SearchWindow> windows) {
    map_.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
                0);
    for (const SearchWindow& window : windows) {
        classify(picture, within(picture, window));
    }
    std::vector<Spot> spots;
    for (const SearchWindow& window : windows) {
        collect(picture, within(picture, window), spots);
    }
    return spots;
}

}  // namespace raks::capture
