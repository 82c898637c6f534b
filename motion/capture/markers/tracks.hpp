// Tracks: where each marker was in the world, frame by frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

#include <glm/vec3.hpp>

namespace raks::capture {

/// How a place came to be known.
enum class PlaceSource : std::uint8_t {
    seen,    ///< triangulated from two or more views
    filled,  ///< between moments at which it was seen
    lost,    ///< not known
};

/// Where a marker was at one frame.
struct MarkerPlace {
    glm::dvec3 place{std::numeric_limits<double>::quiet_NaN()};  ///< world, metres; NaN: lost
    double deviation = 0.0;                  ///< standard deviation along the worst axis, metres
    std::uint8_t views = 0;                  ///< that saw it
    PlaceSource source = PlaceSource::lost;  ///< how it is known
};

/// What is doubtful about a stretch.
enum class Doubt : std::uint8_t {
    lost,       ///< not seen by two views for long
    filled,     ///< filled over more than 0.2 s
    length,     ///< its distance to a marker of the same bone is off
    exchanged,  ///< it may have changed places with another marker
    residual,   ///< its views do not agree, or agree on a jump
    unsure,     ///< the angle of its joint is known to 20 degrees at best, by angles
    jumped,     ///< a network has it far from where other views and moments have it
    person,     ///< a network follows somebody else; of the whole body
};
/// Names of the doubts, as files have them, by Doubt.
inline constexpr std::string_view kDoubtNames[] = {
    "lost", "filled", "length", "exchanged", "residual", "unsure", "jumped", "person"};

/// A stretch of a track that a person should look at.
struct Flag {
    Doubt doubt = Doubt::lost;
    std::size_t marker = 0;  ///< index in Tracks::markers
    std::size_t first = 0;   ///< frame
    std::size_t last = 0;    ///< frame, included
    std::string camera{};    ///< whose view it is about; empty: of all

    friend bool operator==(const Flag&, const Flag&) = default;
};

/// Places of all markers over time.
struct Tracks {
    std::vector<std::string> markers;  ///< names
    double frames_per_second = 0.0;    ///< > 0
    double first_time = 0.0;           ///< capture time of frame 0; seconds
    std::size_t frame_count = 0;
    std::vector<MarkerPlace> places;  ///< frames x markers, row-major
    std::vector<Flag> flags;          ///< by first frame, then marker and doubt

    /// A marker's place at a frame.
    [[nodiscard]] MarkerPlace& at(std::size_t frame, std::size_t marker) noexcept {
        return places[frame * markers.size() + marker];
    }
    /// A marker's place at a frame.
    [[nodiscard]] const MarkerPlace& at(std::size_t frame, std::size_t marker) const noexcept {
        return places[frame * markers.size() + marker];
    }
    /// Capture time of a frame; seconds.
    [[nodiscard]] double time_of(std::size_t frame) const noexcept {
        return first_time + static_cast<double>(frame) / frames_per_second;
    }
};

/// Puts the flags into their order.
void sort_flags(Tracks& tracks);

/// Tracks as a table (`tracks.csv`): frame,time,marker,x,y,z,deviation,views,source; a lost place
/// has blank cells. Numbers read back to the same bits.
[[nodiscard]] std::string tracks_text(const Tracks& tracks);
/// Reads it. Errors, one line with its number: no such head, words that are no numbers, frames out
/// of order or not complete, more than 1,000 markers.
[[nodiscard]] Expected<Tracks> read_tracks(std::string_view text, const std::string& file);

/// Flags as a table (`flags.tsv`): doubt, marker, first, last, camera.
[[nodiscard]] std::string flags_text(const Tracks& tracks);
/// Reads them into `tracks`; tables without the column of cameras too. Errors: an unknown doubt or
/// marker, frames that the tracks lack.
[[nodiscard]] Expected<void> read_flags(std::string_view text,
                                        const std::string& file,
                                        Tracks& tracks);

/// Tracks as a TRC (Motion Analysis, OpenSim), in metres; lost places are blank.
[[nodiscard]] std::string trc_text(const Tracks& tracks, std::string_view name);

}  // namespace raks::capture
