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
        arriving_.reset();
        loading_ =
            std::async(std::launch::async,
                       [name = *std::exchange(asked_, {}), quality = drawing.renderer.quality()] {
                           auto loaded = load_avatar(name);
                           if (loaded) {
                               render::warm_up_shaders(*loaded->avatar, quality);
                           }
                           return loaded;
                       });
    }
    return arriving_ ? take_piece(drawing) : std::nullopt;
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
    drawing.renderer.begin_adding(arriving_->avatar);
    return {};
}

Expected<std::optional<LoadedAvatar>> AvatarChange::take_piece(Drawing& drawing) {
    const auto handle = drawing.renderer.add_pieces(kShare);
    if (!handle) {
        arriving_.reset();
        return fail(handle.error());
    }
    if (!*handle) {
        return std::nullopt;
    }
    drawing.renderer.remove(drawing.bodies.wear(**handle, arriving_->avatar));
    return std::exchange(arriving_, {});
}

}  // namespace raks::engine
