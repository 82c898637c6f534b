#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/terminal/program.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// The files that play one after another, for a list in the window. Threads: main.
class PlayQueue {
 public:
    virtual ~PlayQueue() = default;  ///< queues are owned elsewhere

    /// The names of files in the order in which they play: of the first so many.
    [[nodiscard]] virtual std::vector<std::string> names(std::size_t most) const = 0;
    /// Which of them plays; as many as there are: none any more.
    [[nodiscard]] virtual std::size_t place() const = 0;
    /// Whether one follows the one that plays.
    [[nodiscard]] bool has_more() const { return place() + 1 < size(); }
    /// How many files there are.
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// That one plays next, in the place of the one that does.
    virtual void go_to(std::size_t place) = 0;
    /// Adds files, folders and playlists at the end; returns how many files these are. Errors:
    /// nothing of them can be played.
    [[nodiscard]] virtual Expected<std::size_t> add(const std::vector<Path>& given) = 0;
};

}  // namespace raks::apps
