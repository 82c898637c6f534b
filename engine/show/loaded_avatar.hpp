// Avatars to dance with: the mannequin, or what a model file makes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/show/figure_model.hpp"

namespace raks::render {
struct Avatar;
struct Licence;
}  // namespace raks::render

namespace raks::engine {

/// An avatar, and what a person should know of it.
struct LoadedAvatar {
    std::shared_ptr<const render::Avatar> avatar;  ///< null: not loaded yet
    std::string credit;                 ///< whose work, under which licence; the mannequin: empty
    bool is_credit_required = false;    ///< its licence asks for the line
    std::vector<std::string> warnings;  ///< one line each, for people
};

/// "Seed-san by VirtualCast, Inc., VRM Public License 1.0 (credit required)". Pure.
[[nodiscard]] std::string credit_line(const render::Licence& licence, const std::string& file);

/// The avatar that comes with Raks.
[[nodiscard]] LoadedAvatar mannequin();

/// The avatar of a figure. `file`: its name, for the credit where the model has no title. What its
/// images lack is a warning; the model's own warnings are taken over. Threads: workers.
/// Real-time: no.
[[nodiscard]] LoadedAvatar make_avatar(FigureModel& figure, const std::string& file);

/// Loads what a setting names (find_avatar). Errors: those of find_avatar and load_figure.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<LoadedAvatar> load_avatar(const std::string& name,
                                                 const AvatarOptions& options = {});

}  // namespace raks::engine
