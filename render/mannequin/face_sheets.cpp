#include "render/mannequin/face_sheets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/smooth_steps.hpp"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

// All lengths in metres, of the left half: x to the figure's left.
constexpr float kEyeX = 0.0335F;
constexpr float kEyeHalfWidth = 0.0188F;
constexpr float kOpenAbove = 0.0104F;  // from the eye's middle to the lids
constexpr float kOpenBelow = 0.0070F;
constexpr float kOuterCornerUp = 0.0018F;
constexpr float kIris = 0.0091F;
constexpr float kMouthY = 1.5395F;
constexpr float kMouthHalfWidth = 0.0228F;
constexpr float kMouthGap = 0.0008F;  // of closed lips: the dark line between them
constexpr float kTeeth = 0.0042F;
constexpr float kCornersUp = 0.0050F;  // of the mouth at rest: seen from afar a straight one sulks

/// What of a face is the build's.
struct FaceLook {
    float brow = 1.0F;        ///< thickness
    float brow_low = 0.0F;    ///< by how much brows lie lower, metres
    float lips = 1.0F;        ///< thickness
    float lashes = 1.0F;      ///< thickness, and length of the wing
    float eye_height = 1.0F;  ///< of the opening
    glm::vec3 lip_tint{1.0F};
};
FaceLook look_of(MannequinBuild build) noexcept {
    if (build == MannequinBuild::follow) {
        return {};
    }
    return {.brow = 1.40F,
            .brow_low = 0.0014F,
            .lips = 0.72F,
            .lashes = 0.45F,
            .eye_height = 0.92F,
            .lip_tint = {0.86F, 0.98F, 0.95F}};
}

float arch(float u, float power) noexcept { return std::pow(std::max(1.0F - u * u, 0.0F), power); }
/// u from -1 (inner or right end) to 1.
float along(std::uint32_t column, std::uint32_t columns) noexcept {
    return 2.0F * static_cast<float>(column) / static_cast<float>(columns - 1) - 1.0F;
}

/// The lids of one eye in one shape.
class EyeLines {
 public:
    EyeLines(const FaceShape& shape, std::size_t side, const FaceLook& look) noexcept
        : closed_(shape.lids[side]), lower_(shape.lower_lids), height_(look.eye_height) {}

    [[nodiscard]] static float x(float u) noexcept { return kEyeX + kEyeHalfWidth * u; }
    [[nodiscard]] static float tilt(float u) noexcept { return kEyeHeight + kOuterCornerUp * u; }
    [[nodiscard]] float lower(float u) const noexcept {
        return tilt(u) - height_ * kOpenBelow * arch(u - 0.06F, 0.75F) * (1.0F - lower_);
    }
    [[nodiscard]] float upper(float u) const noexcept {
        const float open = tilt(u) + height_ * kOpenAbove * arch(u + 0.10F * (1.0F - u * u), 0.62F);
        const float shut = lower(u) - 0.0004F;
        return open + closed_ * (shut - open);
    }

 private:
    float closed_;
    float lower_;
    float height_;
};

constexpr std::uint32_t kEyeColumns = 13;

Sheet eye_white(const FaceShape& shape, std::size_t side, const FaceLook& look) {
    const EyeLines lines(shape, side, look);
    const EyeLines open(FaceShape{}, side, look);
    Sheet sheet{.rows = 4, .columns = kEyeColumns, .points = {}};
    for (std::uint32_t row = 0; row < sheet.rows; ++row) {
        const float down = static_cast<float>(row) / 3.0F;
        for (std::uint32_t column = 0; column < sheet.columns; ++column) {
            const float u = along(column, sheet.columns);
            // The white stays where it is: lids move over it.
            const float top = open.upper(u) + 0.0022F * arch(u, 0.5F);
            const float bottom = open.lower(u) - 0.0008F * arch(u, 0.5F);
            // The upper lid and its lashes shade the ball; corners are warmer than the middle.
            const float shade = row == 0 ? 0.52F : row == 1 ? 0.86F : 1.0F;
            const float corner = smoothstep(0.55F, 1.0F, std::abs(u));
            sheet.points.push_back({.x = EyeLines::x(u),
                                    .y = top + (bottom - top) * down,
                                    .off = 0.0004F,
                                    .paint = Paint::white,
                                    .tint = shade * glm::mix(glm::vec3(0.86F, 0.86F, 0.87F),
                                                             glm::vec3(0.72F, 0.56F, 0.54F),
                                                             corner)});
        }
    }
    return sheet;
}

struct IrisRing {
    float radius;  // share of the iris
    Paint paint;
    float shade;
};

