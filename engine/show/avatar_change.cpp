#include "engine/show/avatar_change.hpp"

#include <chrono>
#include <utility>

#include "render/shader_warm_up.hpp"

namespace raks::engine {

void AvatarChange::ask(std::vector<std::string> names) { asked_ = std::move(names); }

Expected<std::vector<LoadedAvatar>> AvatarChange::go_on(Drawing& drawing) {
    constexpr std::chrono::seconds kNoTime(0);
    if (loading_.valid() && loading_.wait_for(kNoTime) == std::future_status::ready) {
        if (auto taken = take_loaded(drawing); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    if (!asked_.empty() && !loading_.valid()) {
        give_up(drawing);
        loading_ = std::async(
            std::launch::async, load, std::exchange(asked_, {}), drawing.renderer.quality());
    }
    return arriving_ ? take_piece(drawing) : std::vector<LoadedAvatar>();
}

Expected<AvatarChange::Arrival> AvatarChange::load(const std::vector<std::string>& names,
                                                   render::Quality quality) {
    auto loaded = load_avatars(names);
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    Arrival arrival{.avatars = std::move(*loaded), .costumes = {}};
    arrival.costumes = costumes_of(arrival.avatars);
    for (const auto& body : arrival.costumes.bodies) {
        render::warm_up_shaders(*body, quality);
    }
    return arrival;
}

void AvatarChange::give_up(Drawing& drawing) {
    for (const DancerBodies::Worn& body : added_) {
        drawing.renderer.remove(body.handle);
    }
    added_.clear();
    arriving_.reset();
}

// What somebody has turned away from meanwhile is dropped, its faults, too.
Expected<void> AvatarChange::take_loaded(Drawing& drawing) {
    auto loaded = loading_.get();
    if (!asked_.empty()) {
        return {};
    }
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    arriving_ = std::move(*loaded);
    drawing.renderer.begin_adding(arriving_->costumes.bodies.front());
    return {};
}

Expected<std::vector<LoadedAvatar>> AvatarChange::take_piece(Drawing& drawing) {
    const auto handle = drawing.renderer.add_pieces(kShare);
    if (!handle) {
        give_up(drawing);
        return fail(handle.error());
    }
    if (!*handle) {
        return std::vector<LoadedAvatar>();
    }
    const auto& bodies = arriving_->costumes.bodies;
    added_.push_back({**handle, bodies[added_.size()]});
    if (added_.size() < bodies.size()) {
        drawing.renderer.begin_adding(bodies[added_.size()]);
        return std::vector<LoadedAvatar>();
    }
    const auto before =
        drawing.bodies.wear(wardrobe_of(arriving_->costumes, std::exchange(added_, {})));
    for (const render::AvatarHandle worn : handles_of(before)) {
        drawing.renderer.remove(worn);
    }
    return std::exchange(arriving_, {})->avatars;
}

}  // namespace raks::engine
