#include "motion/skeleton/formats/mmd/vmd_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "base/pending_file.hpp"
#include "motion/skeleton/formats/mmd/mmd_morphs.hpp"
#include "motion/skeleton/formats/mmd/mmd_text.hpp"
#include "motion/skeleton/formats/mmd/vmd.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr std::size_t kLongestGap = 90;  // frames between two keys of what moves

// What one bone does, by frame.
struct BoneFrames {
    std::vector<glm::vec3> places;
    std::vector<glm::quat> turns;
};

// The frames that get a key: each gap between two is as long as what lies in it stays near the line
// between them. `is_near(from, to, frame)`.
template <typename IsNear>
std::vector<std::size_t> key_frames(std::size_t frames, const IsNear& is_near) {
    std::vector<std::size_t> keys = {0};
    while (keys.back() + 1 < frames) {
        const std::size_t from = keys.back();
        const std::size_t most = std::min(frames - 1, from + kLongestGap);
        std::size_t to = from + 1;
        const auto fits = [&](std::size_t end) {
            for (std::size_t frame = from + 1; frame < end; ++frame) {
                if (!is_near(from, end, frame)) {
                    return false;
                }
            }
            return true;
        };
        while (to < most && fits(to + 1)) {
            ++to;
        }
        keys.push_back(to);
    }
    return keys;
}

float share_between(std::size_t from, std::size_t to, std::size_t frame) {
    return static_cast<float>(frame - from) / static_cast<float>(to - from);
}

std::vector<std::size_t> bone_key_frames(const BoneFrames& bone,
                                         double place_tolerance,
                                         double turn_tolerance) {
    // The sine of half the angle between two turns.
    const auto turn_between = [](const glm::quat& a, const glm::quat& b) {
        const glm::quat way = glm::conjugate(a) * b;
        return glm::length(glm::vec3(way.x, way.y, way.z));
    };
    constexpr float kStill = 1e-5F;  // metres and radians: rounding
    const bool is_still =
        std::all_of(bone.places.begin(),
                    bone.places.end(),
                    [&](const glm::vec3& place) {
                        return glm::length(place - bone.places.front()) < kStill;
                    }) &&
        std::all_of(bone.turns.begin(), bone.turns.end(), [&](const glm::quat& turn) {
            return turn_between(bone.turns.front(), turn) < kStill;
        });
    if (is_still) {
        return {0};
    }
    const auto far_place = static_cast<float>(place_tolerance);
    const float far_turn = static_cast<float>(std::sin(0.5 * turn_tolerance));
    return key_frames(bone.turns.size(), [&](std::size_t from, std::size_t to, std::size_t frame) {
        const float share = share_between(from, to, frame);
        const glm::vec3 place = glm::mix(bone.places[from], bone.places[to], share);
        if (glm::length(place - bone.places[frame]) > far_place) {
            return false;
        }
        return turn_between(bone.turns[frame],
                            glm::slerp(bone.turns[from], bone.turns[to], share)) <= far_turn;
    });
}

std::vector<std::size_t> morph_key_frames(const std::vector<float>& weights) {
    constexpr float kFar = 0.01F;
    return key_frames(weights.size(), [&](std::size_t from, std::size_t to, std::size_t frame) {
        const float line = std::lerp(weights[from], weights[to], share_between(from, to, frame));
        return std::abs(line - weights[frame]) <= kFar;
    });
}

class VmdWriter {
 public:
    VmdWriter(const Skeleton& skeleton,
              std::span<const Pose> poses,
              double rate,
              std::span<const ExpressionTrack> face,
              const VmdWriteOptions& options)
        : poses_(poses), rate_(rate), options_(options) {
        const double seconds = static_cast<double>(poses.size() - 1) / rate;
        // A pose that lies on the last frame but for rounding is one.
        frames_ = static_cast<std::size_t>(std::floor(seconds * kMmdRate + 1e-6)) + 1;
        sample_bones(skeleton);
        sample_face(face);
    }

