#include "engine/outputs/vmc_output.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "engine/outputs/osc_packet.hpp"
#include "engine/outputs/paced_turns.hpp"
#include "engine/outputs/udp_peer.hpp"
#include "engine/outputs/vmc_puppet.hpp"
#include "engine/outputs/vmc_target.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::uint64_t kAtOnce = 1;  // a bundle's time
// Of the longest names, 88 bytes each: they fit into a packet.
constexpr std::size_t kBonesOfBundle = 13;
// Those who watch stand there, before the dancer; metres.
constexpr glm::vec3 kAudience{0.0F, 1.4F, 4.0F};

// As VRM 0.x names them, which every receiver knows; what it has not, as VRM 1.0 and Raks do. By
// FaceExpression.
constexpr std::array<const char*, render::kFaceExpressionCount> kExpressionNames = {
    "Joy",    "Angry",    "Sorrow",   "Fun",       "Surprised",  "Neutral",     "A",
    "I",      "U",        "E",        "O",         "Blink",      "Blink_L",     "Blink_R",
    "LookUp", "LookDown", "LookLeft", "LookRight", "browUpLeft", "browUpRight",
};

class VmcOutput final : public Output {
 public:
    explicit VmcOutput(const VmcTarget& target)
        : Output({.lead = target.lead}),
          target_(target),
          peer_(target.place),
          turns_(target.rate) {}
    ~VmcOutput() override { say_end(); }

    void tell(const OutputMoment& /*moment*/) override {}
    void turn(const OutputTurn& turn) override;
    [[nodiscard]] bool wants_poses() const override { return true; }
    [[nodiscard]] std::optional<HostTime> due() const override { return turns_.next(); }
    std::optional<std::string> take_trouble() override {
        auto trouble = peer_.take_trouble();
        return trouble ? trouble : std::exchange(trouble_, std::nullopt);
    }

 private:
    void dress(const OutputLook& look);
    [[nodiscard]] render::Face face_at(const StageState& stage,
                                       StreamTime moment,
                                       const motion::Pose& pose);
    void send_bones(const VmcFrame& frame);
    void send_rest(const VmcFrame& frame);
    void send_absence(std::size_t dancers);
    void say_end();
    void add_expressions(std::span<const float, render::kFaceExpressionCount> weights,
                         OscPacket& bundle) const;
    void add_state(std::int32_t is_loaded, OscPacket& bundle) const;
    void send(OscPacket& bundle) { count(peer_.send(bundle.finish())); }
    void complain(const std::string& what) { trouble_ = target_.place.text() + ": " + what; }

    VmcTarget target_;
    UdpPeer peer_;
    PacedTurns turns_;
    std::optional<HostTime> begun_;  // with the first frame
    HostTime now_{};
    OutputLook look_;
    std::optional<VmcPuppet> puppet_;
    std::optional<DancerFace> face_;
    bool has_missed_raw_ = false;     // and said so
    bool has_missed_dancer_ = false;  // likewise
    std::optional<std::string> trouble_;
};

void VmcOutput::turn(const OutputTurn& turn) {
    peer_.turn(turn.now);
    if (!turn.line || !turn.dancers || !turns_.take(turn.now)) {
        return;
    }
    now_ = turn.now;
    begun_ = begun_.value_or(now_);
    const StageState& stage = turn.dancers->stage;
    if (target_.dancer >= stage.dancers) {
        send_absence(stage.dancers);
        return;
    }
    if (stage.tracks[target_.dancer].is_empty()) {
        return;
    }
    dress(turn.dancers->look);
    // What is heard when it arrives.
    const StreamTime moment = turn.line->heard_by(now_ + target_.lead);
    const motion::Pose pose =
        puppet_->worn(stage.tracks[target_.dancer].at(moment), stage.places[target_.dancer]);
    const VmcFrame& frame = puppet_->frame(pose, face_at(stage, moment, pose));
    send_bones(frame);
    send_rest(frame);
}

