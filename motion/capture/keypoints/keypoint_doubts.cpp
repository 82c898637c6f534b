#include "motion/capture/keypoints/keypoint_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace raks::capture {
namespace {

constexpr double kLeastSomebody = 0.2;   // of the pictures, or there is nobody
constexpr double kLeastWhole = 0.3;      // likewise, or there is no whole body
constexpr double kUsualSomebody = 0.95;  // fewer is worth a line
constexpr double kUsualWhole = 0.8;      // likewise
constexpr double kSeldomSeveral = 0.05;  // of the pictures that were looked at

constexpr std::array<std::pair<BodyPoint, BodyPoint>, 3> kWholeBody = {
    {{BodyPoint::left_hip, BodyPoint::right_hip},
     {BodyPoint::left_knee, BodyPoint::right_knee},
     {BodyPoint::left_ankle, BodyPoint::right_ankle}}};

bool lies_in_picture(const Keypoint& point, const KeypointFilm& film) {
    return point.pixel.x > -0.5 && point.pixel.y > -0.5 && point.pixel.x < film.width - 0.5 &&
           point.pixel.y < film.height - 0.5;
}

// Hips, knees and ankles are in the picture; from the side one leg hides the other.
bool shows_whole_body(const KeypointPicture& picture, const KeypointFilm& film) {
    return std::all_of(kWholeBody.begin(), kWholeBody.end(), [&](const auto& pair) {
        const Keypoint& left = picture[pair.first];
        const Keypoint& right = picture[pair.second];
        return std::max(left.visibility, right.visibility) >= kSeenVisibility &&
               lies_in_picture(left, film) && lies_in_picture(right, film);
    });
}

}  // namespace

KeypointShares keypoint_shares(const KeypointFilm& film) {
    KeypointShares shares;
    shares.pictures = film.pictures.size();
    std::size_t somebody = 0;
    std::size_t whole = 0;
    for (const KeypointPicture& picture : film.pictures) {
        somebody += picture.score > 0.0 ? 1U : 0U;
        whole += picture.score > 0.0 && shows_whole_body(picture, film) ? 1U : 0U;
        shares.looked += picture.people ? 1U : 0U;
        shares.several += picture.people.value_or(0) > 1 ? 1U : 0U;
    }
    const double all = static_cast<double>(std::max<std::size_t>(shares.pictures, 1));
    shares.somebody = static_cast<double>(somebody) / all;
    shares.whole_body = static_cast<double>(whole) / all;
    return shares;
}

std::string why_no_dance(const KeypointShares& shares) {
    if (shares.pictures == 0) {
        return "has no pictures";
    }
    if (shares.somebody < kLeastSomebody) {
        return fmt::format(
            "nobody is visible in {:.0f} % of its {} pictures: film one dancer, whole, in light",
            100.0 * (1.0 - shares.somebody),
            shares.pictures);
    }
    if (shares.whole_body < kLeastWhole) {
        return fmt::format(
            "no whole body is visible (hips, knees and ankles in {:.0f} % of its {} pictures): "
            "film "
            "the dancer from head to feet",
            100.0 * shares.whole_body,
            shares.pictures);
    }
    return {};
}

std::vector<std::string> keypoint_doubts(const KeypointShares& shares) {
    std::vector<std::string> doubts;
    if (shares.somebody < kUsualSomebody) {
        doubts.push_back(fmt::format("nobody is visible in {:.0f} % of its pictures",
                                     100.0 * (1.0 - shares.somebody)));
    }
    if (shares.whole_body < kUsualWhole) {
        doubts.push_back(
            fmt::format("hips, knees and ankles are visible in {:.0f} % of its pictures",
                        100.0 * shares.whole_body));
    }
    if (static_cast<double>(shares.several) >
        kSeldomSeveral * static_cast<double>(std::max<std::size_t>(shares.looked, 1))) {
        doubts.push_back(
            fmt::format("several people are visible in {} of {} pictures that were looked at: only "
                        "one is followed, and may be another one from time to time",
                        shares.several,
                        shares.looked));
    }
    return doubts;
}

}  // namespace raks::capture
