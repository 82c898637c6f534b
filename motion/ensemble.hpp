// Ensemble: several dancers to the same music.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/realtime.hpp"
#include "motion/dance/hand_hold.hpp"
#include "motion/dancer.hpp"
#include "motion/formation.hpp"
#include "motion/repertoire.hpp"

namespace raks::motion {

/// A body that dances, and the dances that were solved for it.
struct DancingBody {
    Skeleton skeleton;
    std::shared_ptr<const Repertoire> repertoire;  ///< not null
};

/// One of several who dance to the same music.
struct EnsembleMember {
    DancingBody body;
    DancerPart part;  ///< what it does of its own
};

/// Several dancers, each on a track of its own: a couple, or some side by side.
/// Threads: one owner; prepare elsewhere before.
class Ensemble {
 public:
    static constexpr std::size_t kMost = kMostDancers;  ///< members

    Ensemble() = default;  ///< of nobody
    /// Of one dancer who is prepared already.
    Ensemble(Dancer dancer) : places_(1) { dancers_.push_back(std::move(dancer)); }

    /// Errors: none or more than kMost members; as Dancer::prepare says. Real-time: no.
    [[nodiscard]] Expected<void> prepare(std::span<const EnsembleMember> members);

    /// One hop for all: member i appends to tracks[i]. Real-time: yes.
    void advance(const MusicState& state, std::span<PoseTrack> tracks) noexcept RAKS_NONBLOCKING;
    /// Queues the command with all members. Real-time: yes.
    void command(const DancerCommand& command) noexcept RAKS_NONBLOCKING;
    /// Each member goes on where that of `before` is (Dancer::go_on_from). Real-time: yes.
    void go_on_from(const Ensemble& before) noexcept RAKS_NONBLOCKING;
    /// Resets all members. Real-time: yes.
    void reset() noexcept RAKS_NONBLOCKING;

    /// How all stand ready before the first hop: hop 0 of each track, which is emptied first. To be
    /// shown only: advance() begins on empty tracks. Real-time: yes.
    void stand_ready(std::span<PoseTrack> tracks) const noexcept;

    /// Number of members.
    [[nodiscard]] std::size_t size() const noexcept { return dancers_.size(); }
    /// Where each stands when not carried away by the dance (DancerPart::place). Real-time: yes.
    [[nodiscard]] std::span<const glm::vec2> places() const noexcept { return places_; }
    /// How firmly the two of a couple hold one another in the newest final poses, by Grip; all 0
    /// for others. Real-time: yes.
    [[nodiscard]] GripWeights held() const noexcept RAKS_NONBLOCKING { return hold_.held(); }
    /// The first member's status; an empty one without members.
    [[nodiscard]] DancerStatus status() const noexcept RAKS_NONBLOCKING;

 private:
    [[nodiscard]] HoldMoment hold_moment() const noexcept;

    std::vector<Dancer> dancers_;
    std::vector<glm::vec2> places_;  // one a dancer
    // The lead's dances, which say how a couple holds; null unless the first two are a couple.
    std::shared_ptr<const Repertoire> couple_;
    HandHold hold_;
};

/// The members of a formation. `bodies`: of a couple the lead's and the follow's, each with its
/// part of the dances; of others those that dancers have in turn, at least one, with the lead's
/// part. `dancers`: as for dancers_in.
[[nodiscard]] std::vector<EnsembleMember> members_of(Formation formation,
                                                     const std::vector<DancingBody>& bodies,
                                                     std::uint64_t seed,
                                                     Dynamics dynamics = Dynamics::on,
                                                     std::size_t dancers = 0);

}  // namespace raks::motion
