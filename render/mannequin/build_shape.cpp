#include "render/mannequin/build_shape.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "render/mannequin/costume_shape.hpp"

namespace raks::render {
namespace {

/// How far a solid of the lead is thicker than the follow's: across and in depth; 0: it lacks it.
struct Girth {
    std::string_view name;
    float across;
    float depth;
};

// By eye: shoulders and neck broader, waist straight, hips narrow, limbs thicker, jaw square.
constexpr std::array kLeadGirths = {
    Girth{"bust", 0.0F, 0.0F},
    Girth{"chin", 1.30F, 1.02F},
    Girth{"jaw", 1.35F, 1.35F},
    Girth{"neck", 1.16F, 1.16F},
    Girth{"sternomastoid", 1.15F, 1.15F},
    Girth{"trapezius", 1.25F, 1.20F},
    Girth{"deltoid", 1.10F, 1.10F},
    Girth{"upper_arm", 1.13F, 1.13F},
    Girth{"forearm", 1.12F, 1.10F},
    Girth{"lat", 1.15F, 1.05F},
    Girth{"glute", 0.94F, 0.86F},
    Girth{"thigh", 0.99F, 1.0F},
};

// The torso's stations of body_primitives in the lead's build: a straight waist, a flat chest.
constexpr std::array kLeadTorso = {
    // t, half width, half front, half back, shift to the side, shift to the front
    Station{0.845F, 0.118F, 0.07F, 0.080F, 0.0F, -0.006F},
    Station{0.88F, 0.144F, 0.082F, 0.090F, 0.0F, -0.01F},
    Station{0.92F, 0.153F, 0.088F, 0.093F, 0.0F, -0.01F},
    Station{0.96F, 0.149F, 0.090F, 0.086F, 0.0F, -0.006F},
    Station{1.01F, 0.140F, 0.088F, 0.078F, 0.0F, -0.002F},
    Station{1.06F, 0.133F, 0.087F, 0.074F, 0.0F, -0.002F},
    Station{1.11F, 0.133F, 0.090F, 0.078F, 0.0F, -0.006F},
    Station{1.16F, 0.140F, 0.097F, 0.085F, 0.0F, -0.01F},
    Station{1.215F, 0.149F, 0.106F, 0.091F, 0.0F, -0.014F},
    Station{1.27F, 0.155F, 0.107F, 0.093F, 0.0F, -0.02F},
    Station{1.32F, 0.155F, 0.092F, 0.086F, 0.0F, -0.026F},
    Station{1.36F, 0.138F, 0.068F, 0.073F, 0.0F, -0.03F},
    Station{1.392F, 0.098F, 0.048F, 0.058F, 0.0F, -0.032F},
    Station{1.415F, 0.062F, 0.040F, 0.048F, 0.0F, -0.032F},
};

// A trouser leg: straight from the knee to a hem over the shoe.
constexpr std::array kTrouserLeg = {
    Station{-0.03F, 0.0530F, 0.053F, 0.054F, 0.0F, -0.002F},
    Station{0.05F, 0.0545F, 0.054F, 0.060F, 0.001F, -0.004F},
    Station{0.135F, 0.0570F, 0.054F, 0.066F, 0.001F, -0.006F},
    Station{0.25F, 0.0560F, 0.055F, 0.064F, 0.0F, -0.004F},
    Station{0.33F, 0.0555F, 0.056F, 0.064F, 0.0F, -0.002F},
    Station{0.362F, 0.0560F, 0.058F, 0.064F, 0.0F, 0.0F},
};

ShapedPrimitive with_stations(const Primitive& primitive, std::span<const Station> stations) {
    ShapedPrimitive made{primitive, {stations.begin(), stations.end()}};
    return made;
}

void widen(const Girth& girth, ShapedPrimitive& made) {
    if (auto* loft = std::get_if<Loft>(&made.primitive.shape)) {
        made.stations.assign(loft->stations.begin(), loft->stations.end());
        for (Station& station : made.stations) {
            station.half_width *= girth.across;
            station.half_front *= girth.depth;
            station.half_back *= girth.depth;
        }
    } else if (auto* cone = std::get_if<RoundCone>(&made.primitive.shape)) {
        cone->radius_a *= girth.across;
        cone->radius_b *= girth.across;
    } else if (auto* ellipsoid = std::get_if<Ellipsoid>(&made.primitive.shape)) {
        ellipsoid->radii.x *= girth.across;
        ellipsoid->radii.z *= girth.depth;
    }
}

/// In a unitard.
std::optional<ShapedPrimitive> built(const Primitive& primitive, MannequinBuild build) {
    ShapedPrimitive made{primitive, {}};
    if (build == MannequinBuild::follow) {
        return made;
    }
    if (primitive.name == "torso") {
        return with_stations(primitive, kLeadTorso);
    }
    if (primitive.name == "shank") {
        ShapedPrimitive leg = with_stations(primitive, kTrouserLeg);
        std::get<Loft>(leg.primitive.shape).cap_end = 0.006F;
        return leg;
    }
    const auto* const girth =
        std::find_if(kLeadGirths.begin(), kLeadGirths.end(), [&](const Girth& g) {
            return g.name == primitive.name;
        });
    if (girth != kLeadGirths.end()) {
        if (girth->across == 0.0F) {
            return std::nullopt;
        }
        widen(*girth, made);
    }
    return made;
}

}  // namespace

std::optional<ShapedPrimitive> shaped(const Primitive& primitive, MannequinStyle style) {
    std::optional<ShapedPrimitive> made = built(primitive, style.build);
    return made ? dressed(std::move(*made), style) : std::nullopt;
}

}  // namespace raks::render
