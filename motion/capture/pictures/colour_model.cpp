#include "motion/capture/pictures/colour_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr int kHalfWindow = 48;          // pixels around a point in which its region is grown
constexpr int kWidestRegion = 64;        // pixels
constexpr std::size_t kLeastRegion = 6;  // pixels
constexpr int kSnap = 2;                 // pixels beside a point, of which the most coloured counts
constexpr double kLeastColour = 10.0;    // of normalised chroma: less is grey
constexpr double kLeastTolerance = 8.0;  // across the ray from grey through the colour
constexpr double kTolerance = 0.2;       // likewise, of the colour's distance from grey
constexpr double kPalest = 0.65;         // along the ray: shade takes some of a dark colour
constexpr double kRichest = 1.3;

struct Seed {
    glm::ivec2 pixel{};
    glm::dvec2 chroma{};
};

struct Region {
    std::vector<glm::ivec2> pixels;
    int width = 0;
    int height = 0;
};

// The mean chroma of the pixels around a point that tell one.
std::optional<glm::dvec2> chroma_around(const PictureView& picture, const glm::ivec2& at) {
    glm::dvec2 sum{};
    int count = 0;
    for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, picture.height - 1); ++y) {
        for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, picture.width - 1); ++x) {
            if (const auto chroma = chroma_of(picture.at(x, y), ChromaForm::normalised)) {
                sum += *chroma;
                ++count;
            }
        }
    }
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

// The pixel near a point whose neighbourhood is the most coloured: clicks lie beside small markers,
// and some markers are half hidden.
std::optional<Seed> seed_near(const PictureView& picture, const glm::ivec2& at) {
    std::optional<Seed> seed;
    for (int y = std::max(at.y - kSnap, 0); y <= std::min(at.y + kSnap, picture.height - 1); ++y) {
        for (int x = std::max(at.x - kSnap, 0); x <= std::min(at.x + kSnap, picture.width - 1);
             ++x) {
            const auto chroma = chroma_around(picture, {x, y});
            if (chroma && (!seed || glm::length(*chroma) > glm::length(seed->chroma))) {
                seed = Seed{{x, y}, *chroma};
            }
        }
    }
    return seed;
}

// Whether a pixel may be of the colour that has this chroma in its middle.
bool is_alike(const glm::dvec2& here, const glm::dvec2& chroma) {
    const double length = glm::length(chroma);
    const glm::dvec2 ray = chroma / length;
    const double along = glm::dot(here, ray);
    const double across = std::abs(here.x * ray.y - here.y * ray.x);
    return along >= kPalest * length && along <= kRichest * length &&
           across <= std::max(kLeastTolerance, kTolerance * length);
}

// The pixels of about this chroma that hang together with the one at `start`.
Region grow(const PictureView& picture, const glm::ivec2& start, const glm::dvec2& chroma) {
    constexpr int kSide = 2 * kHalfWindow + 1;
    std::vector<std::uint8_t> is_seen(static_cast<std::size_t>(kSide) * kSide);
    Region region;
    region.pixels.push_back(start);
    is_seen[is_seen.size() / 2] = 1;
    glm::ivec2 low = start;
    glm::ivec2 high = start;
    for (std::size_t i = 0; i < region.pixels.size(); ++i) {
        const glm::ivec2 from = region.pixels[i];
        low = {std::min(low.x, from.x), std::min(low.y, from.y)};
        high = {std::max(high.x, from.x), std::max(high.y, from.y)};
        for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const glm::ivec2 to = from + step;
            const glm::ivec2 cell = to - start + glm::ivec2(kHalfWindow);
            if (cell.x < 0 || cell.x >= kSide || cell.y < 0 || cell.y >= kSide || to.x < 0 ||
                to.x >= picture.width || to.y < 0 || to.y >= picture.height) {
                continue;
            }
            std::uint8_t& seen = is_seen[static_cast<std::size_t>(cell.y) * kSide +
                                         static_cast<std::size_t>(cell.x)];
            const auto here = chroma_of(picture.at(to.x, to.y), ChromaForm::normalised);
            if (seen == 0 && here && is_alike(*here, chroma)) {
                region.pixels.push_back(to);
            }
            seen = 1;
        }
    }
    region.width = high.x - low.x + 1;
    region.height = high.y - low.y + 1;
    return region;
}

