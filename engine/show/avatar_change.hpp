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

/// Other avatars on their way onto the stage, while those before dance on: workers read their
/// files, then the renderer takes them in pieces, a few milliseconds with every picture, and then
/// the dancers wear them. Threads: the OpenGL context's. Real-time: no.
class AvatarChange {
 public:
    /// What a picture spends on the change, at most, and a piece.
    static constexpr Nanos kShare = std::chrono::milliseconds(3);

    /// Asks for what `names` mean (find_avatar), at least one, to be worn in turn. What was asked
    /// for before and is not worn yet is given up.
    void ask(std::vector<std::string> names);

    /// Goes on with it; called before each picture. Once the dancers wear them: what they are, with
    /// what people should know; empty: not yet. Errors: those of load_avatars and of
    /// Renderer::add_pieces; the dancers keep what they wear, and nothing is asked for any more.
    [[nodiscard]] Expected<std::vector<LoadedAvatar>> go_on(Drawing& drawing);

 private:
    /// What files are, and the bodies that they make.
    struct Arrival {
        std::vector<LoadedAvatar> avatars;
        Costumes costumes;
    };
    [[nodiscard]] static Expected<Arrival> load(const std::vector<std::string>& names,
                                                render::Quality quality);
    [[nodiscard]] Expected<void> take_loaded(Drawing& drawing);
    [[nodiscard]] Expected<std::vector<LoadedAvatar>> take_piece(Drawing& drawing);
    void give_up(Drawing& drawing);

    std::vector<std::string> asked_;          // and not begun to load
    std::future<Expected<Arrival>> loading_;  // one at a time
    std::optional<Arrival> arriving_;         // read, and on its way into the renderer
    std::vector<DancerBodies::Worn> added_;   // its bodies that have arrived
};

}  // namespace raks::engine
