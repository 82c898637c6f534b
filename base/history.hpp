#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace raks {

/// A value that a person changes, with the values before it and those that were taken back.
///
///     History<std::vector<Edit>> edits(loaded);
///     edits.change(with_one_more);
///     edits.undo();
///
/// Keeps the last kMostSteps values. Pure. Threads: one.
template <typename Value>
class History {
 public:
    /// Values that are kept for undo.
    static constexpr std::size_t kMostSteps = 500;

    /// `first` counts as saved.
    explicit History(Value first = {}) : now_(std::move(first)), saved_(now_) {}

    /// The value as it is.
    [[nodiscard]] const Value& now() const noexcept { return now_; }

    /// A step: what was taken back is forgotten. The same value again is no step.
    void change(Value next) {
        if (next == now_) {
            return;
        }
        if (before_.size() == kMostSteps) {
            before_.erase(before_.begin());
        }
        before_.push_back(std::exchange(now_, std::move(next)));
        taken_back_.clear();
    }

    /// Whether there is a step to take back.
    [[nodiscard]] bool can_undo() const noexcept { return !before_.empty(); }
    /// Whether a step was taken back.
    [[nodiscard]] bool can_redo() const noexcept { return !taken_back_.empty(); }
    /// Takes the last step back; nothing where there is none.
    void undo() { move_step(before_, taken_back_); }
    /// Does again what was taken back last.
    void redo() { move_step(taken_back_, before_); }

    /// The value is in its file now.
    void mark_saved() { saved_ = now_; }
    /// Whether the value is the one that was saved last.
    [[nodiscard]] bool is_saved() const { return now_ == saved_; }

 private:
    void move_step(std::vector<Value>& from, std::vector<Value>& to) {
        if (!from.empty()) {
            to.push_back(std::exchange(now_, std::move(from.back())));
            from.pop_back();
        }
    }

    Value now_;
    Value saved_;
    std::vector<Value> before_;      // oldest first
    std::vector<Value> taken_back_;  // the next one last
};

}  // namespace raks
