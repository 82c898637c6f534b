#include "motion/capture/tracking/view_order.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "base/printable.hpp"

#include <glm/mat3x3.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kMostMoments = 40;
constexpr std::size_t kCamerasAtMostMoments = 8;  // of more cameras fewer moments are looked at
constexpr double kOnLine = 3.0;                   // sigma
constexpr double kLabelOnLine = 6.0;              // sigma: a person clicks less exactly
constexpr double kLabelWeight = 10.0;             // a label is of one marker, a spot of several
constexpr double kGoodAgreement = 0.75;   // films of which so many spots agree are in their order
constexpr double kLabelsApart = 10.0;     // pixels
constexpr std::size_t kFewestLabels = 4;  // that two cameras share

/// A spot at a moment, as its film has it.
struct FilmSpot {
    std::size_t key = 0;  ///< its colour; of a label: its marker, after all colours
    glm::dvec2 pixel{};
    bool is_label = false;
};
/// Spots of one moment, by film.
using Moment = std::vector<std::vector<FilmSpot>>;

/// How many spots agree, of how many that could.
struct Agreement {
    double fitting = 0.0;
    double possible = 0.0;

    Agreement& operator+=(const Agreement& other) {
        fitting += other.fitting;
        possible += other.possible;
        return *this;
    }
    [[nodiscard]] double share() const { return possible > 0.0 ? fitting / possible : 0.0; }
};

/// A film's place: the camera that it is taken to be of, and whether it is flipped.
struct FilmPlace {
    std::size_t camera = 0;
    bool mirrored = false;

    friend auto operator<=>(const FilmPlace&, const FilmPlace&) = default;
};

std::vector<Moment> moments_of(const Rig& rig,
                               FrameViews& views,
                               std::size_t frame_count,
                               const std::vector<SaidView>& said) {
    const std::size_t cameras = rig.cameras.size();
    std::size_t colours = 0;
    std::vector<std::size_t> good;
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        const auto& spots = views.at(frame);
        for (const SeenSpot& spot : spots) {
            colours = std::max(colours, spot.colour + 1);
        }
        if (std::any_of(spots.begin(), spots.end(), [&spots](const SeenSpot& spot) {
                return spot.camera != spots.front().camera;
            })) {
            good.push_back(frame);
        }
    }
    const std::size_t wanted = std::min(
        kMostMoments, kMostMoments * kCamerasAtMostMoments / std::max<std::size_t>(1, cameras));
    std::vector<Moment> moments;
    for (std::size_t i = 0; i < std::min(wanted, good.size()); ++i) {
        const std::size_t frame = good[i * good.size() / std::min(wanted, good.size())];
        moments.emplace_back(cameras);
        for (const SeenSpot& spot : views.at(frame)) {
            moments.back()[spot.camera].push_back({spot.colour, spot.pixel});
        }
    }
    std::map<std::size_t, Moment> labelled;
    for (const SaidView& view : said) {
        Moment& moment = labelled.try_emplace(view.frame, cameras).first->second;
        moment[view.camera].push_back({colours + view.marker, view.pixel, true});
    }
    for (auto& [frame, moment] : labelled) {
        moments.push_back(std::move(moment));
    }
    return moments;
}

/// Counts agreements of films at places, each pair of them once.
class AgreementTable {
 public:
    AgreementTable(const Rig& rig, const std::vector<Moment>& moments, double sigma)
        : rig_(rig), moments_(moments), sigma_(sigma), directions_(rig.cameras.size()) {}

    const Agreement& of(std::size_t one,
                        const FilmPlace& at_one,
                        std::size_t other,
                        const FilmPlace& at_other) {
        if (one > other) {
            return of(other, at_other, one, at_one);
        }
        const auto [place, is_new] = table_.try_emplace({one, at_one, other, at_other});
        if (is_new) {
            place->second = counted(one, at_one, other, at_other);
        }
        return place->second;
    }

    // Of one film with all others.
    Agreement of(std::size_t film, const std::vector<FilmPlace>& places) {
        Agreement sum;
        for (std::size_t other = 0; other < places.size(); ++other) {
            if (other != film) {
                sum += of(film, places[film], other, places[other]);
            }
        }
        return sum;
    }

