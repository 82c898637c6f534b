#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/show/show.hpp"

namespace raks::engine {

/// Another avatar on its way onto the stage, while the one before dances on: a worker reads its
/// file, then the renderer takes it in pieces, a few milliseconds with every picture, and then the
/// dancers wear it. Threads: the OpenGL context's. Real-time: no.
class AvatarChange {
 public:
    /// What a picture spends on the change, at most, and a piece.
    static constexpr Nanos kShare = std::chrono::milliseconds(3);

    /// Asks for what `name` means (find_avatar). What was asked for before and is not worn yet is
    /// given up.
    void ask(std::string name);

    /// Goes on with it; called before each picture. Once the dancers wear it: what it is, with what
    /// people should know. Errors: those of load_avatar and of Renderer::add_pieces; the dancers
    /// keep what they wear, and nothing is asked for any more.
    [[nodiscard]] Expected<std::optional<LoadedAvatar>> go_on(Drawing& drawing);

 private:
    /// What a file is, and the bodies that its dancers have in turn.
    struct Cast {
        LoadedAvatar avatar;
        std::vector<std::shared_ptr<const render::Avatar>> bodies;
    };
    [[nodiscard]] static Expected<Cast> load(const std::string& name, render::Quality quality);
    [[nodiscard]] Expected<void> take_loaded(Drawing& drawing);
    [[nodiscard]] Expected<std::optional<LoadedAvatar>> take_piece(Drawing& drawing);
    void give_up(Drawing& drawing);

    std::optional<std::string> asked_;       // and not begun to load
    std::future<Expected<Cast>> loading_;    // one at a time
    std::optional<Cast> arriving_;           // read, and on its way into the renderer
    std::vector<DancerBodies::Worn> added_;  // its bodies that have arrived
};

}  // namespace raks::engine
