#include "engine/outputs/vmc_target.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "engine/live/stage_state.hpp"

namespace raks::engine {
namespace {

constexpr std::uint16_t kVmcPort = 39539;
constexpr double kUsualFrames = 60.0;
constexpr double kMostFrames = 120.0;
constexpr double kLongestWay = 4.0;
constexpr std::array<std::string_view, 3> kTravels = {"hips", "root", "none"};
constexpr std::array<std::string_view, 3> kRotations = {"auto", "normalised", "raw"};

}  // namespace

Expected<VmcTarget> read_vmc_target(const std::string& target) {
    TargetReader reader(target);
    VmcTarget read;
    read.place = reader.host_port(kVmcPort);
    const double dancer = reader.number("dancer", 1.0, 1.0, motion::Ensemble::kMost);
    if (dancer != std::floor(dancer)) {
        reader.complain("dancer= counts the dancers: 1, 2, ...");
    }
    read.dancer = static_cast<std::size_t>(dancer) - 1;
    read.rate = reader.number("rate", kUsualFrames, 1.0, kMostFrames);
    read.style.travel = static_cast<VmcTravel>(reader.word("travel", kTravels));
    read.style.way = static_cast<float>(reader.number("way", 1.0, 0.0, kLongestWay));
    read.style.rotations = static_cast<VmcRotations>(reader.word("rotations", kRotations));
    read.style.yaw =
        static_cast<float>(reader.number("yaw", 0.0, -360.0, 360.0) * std::numbers::pi / 180.0);
    read.lead = reader.lead();
    if (auto done = reader.finish(); !done) {
        return fail(done.error());
    }
    return read;
}

}  // namespace raks::engine
