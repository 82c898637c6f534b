#include "engine/setup/dance_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/pending_file.hpp"
#include "base/suggest.hpp"
#include "engine/setup/asked_formation.hpp"
#include "engine/setup/settings.hpp"
#include "motion/dance_library.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// Extends a hash by the bytes of a value. The layout may differ between builds, but so does
// program_identity().
template <typename Value>
std::uint64_t with_bytes_of(const Value& value, std::uint64_t hash) {
    static_assert(std::is_trivially_copyable_v<Value>);
    return hash_of({reinterpret_cast<const char*>(&value), sizeof value}, hash);
}

// Hash of the executable's size and time: a program that was built again may solve a dance
// otherwise, so that it must not find what the one before kept.
std::uint64_t program_identity() {
    struct stat self {};
    if (stat("/proc/self/exe", &self) != 0) {
        return 0;
    }
    return with_bytes_of(
        self.st_mtim.tv_nsec,
        with_bytes_of(self.st_mtim.tv_sec, with_bytes_of(self.st_size, hash_of(""))));
}

// Extends a hash by all that the grammar determines: metre, places, and of each rule the figure,
// its energy, its step aside and the weights of what may follow.
std::uint64_t with_grammar(const motion::FigureGrammar& grammar, std::uint64_t hash) {
    hash = hash_of(grammar.dance, hash);
    hash = with_bytes_of(grammar.beats_per_bar, with_bytes_of(grammar.starts, hash));
    // Who holds whom is not solved: only places are.
    if (grammar.couple && grammar.couple->apart) {
        hash = with_bytes_of(*grammar.couple->apart, hash);
    }
    for (const motion::FigureGrammar::Place& place : grammar.places) {
        hash = with_bytes_of(place.role, hash);
        hash = with_bytes_of(place.turn_point, with_bytes_of(place.heading, hash));
    }
    for (const motion::FigureGrammar::Rule& rule : grammar.rules) {
        hash = with_bytes_of(rule.aside, with_bytes_of(rule.energy, hash_of(rule.figure, hash)));
        for (const double weight : rule.after) {
            hash = with_bytes_of(weight, hash);
        }
    }
    return hash;
}

// Part of a file's name for any body but the mannequin.
constexpr std::string_view kBody = "-body";

std::string name_of_body(const motion::Skeleton& skeleton) {
    return fmt::format("{}{:016x}", kBody, with_bytes_of(skeleton, hash_of("")));
}

// Removes those files of avatars' bodies that were written first, so that as many stay as six
// dances of four avatars have, some 130 MB.
void remove_oldest_bodies(const std::vector<fs::path>& files) {
    constexpr std::size_t kMostOfBodies = 24;
    std::vector<std::pair<fs::file_time_type, fs::path>> bodies;
    std::error_code ignored;
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        if (name.find(kBody) != std::string::npos && name.ends_with(".baked")) {
            bodies.emplace_back(fs::last_write_time(file, ignored), file);
        }
    }
    std::sort(bodies.begin(), bodies.end());
    for (std::size_t i = 0; i + kMostOfBodies < bodies.size(); ++i) {
        fs::remove(bodies[i].second, ignored);
    }
}

}  // namespace

DanceCache DanceCache::of_user() {
    const fs::path cache = user_cache_path();
    return DanceCache(cache.empty() ? fs::path() : cache / "dances");
}

