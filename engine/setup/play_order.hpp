#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace raks::engine {

/// How a set of files is gone through.
struct PlayOrderOptions {
    std::optional<std::uint64_t> shuffle_seed =
        std::nullopt;      ///< mixes the files; the same seed, the same order
    bool repeats = false;  ///< begins anew behind the last file
};

/// Which of several files plays, and which come before and after it. Files are numbers from 0 on.
///
///     PlayOrder order(files.size(), {});
///     while (order.current()) { play(files[*order.current()]); order.go_on(); }
///
/// Mixed and repeated, each round is mixed anew, and does not begin with the file that has just
/// ended. Threads: one. Real-time: no.
class PlayOrder {
 public:
    /// Begins with the first of `count` files, mixed if that is asked for.
    PlayOrder(std::size_t count, const PlayOrderOptions& options);

    /// The file to play; nothing: the end, or there are none left.
    [[nodiscard]] std::optional<std::size_t> current() const noexcept;
    /// Whether a file follows the current one.
    [[nodiscard]] bool has_next() const noexcept;
    /// The file that follows; nothing: none does, or the round that begins anew is yet to be mixed.
    [[nodiscard]] std::optional<std::size_t> next() const noexcept;
    /// On to the next file; behind the last one to the end, or around.
    void go_on();
    /// Back to the file before; from the first one nowhere, or around.
    void go_back();
    /// All files in the order in which they play; those that were left out are not among them.
    [[nodiscard]] const std::vector<std::size_t>& files() const noexcept { return order_; }
    /// Where in files() the current one stands; files().size(): at the end.
    [[nodiscard]] std::size_t place() const noexcept { return at_; }
    /// Goes to a place of files(); one behind its end is the end.
    void go_to(std::size_t place) noexcept { at_ = place < order_.size() ? place : order_.size(); }
    /// Puts `count` more files at the end; their numbers follow `first`.
    void append(std::size_t first, std::size_t count);
    /// Leaves the current file out from here on, and goes on to the next.
    void drop_current();
    /// Leaves the file that follows out from here on. There must be one: next().
    void drop_next();

 private:
    void mix();

    PlayOrderOptions options_;
    std::vector<std::size_t> order_;
    std::size_t at_ = 0;
    std::uint64_t rounds_ = 0;
};

}  // namespace raks::engine
