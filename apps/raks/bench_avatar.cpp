#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/bench.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "motion/formation.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/skin_vertices.hpp"
#include "render/gl/offscreen.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::apps {
namespace {

constexpr float kOwnBody = 1.0F;  // poses are on the avatar's body already

// A kilobyte figure of /proc/self/status, in MB; 0 where the system has none.
double memory_mb(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.rfind(name + ":", 0) == 0) {
            return std::stod(line.substr(name.size() + 1)) / 1024.0;
        }
    }
    return 0.0;
}

// Median of the processor's seconds that `work` costs this thread, `repeats` times.
double median_cost(int repeats, const std::function<void()>& work) {
    std::vector<double> costs;
    for (int i = 0; i < repeats; ++i) {
        const double start = thread_cpu_seconds();
        work();
        costs.push_back(thread_cpu_seconds() - start);
    }
    return spread_of(costs).p50;
}

// The same arithmetic on every machine, that no compiler shortens: what ratios are taken against.
double fixed_workload_ms() {
    std::uint64_t state = 88172645463325252U;
    const double seconds = median_cost(5, [&state] {
        for (int i = 0; i < 10'000'000; ++i) {
            state ^= state << 13U;
            state ^= state >> 7U;
            state ^= state << 17U;
        }
    });
    // It is never 0, but that is not known before.
    return state == 0 ? 0.0 : 1e3 * seconds;
}

// A figure that turns and nods, so that its springs swing.
motion::Pose moving_pose(const render::Avatar& avatar, double seconds) {
    const auto t = static_cast<float>(seconds);
    motion::Pose pose;
    pose.hips_position = avatar.skeleton.offsets[0];
    pose.rotation(motion::Bone::hips) =
        glm::angleAxis(0.8F * std::sin(6.2832F * t), glm::vec3(0.0F, 1.0F, 0.0F));
    pose.rotation(motion::Bone::head) =
        glm::angleAxis(0.3F * std::sin(12.566F * t), glm::vec3(1.0F, 0.0F, 0.0F));
    for (std::size_t bone = 1; bone < pose.local_rotations.size(); ++bone) {
        pose.local_rotations[bone] = pose.local_rotations[bone] *
                                     glm::angleAxis(0.1F * std::sin(t + static_cast<float>(bone)),
                                                    glm::vec3(0.0F, 0.0F, 1.0F));
    }
    return pose;
}

// One step of 1/60 s: springs, then bones, gaze, constraints and the face of the picture.
double pose_us(const render::Avatar& avatar) {
    constexpr int kSteps = 600;
    render::RigState state(*avatar.rig);
    const auto pose_at = [&](StreamTime time) { return moving_pose(avatar, to_seconds(time)); };
    render::advance(*avatar.rig, StreamTime{}, kOwnBody, pose_at, state);  // the warm-up
    render::Face face;
    face.weight(render::FaceExpression::aa) = 0.5F;
    const double start = thread_cpu_seconds();
    for (int i = 1; i <= kSteps; ++i) {
        const StreamTime time = render::time_of_step(i);
        render::advance(*avatar.rig, time, kOwnBody, pose_at, state);
        render::pose_avatar(*avatar.rig, pose_at(time), face, kOwnBody, state);
    }
    return 1e6 * (thread_cpu_seconds() - start) / kSteps;
}

// A body of this many vertices, each moved by four of 60 matrices, with three morph targets.
render::ModelPrimitive made_up_body(std::size_t vertices) {
    render::ModelPrimitive body;
    body.morphs.resize(3);
    for (std::size_t i = 0; i < vertices; ++i) {
        const auto x = static_cast<float>(i % 97);
        const auto joint = [i](std::size_t k) {
            return static_cast<std::uint16_t>((i * 7919U + k * 31U) % 60U);
        };
        body.positions.emplace_back(x, 1.0F, -x);
        body.normals.emplace_back(0.0F, 1.0F, 0.0F);
        body.joints.push_back({joint(0), joint(1), joint(2), joint(3)});
        body.weights.push_back({0.4F, 0.3F, 0.2F, 0.1F});
        for (render::MorphTarget& morph : body.morphs) {
            morph.vertices.push_back(static_cast<std::uint32_t>(i));
            morph.positions.emplace_back(0.01F, 0.02F, 0.03F);
            morph.normals.emplace_back(0.1F, 0.0F, 0.0F);
        }
    }
    return body;
}

