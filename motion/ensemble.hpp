// Ensemble: several dancers to the same music.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/realtime.hpp"
#include "motion/dance/hand_hold.hpp"
#include "motion/dancer.hpp"
#include "motion/repertoire.hpp"

namespace raks::motion {

/// One of several who dance to the same music.
struct EnsembleMember {
    std::shared_ptr<const Repertoire> repertoire;  ///< its dances; not null
    DancerPart part;                               ///< what it does of its own
};

/// Several dancers, each on a track of its own: a couple, or some side by side.
/// Threads: one owner; prepare elsewhere before.
class Ensemble {
 public:
    static constexpr std::size_t kMost = 4;  ///< members

    Ensemble() = default;  ///< of nobody
    /// Of one dancer who is prepared already.
    Ensemble(Dancer dancer) { dancers_.push_back(std::move(dancer)); }

    /// Errors: none or more than kMost members; as Dancer::prepare says. Real-time: no.
    [[nodiscard]] Expected<void> prepare(std::span<const EnsembleMember> members,
                                         const Skeleton& skeleton);

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
    /// How firmly the two of a couple hold one another in the newest final poses, by Grip; all 0
    /// for others. Real-time: yes.
    [[nodiscard]] GripWeights held() const noexcept RAKS_NONBLOCKING { return hold_.held(); }
    /// The first member's status; an empty one without members.
    [[nodiscard]] DancerStatus status() const noexcept RAKS_NONBLOCKING;

 private:
    [[nodiscard]] HoldMoment hold_moment() const noexcept;

    std::vector<Dancer> dancers_;
    // The lead's dances, which say how a couple holds; null unless the first two are a couple.
    std::shared_ptr<const Repertoire> couple_;
    HandHold hold_;
};

/// How several stand and follow one another.
enum class Formation {
    solo,
    couple,  ///< lead and follow, facing, the same figures
    unison,  ///< three, the same figures at the same time
    canon,   ///< three, each two bars after the one before
    free,    ///< three, each with figures of its own
};
/// Names of the formations, in the order of Formation.
inline constexpr std::array<std::string_view, 5> kFormationNames = {
    "solo", "couple", "unison", "canon", "free"};

/// The members of a formation. `lead`, `follow`: the two parts of the dance; couples need both.
[[nodiscard]] std::vector<EnsembleMember> members_of(
    Formation formation,
    const std::shared_ptr<const Repertoire>& lead,
    const std::shared_ptr<const Repertoire>& follow,
    std::uint64_t seed,
    Dynamics dynamics = Dynamics::on);

}  // namespace raks::motion