void VmcOutput::dress(const OutputLook& look) {
    if (puppet_ && look == look_) {
        return;
    }
    look_ = look;
    puppet_.emplace(
        look.avatars.empty() ? nullptr : look.avatars[target_.dancer % look.avatars.size()],
        target_.style);
    face_.emplace(target_.dancer, look.face);
    if (puppet_->lacks_raw() && !std::exchange(has_missed_raw_, true)) {
        complain("rotations=raw needs a VRM 1.0 that is worn; they are normalised");
    }
}

// Two who have one place between them look at each other, others at the audience.
render::Face VmcOutput::face_at(const StageState& stage,
                                StreamTime moment,
                                const motion::Pose& pose) {
    const motion::PoseTrack& track = stage.tracks[target_.dancer];
    FaceMoment face{.time = moment,
                    .level_dbfs = stage.music.level_dbfs,
                    .loudness_lufs = stage.music.loudness_lufs,
                    .gaze_target = kAudience,
                    .head = head_turn_at(track, moment),
                    .feeling = track.feeling_at(moment)};
    if (stage.dancers == 2 && stage.places[0] == stage.places[1]) {
        const std::size_t other = 1 - target_.dancer;
        face.partner =
            head_place(puppet_->skeleton(),
                       puppet_->worn(stage.tracks[other].at(moment), stage.places[other]));
    }
    return face_->face_at(face, puppet_->skeleton(), pose);
}

void VmcOutput::send_bones(const VmcFrame& frame) {
    static const std::string kAddress = "/VMC/Ext/Bone/Pos";
    for (std::size_t first = 0; first < frame.bones.size(); first += kBonesOfBundle) {
        OscPacket bundle(kAtOnce);
        const std::size_t end = std::min(first + kBonesOfBundle, frame.bones.size());
        for (std::size_t i = first; i < end; ++i) {
            const VmcBone& bone = frame.bones[i];
            bundle.add(kAddress,
                       bone.name.c_str(),
                       bone.position.x,
                       bone.position.y,
                       bone.position.z,
                       bone.rotation.x,
                       bone.rotation.y,
                       bone.rotation.z,
                       bone.rotation.w);
        }
        send(bundle);
    }
}

// Expressions, the root, and that all of it is there.
void VmcOutput::send_rest(const VmcFrame& frame) {
    OscPacket bundle(kAtOnce);
    add_expressions(frame.expressions, bundle);
    bundle.add("/VMC/Ext/Root/Pos",
               "root",
               frame.root.x,
               frame.root.y,
               frame.root.z,
               0.0F,
               0.0F,
               0.0F,
               1.0F);
    add_state(1, bundle);
    send(bundle);
}

void VmcOutput::send_absence(std::size_t dancers) {
    OscPacket bundle(kAtOnce);
    add_state(0, bundle);
    send(bundle);
    if (!std::exchange(has_missed_dancer_, true)) {
        complain(
            fmt::format("there is no dancer {}: {} of them dance", target_.dancer + 1, dancers));
    }
}

void VmcOutput::say_end() {
    if (begun_) {
        constexpr std::array<float, render::kFaceExpressionCount> kAtRest{};
        OscPacket bundle(kAtOnce);
        add_expressions(kAtRest, bundle);
        add_state(0, bundle);
        send(bundle);
    }
}

void VmcOutput::add_expressions(std::span<const float, render::kFaceExpressionCount> weights,
                                OscPacket& bundle) const {
    for (std::size_t i = 0; i < weights.size(); ++i) {
        bundle.add("/VMC/Ext/Blend/Val", kExpressionNames[i], weights[i]);
    }
    bundle.add("/VMC/Ext/Blend/Apply");
}

void VmcOutput::add_state(std::int32_t is_loaded, OscPacket& bundle) const {
    bundle.add("/VMC/Ext/OK", is_loaded);
    bundle.add("/VMC/Ext/T", static_cast<float>(to_seconds(now_ - *begun_)));
}

}  // namespace

Expected<std::unique_ptr<Output>> open_vmc(const std::string& target) {
    const auto read = read_vmc_target(target);
    if (!read) {
        return fail("--vmc " + target + ": " + read.error().message);
    }
    return std::make_unique<VmcOutput>(*read);
}

Expected<void> check_vmc(const std::string& target) {
    const auto read = read_vmc_target(target);
    return read ? Expected<void>() : fail(read.error());
}

}  // namespace raks::engine