fs::path DanceCache::path_of(const DancePlan& plan,
                             const motion::Skeleton& skeleton,
                             const DanceForm& form) const {
    // No home, no cache.
    if (folder_.empty()) {
        return {};
    }
    // The files are hashed by content, not by time: a reinstalled figure that is the same is found.
    std::uint64_t hash = with_bytes_of(skeleton, program_identity());
    hash = with_grammar(plan.grammar, hash);
    for (const fs::path& file : plan.files) {
        const auto bytes = read_file(file);
        // The reason is reported when the figure itself is read.
        if (!bytes) {
            return {};
        }
        hash = fast_hash_of(*bytes, hash);
    }
    // The name's readable part says dance, role and form; keep() recognises older files by it.
    const bool is_of_positions = form.features == motion::FigureFeatures::positions;
    const bool is_mannequin = skeleton == motion::mannequin_skeleton();
    return folder_ / fmt::format("{}-{}{}{}{}{}-{:016x}.baked",
                                 plan.grammar.dance,
                                 motion::kRoleNames[static_cast<std::size_t>(plan.role)],
                                 is_of_positions ? "-positions" : "",
                                 form.generator == motion::Generator::frames ? "-frames" : "",
                                 form.company == Company::couple ? "-couple" : "",
                                 is_mannequin ? "" : name_of_body(skeleton),
                                 hash);
}

std::shared_ptr<const motion::DanceLibrary> DanceCache::find(const fs::path& path,
                                                             const motion::Skeleton& skeleton,
                                                             const motion::FigureGrammar& grammar) {
    if (path.empty() || !is_there(path)) {
        return nullptr;
    }
    auto bytes = read_file(path);
    // Damaged contents are no error: the dance is solved again.
    if (!bytes) {
        return nullptr;
    }
    auto library = motion::DanceLibrary::unpack(
        std::make_shared<const std::string>(std::move(*bytes)), skeleton, grammar);
    return library ? std::move(*library) : nullptr;
}

void DanceCache::keep(const fs::path& path, const motion::DanceLibrary& library) {
    if (path.empty()) {
        return;
    }
    std::error_code ignored;
    fs::create_directories(path.parent_path(), ignored);
    // Other processes see a whole file or none.
    if (!write_file(path, library.packed())) {
        return;
    }
    // All but the hash at the end: the same for every version of this dance, role and form.
    const std::string name = path.filename().string();
    const std::string kind = name.substr(0, name.rfind('-') + 1);
    const auto others = list_folder(path.parent_path());
    for (const fs::path& other : others ? *others : std::vector<fs::path>{}) {
        const std::string other_name = other.filename().string();
        // The same length too: "salsa-lead-" is also the beginning of "salsa-lead-couple-HASH".
        const bool is_older = other_name.starts_with(kind) && other_name.ends_with(".baked") &&
                              other_name.size() == name.size() && other_name != name;
        if (is_older) {
            fs::remove(other, ignored);
        } else if (other_name.ends_with(".part")) {
            remove_abandoned_part(other);
        }
    }
    if (others) {
        remove_oldest_bodies(*others);
    }
}

namespace {

using motion::DanceRole;
using motion::FigureFeatures;
using motion::Repertoire;

// Words that stand in place of a dance's name in the settings.
constexpr std::string_view kAuto = "auto";
constexpr std::string_view kFirst = "first";
constexpr std::string_view kKeep = "keep";
constexpr std::string_view kStand = "stand";

// Errors: `dance` is neither a dance of the list nor one of the other words.
Expected<void> check_name(const std::string& dance,
                          const DanceList& dances,
                          std::vector<std::string_view> others) {
    const std::vector<std::string_view> names = dances.names();
    others.insert(others.end(), names.begin(), names.end());
    if (std::find(others.begin(), others.end(), dance) == others.end()) {
        return fail(unknown_name("dance", dance, others));
    }
    return {};
}

// What a repertoire does while no dance is recognised; a dance's name as fallback is its first
// dance.
Repertoire::Fallback fallback_of(const Settings& settings) {
    return settings.fallback_dance == kKeep    ? Repertoire::Fallback::keep
           : settings.fallback_dance == kStand ? Repertoire::Fallback::stand
                                               : Repertoire::Fallback::first;
}

// Solves dances and adds them to the repertoires: the lead's and, for couples, the follow's. A copy
// runs on the thread that solves the other dances; it shares the repertoires.
struct DanceLoader {
    DanceCatalogue catalogue;
    motion::Skeleton skeleton;
    DanceForm form;
    std::shared_ptr<Repertoire> lead;
    std::shared_ptr<Repertoire> follow;

