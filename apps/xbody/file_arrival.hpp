// File arrival: files that were dropped on a window, on their way into it.
#pragma once

#include <functional>
#include <future>
#include <optional>
#include <vector>

#include "apps/xbody/dropped_files.hpp"

namespace raks::apps {

/// Reads dropped files beside the thread of the window, which goes on meanwhile. Waits, when it is
/// destroyed, for what is being read. Threads: one. Real-time: no.
class FileArrival {
 public:
    /// What the worker does with what was read, before it is there: shaders may be made ready, and
    /// the sound.
    using Preparation = std::function<void(DroppedFiles&)>;
    explicit FileArrival(Preparation prepare) : prepare_(std::move(prepare)) {}

    /// Asks for files. What was asked for before and is not there yet is given up.
    void ask(std::vector<DroppedFile> files, MotionWearer wearer);
    /// The model that is shown stands otherwise than when it was asked: what is on its way is read
    /// anew.
    void ask_again(MotionWearer wearer);
    /// Whether something is asked for and has not been taken.
    [[nodiscard]] bool is_awaited() const noexcept { return asked_ || loading_.valid(); }
    /// Whether take() would give something, or begin to read.
    [[nodiscard]] bool is_due() const;
    /// What has come, once; none: nothing yet.
    [[nodiscard]] std::optional<DroppedFiles> take();

 private:
    Preparation prepare_;
    std::vector<DroppedFile> files_;     // that were asked for last
    std::optional<MotionWearer> asked_;  // to be read for, and not begun
    std::future<DroppedFiles> loading_;  // one at a time
};

}  // namespace raks::apps
