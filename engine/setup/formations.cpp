#include "engine/setup/formations.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace raks::engine {
namespace {

using motion::Formation;

constexpr auto& kNames = motion::kFormationNames;

std::string_view name_of(Formation formation) {
    return kNames[static_cast<std::size_t>(formation)];
}

// Formations fall into two kinds by the form of the dances that they need.
bool is_couple(Formation formation) { return formation == Formation::couple; }

// `name` is one of the table's: Dancers::load has refused any other.
Formation formation_of(std::string_view name) {
    return static_cast<Formation>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

// The next enumerator, cyclically.
Formation after(Formation formation) {
    return static_cast<Formation>((static_cast<std::size_t>(formation) + 1) % kNames.size());
}

}  // namespace

Expected<Formations> Formations::load(const Settings& settings,
                                      const DanceCatalogue& catalogue,
                                      const motion::Skeleton& skeleton) {
    auto dancers = Dancers::load(settings, catalogue, skeleton);
    if (!dancers) {
        return fail(std::move(dancers.error()));
    }
    return Formations(settings, catalogue, std::move(*dancers));
}

Formations::Formations(Settings settings, DanceCatalogue catalogue, Dancers dancers)
    : settings_(std::move(settings)),
      catalogue_(std::move(catalogue)),
      danced_(formation_of(settings_.formation)),
      asked_(danced_),
      cast_(dancers.cast()) {
    // Dancers are kept by kind, so that going back to a formation needs no loading.
    (is_couple(danced_) ? couple_ : alone_).emplace(std::move(dancers));
}

std::string_view Formations::name() const noexcept { return name_of(danced_); }

// Asking again while a formation is being loaded only moves the wish: poll() serves the last one.
std::string_view Formations::ask_for_next() {
    asked_ = after(asked_);
    is_waiting_ = true;
    return name_of(asked_);
}

bool Formations::has_dancers_for(Formation formation) const noexcept {
    return is_couple(formation) ? couple_.has_value() : alone_.has_value();
}

// Solves the dances of the other kind on a thread of its own; pictures go on meanwhile.
void Formations::load_dancers_for(Formation formation) {
    Settings settings = settings_;
    settings.formation = name_of(formation);
    loading_for_ = formation;
    loading_ = std::async(std::launch::async,
                          [settings, catalogue = catalogue_, skeleton = cast_.skeleton] {
                              return Dancers::load(settings, catalogue, skeleton);
                          });
}

// Takes what the thread has solved. Errors: it failed and is still wanted; a failure that the
// person has meanwhile turned away from is not reported.
Expected<void> Formations::take_loaded() {
    auto loaded = loading_.get();
    if (loaded) {
        (is_couple(loading_for_) ? couple_ : alone_).emplace(std::move(*loaded));
    } else if (is_waiting_ && is_couple(asked_) == is_couple(loading_for_)) {
        is_waiting_ = false;
        return fail(fmt::format("formation {}: {}", name_of(asked_), loaded.error().message));
    }
    return {};
}

Expected<bool> Formations::poll() {
    constexpr std::chrono::seconds kNoTime(0);
    // The future is asked without waiting: poll() is called with every picture.
    if (loading_.valid() && loading_.wait_for(kNoTime) == std::future_status::ready) {
        if (auto taken = take_loaded(); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    if (!is_waiting_) {
        return false;
    }
    if (has_dancers_for(asked_)) {
        form();
        return true;
    }
    // One load at a time: another may begin when this one is done.
    if (!loading_.valid()) {
        load_dancers_for(asked_);
    }
    return false;
}

// Forms the cast from the repertoires of the right kind: all formations of a kind share them. The
// last member's is the follow's in a couple.
void Formations::form() {
    const auto& found = (is_couple(asked_) ? couple_ : alone_)->cast().members;
    cast_.members = motion::members_of(asked_,
                                       found.front().repertoire,
                                       found.back().repertoire,
                                       static_cast<std::uint64_t>(settings_.seed));
    danced_ = asked_;
    is_waiting_ = false;
}

std::vector<std::string> Formations::wait() {
    // The load must end first: it may bring dancers whose own threads are still solving.
    if (loading_.valid()) {
        loading_.wait();
    }
    std::vector<std::string> lines;
    for (std::optional<Dancers>* const dancers : {&alone_, &couple_}) {
        if (*dancers) {
            const std::vector<std::string> more = (*dancers)->wait();
            lines.insert(lines.end(), more.begin(), more.end());
        }
    }
    return lines;
}

}  // namespace raks::engine
