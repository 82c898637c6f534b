// Joints in pictures as OpenPose writes them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/printable.hpp"
#include "motion/capture/keypoints/foreign_keypoints.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using Json = nlohmann::json;

constexpr double kFarthestJoint = 1e5;  // pixels

// OpenPose's bodies, by the number of a joint; nothing: none of ours (neck, middle of the hips).
using MaybePoint = std::optional<BodyPoint>;
constexpr std::array<MaybePoint, 25> kBody25 = {BodyPoint::nose,
                                                std::nullopt,
                                                BodyPoint::right_shoulder,
                                                BodyPoint::right_elbow,
                                                BodyPoint::right_wrist,
                                                BodyPoint::left_shoulder,
                                                BodyPoint::left_elbow,
                                                BodyPoint::left_wrist,
                                                std::nullopt,
                                                BodyPoint::right_hip,
                                                BodyPoint::right_knee,
                                                BodyPoint::right_ankle,
                                                BodyPoint::left_hip,
                                                BodyPoint::left_knee,
                                                BodyPoint::left_ankle,
                                                BodyPoint::right_eye,
                                                BodyPoint::left_eye,
                                                BodyPoint::right_ear,
                                                BodyPoint::left_ear,
                                                BodyPoint::left_foot_index,
                                                std::nullopt,
                                                BodyPoint::left_heel,
                                                BodyPoint::right_foot_index,
                                                std::nullopt,
                                                BodyPoint::right_heel};
constexpr std::array<MaybePoint, 18> kBody18 = {BodyPoint::nose,
                                                std::nullopt,
                                                BodyPoint::right_shoulder,
                                                BodyPoint::right_elbow,
                                                BodyPoint::right_wrist,
                                                BodyPoint::left_shoulder,
                                                BodyPoint::left_elbow,
                                                BodyPoint::left_wrist,
                                                BodyPoint::right_hip,
                                                BodyPoint::right_knee,
                                                BodyPoint::right_ankle,
                                                BodyPoint::left_hip,
                                                BodyPoint::left_knee,
                                                BodyPoint::left_ankle,
                                                BodyPoint::right_eye,
                                                BodyPoint::left_eye,
                                                BodyPoint::right_ear,
                                                BodyPoint::left_ear};

/// A person of a picture.
struct Person {
    std::array<Keypoint, kBodyPoints> points{};
    double sureness = 0.0;  // sum of its likelihoods
    glm::dvec2 middle{};    // of the joints that were found
};

Expected<Keypoint> keypoint_of(std::span<const double> three, std::size_t joint) {
    if (!(three[2] >= 0.0)) {
        return fail(
            fmt::format("the likelihood of joint {} is {}, must be 0 or more", joint, three[2]));
    }
    if (!(std::abs(three[0]) <= kFarthestJoint && std::abs(three[1]) <= kFarthestJoint)) {
        return fail(fmt::format("joint {} does not lie in a picture", joint));
    }
    // Joints that were not found are zeros.
    return three[2] > 0.0 ? Keypoint{{three[0], three[1]}, std::min(three[2], 1.0)} : Keypoint{};
}

Expected<std::vector<double>> joint_numbers(const Json& person) {
    const auto list = person.is_object() ? person.find("pose_keypoints_2d") : person.end();
    if (!person.is_object() || list == person.end() || !list->is_array()) {
        return fail("a person has no list pose_keypoints_2d");
    }
    std::vector<double> numbers;
    for (const Json& number : *list) {
        if (!number.is_number()) {
            return fail("pose_keypoints_2d must hold numbers alone");
        }
        numbers.push_back(number.get<double>());
    }
    return numbers;
}

Expected<Person> read_person(const Json& json) {
    const auto numbers = joint_numbers(json);
    if (!numbers) {
        return fail(numbers.error());
    }
    std::span<const MaybePoint> body = kBody25;
    if (numbers->size() == 3 * kBody18.size()) {
        body = kBody18;
    } else if (numbers->size() != 3 * kBody25.size()) {
        return fail(
            fmt::format("pose_keypoints_2d has {} numbers, must have 75 (25 joints) or 54 (18)",
                        numbers->size()));
    }
    Person person;
    double found = 0.0;
    for (std::size_t joint = 0; joint < body.size(); ++joint) {
        const auto point = keypoint_of(std::span(*numbers).subspan(3 * joint, 3), joint);
        if (!point) {
            return fail(point.error());
        }
        if (body[joint] && point->visibility > 0.0) {
            person.points[static_cast<std::size_t>(*body[joint])] = *point;
            person.sureness += point->visibility;
            person.middle += point->pixel;
            found += 1.0;
        }
    }
    person.middle /= std::max(found, 1.0);
    return person;
}

Expected<std::vector<Person>> read_people(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    if (text.empty()) {
        return fail("is empty: a picture with nobody has an empty list \"people\"");
    }
    if (json.is_discarded()) {
        return fail("is no JSON, or cut off (NaN is none: joints that were not found are zeros)");
    }
    const auto list = json.is_object() ? json.find("people") : json.end();
    if (!json.is_object() || list == json.end() || !list->is_array()) {
        return fail("is not of OpenPose: it has no list \"people\"");
    }
    std::vector<Person> people;
    for (const Json& one : *list) {
        auto person = read_person(one);
        if (!person) {
            return fail(person.error());
        }
        if (person->sureness > 0.0) {
            people.push_back(*person);
        }
    }
    return people;
}

// The last number in a file's name.
std::optional<std::size_t> number_in(std::string_view name) {
    constexpr std::string_view kDigits = "0123456789";
    const std::size_t last = name.find_last_of(kDigits);
    if (last == std::string_view::npos) {
        return std::nullopt;
    }
    const std::size_t before = name.find_last_not_of(kDigits, last);
    const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
    std::size_t number = 0;
    const auto parsed = std::from_chars(name.data() + first, name.data() + last + 1, number);
    constexpr std::size_t kLargestNumber = 100'000'000;
    return parsed.ec == std::errc{} && number <= kLargestNumber ? std::optional(number)
                                                                : std::nullopt;
}

}  // namespace

OpenPoseReader::OpenPoseReader(const ForeignFilm& film)
    : result_{film.camera, film.width, film.height, "openpose", {}},
      pictures_per_second_(film.pictures_per_second) {}

Expected<void> OpenPoseReader::add(std::string_view text, const std::string& file) {
    const auto people = read_people(text);
    const auto number = number_in(file.substr(file.find_last_of('/') + 1));
    if (!people || !number) {
        return fail(file + ": " + (number ? people.error().message : "has no number in its name"));
    }
    if (!result_.pictures.empty() && *number <= result_.pictures.back().number) {
        return fail(fmt::format("{}: its number {} does not come after {}",
                                file,
                                *number,
                                result_.pictures.back().number));
    }
    KeypointPicture& picture = result_.pictures.emplace_back();
    picture.number = *number;
    picture.time = static_cast<double>(*number) / pictures_per_second_;
    picture.people = people->size();
    if (people->empty()) {
        return {};
    }
    const auto rank = [&](const Person& person) {
        return last_ ? glm::distance(person.middle, *last_) : -person.sureness;
    };
    const Person& dancer =
        *std::min_element(people->begin(), people->end(), [&](const auto& one, const auto& other) {
            return rank(one) < rank(other);
        });
    last_ = dancer.middle;
    picture.score = 1.0;
    picture.points = dancer.points;
    return {};
}

}  // namespace raks::capture