// Moving such a body on the processor, with `morphs` targets active.
double vertices_us(std::size_t vertices, std::size_t matrices, std::size_t morphs) {
    const render::ModelPrimitive body = made_up_body(vertices);
    const std::vector<glm::mat4> all(matrices, glm::mat4(1.0F));
    const std::vector<float> weights(morphs, 0.5F);
    render::PosedVertices posed;
    return 1e6 * median_cost(200, [&] { render::pose_vertices(body, weights, all, posed); });
}

// Dancers in a grid who wear one avatar and move, each a little later than the one before.
class MovingCrowd {
 public:
    MovingCrowd(const render::Avatar& avatar, render::AvatarHandle handle, std::size_t dancers)
        : avatar_(avatar), places_(motion::places_in(motion::Formation::grid, dancers)) {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            states_.push_back(
                avatar.rig != nullptr ? std::make_unique<render::RigState>(*avatar.rig) : nullptr);
            dancers_.push_back({.avatar = handle, .pose = {}, .state = states_.back().get()});
        }
    }

    std::span<const render::Dancer> at(double seconds) {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            motion::Pose& pose = dancers_[i].pose;
            pose = moving_pose(avatar_, seconds + 0.1 * static_cast<double>(i));
            pose.hips_position += glm::vec3(places_[i].x, 0.0, places_[i].y);
            if (states_[i] != nullptr) {
                render::pose_avatar(*avatar_.rig, pose, {}, kOwnBody, *states_[i]);
            }
        }
        return dancers_;
    }

    // How far the farthest stands from the middle, metres.
    [[nodiscard]] float reach() const {
        double reach = 0.0;
        for (const glm::dvec2& place : places_) {
            reach = std::max(reach, glm::length(place));
        }
        return static_cast<float>(reach);
    }

 private:
    const render::Avatar& avatar_;
    std::vector<glm::dvec2> places_;
    std::vector<std::unique_ptr<render::RigState>> states_;
    std::vector<render::Dancer> dancers_;
};

// Drawing a crowd with all of the stage; posing is not counted.
Expected<std::vector<double>> picture_costs(render::Renderer& renderer,
                                            MovingCrowd crowd,
                                            std::pair<int, int> size,
                                            int pictures = 60) {
    auto target = render::OffscreenTarget::create(
        {.width = size.first, .height = size.second, .samples = renderer.samples()});
    if (!target) {
        return fail(target.error());
    }
    render::Scene scene;
    scene.rings = render::beat_rings({.confidence = 1.0F}, stream_time_from_seconds(0.2));
    scene.camera.distance += 2.0F * crowd.reach();
    scene.floor_size = render::floor_size_for(crowd.reach());
    std::vector<double> costs;
    for (int i = 0; i < pictures; ++i) {
        const std::span<const render::Dancer> dancers = crowd.at(i / 30.0);
        const double start = process_cpu_seconds();
        renderer.draw(scene, dancers, target->frame());
        target->finish();
        costs.push_back(1e3 * (process_cpu_seconds() - start));
    }
    return costs;
}

constexpr std::array<std::pair<int, int>, 2> kSizes = {{{1280, 720}, {640, 360}}};

// Adds the costs of pictures in both sizes under names that begin so.
Expected<void> add_pictures(const std::string& name,
                            render::Renderer& renderer,
                            const render::Avatar& avatar,
                            render::AvatarHandle handle,
                            BenchReport& report) {
    for (const auto& size : kSizes) {
        const auto costs = picture_costs(renderer, MovingCrowd(avatar, handle, 1), size);
        if (!costs) {
            return fail(costs.error());
        }
        report.spreads.emplace_back(fmt::format("{}cpu_ms_{}x{}", name, size.first, size.second),
                                    spread_of(*costs));
    }
    return {};
}