/// Pupil, iris, and its dark edge; lighter below, as light falls through from above.
Sheet iris(const FaceShape& shape) {
    constexpr std::array kRings = {
        IrisRing{0.0F, Paint::white, 0.012F},
        IrisRing{0.42F, Paint::white, 0.012F},
        IrisRing{0.47F, Paint::iris, 0.75F},
        IrisRing{0.80F, Paint::iris, 1.0F},
        IrisRing{0.90F, Paint::iris, 0.30F},
        IrisRing{1.0F, Paint::iris, 0.22F},
    };
    constexpr std::uint32_t kSpokes = 15;
    Sheet sheet{.rows = kRings.size(), .columns = kSpokes, .points = {}, .is_disc = true};
    for (const IrisRing& ring : kRings) {
        for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
            const float angle = glm::radians(360.0F) * static_cast<float>(spoke) / kSpokes;
            const float below = 0.5F - 0.5F * std::sin(angle);
            const bool is_coloured = ring.radius > 0.45F && ring.radius < 0.85F;
            const float light = is_coloured ? 0.55F + 0.9F * below : 1.0F;
            sheet.points.push_back(
                {.x = kEyeX + shape.gaze_right + kIris * ring.radius * std::cos(angle),
                 .y = kEyeHeight + 0.0008F + shape.gaze_up + kIris * ring.radius * std::sin(angle),
                 .off = 0.0009F,
                 .paint = ring.paint,
                 .tint = glm::vec3(ring.shade * light)});
        }
    }
    return sheet;
}

/// The light that an eye mirrors: what makes it alive. It stays where the light is.
Sheet glint(const FaceShape& shape, float x_off, float y_off, float radius) {
    constexpr std::uint32_t kSpokes = 6;
    Sheet sheet{.rows = 2, .columns = kSpokes, .points = {}, .is_disc = true};
    for (const float share : {0.0F, 1.0F}) {
        for (std::uint32_t spoke = 0; spoke < kSpokes; ++spoke) {
            const float angle = glm::radians(360.0F) * static_cast<float>(spoke) / kSpokes;
            sheet.points.push_back(
                {.x = kEyeX + x_off + 0.7F * shape.gaze_right + radius * share * std::cos(angle),
                 .y = kEyeHeight + y_off + 0.7F * shape.gaze_up + radius * share * std::sin(angle),
                 .off = 0.0012F,
                 .paint = Paint::white,
                 .tint = glm::vec3(1.6F)});
        }
    }
    return sheet;
}

/// Skin from under the brow to the lid's edge.
Sheet upper_lid(const FaceShape& shape, std::size_t side, const FaceLook& look) {
    const EyeLines lines(shape, side, look);
    const EyeLines open(FaceShape{}, side, look);
    Sheet sheet{.rows = 4, .columns = kEyeColumns, .points = {}};
    constexpr std::array kDown = {0.0F, 0.28F, 0.75F, 1.0F};
    constexpr std::array kOff = {-0.0008F, 0.0017F, 0.0021F, 0.0019F};
    constexpr std::array kShade = {1.0F, 0.97F, 0.88F, 0.80F};
    for (std::size_t row = 0; row < kDown.size(); ++row) {
        for (std::uint32_t column = 0; column < sheet.columns; ++column) {
            const float u = along(column, sheet.columns);
            const float top = open.upper(u) + 0.0082F * arch(u, 0.5F) + 0.0010F;
            const float wider = 1.0F + 0.10F * (1.0F - kDown[row]);
            sheet.points.push_back({.x = kEyeX + kEyeHalfWidth * 1.04F * wider * u,
                                    .y = top + (lines.upper(u) - top) * kDown[row],
                                    .off = kOff[row] * arch(u, 0.35F) - 0.0004F * u * u,
                                    .paint = Paint::skin,
                                    .tint = kShade[row] * glm::vec3(1.0F, 0.97F, 0.96F)});
        }
    }
    return sheet;
}

Sheet lower_lid(const FaceShape& shape, std::size_t side, const FaceLook& look) {
    const EyeLines lines(shape, side, look);
    Sheet sheet{.rows = 3, .columns = kEyeColumns, .points = {}};
    constexpr std::array kOff = {0.0017F, 0.0016F, -0.0010F};
    constexpr std::array kDown = {0.0F, 0.0042F, 0.0092F};
    constexpr std::array kShade = {0.66F, 0.95F, 1.0F};
    for (std::size_t row = 0; row < kOff.size(); ++row) {
        for (std::uint32_t column = 0; column < sheet.columns; ++column) {
            const float u = along(column, sheet.columns);
            sheet.points.push_back({.x = EyeLines::x(u),
                                    .y = lines.lower(u) - kDown[row] * arch(u, 0.4F),
                                    .off = kOff[row] * arch(u, 0.35F) - 0.0004F * u * u,
                                    .paint = Paint::skin,
                                    .tint = kShade[row] * glm::vec3(1.0F, 0.97F, 0.96F)});
        }
    }
    return sheet;
}

