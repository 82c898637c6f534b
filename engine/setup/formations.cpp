#include "engine/setup/formations.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/suggest.hpp"
#include "engine/setup/asked_formation.hpp"
#include "engine/setup/dance_files.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

using motion::Formation;

// Formations fall into two kinds by the form of the dances that they need.
bool is_couple(Formation formation) { return formation == Formation::couple; }

// The next enumerator, cyclically.
Formation after(Formation formation) {
    return static_cast<Formation>((static_cast<std::size_t>(formation) + 1) %
                                  motion::kFormationNames.size());
}

}  // namespace

Expected<Formations> Formations::load(const Settings& settings,
                                      const DanceCatalogue& catalogue,
                                      const std::vector<motion::Skeleton>& bodies) {
    auto dancers = Dancers::load(settings, catalogue, bodies);
    if (!dancers) {
        return fail(std::move(dancers.error()));
    }
    return Formations(settings, catalogue, std::move(*dancers), bodies);
}

Formations::Formations(Settings settings,
                       DanceCatalogue catalogue,
                       Dancers dancers,
                       std::vector<motion::Skeleton> bodies)
    : settings_(std::move(settings)),
      catalogue_(std::move(catalogue)),
      danced_(asked_formation(settings_)),
      asked_(danced_),
      cast_(dancers.cast()),
      bodies_(std::move(bodies)),
      danced_bodies_(bodies_) {
    // Dancers are kept by kind, so that going back to a formation needs no loading.
    (is_couple(danced_) ? couple_ : alone_).emplace(std::move(dancers));
}

Formations::~Formations() {
    // Of one that was moved from nothing is loading, and nobody is there.
    if (loading_.valid()) {
        loading_stop_.ask();
    }
    for (std::optional<Dancers>* const dancers : {&alone_, &couple_}) {
        if (*dancers) {
            (*dancers)->stop_solving();
        }
    }
}

std::string_view Formations::name() const noexcept { return name_of(danced_); }

// Asking again while a formation is being loaded only moves the wish: poll() serves the last one.
std::string_view Formations::ask_for_next() {
    asked_ = after(asked_);
    is_waiting_ = true;
    return name_of(asked_);
}

Expected<void> Formations::ask_for(std::string_view name) {
    const auto& names = motion::kFormationNames;
    const auto* const found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        return fail(unknown_name("formation", name, names));
    }
    asked_ = static_cast<motion::Formation>(found - names.begin());
    is_waiting_ = true;
    return {};
}

void Formations::ask_for_bodies(const std::vector<motion::Skeleton>& bodies) {
    if (bodies == bodies_) {
        return;
    }
    bodies_ = bodies;
    // A formation that the dance has not is not asked for again with the bodies.
    if (!is_waiting_) {
        asked_ = danced_;
    }
    is_waiting_ = true;
    // They go on to dance what they know; the processor is for the others.
    if (loading_.valid()) {
        loading_stop_.ask();
    }
    for (std::optional<Dancers>* const dancers : {&alone_, &couple_}) {
        if (*dancers) {
            (*dancers)->stop_solving();
        }
    }
}

std::optional<Dancers>& Formations::dancers_for(Formation formation) noexcept {
    return is_couple(formation) ? couple_ : alone_;
}

bool Formations::has_dancers_for(Formation formation) const noexcept {
    const std::optional<Dancers>& dancers = is_couple(formation) ? couple_ : alone_;
    if (!dancers || dancers->is_stopped()) {
        return false;
    }
    return bodies_in(formation, bodies_, settings_) == dancers->loaded_for();
}

// Whether those who are asked for know a dance.
bool Formations::knows(DanceId dance) const noexcept {
    const std::optional<Dancers>& dancers = is_couple(asked_) ? couple_ : alone_;
    return dancers->bodies().front().repertoire->of(dance) != nullptr;
}

// Solves the dances on a thread of its own; pictures go on meanwhile.
void Formations::load_dancers_for(Formation formation) {
    Settings settings = settings_;
    settings.formation = name_of(formation);
    loading_for_ = formation;
    loading_stop_ = StopSolving();
    loading_ =
        std::async(std::launch::async,
                   [settings, catalogue = catalogue_, bodies = bodies_, stop = loading_stop_] {
                       constexpr int kThreads = 1;  // the others are the show's
                       return Dancers::load(settings, catalogue, bodies, kThreads, stop);
                   });
}

// Destroyed at once, they would make this thread wait for the dance that is being solved.
void Formations::dismiss(std::optional<Dancers>& dancers) {
    if (dancers) {
        dancers->stop_solving();
        dismissed_.push_back(std::move(*dancers));
        dancers.reset();
    }
}

void Formations::free_dismissed() {
    std::erase_if(dismissed_, [](const Dancers& dancers) { return dancers.is_done(); });
}

// Takes what the thread has solved. Errors: it failed and is still wanted; a failure that the
// person has meanwhile turned away from is not reported.
Expected<void> Formations::take_loaded() {
    auto loaded = loading_.get();
    if (loaded) {
        std::optional<Dancers>& dancers = dancers_for(loading_for_);
        dismiss(dancers);
        dancers.emplace(std::move(*loaded));
    } else if (is_waiting_ && !loading_stop_.is_asked() &&
               is_couple(asked_) == is_couple(loading_for_)) {
        is_waiting_ = false;
        // Bodies that cannot be danced with are not asked for again with the next picture.
        if (asked_ == danced_) {
            return fail("the dance does not fit this avatar exactly: " + loaded.error().message);
        }
        // The formation after this one is asked for next; the bodies are still to be solved for.
        bodies_ = danced_bodies_;
        return fail(fmt::format("formation {}: {}", name_of(loading_for_), loaded.error().message));
    }
    return {};
}

Expected<Formations::Change> Formations::poll(DanceId danced) {
    constexpr std::chrono::seconds kNoTime(0);
    free_dismissed();
    // The future is asked without waiting: poll() is called with every picture.
    if (loading_.valid() && loading_.wait_for(kNoTime) == std::future_status::ready) {
        if (auto taken = take_loaded(); !taken) {
            return fail(std::move(taken.error()));
        }
    }
    if (!is_waiting_) {
        return Change::none;
    }
    if (has_dancers_for(asked_)) {
        const bool can_go_on = danced == DanceId::none || asked_ != danced_ || knows(danced);
        return can_go_on ? form() : Change::none;
    }
    // One load at a time: another may begin when this one is done.
    if (!loading_.valid()) {
        load_dancers_for(asked_);
    }
    return Change::none;
}

// Forms the cast from the repertoires of the right kind: all formations of a kind share them.
Formations::Change Formations::form() {
    const Change change = asked_ == danced_ ? Change::bodies : Change::formation;
    cast_ = motion::members_of(asked_,
                               dancers_for(asked_)->bodies(),
                               static_cast<std::uint64_t>(settings_.seed),
                               dynamics_of(settings_),
                               asked_dancers(settings_, asked_));
    danced_ = asked_;
    danced_bodies_ = bodies_;
    is_waiting_ = false;
    return change;
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
