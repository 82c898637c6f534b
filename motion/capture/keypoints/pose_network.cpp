#include "motion/capture/keypoints/pose_network.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/file.hpp"
#include "motion/capture/calibration/one_thread.hpp"
#include "motion/capture/keypoints/pose_model_file.hpp"

#include <opencv2/core.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

namespace raks::capture {
namespace {

constexpr int kDetectorSide = 224;          // pixels of its input
constexpr int kJointsSide = 256;            // likewise
constexpr int kBoxNumbers = 12;             // of the detector's: centre, size, four points
constexpr int kPointNumbers = 5;            // x, y, z, visibility, presence
constexpr std::size_t kHipsPoint = 33;      // of the landmarks: where the next square is
constexpr std::size_t kOnCirclePoint = 34;  // likewise
constexpr double kSureByHalf = 0.5;
constexpr double kSamePerson = 0.3;  // overlap of squares; MediaPipe's suppression

double logistic(float value) {
    return 1.0 / (1.0 + std::exp(-std::clamp(double{value}, -100.0, 100.0)));
}

// The places of the detector's boxes: two in each cell of the grids of 28 and 14, six in that of 7.
std::vector<glm::dvec2> detector_anchors() {
    std::vector<glm::dvec2> anchors;
    for (const auto& [cells, boxes] : {std::pair(28, 2), std::pair(14, 2), std::pair(7, 6)}) {
        for (int y = 0; y < cells; ++y) {
            for (int x = 0; x < cells; ++x) {
                anchors.insert(anchors.end(),
                               static_cast<std::size_t>(boxes),
                               (glm::dvec2(x, y) + 0.5) / static_cast<double>(cells));
            }
        }
    }
    return anchors;
}

// A square of a picture as a network takes it: channel by channel, levels by scale and offset.
// What lies beyond the picture is black.
cv::Mat cut_out(
    const PictureView& picture, const PoseSquare& square, int side, double scale, double offset) {
    // OpenCV's warp takes no const; it does not write.
    const cv::Mat whole(picture.height,
                        picture.width,
                        CV_8UC3,
                        const_cast<std::uint8_t*>(picture.rgb.data()));  // NOLINT
    const auto at = [&](double x, double y) {
        return square.to_picture((glm::dvec2(x, y) + 0.5) / static_cast<double>(side));
    };
    const glm::dvec2 origin = at(0, 0);
    const glm::dvec2 right = at(1, 0) - origin;
    const glm::dvec2 down = at(0, 1) - origin;
    const cv::Matx23d warp(right.x, down.x, origin.x, right.y, down.y, origin.y);
    cv::Mat cut;
    cv::warpAffine(whole,
                   cut,
                   warp,
                   {side, side},
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_CONSTANT);
    cv::Mat levels;
    cut.convertTo(levels, CV_32F, scale, offset);
    return cv::dnn::blobFromImage(levels);
}

PoseSquare whole_picture(const PictureView& picture) {
    return {(glm::dvec2(picture.width, picture.height) - 1.0) / 2.0,
            static_cast<double>(std::max(picture.width, picture.height)),
            0.0};
}

Expected<std::pair<KnownPoseNetwork, std::string>> load_pose_file(
    const std::filesystem::path& path) {
    auto bytes = read_file(path);
    if (!bytes) {
        return fail(bytes.error());
    }
    auto known = known_pose_network(*bytes);
    auto onnx = known ? pose_file_as_onnx(*bytes) : fail(known.error());
    if (!onnx) {
        return fail(Error(onnx.error()).in(path.string()));
    }
    return std::pair(*known, std::move(*onnx));
}

}  // namespace

struct PoseNetwork::Networks {
    cv::dnn::Net detector;
    cv::dnn::Net joints;
    std::vector<glm::dvec2> anchors = detector_anchors();
};

Expected<PoseModels> load_pose_models(const std::filesystem::path& detector,
                                      const std::filesystem::path& joints) {
    auto one = load_pose_file(detector);
    auto other = one ? load_pose_file(joints) : fail(one.error());
    if (!other) {
        return fail(other.error());
    }
    if (one->first.kind != PoseNetworkKind::detector) {
        return fail(detector.string() + ": finds joints, and must be the detector");
    }
    if (other->first.kind != PoseNetworkKind::joints) {
        return fail(joints.string() +
                    ": is the detector, and must find joints: lite, full or heavy");
    }
    return PoseModels{
        std::move(one->second), std::move(other->second), std::string(other->first.name)};
}

PoseNetwork::PoseNetwork(std::unique_ptr<Networks> networks) : networks_(std::move(networks)) {}
PoseNetwork::PoseNetwork(PoseNetwork&& other) noexcept = default;
PoseNetwork& PoseNetwork::operator=(PoseNetwork&& other) noexcept = default;
PoseNetwork::~PoseNetwork() = default;

Expected<PoseNetwork> PoseNetwork::create(const PoseModels& models) {
    use_one_thread();
    auto networks = std::make_unique<Networks>();
    try {
        for (const auto& [onnx, net] : {std::pair(&models.detector, &networks->detector),
                                        std::pair(&models.joints, &networks->joints)}) {
            *net = cv::dnn::readNetFromONNX(onnx->data(), onnx->size());
            net->setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
            net->setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
        }
    } catch (const cv::Exception& problem) {
        return fail("OpenCV does not take a pose network: " + problem.err);
    }
    return PoseNetwork(std::move(networks));
}

std::vector<DetectedPerson> PoseNetwork::detect(const PictureView& picture) {
    const PoseSquare whole = whole_picture(picture);
    networks_->detector.setInput(cut_out(picture, whole, kDetectorSide, 1.0 / 127.5, -1.0));
    std::vector<cv::Mat> outputs;
    networks_->detector.forward(outputs, std::vector<cv::String>{"boxes", "scores"});
    const auto* const boxes = outputs[0].ptr<float>();
    const auto* const scores = outputs[1].ptr<float>();
    std::vector<DetectedPerson> found;
    for (std::size_t i = 0; i < networks_->anchors.size(); ++i) {
        const double score = logistic(scores[i]);
        if (score < kSureByHalf) {
            continue;
        }
        const float* const numbers = boxes + i * kBoxNumbers;
        const auto place = [&](std::size_t point) {
            return whole.to_picture(networks_->anchors[i] +
                                    glm::dvec2(numbers[4 + 2 * point], numbers[5 + 2 * point]) /
                                        double{kDetectorSide});
        };
        found.push_back({pose_square(place(0), place(1)), score});
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& one, const auto& other) {
        return one.score > other.score;
    });
    std::vector<DetectedPerson> people;
    for (const DetectedPerson& one : found) {
        const bool is_new = std::none_of(people.begin(), people.end(), [&](const auto& other) {
            return overlap_of(one.square, other.square) > kSamePerson;
        });
        if (is_new && one.square.side > 0.0) {
            people.push_back(one);
        }
    }
    return people;
}

FoundJoints PoseNetwork::find_joints(const PictureView& picture, const PoseSquare& square) {
    networks_->joints.setInput(cut_out(picture, square, kJointsSide, 1.0 / 255.0, 0.0));
    std::vector<cv::Mat> outputs;
    networks_->joints.forward(outputs, std::vector<cv::String>{"points", "flag"});
    const auto* const numbers = outputs[0].ptr<float>();
    const auto place = [&](std::size_t point) {
        const float* const of_point = numbers + point * kPointNumbers;
        return square.to_picture(glm::dvec2(of_point[0], of_point[1]) / double{kJointsSide});
    };
    FoundJoints found;
    found.score = double{outputs[1].ptr<float>()[0]};
    for (std::size_t point = 0; point < kBodyPoints; ++point) {
        const float* const of_point = numbers + point * kPointNumbers;
        found.points[point] = {place(point), logistic(of_point[3]) * logistic(of_point[4])};
    }
    found.next = pose_square(place(kHipsPoint), place(kOnCirclePoint));
    return found;
}

}  // namespace raks::capture
