// Avatars to dance with: the mannequin, or what a model file makes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"

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

/// The avatar that comes with Raks.
[[nodiscard]] LoadedAvatar mannequin();
/// The body of its lead, where dancers differ (DancerBodies::add_partner).
[[nodiscard]] std::shared_ptr<const render::Avatar> mannequin_partner();

/// Loads what a setting names (find_avatar). `height`: metres; none: its own where that is
/// 0.5 to 2.5 m, else 1.7. Errors: those of find_avatar; of the file (base/file.hpp); of its
/// reader, with what is wrong and where; bones that a dancer needs are missing. Threads: workers.
/// Real-time: no.
[[nodiscard]] Expected<LoadedAvatar> load_avatar(const std::string& name,
                                                 std::optional<float> height = std::nullopt);

}  // namespace raks::engine