/// Lashes along the upper lid, thick outside, with a wing over the outer corner.
Sheet lashes(const FaceShape& shape, std::size_t side, const FaceLook& look) {
    const EyeLines lines(shape, side, look);
    Sheet sheet{.rows = 2, .columns = kEyeColumns + 1, .points = {}};
    for (std::uint32_t row = 0; row < 2; ++row) {
        for (std::uint32_t column = 0; column < sheet.columns; ++column) {
            const bool is_wing = column == kEyeColumns;
            const float u = is_wing ? 1.0F : along(column, kEyeColumns);
            const float thick =
                is_wing ? 0.0003F : look.lashes * (0.0008F + 0.0011F * smoothstep(-1.0F, 0.7F, u));
            const float rise = is_wing ? look.lashes * 0.0022F : 0.0F;
            sheet.points.push_back(
                {.x = EyeLines::x(u) + (is_wing ? look.lashes * 0.0034F : 0.0006F * u),
                 .y = lines.upper(u) + rise + (row == 0 ? 0.62F * thick : -0.55F * thick),
                 .off = 0.0024F,
                 .paint = Paint::hair,
                 .tint = glm::vec3(0.35F)});
        }
    }
    return sheet;
}

Sheet brow(const FaceShape& shape, std::size_t side, const FaceLook& look) {
    constexpr std::uint32_t kColumns = 10;
    Sheet sheet{.rows = 3, .columns = kColumns, .points = {}};
    for (std::uint32_t row = 0; row < 3; ++row) {
        const float across = 1.0F - static_cast<float>(row);
        for (std::uint32_t column = 0; column < kColumns; ++column) {
            const float s = 0.5F + 0.5F * along(column, kColumns);  // 0 inner, 1 outer
            // Inner ends hang no lower than outer ones: lower, they frown.
            const float arc = 0.0052F * std::sin(glm::radians(150.0F) * s) + 0.0022F * (1.0F - s);
            const float thick = look.brow * 0.0026F * (1.0F - 0.75F * smoothstep(0.35F, 1.0F, s)) *
                                smoothstep(-0.25F, 0.12F, s);
            const float alone = shape.brow_up[side] * (0.35F + std::sin(glm::radians(150.0F) * s));
            const float rise = shape.brow_inner + (shape.brow_outer - shape.brow_inner) * s + alone;
            sheet.points.push_back({.x = 0.0130F + 0.0420F * s,
                                    .y = 1.6146F - look.brow_low + arc + rise + across * thick,
                                    .off = row == 1 ? 0.0016F : 0.0002F,
                                    .paint = Paint::hair,
                                    .tint = glm::vec3(0.85F)});
        }
    }
    return sheet;
}

/// The lines of the mouth in one shape; u from -1 (right corner) to 1.
class MouthLines {
 public:
    MouthLines(const FaceShape& shape, const FaceLook& look) noexcept
        : lips_(look.lips),
          half_width_(kMouthHalfWidth + shape.mouth_wider),
          open_(shape.mouth_open),
          corners_up_(shape.corners_up) {}

    [[nodiscard]] float x(float u) const noexcept { return half_width_ * u; }
    [[nodiscard]] float middle(float u) const noexcept {
        return kMouthY + (kCornersUp + corners_up_) * u * u - 0.0006F * (1.0F - u * u) -
               0.12F * open_;
    }
    [[nodiscard]] float inner_top(float u) const noexcept {
        return middle(u) + (0.5F * kMouthGap + 0.20F * open_) * arch(u, 0.5F);
    }
    [[nodiscard]] float inner_bottom(float u) const noexcept {
        return middle(u) - (0.5F * kMouthGap + 0.80F * open_) * arch(u, 0.55F);
    }
    [[nodiscard]] float top(float u) const noexcept {
        const float bow = 0.0011F * std::exp(-u * u / 0.035F);
        return inner_top(u) + lips_ * 0.0054F * arch(u, 0.8F) - bow;
    }
    [[nodiscard]] float bottom(float u) const noexcept {
        return inner_bottom(u) - lips_ * 0.0064F * arch(u, 0.75F);
    }