    [[nodiscard]] Expected<std::shared_ptr<const motion::DanceLibrary>> library(
        const std::string& dance, DanceRole role) const {
        return load_dance(catalogue, dance, skeleton, role, form);
    }

    // A repertoire with the dance that a show begins with, solved at once.
    [[nodiscard]] Expected<std::shared_ptr<Repertoire>> first_of(const Settings& settings,
                                                                 DanceRole role) const {
        const std::string dance = dance_to_load(settings, *catalogue.list());
        auto first = library(dance, role);
        if (!first) {
            return fail(std::move(first.error()));
        }
        return std::make_shared<Repertoire>(
            catalogue.list()->id_of(dance), std::move(*first), fallback_of(settings));
    }

    // Adds a dance to both repertoires, or to neither when one part is missing: a lead must not
    // dance what the follow cannot.
    [[nodiscard]] Expected<void> add(const std::string& dance) const {
        auto lead_dance = library(dance, DanceRole::lead);
        if (!lead_dance) {
            return fail(std::move(lead_dance.error()));
        }
        const DanceId id = catalogue.list()->id_of(dance);
        if (follow) {
            auto follow_dance = library(dance, DanceRole::follow);
            if (!follow_dance) {
                return fail(std::move(follow_dance.error()));
            }
            follow->add(id, std::move(*follow_dance));
        }
        lead->add(id, std::move(*lead_dance));
        return {};
    }

    // Adds the dances one after the other; a bad one is reported and the rest goes on.
    [[nodiscard]] std::vector<std::string> add_all(const std::vector<std::string>& dances,
                                                   const std::atomic<bool>& is_stopped) const {
        std::vector<std::string> left_out;
        for (const std::string& dance : dances) {
            // relaxed: a wish by itself
            if (is_stopped.load(std::memory_order_relaxed)) {
                break;
            }
            if (auto added = add(dance); !added) {
                left_out.push_back(fmt::format("{} is left out: {}", dance, added.error().message));
            }
        }
        return left_out;
    }
};

// The dances that are solved while the show runs: all but the first, for couples those for two.
// None where the settings keep to one dance.
std::vector<std::string> other_dances(const Settings& settings, const DanceList& dances) {
    std::vector<std::string> others;
    if (settings.dance != kAuto) {
        return others;
    }
    const bool is_couple = form_of(settings).company == Company::couple;
    const std::string first = dance_to_load(settings, dances);
    for (const DanceInfo& dance : dances.all()) {
        if (dance.name != first && (!is_couple || dance.roles == 2)) {
            others.push_back(dance.name);
        }
    }
    return others;
}

}  // namespace

Expected<void> check_dances(const Settings& settings, const DanceList& dances) {
    if (auto checked = check_name(settings.dance, dances, {kAuto}); !checked) {
        return checked;
    }
    return check_name(settings.fallback_dance, dances, {kFirst, kKeep, kStand});
}

Expected<void> check_dances(const Settings& settings, const DanceCatalogue& catalogue) {
    auto checked = check_dances(settings, *catalogue.list());
    if (checked) {
        return checked;
    }
    // A name that is unknown only because its files are not there.
    const bool is_fallback = settings.dance == kAuto;
    const std::string& name = is_fallback ? settings.fallback_dance : settings.dance;
    const auto& notes = catalogue.notes();
    const auto reason = std::find_if(notes.begin(), notes.end(), [&](const std::string& note) {
        return note.find("is not installed") != std::string::npos ||
               note.find("so that " + name + " cannot") != std::string::npos;
    });
    return reason == notes.end() ? checked : fail(*reason + " (" + checked.error().message + ")");
}

std::string dance_to_load(const Settings& settings, const DanceList& dances) {
    if (settings.dance != kAuto) {
        return settings.dance;
    }
    const bool is_dance = dances.id_of(settings.fallback_dance) != DanceId::none;
    return is_dance ? settings.fallback_dance : dances.all().front().name;
}