    double total(const std::vector<FilmPlace>& places) {
        Agreement sum;
        for (std::size_t film = 0; film < places.size(); ++film) {
            sum += of(film, places);
        }
        return sum.share();
    }

 private:
    using Directions = std::vector<std::vector<glm::dvec2>>;  // by moment and spot
    struct Pair {
        std::size_t one;
        FilmPlace at_one;
        std::size_t other;
        FilmPlace at_other;

        friend auto operator<=>(const Pair&, const Pair&) = default;
    };

    // Directions of a film's spots as those of a place.
    const Directions& directions(std::size_t film, const FilmPlace& place) {
        const auto [found, is_new] = directions_[film].try_emplace(place);
        if (is_new) {
            const Lens& own = rig_.cameras[film].lens;
            const Lens& lens = rig_.cameras[place.camera].lens;
            for (const Moment& moment : moments_) {
                std::vector<glm::dvec2>& of_moment = found->second.emplace_back();
                for (const FilmSpot& spot : moment[film]) {
                    const double u = place.mirrored ? own.width - 1.0 - spot.pixel.x : spot.pixel.x;
                    of_moment.push_back(direction_of(lens, {u, spot.pixel.y}));
                }
            }
        }
        return found->second;
    }

    Agreement counted(std::size_t one,
                      const FilmPlace& at_one,
                      std::size_t other,
                      const FilmPlace& at_other) {
        const Camera& to = rig_.cameras[at_other.camera];
        const glm::dmat3 lines = epipolar_matrix(rig_.cameras[at_one.camera], to);
        const double pixels = 0.5 * (to.lens.fx + to.lens.fy);
        const Directions& from = directions(one, at_one);
        const Directions& onto = directions(other, at_other);
        Agreement sum;
        for (std::size_t i = 0; i < moments_.size(); ++i) {
            std::map<std::size_t, std::array<double, 3>> keys;  // spots in both, and those that fit
            const auto& own = moments_[i][one];
            const auto& others = moments_[i][other];
            for (const FilmSpot& spot : others) {
                keys[spot.key][1] += 1.0;
            }
            for (std::size_t s = 0; s < own.size(); ++s) {
                keys[own[s].key][0] += 1.0;
                const glm::dvec3 line = lines * glm::dvec3(from[i][s], 1.0);
                const double scale = pixels / std::max(std::hypot(line.x, line.y), 1e-12);
                const double most = sigma_ * (own[s].is_label ? kLabelOnLine : kOnLine);
                for (std::size_t t = 0; t < others.size(); ++t) {
                    if (others[t].key == own[s].key &&
                        scale * std::abs(glm::dot(line, glm::dvec3(onto[i][t], 1.0))) <= most) {
                        keys[own[s].key][2] += 1.0;
                        break;
                    }
                }
            }
            const bool are_labels = !own.empty() && own.front().is_label;
            for (const auto& [key, counts] : keys) {
                const double possible = std::min(counts[0], counts[1]);
                const double weight = are_labels ? kLabelWeight : 1.0;
                sum += {weight * std::min(possible, counts[2]), weight * possible};
            }
        }
        return sum;
    }

    const Rig& rig_;
    const std::vector<Moment>& moments_;
    double sigma_;
    std::vector<std::map<FilmPlace, Directions>> directions_;
    std::map<Pair, Agreement> table_;
};

// The best of all orders that differ from this one by two films or by one mirror.
std::vector<FilmPlace> best_change(AgreementTable& table, const std::vector<FilmPlace>& places) {
    std::vector<FilmPlace> best = places;
    double most = table.total(places);
    const auto try_order = [&](std::vector<FilmPlace> order) {
        const double share = table.total(order);
        if (share > most + 1e-9) {
            most = share;
            best = std::move(order);
        }
    };
    for (std::size_t one = 0; one < places.size(); ++one) {
        std::vector<FilmPlace> order = places;
        order[one].mirrored = !order[one].mirrored;
        try_order(order);
        for (std::size_t other = one + 1; other < places.size(); ++other) {
            order = places;
            std::swap(order[one].camera, order[other].camera);
            try_order(order);
        }
    }
    return best;
}