// Adds the costs of a crowd's pictures, each dancer with springs and bones of its own.
Expected<void> add_crowd(render::Renderer& renderer,
                         const render::Avatar& avatar,
                         render::AvatarHandle handle,
                         BenchReport& report) {
    constexpr int kPictures = 10;
    const auto costs =
        picture_costs(renderer, MovingCrowd(avatar, handle, 32), {1920, 1080}, kPictures);
    if (!costs) {
        return fail(costs.error());
    }
    report.spreads.emplace_back("crowd_of_32_cpu_ms_1920x1080", spread_of(*costs));
    return {};
}

// Median of a spread that is in the report.
double p50_of(const BenchReport& report, const std::string& name) {
    const auto found = std::find_if(report.spreads.begin(),
                                    report.spreads.end(),
                                    [&](const auto& spread) { return spread.first == name; });
    return found->second.p50;
}

// What loading costs, in milliseconds: all of it, and the part up to the driver.
struct LoadCosts {
    std::vector<double> all;
    std::vector<double> made;
};

// Loading, from the file to the driver's memory, several times; the last one stays.
Expected<LoadCosts> load_costs(const std::string& model,
                               render::Renderer& renderer,
                               engine::LoadedAvatar& loaded,
                               render::AvatarHandle& handle) {
    constexpr int kLoads = 9;
    LoadCosts costs;
    for (int i = 0; i < kLoads; ++i) {
        if (i > 0) {
            renderer.remove(handle);
            loaded = {};
        }
        const double start = process_cpu_seconds();
        auto read = engine::load_avatar(model);
        if (!read) {
            return fail(read.error());
        }
        costs.made.push_back(1e3 * (process_cpu_seconds() - start));
        auto added = renderer.add(*read->avatar);
        if (!added) {
            return fail(added.error());
        }
        costs.all.push_back(1e3 * (process_cpu_seconds() - start));
        loaded = std::move(*read);
        handle = *added;
    }
    return costs;
}

}  // namespace

Expected<BenchReport> bench_avatar(const std::string& model) {
    const auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    const engine::LoadedAvatar mannequin = engine::mannequin();
    auto renderer = render::Renderer::create(*mannequin.avatar, {.quality = render::Quality::fast});
    if (!renderer) {
        return fail(renderer.error());
    }
    BenchReport report;
    report.notes.emplace_back("driver", context->renderer_name());
    report.notes.emplace_back("model", model);
    const double workload = fixed_workload_ms();
    report.values.emplace_back("fixed_workload_ms", workload);
    if (auto added = add_pictures("mannequin_", *renderer, *mannequin.avatar, {}, report); !added) {
        return fail(added.error());
    }
    const double memory_before = memory_mb("VmRSS");
    engine::LoadedAvatar loaded;
    render::AvatarHandle handle;
    const auto loads = load_costs(model, *renderer, loaded, handle);
    if (!loads) {
        return fail(loads.error());
    }
    const Spread load = spread_of(loads->all);
    report.spreads.emplace_back("load_cpu_ms", load);
    report.spreads.emplace_back("load_without_driver_cpu_ms", spread_of(loads->made));
    const render::Avatar& avatar = *loaded.avatar;
    if (auto added = add_pictures("", *renderer, avatar, handle, report); !added) {
        return fail(added.error());
    }
    report.values.emplace_back("memory_mb_above_mannequin", memory_mb("VmRSS") - memory_before);
    report.values.emplace_back("peak_memory_mb_above_mannequin",
                               memory_mb("VmHWM") - memory_before);
    if (auto added = add_crowd(*renderer, avatar, handle, report); !added) {
        return fail(added.error());
    }
    report.values.emplace_back("load_per_workload", load.p50 / workload);
    report.values.emplace_back(
        "picture_per_mannequin",
        p50_of(report, "cpu_ms_1280x720") / p50_of(report, "mannequin_cpu_ms_1280x720"));
    if (avatar.rig != nullptr) {
        report.values.emplace_back("pose_us_a_step", pose_us(avatar));
    }
    constexpr std::size_t kFace = 6'800;
    constexpr std::size_t kBody = 10'000;
    constexpr std::size_t kMatrices = 60;
    report.values.emplace_back("morphs_us", vertices_us(kFace, 1, 3) - vertices_us(kFace, 1, 0));
    report.values.emplace_back("skinning_us", vertices_us(kBody, kMatrices, 0));
    return report;
}

}  // namespace raks::apps
