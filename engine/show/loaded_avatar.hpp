// Avatars to dance with: the mannequin, or what a model file makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/show/avatar_model.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/model/mannequin_style.hpp"

namespace raks::render {
struct Avatar;
struct Licence;
}  // namespace raks::render

namespace raks::engine {

/// An avatar, and what a person should know of it.
struct LoadedAvatar {
    std::shared_ptr<const render::Avatar> avatar;  ///< null: not loaded yet
    std::string name;                              ///< kMannequinName, or its file
    std::string credit;                 ///< whose work, under which licence; the mannequin: empty
    bool is_credit_required = false;    ///< its licence asks for the line
    std::vector<std::string> warnings;  ///< one line each, for people
    bool is_mannequin = false;          ///< its dancers differ in build, clothes and hair
};

/// "Seed-san by VirtualCast, Inc., VRM Public License 1.0 (credit required)". Pure.
[[nodiscard]] std::string credit_line(const render::Licence& licence, const std::string& file);

/// Those of avatars that have one, each once.
[[nodiscard]] std::vector<std::string> credits_of(const std::vector<LoadedAvatar>& avatars);

/// The avatar that comes with Raks.
[[nodiscard]] LoadedAvatar mannequin(render::Costume costume = render::Costume::unitard);
/// The body of its lead, where dancers differ (DancerBodies::Builds).
[[nodiscard]] std::shared_ptr<const render::Avatar> mannequin_partner(
    render::Costume costume = render::Costume::unitard);

/// The same avatars, the mannequins among them in this costume. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<LoadedAvatar> dressed(std::vector<LoadedAvatar> avatars,
                                                render::Costume costume);

/// The avatar of a figure. `file`: its name, for the credit where the model has no title.
/// `most_image_bytes`: see render::fit_images. What its images lack is a warning; the model's own
/// warnings are taken over. Threads: workers. Real-time: no.
[[nodiscard]] LoadedAvatar make_avatar(AvatarModel& figure,
                                       const std::string& file,
                                       std::size_t most_image_bytes = render::kUsualImageBytes);

/// Loads what a setting names (find_avatar). Errors: those of find_avatar, load_avatar_model and
/// check_has_surface.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<LoadedAvatar> load_avatar(const std::string& name,
                                                 const AvatarOptions& options = {});

/// Loads several on all cores, each that is named more than once only once. Errors: that of the
/// first of them that cannot be loaded. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<LoadedAvatar>> load_avatars(
    const std::vector<std::string>& names, const AvatarOptions& options = {});

/// The bodies that the dances of avatars that are loaded are solved for (render::dance_body), one
/// an avatar.
[[nodiscard]] std::vector<motion::Skeleton> dance_bodies_of(
    const std::vector<LoadedAvatar>& avatars);

/// The bodies of each avatar (DancerBodies::Builds), and of all of them those that differ. Made by
/// workers, worn by dancers.
struct Costumes {
    /// Each once.
    std::vector<std::shared_ptr<const render::Avatar>> bodies;
    /// Of avatar k: which of `bodies`.
    std::vector<std::vector<std::size_t>> builds;
};
/// Who is seen of those whose dancers differ.
enum class Partners : std::uint8_t {
    all,    ///< leads and follows
    first,  ///< one dancer alone: the other body is not made
};
/// Of avatars that are loaded, at least one. Threads: workers. Real-time: no.
[[nodiscard]] Costumes costumes_of(const std::vector<LoadedAvatar>& avatars,
                                   Partners partners = Partners::all);

}  // namespace raks::engine
