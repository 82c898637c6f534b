#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/play_queue.hpp"
#include "audio/io/pipe_reader.hpp"
#include "base/expected.hpp"
#include "engine/setup/play_list.hpp"
#include "engine/setup/play_order.hpp"

namespace raks::apps {

/// Whether what waits for a file is to stop.
using IsStopped = std::function<bool()>;

/// Opens what comes through a pipe. Errors: the section does not begin at 0; those of opening it.
[[nodiscard]] Expected<std::unique_ptr<audio::PipeReader>> open_pipe(const Path& path,
                                                                     const Section& section);
/// Whether a file can be played from the section's start on. Errors: why not.
[[nodiscard]] Expected<void> check_file(const Path& path,
                                        const Section& section,
                                        const IsStopped& is_stopped);

/// Of files none of which could be played, why. `skipped`: at least one.
[[nodiscard]] std::string nothing_played(const engine::SkippedFiles& skipped);

/// The files in their order, and what of them turned out not to be playable. Threads: main.
class PlaySet final : public PlayQueue {
 public:
    /// `arguments`: section, order and seed; must outlive this.
    PlaySet(engine::PlayList list, const PlayArguments& arguments);

    /// Goes to the first file that can be played; a pipe is opened. Errors: there is none; the line
    /// says why.
    [[nodiscard]] Expected<void> begin();
    /// The pipe that begin() opened, once; else null.
    [[nodiscard]] std::unique_ptr<audio::PipeReader> take_pipe() { return std::move(pipe_); }
    /// The file that plays; null: the end.
    [[nodiscard]] const Path* current() const;
    /// Whether a file follows that can be played, as far as that can be told without playing it.
    [[nodiscard]] bool has_next();
    /// That file, once has_next() has looked; empty: none, or one that comes through a pipe.
    [[nodiscard]] Path next() const;
    void go_on() { order_.go_on(); }      ///< as of engine::PlayOrder
    void go_back() { order_.go_back(); }  ///< likewise
    /// The current file turned out not to be playable: it is left out, the next one follows.
    void skip_current(const std::string& why) {
        list_.skipped.add(why);
        order_.drop_current();
    }
    /// What was left out.
    [[nodiscard]] const engine::SkippedFiles& skipped() const noexcept { return list_.skipped; }
    /// Asked while a file's decoder keeps one waiting; until this is called, signals end that.
    void stop_when(IsStopped is_stopped) { is_stopped_ = std::move(is_stopped); }

    [[nodiscard]] std::vector<std::string> names(std::size_t most) const override;
    [[nodiscard]] std::size_t size() const override { return order_.files().size(); }
    [[nodiscard]] std::size_t place() const override { return order_.place(); }
    void go_to(std::size_t place) override { order_.go_to(place); }
    [[nodiscard]] Expected<std::size_t> add(const std::vector<Path>& given) override;

 private:
    // Pipes are opened once, when they are played.
    [[nodiscard]] Expected<void> check(const Path& path) const;
    [[nodiscard]] Expected<void> open_first();

    engine::PlayList list_;
    const Section& section_;
    engine::PlayOrder order_;
    std::unique_ptr<audio::PipeReader> pipe_;
    IsStopped is_stopped_;
};

}  // namespace raks::apps
