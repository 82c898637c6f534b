#include "motion/ensemble.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include "motion/library_content.hpp"

namespace raks::motion {
namespace {

constexpr int kCanonBars = 2;  // a figure of eight counts

/// Seed of member i's ways: differs between members, so that they do not move alike.
std::uint64_t ways_of(std::uint64_t seed, std::size_t member) {
    return seed + 1000 * static_cast<std::uint64_t>(member);
}

}  // namespace

Expected<void> Ensemble::prepare(std::span<const EnsembleMember> members) {
    if (members.empty() || members.size() > kMost) {
        return fail("an ensemble has 1 to " + std::to_string(kMost) + " dancers");
    }
    std::vector<Dancer> dancers(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
        const DancingBody& body = members[i].body;
        if (auto ok = dancers[i].prepare(body.repertoire, body.skeleton, members[i].part); !ok) {
            return ok;
        }
    }
    dancers_ = std::move(dancers);
    places_.clear();
    for (const EnsembleMember& member : members) {
        places_.emplace_back(member.part.place);
    }
    hold_.prepare(members.front().body.skeleton, members.back().body.skeleton);
    const bool is_couple = members.size() == 2 && members[0].part.is_in_couple;
    couple_ = is_couple ? members[0].body.repertoire : nullptr;
    return {};
}

// The lead's figure is the follow's, too: both are chosen from one seed.
HoldMoment Ensemble::hold_moment() const noexcept {
    HoldMoment moment;
    const DancerStatus status = dancers_.front().status();
    const DanceLibrary* const library = couple_->of(status.dance);
    if (!status.is_dancing || library == nullptr) {
        return moment;
    }
    const DanceContent& content = library->content();
    // Longer names are cut in the status.
    const auto cut = [](std::string_view name) {
        return name.substr(0, DancerStatus{}.figure.size() - 1);
    };
    const auto figure =
        std::find_if(content.figures.begin(), content.figures.end(), [&](const LibraryFigure& one) {
            return cut(one.name) == std::string_view(status.figure.data());
        });
    if (figure != content.figures.end()) {
        moment.hold = content.form.hold;
        moment.frame = content.form.frame;
        moment.holds = figure->holds;
        moment.beat = status.phase;
        moment.beats = figure->beats;
        moment.rate = status.rate;
    }
    return moment;
}

void Ensemble::advance(const MusicState& state,
                       std::span<PoseTrack> tracks) noexcept RAKS_NONBLOCKING {
    for (std::size_t i = 0; i < std::min(dancers_.size(), tracks.size()); ++i) {
        dancers_[i].advance(state, tracks[i]);
    }
    // After all have advanced: the hold changes the poses of both.
    if (couple_ && tracks.size() >= 2 && !tracks[0].is_empty()) {
        hold_.advance(hold_moment(), tracks[0], tracks[1]);
    }
}

void Ensemble::stand_ready(std::span<PoseTrack> tracks) const noexcept {
    for (std::size_t i = 0; i < dancers_.size(); ++i) {
        tracks[i].clear();
        tracks[i].append_final(0, dancers_[i].shown());
    }
}

void Ensemble::command(const DancerCommand& command) noexcept RAKS_NONBLOCKING {
    for (Dancer& dancer : dancers_) {
        dancer.command(command);
    }
}

void Ensemble::go_on_from(const Ensemble& before) noexcept RAKS_NONBLOCKING {
    for (std::size_t i = 0; i < std::min(dancers_.size(), before.dancers_.size()); ++i) {
        dancers_[i].go_on_from(before.dancers_[i]);
    }
    hold_.go_on_from(before.hold_);
}

void Ensemble::reset() noexcept RAKS_NONBLOCKING {
    for (Dancer& dancer : dancers_) {
        dancer.reset();
    }
    hold_.reset();
}

DancerStatus Ensemble::status() const noexcept RAKS_NONBLOCKING {
    return dancers_.empty() ? DancerStatus{} : dancers_.front().status();
}

std::vector<EnsembleMember> members_of(Formation formation,
                                       const std::vector<DancingBody>& bodies,
                                       std::uint64_t seed,
                                       Dynamics dynamics,
                                       std::size_t dancers) {
    DancerPart part;
    part.dynamics = dynamics;
    part.seed = part.ways = seed;
    if (formation == Formation::solo) {
        return {{bodies.front(), part}};
    }
    std::vector<EnsembleMember> members;
    if (formation == Formation::couple) {
        part.is_in_couple = true;
        for (const std::size_t own : {0U, 1U}) {
            part.ways = ways_of(seed, own);
            part.partner = bodies[1 - own].repertoire;
            members.push_back({bodies[own], part});
        }
        return members;
    }
    // Of more than these the last would begin when the song is over.
    constexpr std::size_t kCanonVoices = 8;
    const std::vector<glm::dvec2> places = places_in(formation, dancers_in(formation, dancers));
    for (std::size_t i = 0; i < places.size(); ++i) {
        part.place = places[i];
        part.bars_late =
            formation == Formation::canon ? kCanonBars * static_cast<int>(i % kCanonVoices) : 0;
        part.room = room_in(formation);
        part.ways = ways_of(seed, i);
        part.seed = formation == Formation::free ? part.ways : seed;
        members.push_back({bodies[i % bodies.size()], part});
    }
    return members;
}

}  // namespace raks::motion
