// The networks on a picture whose truth is known: the mannequin as a simulated camera filmed it
// (tests/data/pose/README.md).
#include "motion/capture/keypoints/pose_network.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "motion/capture/keypoints/pose_tracker.hpp"
#include "render/import/image_file.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// A picture in colour.
struct ColourPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    [[nodiscard]] PictureView view() const { return {width, height, rgb}; }
    void set(int x, int y, const std::uint8_t* colour) {
        std::copy_n(colour, 3, rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * width + x));
    }
};

ColourPicture grey_picture(int width, int height) {
    const auto size = static_cast<std::size_t>(3 * width * height);
    return {width, height, std::vector<std::uint8_t>(size, 128)};
}

const ColourPicture& dancer() {
    static const ColourPicture picture = [] {
        const auto bytes = read_file(RAKS_SOURCE_DIR "/tests/data/pose/dancer.jpg");
        render::ModelUnpacker unpacker;
        const auto image = render::decode_image(unpacker, std::as_bytes(std::span(*bytes)));
        ColourPicture read{image->width, image->height, {}};
        for (std::size_t i = 0; i < image->pixels.size(); ++i) {
            if (i % 4 != 3) {
                read.rgb.push_back(image->pixels[i]);
            }
        }
        return read;
    }();
    return picture;
}

// The picture turned by 90 degrees clockwise.
ColourPicture turned(const ColourPicture& picture) {
    ColourPicture result = grey_picture(picture.height, picture.width);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            result.set(picture.height - 1 - y, x, picture.view().at(x, y));
        }
    }
    return result;
}

PoseNetwork shipped_network() {
    const std::string folder = RAKS_SOURCE_DIR "/models/pretrained/blazepose_";
    static const auto models = load_pose_models(folder + "detector.pose", folder + "full.pose");
    EXPECT_TRUE(models) << models.error().message;
    auto network = PoseNetwork::create(*models);
    EXPECT_TRUE(network) << network.error().message;
    return std::move(*network);
}

// Where the joints of the mannequin are, by its motion and the camera.
const std::vector<std::pair<BodyPoint, glm::dvec2>> kTruth = {
    {BodyPoint::left_shoulder, {119.2, 70.8}},
    {BodyPoint::right_shoulder, {66.1, 75.9}},
    {BodyPoint::left_elbow, {126.6, 128.5}},
    {BodyPoint::right_elbow, {60.9, 137.7}},
    {BodyPoint::left_wrist, {137.7, 130.3}},
    {BodyPoint::right_wrist, {112.1, 136.3}},
    {BodyPoint::left_hip, {114.9, 174.2}},
    {BodyPoint::right_hip, {84.5, 177.1}},
    {BodyPoint::left_knee, {122.7, 259.6}},
    {BodyPoint::right_knee, {95.1, 265.2}},
    {BodyPoint::left_ankle, {116.9, 337.5}},
    {BodyPoint::right_ankle, {88.5, 346.3}}};

double mean_error(const KeypointPicture& seen) {
    double sum = 0.0;
    for (const auto& [point, place] : kTruth) {
        sum += glm::distance(seen[point].pixel, place);
    }
    return sum / static_cast<double>(kTruth.size());
}

TEST(PoseNetwork, finds_the_joints_of_the_dancer) {
    PoseTracker tracker(shipped_network());
    const KeypointPicture first = tracker.follow(dancer().view());
    EXPECT_GT(first.score, 0.9);
    EXPECT_EQ(first.people, 1U);
    // Measured 7.5 px over a film of such pictures; much of it is where a joint is taken to be.
    EXPECT_LT(mean_error(first), 12.0);
    // The second time it is known where to look.
    const KeypointPicture second = tracker.follow(dancer().view());
    EXPECT_FALSE(second.people);
    EXPECT_LT(mean_error(second), 12.0);
}

TEST(PoseNetwork, a_turned_picture_has_the_joints_turned) {
    const KeypointPicture upright = PoseTracker(shipped_network()).follow(dancer().view());
    const ColourPicture picture = turned(dancer());
    const KeypointPicture seen = PoseTracker(shipped_network()).follow(picture.view());
    double sum = 0.0;
    for (const auto& [point, place] : kTruth) {
        const glm::dvec2 back(seen[point].pixel.y, dancer().height - 1 - seen[point].pixel.x);
        sum += glm::distance(back, upright[point].pixel);
    }
    EXPECT_LT(sum / static_cast<double>(kTruth.size()), 8.0);
}

TEST(PoseNetwork, nobody_and_two_are_counted) {
    const KeypointPicture nobody =
        PoseTracker(shipped_network()).follow(grey_picture(320, 240).view());
    EXPECT_EQ(nobody.people, 0U);
    EXPECT_EQ(nobody.score, 0.0);
    EXPECT_EQ(nobody[BodyPoint::nose], Keypoint{});
    ColourPicture two = grey_picture(3 * dancer().width, dancer().height);
    for (int y = 0; y < dancer().height; ++y) {
        for (int x = 0; x < dancer().width; ++x) {
            two.set(x, y, dancer().view().at(x, y));
            two.set(x + 2 * dancer().width, y, dancer().view().at(x, y));
        }
    }
    EXPECT_EQ(shipped_network().detect(two.view()).size(), 2U);
}

TEST(PoseNetwork, side_by_side_gives_the_same_bits) {
    const auto find = [] { return PoseTracker(shipped_network()).follow(dancer().view()); };
    const KeypointPicture alone = find();
    std::vector<KeypointPicture> seen(2);
    std::vector<std::thread> threads;
    for (KeypointPicture& one : seen) {
        threads.emplace_back([&one, &find] { one = find(); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(seen[0], alone);
    EXPECT_EQ(seen[1], alone);
}

TEST(PoseNetwork, files_in_each_other_s_place_are_refused) {
    const std::string folder = RAKS_SOURCE_DIR "/models/pretrained/blazepose_";
    const auto exchanged = load_pose_models(folder + "full.pose", folder + "detector.pose");
    ASSERT_FALSE(exchanged);
    EXPECT_EQ(exchanged.error().message,
              folder + "full.pose: finds joints, and must be the detector");
}

}  // namespace
}  // namespace raks::capture
