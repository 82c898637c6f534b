#include "engine/show/avatar_change.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "render/shader_warm_up.hpp"

namespace raks::engine {
namespace {

bool is_worn(render::AvatarHandle handle, const Drawing& drawing) {
    const auto worn = handles_of(drawing.bodies.wardrobe());
    return std::any_of(worn.begin(), worn.end(), [handle](render::AvatarHandle one) {
        return one.number == handle.number;
    });
}

}  // namespace

void AvatarChange::ask(std::vector<std::string> names) { asked_ = std::move(names); }

void AvatarChange::dress(render::Costume costume) {
    is_dress_asked_ = costume != costume_ || is_dress_asked_;
    costume_ = costume;
}

Expected<std::vector<LoadedAvatar>> AvatarChange::go_on(Drawing& drawing) {
    constexpr std::chrono::seconds kNoTime(0);
    if (loading_.valid() && loading_.wait_for(kNoTime) == std::future_status::ready) {
        if (auto taken = take_loaded(drawing); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    if (!loading_.valid()) {
        begin(drawing);
    }
    return arriving_ ? take_piece(drawing) : std::vector<LoadedAvatar>();
}

// A costume waits for avatars that are on their way.
void AvatarChange::begin(Drawing& drawing) {
    const render::Quality quality = drawing.renderer.quality();
    if (!asked_.empty()) {
        give_up(drawing);
        is_dress_asked_ = false;
        const AvatarOptions options{
            .height = {}, .labels = {}, .costume = costume_, .most_image_bytes = most_image_bytes_};
        loading_ =
            std::async(std::launch::async, load, std::exchange(asked_, {}), options, quality);
    } else if (is_dress_asked_ && !arriving_) {
        is_dress_asked_ = false;
        const bool has_mannequin = std::any_of(
            worn_.begin(), worn_.end(), [](const auto& avatar) { return avatar.is_mannequin; });
        if (has_mannequin) {
            loading_ = std::async(std::launch::async, dress_worn, worn_, costume_, quality);
        }
    }
}

Expected<AvatarChange::Arrival> AvatarChange::load(const std::vector<std::string>& names,
                                                   const AvatarOptions& options,
                                                   render::Quality quality) {
    auto loaded = load_avatars(names, options);
    if (!loaded) {
        return fail(std::move(loaded.error()));
    }
    return made_ready({.avatars = std::move(*loaded), .costumes = {}}, quality);
}

Expected<AvatarChange::Arrival> AvatarChange::dress_worn(const std::vector<LoadedAvatar>& worn,
                                                         render::Costume costume,
                                                         render::Quality quality) {
    return made_ready({.avatars = dressed(worn, costume), .costumes = {}, .is_costume_alone = true},
                      quality);
}

AvatarChange::Arrival AvatarChange::made_ready(Arrival arrival, render::Quality quality) {
    arrival.costumes = costumes_of(arrival.avatars);
    for (const auto& body : arrival.costumes.bodies) {
        render::warm_up_shaders(*body, quality);
    }
    return arrival;
}

void AvatarChange::give_up(Drawing& drawing) {
    for (const DancerBodies::Worn& body : added_) {
        if (!is_worn(body.handle, drawing)) {
            drawing.renderer.remove(body.handle);
        }
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
    add_next(drawing);
    return {};
}

/// Begins to add the next body that the renderer lacks.
void AvatarChange::add_next(Drawing& drawing) {
    const auto& bodies = arriving_->costumes.bodies;
    while (added_.size() < bodies.size()) {
        const auto& body = bodies[added_.size()];
        const auto worn = find_worn(drawing.bodies.wardrobe(), body);
        if (!worn) {
            drawing.renderer.begin_adding(body);
            return;
        }
        added_.push_back(*worn);
    }
}

Expected<std::vector<LoadedAvatar>> AvatarChange::take_piece(Drawing& drawing) {
    const auto& bodies = arriving_->costumes.bodies;
    if (added_.size() < bodies.size()) {
        const auto handle = drawing.renderer.add_pieces(kShare);
        if (!handle) {
            give_up(drawing);
            return fail(handle.error());
        }
        if (!*handle) {
            return std::vector<LoadedAvatar>();
        }
        added_.push_back({**handle, bodies[added_.size()]});
        add_next(drawing);
    }
    return added_.size() < bodies.size() ? std::vector<LoadedAvatar>() : wear_arrived(drawing);
}

std::vector<LoadedAvatar> AvatarChange::wear_arrived(Drawing& drawing) {
    const auto before =
        drawing.bodies.wear(wardrobe_of(arriving_->costumes, std::exchange(added_, {})));
    for (const render::AvatarHandle worn : handles_of(before)) {
        if (!is_worn(worn, drawing)) {
            drawing.renderer.remove(worn);
        }
    }
    const Arrival arrived = *std::exchange(arriving_, {});
    worn_ = arrived.avatars;
    return arrived.is_costume_alone ? std::vector<LoadedAvatar>() : worn_;
}

}  // namespace raks::engine