// Distance of two labels of one marker from each other's lines, by pairs of cameras.
Expected<void> check_labels_agree(const Rig& rig, const std::vector<SaidView>& said) {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> apart;
    for (const SaidView& one : said) {
        for (const SaidView& other : said) {
            if (one.camera < other.camera && one.frame == other.frame &&
                one.marker == other.marker) {
                const Camera& from = rig.cameras[one.camera];
                const Camera& to = rig.cameras[other.camera];
                apart[{one.camera, other.camera}].push_back(
                    epipolar_distance(from,
                                      direction_of(from.lens, one.pixel),
                                      to,
                                      direction_of(to.lens, other.pixel)));
            }
        }
    }
    for (auto& [cameras, distances] : apart) {
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        if (distances.size() >= kFewestLabels && *middle > kLabelsApart) {
            return fail(fmt::format(
                "the labels in cameras \"{}\" and \"{}\" miss each other by {:.0f} pixels: a "
                "camera "
                "was moved after the board was filmed, a clock is wrong, or markers are mixed up",
                printable(rig.cameras[cameras.first].name, 40),
                printable(rig.cameras[cameras.second].name, 40),
                *middle));
        }
    }
    return {};
}

}  // namespace

std::vector<std::size_t> ViewOrder::wrong() const {
    std::vector<std::size_t> cameras;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if ((places[i] != i || mirrored[i]) && agreement[i] >= 1.5 * agreement_as_named[i] + 0.1) {
            cameras.push_back(i);
        }
    }
    return cameras;
}

ViewOrder find_view_order(const Rig& rig,
                          FrameViews& views,
                          std::size_t frame_count,
                          const std::vector<SaidView>& said,
                          double sigma) {
    const std::vector<Moment> moments = moments_of(rig, views, frame_count, said);
    AgreementTable table(rig, moments, sigma);
    std::vector<FilmPlace> places(rig.cameras.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i].camera = i;
    }
    ViewOrder order;
    bool is_good = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Agreement own = table.of(i, places);
        order.agreement_as_named.push_back(own.share());
        is_good = is_good && (own.possible == 0.0 || own.share() >= kGoodAgreement);
    }
    while (!is_good) {
        std::vector<FilmPlace> better = best_change(table, places);
        is_good = better == places;
        places = std::move(better);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        order.places.push_back(places[i].camera);
        order.mirrored.push_back(places[i].mirrored);
        order.agreement.push_back(table.of(i, places).share());
    }
    return order;
}

Expected<void> check_view_order(const Rig& rig,
                                FrameViews& views,
                                std::size_t frame_count,
                                const std::vector<SaidView>& said,
                                double sigma) {
    const ViewOrder order = find_view_order(rig, views, frame_count, said, sigma);
    const std::vector<std::size_t> wrong = order.wrong();
    if (wrong.empty()) {
        return check_labels_agree(rig, said);
    }
    const auto name = [&rig](std::size_t camera) {
        return printable(rig.cameras[camera].name, 40);
    };
    std::vector<std::string> parts;
    bool is_any_moved = false;
    for (const std::size_t camera : wrong) {
        const std::size_t place = order.places[camera];
        is_any_moved = is_any_moved || place != camera;
        parts.push_back(fmt::format(
            "the film of camera \"{}\" fits {}{} ({:.0f} % of its spots agree with the other "
            "films, not {:.0f})",
            name(camera),
            place != camera ? fmt::format("the place of \"{}\"", name(place)) : "its place",
            order.mirrored[camera] ? (place != camera ? ", mirrored" : " when it is mirrored") : "",
            100.0 * order.agreement[camera],
            100.0 * order.agreement_as_named[camera]));
    }
    return fail(fmt::format(
        "{}: {}",
        fmt::join(parts, "; "),
        is_any_moved ? "exchange them in capture.toml" : "flip its picture from left to right"));
}

}  // namespace raks::capture
