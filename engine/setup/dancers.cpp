#include "engine/setup/dancers.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "engine/setup/asked_formation.hpp"
#include "engine/setup/dance_files.hpp"
#include "motion/repertoire.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using motion::DanceRole;
using motion::Formation;
using motion::Repertoire;

// One part of the dances, solved for one body.
struct SolvedPart {
    BodyOfMaterial body;
    DanceRole role = DanceRole::lead;
    std::shared_ptr<Repertoire> repertoire;  // null: nothing is solved yet
};

// The parts that a formation dances, each once, and which of them each of its bodies has.
struct Parts {
    std::vector<SolvedPart> each;
    std::vector<std::size_t> of_body;
};

Parts parts_of(Formation formation, const std::vector<BodyOfMaterial>& bodies) {
    Parts parts;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const bool is_follow = formation == Formation::couple && i == 1;
        const DanceRole role = is_follow ? DanceRole::follow : DanceRole::lead;
        const auto same =
            std::find_if(parts.each.begin(), parts.each.end(), [&](const SolvedPart& part) {
                return part.role == role && part.body == bodies[i];
            });
        parts.of_body.push_back(static_cast<std::size_t>(same - parts.each.begin()));
        if (same == parts.each.end()) {
            parts.each.push_back({bodies[i], role, nullptr});
        }
    }
    return parts;
}

// Solves dances and adds them to the repertoires of all parts. A copy runs on the thread that
// solves the other dances; it shares the repertoires.
struct DanceLoader {
    using Libraries = std::vector<std::shared_ptr<const motion::DanceLibrary>>;

    DanceCatalogue catalogue;
    DanceForm form;
    std::vector<SolvedPart> parts;
    int threads = 1;
    StopSolving stop;

    // Solves a dance for each part, in the order of the parts. Errors: of the first part for which
    // it cannot be solved; a stop was asked for.
    [[nodiscard]] Expected<Libraries> solve(const std::string& dance) const {
        std::vector<std::optional<Expected<std::shared_ptr<const motion::DanceLibrary>>>> solved(
            parts.size());
        run_parallel(parts.size(), threads, [&](std::size_t i) {
            if (!stop.is_asked() && first_alike(i, dance) == i) {
                const SolvedPart& part = parts[i];
                solved[i] =
                    load_dance(catalogue, dance, part.body.skeleton, part.role, form_for(part));
            }
        });
        Libraries libraries;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto& library = solved[first_alike(i, dance)];
            if (!library) {
                return fail("nobody waits for the dance any more");
            }
            if (!*library) {
                return fail(library->error());
            }
            libraries.push_back(**library);
        }
        return libraries;
    }

    [[nodiscard]] motion::DanceTempo tempo_of(const std::string& dance) const {
        const DanceInfo* const info = catalogue.list()->find(catalogue.list()->id_of(dance));
        return info != nullptr ? motion::DanceTempo{info->lowest,
                                                    info->highest,
                                                    info->likely,
                                                    info->beats_per_bar}
                               : motion::DanceTempo{};
    }

    [[nodiscard]] motion::DanceMood mood_of(const std::string& dance) const {
        const CatalogueEntry* const entry = catalogue.find(dance);
        return entry != nullptr ? entry->mood : motion::DanceMood{};
    }

    [[nodiscard]] DanceForm form_for(const SolvedPart& part) const {
        DanceForm own = form;
        own.material = part.body.material;
        return own;
    }

    // The first part that dances the same: a dance that has one material alone is solved once for
    // those who would dance either.
    [[nodiscard]] std::size_t first_alike(std::size_t i, const std::string& dance) const {
        const CatalogueEntry* const entry = catalogue.find(dance);
        const auto same = std::find_if(parts.begin(), parts.end(), [&](const SolvedPart& part) {
            return part.role == parts[i].role && part.body.skeleton == parts[i].body.skeleton &&
                   (entry == nullptr || is_of_cells(*entry, part.role, form_for(part)) ==
                                            is_of_cells(*entry, part.role, form_for(parts[i])));
        });
        return static_cast<std::size_t>(same - parts.begin());
    }

    // Gives each part a repertoire with the dance that a show begins with.
    [[nodiscard]] Expected<void> begin(const Settings& settings) {
        const std::string dance = dance_to_load(settings, catalogue);
        auto libraries = solve(dance);
        if (!libraries) {
            return fail(std::move(libraries.error()));
        }
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i].repertoire = std::make_shared<Repertoire>(catalogue.list()->id_of(dance),
                                                               std::move((*libraries)[i]),
                                                               fallback_of(settings),
                                                               tempo_of(dance),
                                                               mood_of(dance));
        }
        return {};
    }

    // Adds a dance to the repertoires of all parts, or to none when it cannot be solved for one of
    // them: nobody must dance what the others cannot. The first dancer gets it last, so that
    // everybody knows what the first dancer knows.
    [[nodiscard]] Expected<void> add(const std::string& dance) const {
        auto libraries = solve(dance);
        if (!libraries) {
            return fail(std::move(libraries.error()));
        }
        const DanceId id = catalogue.list()->id_of(dance);
        for (std::size_t i = parts.size(); i-- > 0;) {
            parts[i].repertoire->add(
                id, std::move((*libraries)[i]), tempo_of(dance), mood_of(dance));
        }
        return {};
    }

    // Adds the dances one after the other; a bad one is reported and the rest goes on.
    [[nodiscard]] std::vector<std::string> add_all(const std::vector<std::string>& dances) const {
        std::vector<std::string> left_out;
        for (const std::string& dance : dances) {
            const auto added = add(dance);
            if (stop.is_asked()) {
                break;
            }
            if (!added) {
                left_out.push_back(fmt::format("{} is left out: {}", dance, added.error().message));
            }
        }
        return left_out;
    }
};

}  // namespace

