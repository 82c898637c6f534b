#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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

    /// `worn`: what the dancers wear; the mannequins among them in this costume.
    /// `most_image_bytes`: of others that are loaded (AvatarOptions).
    AvatarChange(std::vector<LoadedAvatar> worn,
                 render::Costume costume,
                 std::size_t most_image_bytes = render::kUsualImageBytes)
        : worn_(std::move(worn)), costume_(costume), most_image_bytes_(most_image_bytes) {}

    /// Asks for what `names` mean (find_avatar), at least one, to be worn in turn. What was asked
    /// for before and is not worn yet is given up.
    void ask(std::vector<std::string> names);
    /// Asks for another costume of the mannequins among the avatars that are worn or asked for.
    void dress(render::Costume costume);

    /// Asks for the bodies that pictures of one dancer alone need not have (Partners).
    void add_partners() { is_dress_asked_ = true; }

    /// Goes on with it; called before each picture. Once the dancers wear other avatars: what they
    /// are, with what people should know; empty: not yet, or they are the same in another costume.
    /// Errors: those of load_avatars and of Renderer::add_pieces; the dancers keep what they wear,
    /// and nothing is asked for any more.
    [[nodiscard]] Expected<std::vector<LoadedAvatar>> go_on(Drawing& drawing);

 private:
    /// What files are, and the bodies that they make.
    struct Arrival {
        std::vector<LoadedAvatar> avatars;
        Costumes costumes;
        bool is_costume_alone = false;
    };
    [[nodiscard]] static Expected<Arrival> load(const std::vector<std::string>& names,
                                                const AvatarOptions& options,
                                                render::Quality quality);
    [[nodiscard]] static Expected<Arrival> dress_worn(const std::vector<LoadedAvatar>& worn,
                                                      render::Costume costume,
                                                      render::Quality quality);
    [[nodiscard]] static Arrival made_ready(Arrival arrival, render::Quality quality);
    void begin(Drawing& drawing);
    [[nodiscard]] Expected<void> take_loaded(Drawing& drawing);
    [[nodiscard]] Expected<std::vector<LoadedAvatar>> take_piece(Drawing& drawing);
    void add_next(Drawing& drawing);
    [[nodiscard]] std::vector<LoadedAvatar> wear_arrived(Drawing& drawing);
    void give_up(Drawing& drawing);

    std::vector<LoadedAvatar> worn_;
    render::Costume costume_;
    std::size_t most_image_bytes_;
    std::vector<std::string> asked_;          // and not begun to load
    bool is_dress_asked_ = false;             // and not begun to make
    std::future<Expected<Arrival>> loading_;  // one at a time
    std::optional<Arrival> arriving_;         // read, and on its way into the renderer
    std::vector<DancerBodies::Worn> added_;   // its bodies that have arrived, or are worn already
};

}  // namespace raks::engine
