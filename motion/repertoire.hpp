#pragma once

#include <array>
#include <atomic>
#include <memory>

#include "base/dance_list.hpp"
#include "motion/dance_library.hpp"

namespace raks::motion {

/// The dances that a dancer knows, by their numbers in the program's list, and what is danced to
/// music of none of them. May grow while it is danced from: a dance that is added later is danced
/// from then on.
class Repertoire {
 public:
    /// What is danced while the genre is unknown, or its dance is not known.
    enum class Fallback {
        first,  ///< the first dance
        keep,   ///< what is danced already
        stand,  ///< nothing
    };

    /// Errors are the caller's: `library` must be there. Threads: any. Real-time: no.
    Repertoire(DanceId first,
               std::shared_ptr<const DanceLibrary> library,
               Fallback otherwise = Fallback::first);

    /// One dance to any music. Null stays null.
    [[nodiscard]] static std::shared_ptr<const Repertoire> of_one(
        std::shared_ptr<const DanceLibrary> library);

    /// Adds a dance, once; it stays for as long as the repertoire lives.
    /// Threads: one at a time. Real-time: no.
    void add(DanceId id, std::shared_ptr<const DanceLibrary> library);

    /// Null: not known (yet). Threads: any. Real-time: yes.
    [[nodiscard]] const DanceLibrary* of(DanceId id) const noexcept;
    [[nodiscard]] DanceId first() const noexcept { return first_; }
    [[nodiscard]] Fallback otherwise() const noexcept { return fallback_; }

 private:
    DanceId first_;
    Fallback fallback_;
    std::array<std::shared_ptr<const DanceLibrary>, kMostDances> owned_;
    std::array<std::atomic<const DanceLibrary*>, kMostDances> dances_{};
};

}  // namespace raks::motion