 private:
    float lips_;
    float half_width_;
    float open_;
    float corners_up_;
};

constexpr std::uint32_t kMouthColumns = 17;

Sheet upper_lip(const FaceShape& shape, const FaceLook& look) {
    const MouthLines lines(shape, look);
    Sheet sheet{.rows = 3, .columns = kMouthColumns, .points = {}};
    constexpr std::array kOff = {-0.0003F, 0.0016F, 0.0014F};
    constexpr std::array kShade = {0.95F, 0.86F, 0.62F};
    for (std::size_t row = 0; row < kOff.size(); ++row) {
        for (std::uint32_t column = 0; column < kMouthColumns; ++column) {
            const float u = along(column, kMouthColumns);
            const float down = 0.5F * static_cast<float>(row);
            sheet.points.push_back({.x = lines.x(u),
                                    .y = lines.top(u) + (lines.inner_top(u) - lines.top(u)) * down,
                                    .off = kOff[row] * arch(u, 0.4F) + 0.0002F,
                                    .paint = Paint::lips,
                                    .tint = kShade[row] * look.lip_tint});
        }
    }
    return sheet;
}

Sheet lower_lip(const FaceShape& shape, const FaceLook& look) {
    const MouthLines lines(shape, look);
    Sheet sheet{.rows = 3, .columns = kMouthColumns, .points = {}};
    constexpr std::array kOff = {0.0012F, 0.0026F, -0.0003F};
    constexpr std::array kShade = {0.78F, 1.08F, 0.92F};
    for (std::size_t row = 0; row < kOff.size(); ++row) {
        for (std::uint32_t column = 0; column < kMouthColumns; ++column) {
            const float u = along(column, kMouthColumns);
            const float down = 0.5F * static_cast<float>(row);
            sheet.points.push_back(
                {.x = lines.x(u),
                 .y = lines.inner_bottom(u) + (lines.bottom(u) - lines.inner_bottom(u)) * down,
                 .off = kOff[row] * arch(u, 0.4F) + 0.0002F,
                 .paint = Paint::lips,
                 .tint = kShade[row] * look.lip_tint});
        }
    }
    return sheet;
}

/// Teeth and what is dark behind them.
Sheet inside_of_mouth(const FaceShape& shape, const FaceLook& look) {
    const MouthLines lines(shape, look);
    Sheet sheet{.rows = 5, .columns = kMouthColumns, .points = {}};
    constexpr glm::vec3 kTooth{0.80F, 0.77F, 0.73F};
    constexpr glm::vec3 kDark{0.085F, 0.014F, 0.016F};
    constexpr glm::vec3 kTongue{0.36F, 0.07F, 0.075F};
    for (std::uint32_t row = 0; row < sheet.rows; ++row) {
        for (std::uint32_t column = 0; column < kMouthColumns; ++column) {
            const float u = along(column, kMouthColumns);
            const float top = lines.inner_top(u);
            const float gap = top - lines.inner_bottom(u);
            const float teeth = std::min(kTeeth, std::max(0.55F * gap - kMouthGap, 0.0F));
            const std::array kBelow = {0.0F, teeth, teeth, teeth + 0.45F * (gap - teeth), gap};
            sheet.points.push_back({.x = lines.x(u),
                                    .y = top - kBelow[row],
                                    .off = 0.0004F,
                                    .paint = Paint::white,
                                    .tint = row < 2    ? kTooth
                                            : row == 4 ? kTongue
                                                       : kDark});
        }
    }
    return sheet;
}

}  // namespace

std::vector<Sheet> face_sheets(const FaceShape& shape, MannequinBuild build) {
    const FaceLook look = look_of(build);
    std::vector<Sheet> sheets;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        FaceShape own = shape;
        // The right eye is the left one's image in a mirror, but both look the same way.
        own.gaze_right = side == 0 ? shape.gaze_right : -shape.gaze_right;
        const float light = side == 0 ? -0.0026F : 0.0026F;
        for (Sheet sheet : {eye_white(own, side, look),
                            iris(own),
                            glint(own, light, 0.0038F, 0.0021F),
                            glint(own, -light, -0.0030F, 0.0010F),
                            upper_lid(own, side, look),
                            lower_lid(own, side, look),
                            lashes(own, side, look),
                            brow(own, side, look)}) {
            sheet.is_right = side == 1;
            sheets.push_back(std::move(sheet));
        }
    }
    for (Sheet sheet :
         {inside_of_mouth(shape, look), upper_lip(shape, look), lower_lip(shape, look)}) {
        sheets.push_back(std::move(sheet));
    }
    return sheets;
}

}  // namespace raks::render