    Expected<WrittenVmd> write() {
        WrittenVmd written;
        double place = options_.place_tolerance;
        double turn = options_.turn_tolerance;
        constexpr int kMostDoublings = 8;
        for (choose_keys(place, turn); keys_ > kMostVmdKeys; choose_keys(place, turn)) {
            if (++written.doublings > kMostDoublings) {
                return fail(
                    fmt::format("takes {} keys, of which MikuMikuDance holds {}; write "
                                "less of it",
                                keys_,
                                kMostVmdKeys));
            }
            place *= 2.0;
            turn *= 2.0;
        }
        written.keys = keys_;
        write_head();
        write_bones();
        write_morphs();
        // No camera, no light, no shadow.
        for (int section = 0; section < 3; ++section) {
            put(std::uint32_t{0});
        }
        write_switches();
        written.bytes = std::move(bytes_);
        return written;
    }

 private:
    void sample_bones(const Skeleton& skeleton) {
        const MmdBody body;
        for (std::size_t frame = 0; frame < frames_; ++frame) {
            const Pose pose = pose_between(poses_, static_cast<double>(frame) * rate_ / kMmdRate);
            const MmdPose keys = mmd_pose_of(body, skeleton, pose, options_.legs);
            for (std::size_t bone = 0; bone < kMmdBones; ++bone) {
                bones_[bone].places.emplace_back(keys.places[bone]);
                bones_[bone].turns.emplace_back(keys.turns[bone]);
            }
        }
    }

    void sample_face(std::span<const ExpressionTrack> face) {
        for (const ExpressionTrack& track : face) {
            const std::string_view morph = mmd_morph_of(track.name);
            if (morph.empty() || track.weights.empty()) {
                continue;
            }
            std::vector<float> weights;
            for (std::size_t frame = 0; frame < frames_; ++frame) {
                const double at = static_cast<double>(frame) * rate_ / kMmdRate;
                const std::size_t last = track.weights.size() - 1;
                const std::size_t from = std::min(static_cast<std::size_t>(at), last);
                weights.push_back(std::lerp(track.weights[from],
                                            track.weights[std::min(from + 1, last)],
                                            static_cast<float>(at - std::floor(at))));
            }
            morphs_.emplace_back(morph, std::move(weights));
        }
    }

    // A bone that never leaves its rest needs no key.
    bool is_written(std::size_t bone) const {
        const BoneFrames& frames = bones_[bone];
        return std::any_of(frames.turns.begin(),
                           frames.turns.end(),
                           [](const glm::quat& turn) { return std::abs(turn.w) < 1.0F; }) ||
               std::any_of(frames.places.begin(), frames.places.end(), [](const glm::vec3& place) {
                   return place != glm::vec3(0.0F);
               });
    }

    void choose_keys(double place_tolerance, double turn_tolerance) {
        keys_ = 0;
        for (std::size_t bone = 0; bone < kMmdBones; ++bone) {
            bone_keys_[bone].clear();
            if (is_written(bone)) {
                bone_keys_[bone] = bone_key_frames(bones_[bone], place_tolerance, turn_tolerance);
            }
            keys_ += bone_keys_[bone].size();
        }
        morph_keys_.clear();
        for (const auto& [name, weights] : morphs_) {
            morph_keys_.push_back(morph_key_frames(weights));
            keys_ += morph_keys_.back().size();
        }
    }

    template <typename Number>
    void put(Number value) {
        std::array<char, sizeof(Number)> raw{};
        std::memcpy(raw.data(), &value, raw.size());
        bytes_.append(raw.data(), raw.size());
    }
    void put_name(std::string_view utf8, std::size_t field) {
        // All names that are written are standard ones.
        std::string name = mmd_bytes(utf8, MmdCode::windows_932).value_or("");
        name.resize(field, '\0');
        bytes_ += name;
    }

    void write_head() {
        std::string head = "Vocaloid Motion Data 0002";
        head.resize(30, '\0');
        bytes_ = head;
        put_name("Raks", 20);
    }

    void write_bones() {
        std::size_t count = 0;
        for (const auto& keys : bone_keys_) {
            count += keys.size();
        }
        put(static_cast<std::uint32_t>(count));
        for (std::size_t bone = 0; bone < kMmdBones; ++bone) {
            const std::string name = mmd_name(static_cast<MmdBone>(bone));
            for (const std::size_t frame : bone_keys_[bone]) {
                put_name(name, kMmdNameBytes);
                put(static_cast<std::uint32_t>(frame));
                const glm::vec3 place = bones_[bone].places[frame] / static_cast<float>(kMmdMetres);
                const glm::quat& turn = bones_[bone].turns[frame];
                for (const float number :
                     {place.x, place.y, -place.z, -turn.x, -turn.y, turn.z, turn.w}) {
                    put(number);
                }
                write_straight_curves();
            }
        }
    }

