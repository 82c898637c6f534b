#include "apps/raks_capture/track_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "base/printable.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

// Markers that are lost most of the time, in one line; empty: none.
std::string lost_markers(const capture::Tracks& tracks) {
    std::vector<std::string> names;
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        std::size_t lost = 0;
        for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
            lost += tracks.at(frame, marker).source == capture::PlaceSource::lost ? 1U : 0U;
        }
        if (2 * lost > tracks.frame_count) {
            names.push_back(tracks.markers[marker]);
        }
    }
    return names.empty()
               ? std::string()
               : fmt::format(
                     "lost most of the time: {}: are they labelled in two cameras at one moment, "
                     "and do their colours show?",
                     fmt::join(names, ", "));
}

// How upright the dancer is: the cosine of the angle from the feet to the head against up, in the
// middle of all frames that show both; none: no frame does.
std::optional<double> uprightness(const capture::Tracks& tracks,
                                  const capture::MarkerSet& markers) {
    std::vector<double> cosines;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        glm::dvec3 head(0.0);
        glm::dvec3 feet(0.0);
        double heads = 0.0;
        double toes = 0.0;
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            const capture::MarkerPlace& place = tracks.at(frame, marker);
            const auto index = markers.index_of(tracks.markers[marker]);
            if (place.source == capture::PlaceSource::lost || !index) {
                continue;
            }
            const motion::Bone bone = markers.markers[*index].bone;
            if (bone == motion::Bone::head) {
                head += place.place;
                heads += 1.0;
            } else if (bone == motion::Bone::left_foot || bone == motion::Bone::right_foot ||
                       bone == motion::Bone::left_toes || bone == motion::Bone::right_toes) {
                feet += place.place;
                toes += 1.0;
            }
        }
        if (heads > 0.0 && toes > 0.0) {
            cosines.push_back(glm::normalize(head / heads - feet / toes).y);
        }
    }
    if (cosines.empty()) {
        return std::nullopt;
    }
    const auto middle = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 2);
    std::nth_element(cosines.begin(), middle, cosines.end());
    return *middle;
}

// A world whose floor is not under the dancer's feet.
std::string floor_doubt(const capture::Tracks& tracks, const capture::MarkerSet& markers) {
    const double upright = uprightness(tracks, markers).value_or(1.0);
    constexpr double kLying = 0.5;  // the cosine of 60 degrees
    if (upright > kLying) {
        return {};
    }
    return fmt::format(
        "the dancer {}: the floor is not where the board says; lay it down printed side up, in "
        "view of three cameras, and calibrate again with --floor",
        upright < -kLying ? "stands on the head" : "lies all the time");
}

// The share of places that are known in this way; 0 where there are none.
double share_of(const capture::Tracks& tracks, capture::PlaceSource source) {
    const auto count = std::count_if(
        tracks.places.begin(), tracks.places.end(), [source](const capture::MarkerPlace& place) {
            return place.source == source;
        });
    return static_cast<double>(count) /
           static_cast<double>(std::max<std::size_t>(tracks.places.size(), 1));
}

// Films that end long before the one that ends last.
std::vector<std::string> short_films(const capture::Observations& seen,
                                     const std::vector<capture::Clock>& clocks) {
    constexpr double kEarly = 1.0;  // seconds
    std::vector<std::pair<const capture::SeenFilm*, double>> ends;
    double last = -std::numeric_limits<double>::infinity();
    for (const capture::SeenFilm& film : seen.films) {
        const auto clock = std::find_if(clocks.begin(), clocks.end(), [&film](const auto& one) {
            return one.camera == film.camera;
        });
        if (clock != clocks.end() && !film.pictures.empty()) {
            ends.emplace_back(&film, clock->capture_time(film.pictures.back().time));
            last = std::max(last, ends.back().second);
        }
    }
    std::vector<std::string> doubts;
    for (const auto& [film, end] : ends) {
        if (end < last - kEarly) {
            doubts.push_back(
                fmt::format("the film of camera \"{}\" ends {:.1f} s before the "
                            "last one: what follows is seen by the others alone",
                            printable(film->camera),
                            last - end));
        }
    }
    return doubts;
}

}  // namespace

std::vector<std::string> film_doubts(const capture::Rig& rig,
                                     const capture::Observations& seen,
                                     const std::vector<capture::Clock>& clocks) {
    std::vector<std::string> doubts = short_films(seen, clocks);
    std::vector<double> used(rig.cameras.size());
    for (const capture::SeenFilm& film : seen.films) {
        const auto camera = rig.index_of(film.camera);
        for (std::size_t i = 0; camera && i < film.pictures.size(); ++i) {
            const capture::Lens& lens = rig.cameras[*camera].lens;
            for (const capture::Detection& spot : film.pictures[i].detections) {
                used[*camera] = std::max(used[*camera],
                                         glm::distance(spot.pixel, glm::dvec2(lens.cx, lens.cy)));
            }
        }
    }
    for (std::string& doubt : capture::folding_doubts(rig, used)) {
        doubts.push_back(std::move(doubt));
    }
    return doubts;
}

double lost_share(const capture::Tracks& tracks) {
    return share_of(tracks, capture::PlaceSource::lost);
}

std::string too_much_lost(const capture::Tracks& tracks) {
    constexpr double kMostLost = 0.2;
    constexpr double kMostUnseen = 0.5;
    const double lost = lost_share(tracks);
    const double unseen = lost + share_of(tracks, capture::PlaceSource::filled);
    if (lost <= kMostLost && unseen <= kMostUnseen) {
        return {};
    }
    return fmt::format(
        "{:.0f} % of the places are lost{}: no dance can be learnt from these "
        "tracks; film with more cameras, or look at report.html for what is not seen",
        100.0 * (lost > kMostLost ? lost : unseen),
        lost > kMostLost ? "" : " or filled in");
}

std::string colour_doubt(const capture::MarkerSet& markers) {
    const std::size_t colours = markers.colours().size();
    constexpr std::size_t kEnough = 3;
    if (colours >= kEnough) {
        return {};
    }
    return fmt::format(
        "{} markers of {}: where spots are missed or false a limb is taken for another and the "
        "body is lost at times; give neighbours, left and right, different colours (five are "
        "enough)",
        markers.markers.size(),
        colours == 1 ? "one colour" : "two colours");
}

std::vector<std::string> track_doubts(const capture::Tracks& tracks,
                                      const capture::MarkerSet& markers) {
    std::vector<std::string> doubts = {lost_markers(tracks), floor_doubt(tracks, markers)};
    std::erase(doubts, std::string());
    return doubts;
}

}  // namespace raks::apps
