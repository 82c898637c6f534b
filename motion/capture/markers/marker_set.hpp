// Marker set: which coloured markers a dancer wears, and where.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/humanoid.hpp"

#include <glm/vec3.hpp>

namespace raks::capture {

/// One marker on the body.
struct Marker {
    std::string name;                        ///< "left_wrist"; plain, differs from the others
    std::string colour;                      ///< "green"; markers may share one
    motion::Bone bone = motion::Bone::hips;  ///< that carries it
    /// In the bone's frame of a T-pose (axes of the world), from the bone's joint, for a body as
    /// tall as the mannequin (1.714 m); metres.
    glm::dvec3 place{};
};

/// The markers of a capture. A marker set is such a file (TOML):
///
///     format = "raks-markers"
///     version = 1
///     radius = 0.02                      # of a marker, metres
///     [[marker]]
///     name = "left_wrist"
///     colour = "green"
///     bone = "leftLowerArm"
///     place = [0.22, 0.03, 0.0]
struct MarkerSet {
    double radius = 0.02;  ///< of a marker; metres
    std::vector<Marker> markers;

    /// The marker of a name. None: there is none.
    [[nodiscard]] std::optional<std::size_t> index_of(std::string_view name) const noexcept;
    /// The colours that occur, each once, in the order of their first markers.
    [[nodiscard]] std::vector<std::string> colours() const;
    /// By marker: the index of its colour in colours().
    [[nodiscard]] std::vector<std::size_t> classes() const;
};

/// Reads a marker set. Errors, one line with its number: not TOML, another format or version, two
/// markers of one name, an unknown bone (with the nearest), fewer than 6 or more than 100 markers,
/// places more than half a metre from their joint, a radius outside of 2 to 100 mm.
[[nodiscard]] Expected<MarkerSet> read_marker_set(std::string_view text, const std::string& file);

/// The same as such a file. Reads back to the same values.
[[nodiscard]] std::string marker_set_text(const MarkerSet& set);

/// Where the set that is shipped gets its colours from.
enum class MarkerColours {
    five,    ///< green, blue, yellow, magenta and cyan, so that no two neighbours are alike
    unique,  ///< one for each marker: for simulated points, since no film tells so many apart
};
/// The set that is shipped: 18 markers of head, trunk and limbs, and two over the toes. Those of
/// elbows and knees lie beside the hinge, so that a straight limb's twist is seen.
[[nodiscard]] MarkerSet default_markers(MarkerColours colours = MarkerColours::five);

}  // namespace raks::capture
