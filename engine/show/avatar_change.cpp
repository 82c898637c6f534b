#include "engine/show/avatar_change.hpp"

#include <chrono>
#include <utility>

#include "render/shader_warm_up.hpp"

namespace raks::engine {

void AvatarChange::ask(std::string name) { asked_ = std::move(name); }

Expected<std::optional<LoadedAvatar>> AvatarChange::go_on(Drawing& drawing) {
    constexpr std::chrono::seconds kNoTime(0);
    if (loading_.valid() && loading_.wait_for(kNoTime) == std::future_status::ready) {
        if (auto taken = take_loaded(drawing); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    if (asked_ && !loading_.valid()) {
        give_up(drawing);
        loading_ = std::async(
            std::launch::async, load, *std::exchange(asked_, {}), drawing.renderer.quality());
    }
    return arriving_ ? take_piece(drawing) : std::nullopt;
}

Expected<AvatarChange::Cast> AvatarChange::load(const std::string& name, render::Quality quality) {
    auto loaded = load_avatar(name);
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    Cast cast{.avatar = std::move(*loaded), .bodies = {}};
    cast.bodies.push_back(cast.avatar.avatar);
    if (cast.avatar.is_mannequin) {
        cast.bodies.push_back(mannequin_partner());
    }
    for (const auto& body : cast.bodies) {
        render::warm_up_shaders(*body, quality);
    }
    return cast;
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
    if (asked_) {
        return {};
    }
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    arriving_ = std::move(*loaded);
    drawing.renderer.begin_adding(arriving_->bodies.front());
    return {};
}

Expected<std::optional<LoadedAvatar>> AvatarChange::take_piece(Drawing& drawing) {
    const auto handle = drawing.renderer.add_pieces(kShare);
    if (!handle) {
        give_up(drawing);
        return fail(handle.error());
    }
    if (!*handle) {
        return std::nullopt;
    }
    const auto& bodies = arriving_->bodies;
    added_.push_back({**handle, bodies[added_.size()]});
    if (added_.size() < bodies.size()) {
        drawing.renderer.begin_adding(bodies[added_.size()]);
        return std::nullopt;
    }
    for (const DancerBodies::Worn& before : drawing.bodies.wear(std::exchange(added_, {}))) {
        drawing.renderer.remove(before.handle);
    }
    return std::exchange(arriving_, {})->avatar;
}

}  // namespace raks::engine