Expected<Region> region_at(const PictureView& picture, const glm::dvec2& pixel) {
    const std::string where = fmt::format("the point {:.0f}, {:.0f}", pixel.x, pixel.y);
    if (!(pixel.x > -0.5 && pixel.y > -0.5 && pixel.x < picture.width - 0.5 &&
          pixel.y < picture.height - 0.5)) {
        return fail(fmt::format(
            "{} lies outside of the picture ({} x {})", where, picture.width, picture.height));
    }
    const auto seed = seed_near(
        picture, {static_cast<int>(std::lround(pixel.x)), static_cast<int>(std::lround(pixel.y))});
    if (!seed) {
        return fail(where +
                    " is too dark or burnt out to tell a colour; show the marker in another "
                    "picture or change the light");
    }
    if (glm::length(seed->chroma) < kLeastColour) {
        return fail(where + " has hardly any colour; click into the middle of the marker");
    }
    Region region = grow(picture, seed->pixel, seed->chroma);
    if (region.pixels.size() < kLeastRegion) {
        return fail(where +
                    " has fewer than 6 pixels of one colour around it; click into the "
                    "middle of the marker");
    }
    if (region.width > kWidestRegion || region.height > kWidestRegion) {
        return fail(where +
                    " lies in something larger than 64 pixels of one colour; click into a "
                    "marker, or use a colour that clothes and walls have not");
    }
    return region;
}

// Sums over pixels from which mean and covariance follow.
struct Moments {
    double count = 0.0;
    glm::dvec2 sum{};
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;

    void add(const glm::dvec2& value, double weight) {
        count += weight;
        sum += weight * value;
        xx += weight * value.x * value.x;
        xy += weight * value.x * value.y;
        yy += weight * value.y * value.y;
    }
};

ColourModel model_of(const Moments& moments, ChromaForm form) {
    constexpr double kGreyLevel2 = 1.0;
    ColourModel model{.form = form, .mean = moments.sum / moments.count};
    const glm::dvec2 mean = model.mean;
    const double xy = moments.xy / moments.count - mean.x * mean.y;
    const double xx = std::max(moments.xx / moments.count - mean.x * mean.x, 0.0);
    const double yy = std::max(moments.yy / moments.count - mean.y * mean.y, 0.0);
    model.covariance = {xx + kGreyLevel2, xy, xy, yy + kGreyLevel2};
    return model;
}

}  // namespace

Expected<ColourModel> learn_colour(std::span<const PictureView> pictures,
                                   std::span<const ColourPoint> points,
                                   ChromaForm form) {
    Moments moments;
    double area = 0.0;
    for (const ColourPoint& point : points) {
        const PictureView& picture = pictures[point.picture];
        const auto region = region_at(picture, point.pixel);
        if (!region) {
            return fail(region.error());
        }
        area += static_cast<double>(region->pixels.size());
        // Each region counts alike: near markers are not to drown those far away.
        const double weight = 1.0 / static_cast<double>(region->pixels.size());
        for (const glm::ivec2& pixel : region->pixels) {
            if (const auto chroma = chroma_of(picture.at(pixel.x, pixel.y), form)) {
                moments.add(*chroma, weight);
            }
        }
    }
    if (moments.count == 0.0) {
        return fail("no point shows this colour");
    }
    ColourModel model = model_of(moments, form);
    model.area = area / static_cast<double>(points.size());
    return model;
}

double separation(const ColourModel& a, const ColourModel& b) noexcept {
    return std::sqrt(std::min(a.distance2(b.mean), b.distance2(a.mean)));
}

void adapt(ColourModel& model, const glm::dvec2& seen_mean, double rate) noexcept {
    model.mean += std::clamp(rate, 0.0, kMostAdaption) * (seen_mean - model.mean);
}

}  // namespace raks::capture