Cast cast_of(std::shared_ptr<const motion::DanceLibrary> library,
             const motion::Skeleton& skeleton,
             std::uint64_t seed,
             motion::Dynamics dynamics) {
    return motion::members_of(
        Formation::solo, {{skeleton, Repertoire::of_one(std::move(library))}}, seed, dynamics);
}

std::vector<BodyOfMaterial> bodies_in(Formation formation,
                                      const std::vector<motion::Skeleton>& bodies,
                                      const Settings& settings) {
    const std::size_t n = bodies.size();
    if (formation == Formation::couple) {
        const Material material = material_of(settings, 0);
        return {{bodies[0], material}, {bodies[1 % n], material}};
    }
    std::vector<BodyOfMaterial> in_turn;
    const std::size_t rounds = settings.material == "both" ? 2 : 1;
    for (std::size_t i = 0; i < rounds * n; ++i) {
        // Of an even number of bodies the second round begins with the other material, or each
        // would always have the same.
        const std::size_t shifted = n % 2 == 0 ? i / n : 0;
        in_turn.push_back({bodies[i % n], material_of(settings, i + shifted)});
    }
    return in_turn;
}

Expected<Dancers> Dancers::load(const Settings& settings,
                                const DanceCatalogue& catalogue,
                                const std::vector<motion::Skeleton>& bodies,
                                int threads,
                                const StopSolving& stop) {
    const motion::Formation formation = asked_formation(settings);
    const std::vector<BodyOfMaterial> in_turn = bodies_in(formation, bodies, settings);
    Parts parts = parts_of(formation, in_turn);
    DanceLoader loader{catalogue, form_of(settings), std::move(parts.each), threads, stop};
    if (auto begun = loader.begin(settings); !begun) {
        return fail(std::move(begun.error()));
    }
    Dancers dancers;
    dancers.stop_ = stop;
    dancers.loaded_for_ = in_turn;
    for (const std::size_t part : parts.of_body) {
        dancers.bodies_.push_back(
            {loader.parts[part].body.skeleton, loader.parts[part].repertoire});
    }
    dancers.cast_ = motion::members_of(formation,
                                       dancers.bodies_,
                                       static_cast<std::uint64_t>(settings.seed),
                                       dynamics_of(settings),
                                       asked_dancers(settings, formation));
    // From here on the others are solved on their own thread; the future joins it when destroyed.
    const auto others = other_dances_to_load(settings, catalogue);
    dancers.others_ =
        std::async(std::launch::async, [loader, others] { return loader.add_all(others); });
    return dancers;
}

bool Dancers::is_done() const {
    return !others_.valid() ||
           others_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::vector<std::string> Dancers::wait() {
    // A second wait has nothing to wait for.
    return others_.valid() ? others_.get() : std::vector<std::string>{};
}

}  // namespace raks::engine