    // Sixteen numbers, handle by handle, each of x, y, z and the turn; each row begins one number
    // later. Two bytes of the first row are the physics' switch: on.
    void write_straight_curves() {
        constexpr MmdCurve kStraight;
        std::array<std::uint8_t, 16> numbers{};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i] = i < 8 ? kStraight.x1 : kStraight.x2;
        }
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const bool is_switch = row == 0 && (i == 2 || i == 3);
                const bool is_past = i + row >= numbers.size();
                put(is_switch || is_past ? std::uint8_t{0} : numbers[i + row]);
            }
        }
    }

    void write_morphs() {
        std::size_t count = 0;
        for (const auto& keys : morph_keys_) {
            count += keys.size();
        }
        put(static_cast<std::uint32_t>(count));
        for (std::size_t morph = 0; morph < morphs_.size(); ++morph) {
            for (const std::size_t frame : morph_keys_[morph]) {
                put_name(morphs_[morph].first, kMmdNameBytes);
                put(static_cast<std::uint32_t>(frame));
                put(morphs_[morph].second[frame]);
            }
        }
    }

    void write_switches() {
        put(std::uint32_t{1});
        put(std::uint32_t{0});  // frame
        put(std::uint8_t{1});   // the model is shown
        put(std::uint32_t{4});
        for (const Side side : kSides) {
            for (const MmdBone bone : {MmdBone::left_leg_ik, MmdBone::left_toe_ik}) {
                put_name(mmd_name(on_side(bone, side)), kMmdSwitchBytes);
                put(std::uint8_t{options_.legs == MmdLegs::ik ? std::uint8_t{1} : std::uint8_t{0}});
            }
        }
    }

    std::span<const Pose> poses_;
    double rate_;
    VmdWriteOptions options_;
    std::size_t frames_ = 0;
    std::array<BoneFrames, kMmdBones> bones_;
    std::vector<std::pair<std::string_view, std::vector<float>>> morphs_;
    std::array<std::vector<std::size_t>, kMmdBones> bone_keys_;
    std::vector<std::vector<std::size_t>> morph_keys_;
    std::size_t keys_ = 0;
    std::string bytes_;
};

Expected<void> check_motion(std::span<const Pose> poses, double rate) {
    if (poses.empty()) {
        return fail("no poses to write");
    }
    if (!(rate > 0.0) || !std::isfinite(rate)) {
        return fail(fmt::format("{} poses a second, must be > 0", rate));
    }
    if (static_cast<double>(poses.size() - 1) / rate * kMmdRate > kMostMmdFrames) {
        return fail("is more than an hour; write less of it");
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!is_finite(poses[i])) {
            return fail(fmt::format("pose {} is not finite", i));
        }
    }
    return {};
}

}  // namespace

Expected<WrittenVmd> vmd_bytes(const Skeleton& skeleton,
                               std::span<const Pose> poses,
                               double poses_per_second,
                               std::span<const ExpressionTrack> face,
                               const VmdWriteOptions& options) {
    if (auto checked = check_motion(poses, poses_per_second); !checked) {
        return fail(std::move(checked.error()));
    }
    return VmdWriter(skeleton, poses, poses_per_second, face, options).write();
}

Expected<std::string> write_vmd(const std::filesystem::path& path,
                                const Skeleton& skeleton,
                                std::span<const Pose> poses,
                                double poses_per_second,
                                std::span<const ExpressionTrack> face,
                                const VmdWriteOptions& options) {
    auto written = vmd_bytes(skeleton, poses, poses_per_second, face, options);
    if (!written) {
        return fail(std::move(written.error()).in(path.string()));
    }
    if (auto done = write_file(path, written->bytes); !done) {
        return fail(std::move(done.error()));
    }
    if (written->doublings == 0) {
        return std::string();
    }
    return fmt::format(
        "{}: the motion is up to {} times coarser than usual, so that MikuMikuDance "
        "holds its {} keys",
        path.string(),
        1 << written->doublings,
        written->keys);
}

}  // namespace raks::motion
