#include "motion/choreography/controls.hpp"

#include <algorithm>
#include <vector>

namespace raks::motion {
namespace {

using Group = ControlGroup;
using Unit = ControlUnit;

// The columns are those of ControlInfo. Limits leave about twice the room that figures use, within
// what bodies can do. Sideways places, rolls and yaws change sign in the mirror.
constexpr std::array<ControlInfo, kControlCount> kControls = {{
    {"hip.x", "", Group::hip, Unit::centimetres, -25, 25, 0, -1},
    {"hip.y", "", Group::hip, Unit::centimetres, -25, 15, 0, 1},
    {"hip.z", "", Group::hip, Unit::centimetres, -20, 20, 0, 1},
    {"hip.roll", "", Group::hip, Unit::degrees, -25, 25, 0, -1},
    {"hip.tilt", "", Group::hip, Unit::degrees, -35, 45, 0, 1},
    {"hip.yaw", "", Group::hip, Unit::degrees, -50, 50, 0, -1},
    {"chest.x", "", Group::chest, Unit::centimetres, -12, 12, 0, -1},
    {"chest.z", "", Group::chest, Unit::centimetres, -12, 12, 0, 1},
    {"chest.roll", "", Group::chest, Unit::degrees, -30, 30, 0, -1},
    {"chest.tilt", "", Group::chest, Unit::degrees, -40, 50, 0, 1},
    {"chest.yaw", "", Group::chest, Unit::degrees, -60, 60, 0, -1},
    {"lean.x", "", Group::lean, Unit::degrees, -35, 35, 0, -1},
    {"lean.z", "", Group::lean, Unit::degrees, -30, 60, 0, 1},
    {"head.tilt", "", Group::head, Unit::degrees, -40, 45, 0, 1},
    {"head.yaw", "", Group::head, Unit::degrees, -70, 70, 0, -1},
    {"knee", "", Group::knee, Unit::degrees, 0, 100, 20, 1},
    {"shoulder.l.up", "shoulders.up", Group::shoulder, Unit::degrees, -15, 30, 0, 1},
    {"arm.l.up", "arms.up", Group::arm, Unit::degrees, -95, 95, -72, 1},
    {"arm.l.front", "arms.front", Group::arm, Unit::degrees, -40, 140, 35, 1},
    {"arm.l.bend", "arms.bend", Group::elbow, Unit::degrees, 0, 150, 28, 1},
    {"arm.l.elbow", "arms.elbow", Group::arm, Unit::degrees, -60, 100, 0, 1},
    {"hand.l.bend", "hands.bend", Group::hand, Unit::degrees, -70, 80, 0, 1},
    {"hand.l.turn", "hands.turn", Group::hand, Unit::degrees, -100, 100, 0, 1},
    {"hand.l.fist", "hands.fist", Group::fist, Unit::share, 0, 1, 0.25, 1},
    {"heel.l", "heels", Group::heel, Unit::degrees, 0, 50, 0, 1},
    {"shoulder.r.up", "shoulders.up", Group::shoulder, Unit::degrees, -15, 30, 0, 1},
    {"arm.r.up", "arms.up", Group::arm, Unit::degrees, -95, 95, -72, 1},
    {"arm.r.front", "arms.front", Group::arm, Unit::degrees, -40, 140, 35, 1},
    {"arm.r.bend", "arms.bend", Group::elbow, Unit::degrees, 0, 150, 28, 1},
    {"arm.r.elbow", "arms.elbow", Group::arm, Unit::degrees, -60, 100, 0, 1},
    {"hand.r.bend", "hands.bend", Group::hand, Unit::degrees, -70, 80, 0, 1},
    {"hand.r.turn", "hands.turn", Group::hand, Unit::degrees, -100, 100, 0, 1},
    {"hand.r.fist", "hands.fist", Group::fist, Unit::share, 0, 1, 0.25, 1},
    {"heel.r", "heels", Group::heel, Unit::degrees, 0, 50, 0, 1},
}};

// Each name once: both sides share their common name.
std::vector<std::string_view> make_names() {
    std::vector<std::string_view> names;
    for (const ControlInfo& info : kControls) {
        names.push_back(info.name);
        const bool is_new = std::find(names.begin(), names.end(), info.both_name) == names.end();
        if (!info.both_name.empty() && is_new) {
            names.push_back(info.both_name);
        }
    }
    return names;
}

}  // namespace

const ControlInfo& info_of(Control control) noexcept { return kControls[index_of(control)]; }

NamedControls controls_named(std::string_view name) noexcept {
    NamedControls named;
    for (std::size_t i = 0; i < kControls.size() && named.count < 2; ++i) {
        if (kControls[i].name == name || kControls[i].both_name == name) {
            named.controls[named.count++] = static_cast<Control>(i);
        }
    }
    return named;
}

std::span<const std::string_view> control_names() noexcept {
    // Built on first use; initialisation is thread-safe.
    static const std::vector<std::string_view> names = make_names();
    return names;
}

}  // namespace raks::motion
