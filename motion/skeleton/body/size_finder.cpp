#include "motion/skeleton/body/size_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/printable.hpp"
#include "base/statistics.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {
namespace {

struct Unit {
    std::string_view name;
    double metres;
};
constexpr std::array<Unit, 6> kUnits = {
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"dm", 0.1}, {"in", 0.0254}, {"ft", 0.3048}}};

constexpr double kMeanHeight = 1.68;      // metres: mean of grown-up people
constexpr double kFallbackHeight = 1.70;  // metres, where no unit fits
constexpr double kMannequinHeight = 1.714;
// Grown-up people; outside, a child, a giant or another unit.
constexpr double kShort = 1.45;
constexpr double kTall = 2.05;
// Outside, no person at all.
constexpr double kShortest = 1.1;
constexpr double kTallest = 2.3;
constexpr double kCmuUnit = 0.0254 / 0.45;  // metres of CMU's ASF files and all conversions
constexpr double kGravity = 9.81;           // metres a second squared

constexpr std::array<Bone, 6> kTrunk = {
    Bone::hips, Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck, Bone::head};

/// Length of the mannequin's bones between two bones of one limb.
double mannequin_length(Bone above, Bone below) {
    double length = 0.0;
    for (Bone bone = below; bone != above && bone != Bone::hips;
         bone = static_cast<Bone>(kBoneParents[index_of(bone)])) {
        length += static_cast<double>(glm::length(mannequin_skeleton().offsets[index_of(bone)]));
    }
    return length;
}

/// Adds a bone's length in the clip and the mannequin.
struct Lengths {
    double clip = 0.0;
    double mannequin = 0.0;

    void add(const PosedBody& body, Bone above, Bone below, double weight) {
        clip += weight * body.distance(above, below);
        mannequin += weight * mannequin_length(above, below);
    }
};

/// Where the frames of one jump lie.
struct Jump {
    std::size_t begin;
    std::size_t end;
};

/// Height of the body's middle and of its lowest foot, frame by frame.
struct Heights {
    std::vector<double> middle;
    std::vector<double> lowest;
};

Heights heights_of(const MotionClip& clip, const HumanoidMapping& mapping, const glm::dvec3& up) {
    Heights heights;
    const std::size_t top =
        mapping.joint(Bone::neck)
            .value_or(mapping.joint(Bone::head).value_or(*mapping.joint(Bone::hips)));
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ClipWorldPose world = world_pose(clip, frame);
        const auto height = [&](std::size_t joint) { return glm::dot(world.positions[joint], up); };
        heights.middle.push_back(0.5 * (height(*mapping.joint(Bone::hips)) + height(top)));
        double lowest = 1e300;
        for (const Side side : kSides) {
            lowest = std::min(
                {lowest,
                 height(*mapping.joint(on_side(Bone::left_foot, side))),
                 glm::dot(toe_tip_of(clip, mapping, side, world.positions, world.rotations), up)});
        }
        heights.lowest.push_back(lowest);
    }
    return heights;
}

/// Acceleration downward of the parabola through a jump's frames; none: it is no parabola.
std::optional<double> fall_of(const std::vector<double>& heights,
                              Jump jump,
                              double rate,
                              double size) {
    // Least squares about the middle: h = a + b t + c t^2, with odd and even parts apart.
    const double n = static_cast<double>(jump.end - jump.begin);
    double s2 = 0.0;
    double s4 = 0.0;
    double h0 = 0.0;
    double h1 = 0.0;
    double h2 = 0.0;
    const auto time = [&](std::size_t frame) {
        return (static_cast<double>(frame - jump.begin) - 0.5 * (n - 1.0)) / rate;
    };
    for (std::size_t frame = jump.begin; frame < jump.end; ++frame) {
        const double t = time(frame);
        s2 += t * t;
        s4 += t * t * t * t;
        h0 += heights[frame];
        h1 += heights[frame] * t;
        h2 += heights[frame] * t * t;
    }
    const double c = (h2 - s2 * h0 / n) / (s4 - s2 * s2 / n);
    const double a = (h0 - c * s2) / n;
    const double b = h1 / s2;
    double error = 0.0;
    for (std::size_t frame = jump.begin; frame < jump.end; ++frame) {
        const double t = time(frame);
        error = std::max(error, std::abs(heights[frame] - a - b * t - c * t * t));
    }
    if (!(c < 0.0) || error > 0.01 * size) {
        return std::nullopt;
    }
    return -2.0 * c;
}

