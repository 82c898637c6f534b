#include "engine/setup/dance_cache.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/pending_file.hpp"
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

/// The body as far as dances are solved for it: how large it is shown does not matter.
motion::Skeleton solved_for(motion::Skeleton body) {
    body.shown_size = motion::Skeleton().shown_size;
    return body;
}

std::string name_of_body(const motion::Skeleton& skeleton) {
    return fmt::format("{}{:016x}", kBody, with_bytes_of(skeleton, hash_of("")));
}

// Removes those files of avatars' bodies that were written first, so that as many stay as six
// dances of sixteen avatars have, some 500 MB.
void remove_oldest_bodies(const std::vector<fs::path>& files) {
    constexpr std::size_t kMostOfBodies = 96;
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

// The bytes of a file; null: there is no such file, or it cannot be read, which is no error: the
// dance is solved again.
std::shared_ptr<const std::string> kept_bytes(const fs::path& path) {
    if (path.empty() || !is_there(path)) {
        return nullptr;
    }
    auto bytes = read_file(path);
    return bytes ? std::make_shared<const std::string>(std::move(*bytes)) : nullptr;
}

}  // namespace

DanceCache DanceCache::of_user() {
    const fs::path cache = user_cache_path();
    return DanceCache(cache.empty() ? fs::path() : cache / "dances");
}

fs::path DanceCache::path_of(const DancePlan& plan,
                             const motion::Skeleton& shown,
                             const DanceForm& form) const {
    const motion::Skeleton skeleton = solved_for(shown);
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

fs::path DanceCache::path_of(std::string_view dance,
                             std::string_view cells,
                             const motion::Skeleton& shown) const {
    const motion::Skeleton skeleton = solved_for(shown);
    if (folder_.empty()) {
        return {};
    }
    const std::uint64_t hash = fast_hash_of(cells, with_bytes_of(skeleton, program_identity()));
    const bool is_mannequin = skeleton == motion::mannequin_skeleton();
    // No role is called so: a dance's figures are told from its cells.
    return folder_ /
           fmt::format(
               "{}-cells{}-{:016x}.baked", dance, is_mannequin ? "" : name_of_body(skeleton), hash);
}

std::shared_ptr<const motion::DanceLibrary> DanceCache::find(const fs::path& path,
                                                             const motion::Skeleton& skeleton,
                                                             const motion::FigureGrammar& grammar) {
    auto bytes = kept_bytes(path);
    if (!bytes) {
        return nullptr;
    }
    auto library = motion::DanceLibrary::unpack(std::move(bytes), skeleton, grammar);
    return library ? std::move(*library) : nullptr;
}

std::shared_ptr<const motion::DanceLibrary> DanceCache::find(const fs::path& path,
                                                             const motion::Skeleton& skeleton,
                                                             const motion::DanceHabits& habits) {
    auto bytes = kept_bytes(path);
    if (!bytes) {
        return nullptr;
    }
    auto library = motion::DanceLibrary::unpack(std::move(bytes), skeleton, habits);
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

}  // namespace raks::engine
