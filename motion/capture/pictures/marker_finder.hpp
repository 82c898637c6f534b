// Marker finder: the spots of the markers' colours in a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/pictures/chroma.hpp"
#include "motion/capture/pictures/colour_model.hpp"

#include <glm/vec2.hpp>

namespace raks::capture {

/// A part of a picture in which markers are looked for: pixels from `low` to `high`, both included;
/// may reach beyond the picture.
struct SearchWindow {
    glm::ivec2 low{};
    glm::ivec2 high{};
};

/// Which spots are kept.
struct FinderOptions {
    double gate = kColourGate;        ///< squared Mahalanobis distance of a pixel from its colour
    double least_area = 6.0;          ///< pixels; smaller spots are noise
    double greatest_area = 10'000.0;  ///< pixels; larger spots are clothes or walls
    bool is_splitting = true;         ///< two touching discs of a colour are two spots
};

/// A spot and what adapt() wants of it.
struct Spot {
    Detection detection;       ///< its centre, its colour (index among the models), its area
    glm::dvec2 mean_chroma{};  ///< of its pixels, in the units of its model
};

/// Finds the markers of up to 64 colours. A pixel has the colour whose Gaussian is nearest, if it
/// lies in its gate. Pixels of a colour that touch (8 neighbours) are a spot, with those around
/// them that may have it: in the shade, where the sensor's noise counts for more, or burnt out but
/// of the same hue. (Without them the centre moves towards the light.) Holes are filled, and pixels
/// far from the colour's mean, mixed at the edge, weigh less in the centre. The same picture,
/// windows and models give the same spots in the same order. Threads: one (it keeps its memory);
/// several finders side by side. Real-time: no.
class MarkerFinder {
 public:
    /// Spots are made by these models, which are all of one form. Errors: none, or more than 64.
    [[nodiscard]] static Expected<MarkerFinder> create(std::vector<ColourModel> models,
                                                       const FinderOptions& options = {});

    /// In the whole picture.
    [[nodiscard]] std::vector<Spot> find(const PictureView& picture);
    /// In these windows alone; a spot in two windows is found once.
    [[nodiscard]] std::vector<Spot> find(const PictureView& picture,
                                         std::span<const SearchWindow> windows);

    /// The models, by colour.
    [[nodiscard]] const std::vector<ColourModel>& models() const noexcept { return models_; }
    /// adapt() of one of them.
    void adapt_colour(std::size_t colour, const glm::dvec2& seen_mean, double rate);

 private:
    struct Blob;

    MarkerFinder(std::vector<ColourModel> models, const FinderOptions& options);
    void fill_candidates();
    [[nodiscard]] std::uint8_t may_have_colour(const std::uint8_t* low,
                                               const std::uint8_t* high) const noexcept;
    void classify(const PictureView& picture, const SearchWindow& window);
    [[nodiscard]] std::uint8_t mark_of(const std::uint8_t* rgb) const noexcept;
    void collect(const PictureView& picture, const SearchWindow& window, std::vector<Spot>& spots);
    [[nodiscard]] Blob take_blob(const PictureView& picture, int x, int y);
    void add_spots(const PictureView& picture, const Blob& blob, std::vector<Spot>& spots) const;

    std::vector<ColourModel> models_;
    FinderOptions options_;
    std::vector<glm::dvec2> means_;         // of the models when candidates_ was filled
    std::vector<std::uint8_t> candidates_;  // by cell of the RGB cube: whether any colour may be in
    std::vector<std::uint8_t>
        map_;  // by pixel: 0: none; else colour + 1, and whether it only may be
    std::vector<glm::ivec2> pixels_;  // of the newest blob
};

}  // namespace raks::capture