/// What remains where no usual unit makes a person: CMU's, free fall, or a usual height.
FoundSize without_usual_unit(const PosedBody& body, const glm::dvec3& up, double height) {
    FoundSize found;
    const auto take = [&](double metres, double confidence, const char* reason) {
        found.metres_per_unit = metres;
        found.height = height * metres;
        found.confidence = confidence;
        found.reason = reason;
        return found;
    };
    const auto fall = free_fall(body.clip(), body.mapping(), up, height);
    const double falling = fall ? kGravity / *fall : 0.0;
    const auto makes_person = [&](double metres) {
        return height * metres > kShortest && height * metres < kTallest;
    };
    // Jumps are good to a fifth or so; hops that are none make no person.
    constexpr double kAgree = 0.25;
    const bool does_fall = makes_person(falling);
    if (makes_person(kCmuUnit) && (!does_fall || std::abs(std::log(falling / kCmuUnit)) < kAgree)) {
        return take(kCmuUnit, 0.55, "no usual unit, but that of CMU's skeletons");
    }
    if (does_fall) {
        return take(falling, 0.55, "no usual unit, but bodies in the air fall so fast");
    }
    return take(
        kFallbackHeight / height, 0.3, "no usual unit; the body is taken to be 1.70 m tall");
}

}  // namespace

double body_height(const PosedBody& body) {
    Lengths lengths;
    for (const Side side : kSides) {
        lengths.add(
            body, on_side(Bone::left_upper_leg, side), on_side(Bone::left_lower_leg, side), 0.5);
        lengths.add(body, on_side(Bone::left_lower_leg, side), on_side(Bone::left_foot, side), 0.5);
    }
    Bone below = Bone::hips;
    for (const Bone bone : kTrunk) {
        if (body.has(bone) && bone != Bone::hips) {
            lengths.add(body, below, bone, 1.0);
            below = bone;
        }
    }
    return kMannequinHeight * lengths.clip / lengths.mannequin;
}

std::optional<double> free_fall(const MotionClip& clip,
                                const HumanoidMapping& mapping,
                                const glm::dvec3& up,
                                double height) {
    const Heights heights = heights_of(clip, mapping, up);
    // Over the place where the lower foot mostly is.
    const double off = lower_percentile(heights.lowest, 0.05) + 0.05 * height;
    const double rate = clip.frames_per_second;
    constexpr double kLeastSeconds = 0.15;
    std::vector<double> falls;
    for (std::size_t frame = 0; frame < clip.frame_count;) {
        std::size_t end = frame;
        while (end < clip.frame_count && heights.lowest[end] > off) {
            ++end;
        }
        if (static_cast<double>(end - frame) > kLeastSeconds * rate && end - frame >= 5) {
            if (const auto fall = fall_of(heights.middle, {frame, end}, rate, height)) {
                falls.push_back(*fall);
            }
        }
        frame = end + 1;
    }
    return median(falls);
}

FoundSize find_size(const PosedBody& body, const glm::dvec3& up, const SizeOptions& options) {
    FoundSize found;
    const double height = body_height(body);
    if (options.metres_per_unit) {
        found.metres_per_unit = *options.metres_per_unit;
        found.height = height * found.metres_per_unit;
        found.confidence = 1.0;
        found.reason = "given";
        return found;
    }
    if (!(height > 1e-9)) {
        found.reason = "the body has no size";
        return found;
    }
    if (options.height) {
        found.metres_per_unit = *options.height / height;
        found.height = *options.height;
        found.confidence = 1.0;
        found.reason = "by the height that was given";
        return found;
    }
    const auto off = [&](double metres) {
        return std::abs(std::log(height * metres / kMeanHeight));
    };
    const auto best =
        std::min_element(kUnits.begin(), kUnits.end(), [&](const Unit& a, const Unit& b) {
            return off(a.metres) < off(b.metres);
        });
    found.metres_per_unit = best->metres;
    found.height = height * best->metres;
    found.reason = fmt::format("makes the body {:.2f} m tall", found.height);
    if (found.height > kShort && found.height < kTall) {
        found.confidence = 0.95;
        return found;
    }
    if (found.height > kShortest && found.height < kTallest) {
        found.confidence = 0.5;
        return found;
    }
    return without_usual_unit(body, up, height);
}

Expected<double> read_unit(std::string_view text) {
    for (const Unit& unit : kUnits) {
        if (text == unit.name) {
            return unit.metres;
        }
    }
    return fail(
        fmt::format("\"{}\" is not a unit; known: m, dm, cm, mm, in, ft", printable(text, 20)));
}

std::string unit_name(double metres) {
    for (const Unit& unit : kUnits) {
        if (metres == unit.metres) {
            return std::string(unit.name);
        }
    }
    return fmt::format("{:.4g} m", metres);
}

}  // namespace raks::motion
