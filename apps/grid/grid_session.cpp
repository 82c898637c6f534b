#include "apps/grid/grid_session.hpp"

#include <algorithm>
#include <utility>

namespace raks::apps {
namespace {

/// Changes a session by one action.
class GridChange {
 public:
    explicit GridChange(GridSession& session) : session_(session) {}

    void operator()(const ChooseBeat& choose) {
        session_.chosen = choose.beat && *choose.beat < now().size() ? choose.beat : std::nullopt;
    }
    void operator()(const StepBeat& step) {
        if (now().empty()) {
            return;
        }
        if (!session_.chosen) {
            session_.chosen = step.is_next ? 0 : now().size() - 1;
        } else if (step.is_next) {
            session_.chosen = std::min(*session_.chosen + 1, now().size() - 1);
        } else {
            session_.chosen = *session_.chosen - std::min<std::size_t>(*session_.chosen, 1);
        }
    }
    void operator()(const TapBeat& tap) {
        // Whoever goes back and taps again begins a new run.
        if (!session_.taps.empty() && tap.time <= session_.taps.back()) {
            end_taps();
        }
        session_.taps.push_back(std::clamp(tap.time, 0.0, session_.seconds));
        session_.chosen.reset();
    }
    void operator()(const EndTaps& /*action*/) { end_taps(); }
    void operator()(const HoldBeat& hold) {
        session_.held = hold.held;
        session_.chosen = hold.held.beat;
    }
    void operator()(const LetGoOfBeat& /*action*/) {
        const std::optional<HeldBeat> held = std::exchange(session_.held, std::nullopt);
        if (held && held->beat < now().size()) {
            change(with_moved(now(), held->beat, held->time, session_.seconds));
        }
    }
    void operator()(const NudgeBeat& nudge) {
        if (session_.chosen) {
            const double time = now()[*session_.chosen].time + nudge.by;
            change(with_moved(now(), *session_.chosen, time, session_.seconds));
        }
    }
    void operator()(const InsertBeat& insert) {
        const double time = std::clamp(insert.time, 0.0, session_.seconds);
        change(with_inserted(now(), time));
        const BeatReach there = between(now(), time - kClosestBeats, time + kClosestBeats);
        if (there.first < there.last) {
            session_.chosen = there.first;
        }
    }
    void operator()(const RemoveBeat& /*action*/) {
        if (session_.chosen) {
            change(with_removed(now(), *session_.chosen));
        }
    }
    void operator()(const ShiftBeats& shift) {
        change(with_shifted(now(), session_.meant(), shift.by, session_.seconds));
    }
    void operator()(const HalveBeats& /*action*/) {
        change(with_half(now(), session_.meant()));
        session_.chosen.reset();
    }
    void operator()(const DoubleBeats& /*action*/) {
        change(with_double(now(), session_.meant()));
        session_.chosen.reset();
    }
    void operator()(const EvenBeats& /*action*/) { change(with_even(now(), session_.meant())); }
    void operator()(const MarkOne& /*action*/) {
        if (session_.chosen) {
            change(with_one_at(now(), *session_.chosen));
        }
    }
    void operator()(const ToggleUse& /*action*/) {
        const BeatReach reach = session_.meant_for_use();
        bool is_any = false;
        for (std::size_t i = reach.first; i < reach.last; ++i) {
            is_any = is_any || now()[i].is_used;
        }
        change(with_use(now(), reach, !is_any));
    }
    void operator()(const MarkStretch& mark) {
        GridStretch stretch = session_.stretch.value_or(GridStretch{0.0, session_.seconds});
        (mark.is_first ? stretch.from : stretch.to) = mark.time;
        // An end that lies before the beginning is a beginning of another stretch.
        if (stretch.to < stretch.from) {
            (mark.is_first ? stretch.to : stretch.from) = mark.is_first ? session_.seconds : 0.0;
        }
        session_.stretch = stretch;
    }
    void operator()(const ForgetChosen& /*action*/) {
        session_.chosen.reset();
        session_.stretch.reset();
        session_.held.reset();
    }
    void operator()(const ReplaceBeats& replace) {
        change(replace.beats);
        session_.chosen.reset();
    }
    void operator()(const UndoGrid& /*action*/) {
        session_.beats.undo();
        keep_chosen();
    }
    void operator()(const RedoGrid& /*action*/) {
        session_.beats.redo();
        keep_chosen();
    }

    void end_taps() {
        if (!session_.taps.empty()) {
            change(with_taps(now(), session_.taps));
            session_.taps.clear();
        }
    }

 private:
    [[nodiscard]] const GridBeats& now() const { return session_.beats.now(); }
    void change(GridBeats beats) {
        session_.beats.change(std::move(beats));
        keep_chosen();
    }
    void keep_chosen() {
        session_.held.reset();
        if (session_.chosen && *session_.chosen >= now().size()) {
            session_.chosen.reset();
        }
    }

    GridSession& session_;
};

}  // namespace

GridBeats GridSession::shown() const {
    if (!taps.empty()) {
        return with_taps(beats.now(), taps);
    }
    if (held && held->beat < beats.now().size()) {
        return with_moved(beats.now(), held->beat, held->time, seconds);
    }
    return beats.now();
}

BeatReach GridSession::meant() const {
    return stretch ? between(beats.now(), stretch->from, stretch->to) : all_of(beats.now());
}

BeatReach GridSession::meant_for_use() const {
    if (stretch) {
        return meant();
    }
    return chosen ? BeatReach{*chosen, *chosen + 1} : BeatReach{};
}

GridSession grid_session(const motion::TakeGrid& grid, double seconds) {
    GridSession session;
    session.take = grid.take;
    session.seconds = seconds;
    session.beats = History<GridBeats>(grid.beats);
    return session;
}

void apply(const GridAction& action, GridSession& session) {
    GridChange change(session);
    if (!std::holds_alternative<TapBeat>(action)) {
        change.end_taps();
    }
    std::visit(change, action);
}

}  // namespace raks::apps
