#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "motion/dance/generator.hpp"
#include "motion/ensemble.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::engine {

/// Dances whose trained figures come with Raks, in the order of the genres.
[[nodiscard]] std::vector<std::string> known_dances();

/// Errors: `dance` is neither known nor "auto"; the nearest is named.
[[nodiscard]] Expected<void> check_dance(const std::string& dance);
/// Errors: `dance` is neither known nor "keep" nor "stand"; the nearest is named.
[[nodiscard]] Expected<void> check_fallback_dance(const std::string& dance);

/// The dance that a show begins with: `dance`, where that is "auto" the fallback, and where that
/// is no dance the first that is known.
[[nodiscard]] std::string dance_to_load(const Settings& settings);

/// Who one dances with: one of a couple leaves the other room.
enum class Company : std::uint8_t { alone, couple };

/// In which of its forms a dance is danced.
struct DanceForm {
    motion::FigureFeatures features = motion::FigureFeatures::angles;
    motion::Generator generator = motion::Generator::trajectories;
    Company company = Company::alone;
};
/// By the settings' figures, generator ("frames" is the paper's; all else that passed validate() is
/// ours) and formation.
[[nodiscard]] DanceForm form_of(const Settings& settings);

/// Reads the trained figures of a dance from models/trained and solves them for the built-in
/// mannequin; of positions where it has such, else of angles. Errors: an unknown dance, a model
/// file that is missing or bad.
[[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(
    const std::string& dance,
    motion::DanceRole role = motion::DanceRole::lead,
    const DanceForm& form = {});

/// Who dances, by the settings: dance, figures, formation, generator and seed. The dance that a
/// show begins with is there at once; with `dance = "auto"` a thread of its own solves all others
/// meanwhile, so that a show begins at once. Threads: one owner.
class Dancers {
 public:
    /// Errors: as load_dance, an unknown formation.
    [[nodiscard]] static Expected<Dancers> load(const Settings& settings);

    [[nodiscard]] const std::vector<motion::EnsembleMember>& members() const noexcept {
        return members_;
    }
    /// Waits until all dances are there: the same dance again needs that. Errors: a file of one of
    /// them is bad; it is left out.
    [[nodiscard]] Expected<void> wait();

 private:
    std::vector<motion::EnsembleMember> members_;
    std::future<Expected<void>> others_;
};

}  // namespace raks::engine