DanceForm form_of(const Settings& settings) {
    DanceForm form;
    form.features =
        settings.figures == "positions" ? FigureFeatures::positions : FigureFeatures::angles;
    form.generator = settings.generator == "frames" ? motion::Generator::frames
                                                    : motion::Generator::trajectories;
    form.company = settings.formation == "couple" ? Company::couple : Company::alone;
    return form;
}

motion::Dynamics dynamics_of(const Settings& settings) {
    return settings.dynamics == "off" ? motion::Dynamics::off : motion::Dynamics::on;
}

Expected<std::shared_ptr<const motion::DanceLibrary>> load_dance(const DanceCatalogue& catalogue,
                                                                 std::string_view dance,
                                                                 const motion::Skeleton& skeleton,
                                                                 motion::DanceRole role,
                                                                 const DanceForm& form,
                                                                 const DanceCache& cache) {
    auto plan = catalogue.plan(dance, role, form);
    if (!plan) {
        return fail(std::move(plan.error()));
    }
    // The cache is asked before the figures are parsed: a hit costs one read.
    const std::filesystem::path kept = cache.path_of(*plan, skeleton, form);
    if (auto found = DanceCache::find(kept, skeleton, plan->grammar)) {
        return found;
    }
    auto parts = read_figures(std::move(*plan));
    if (!parts) {
        return fail(std::move(parts.error()));
    }
    auto library =
        motion::DanceLibrary::build(parts->figures, skeleton, &parts->grammar, form.generator);
    // A build that fails is not kept: its error is to be seen again.
    if (library) {
        DanceCache::keep(kept, **library);
    }
    return library;
}

Cast cast_of(std::shared_ptr<const motion::DanceLibrary> library,
             const motion::Skeleton& skeleton,
             std::uint64_t seed,
             motion::Dynamics dynamics) {
    return {motion::members_of(motion::Formation::solo,
                               Repertoire::of_one(std::move(library)),
                               nullptr,
                               seed,
                               dynamics),
            skeleton};
}

Expected<Dancers> Dancers::load(const Settings& settings,
                                const DanceCatalogue& catalogue,
                                const motion::Skeleton& skeleton) {
    const auto formation = asked_formation(settings);
    if (!formation) {
        return fail(std::move(formation.error()));
    }
    // No repertoires yet: first_of() makes them.
    DanceLoader loader{catalogue, skeleton, form_of(settings), nullptr, nullptr};
    auto lead = loader.first_of(settings, DanceRole::lead);
    if (!lead) {
        return fail(std::move(lead.error()));
    }
    loader.lead = std::move(*lead);
    // Only a couple needs the follow's part; other formations dance the lead's.
    if (*formation == motion::Formation::couple) {
        auto follow = loader.first_of(settings, DanceRole::follow);
        if (!follow) {
            return fail(std::move(follow.error()));
        }
        loader.follow = std::move(*follow);
    }
    Dancers dancers;
    dancers.cast_ = {motion::members_of(*formation,
                                        loader.lead,
                                        loader.follow,
                                        static_cast<std::uint64_t>(settings.seed),
                                        dynamics_of(settings),
                                        asked_dancers(settings, *formation)),
                     skeleton};
    // From here on the others are solved on their own thread; the future joins it when destroyed.
    const auto others = other_dances(settings, *catalogue.list());
    dancers.others_ =
        std::async(std::launch::async, [loader, others, is_stopped = dancers.is_stopped_] {
            return loader.add_all(others, *is_stopped);
        });
    return dancers;
}

void Dancers::stop_solving() noexcept {
    is_stopped_->store(true, std::memory_order_relaxed);  // relaxed: a wish by itself
}

bool Dancers::is_stopped() const noexcept {
    return is_stopped_->load(std::memory_order_relaxed);  // relaxed: as above
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
