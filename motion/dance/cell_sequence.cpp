#include "motion/dance/cell_sequence.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kThinksFor = 1.0;      // beats before a decision in which futures are drawn
constexpr double kLatest = 0.5;         // beats ahead that are decided, also without all futures
constexpr double kCutAhead = 0.6;       // beats before which nothing that is decided changes
constexpr int kBar = 4;                 // beats
constexpr double kDropLasts = 4.0;      // beats of the greatest cells
constexpr double kBeatRounding = 1e-6;  // beats
constexpr int kMostToComeBack = 6;      // beats of a take in which it comes from a rest into time
constexpr double kRateBack = 1.1;       // at which it does best
constexpr double kBackCost = 0.30;      // of a beat that passes until then
constexpr double kSeenBefore = 0.1;   // beats before, from which on it moves: its speed is smoothed
constexpr double kSoonestBack = 0.4;  // beats

bool is_odd(double phase) noexcept { return std::lround(phase) % 2 != 0; }

}  // namespace

void CellSequence::start(const DanceContent& content,
                         const FloorMove& stage,
                         const DancerPart& part) noexcept RAKS_NONBLOCKING {
    if (content_ == nullptr || content_->cells != content.cells) {
        rows_ = CellRows();
    }
    content_ = &content;
    stage_ = stage;
    faces_us_ = !part.is_in_couple;
    room_ = part.room;
    last_ = chooser_.start(*content.cells, part.seed);
    phase_ = 0.0;
    has_cut_ = false;
    Piece first;
    first.first_cell = last_.cell;
    first.until = 1.0;
    // The hips stand in the middle of the stage, to the front.
    first.floor = stage * inverse(floor_frame(pose_of(first, 0.0)));
    begin_with(first);
    number_ = 0;
}

void CellSequence::go_on_in(const DanceContent& content, const FloorMove& stage) noexcept {
    if (content_ != nullptr && content.cells != nullptr) {
        chooser_.go_on_in(*content.cells);
    }
    content_ = content_ != nullptr ? &content : nullptr;
    stage_ = stage;
}

// One piece alone, of which the last cell is the last that is decided.
void CellSequence::begin_with(const Piece& piece) noexcept {
    pieces_[0] = piece;
    count_ = 1;
    present_ = 0;
    ++number_;
    last_ = {
        static_cast<std::uint16_t>(cell_of(piece, piece.until - 0.5)), piece.is_mirrored, false};
    forget_choice();
}

void CellSequence::forget_choice() noexcept {
    second_.reset();
    chooser_.forget_futures();
}

std::size_t CellSequence::piece_at(double phase) const noexcept {
    std::size_t i = 0;
    while (i + 1 < count_ && phase >= pieces_[i + 1].from) {
        ++i;
    }
    return i;
}

std::size_t CellSequence::cell_of(const Piece& piece, double phase) const noexcept {
    const double last = std::round(piece.until - piece.from) - 1.0;
    const double beats = std::floor(shown(piece, phase) - piece.from + kBeatRounding);
    return piece.first_cell + static_cast<std::size_t>(std::clamp(beats, 0.0, std::max(0.0, last)));
}

bool CellSequence::rests_at(Beats phase) const noexcept RAKS_NONBLOCKING {
    return is_rest(*content_->cells, step_at(phase - Beats(0.5)).cell);
}

CellStep CellSequence::step_at(Beats phase) const noexcept RAKS_NONBLOCKING {
    const Piece& piece = pieces_[piece_at(phase.count())];
    return {static_cast<std::uint16_t>(cell_of(piece, phase.count())), piece.is_mirrored, false};
}

// Where the last piece that is decided ends, seen from the stage.
FloorMove CellSequence::end_on_stage() const noexcept {
    const Piece& last = pieces_[count_ - 1];
    return inverse(stage_) * floor_frame(pose_of(last, last.until));
}

// What the beats after the last that is decided shall be like.
CellWish CellSequence::wished(const CellMusic& music, const FigureWish& wish) const noexcept {
    CellWish wanted;
    wanted.faces_us = faces_us_;
    wanted.room = room_;
    if (wish.figure && *wish.figure < content_->figures.size()) {
        wanted.take = static_cast<std::uint16_t>(*wish.figure);
    }
    for (int i = 0; i < kCellLook; ++i) {
        CellBeatWish& beat = wanted.beats[static_cast<std::size_t>(i)];
        const double phase = pieces_[count_ - 1].until + i;
        const auto is_at = [phase](const std::optional<double>& when) {
            return when && std::abs(*when - phase) < 0.5;
        };
        beat.is_greatest = music.drop_at && phase > *music.drop_at - 0.5 &&
                           phase < *music.drop_at + kDropLasts - 0.5;
        beat.energy = beat.is_greatest ? 1.0 : music.energy;
        beat.rests_at_end = music.rests_at && std::abs(*music.rests_at - (phase + 1.0)) < 0.5;
        beat.is_another = is_at(music.anew_at) || (i == 0 && wish.is_another);
        if (rows_.is_kept()) {
            beat.is = rows_.kept(i);
        } else if (music.song && !beat.rests_at_end) {
            beat.is = rows_.repeated(phase, *music.song);
        }
    }
    return wanted;
}

// What asks for another row of cells than the one that is decided.
void CellSequence::take_wishes(const CellMusic& music, const FigureWish& wish) noexcept {
    if (!wish.is_locked) {
        rows_.let_go();
    } else if (!rows_.is_kept()) {
        rows_.keep(*content_->cells);
    }
    const bool is_asked = wish.is_another || wish.figure.has_value();
    if (music.has_come_in || (is_asked && !has_cut_)) {
        cut();
    }
    has_cut_ = is_asked;
}

// Leaves what is decided from the next beat on.
void CellSequence::cut() noexcept {
    const double at = std::ceil(phase_ + kCutAhead);
    while (count_ > 1 && pieces_[count_ - 1].from >= at) {
        --count_;
    }
    Piece& last = pieces_[count_ - 1];
    last.until = std::min(last.until, std::max(at, std::ceil(last.rest.to)));
    last_ = {static_cast<std::uint16_t>(cell_of(last, last.until - 0.5)), last.is_mirrored, false};
    forget_choice();
}

void CellSequence::advance(Beats phase,
                           const CellMusic& music,
                           FigureWish& wish) noexcept RAKS_NONBLOCKING {
    phase_ = phase.count();
    while (present_ + 1 < count_ && phase_ >= pieces_[present_ + 1].from) {
        ++present_;
        ++number_;
    }
    // The piece before is kept for as long as it is joined.
    if (present_ > 1) {
        const std::size_t gone = present_ - 1;
        std::move(pieces_.begin() + static_cast<std::ptrdiff_t>(gone),
                  pieces_.begin() + static_cast<std::ptrdiff_t>(count_),
                  pieces_.begin());
        count_ -= gone;
        present_ -= gone;
    }
    take_wishes(music, wish);
    if (second_) {
        const CellStep step = *second_;
        second_.reset();
        append(step, music);
        return;
    }
    const double left = pieces_[count_ - 1].until - phase_;
    if (left > kDecided + kThinksFor) {
        return;
    }
    chooser_.draw(*content_->cells, last_, end_on_stage(), wished(music, wish));
    const bool is_due = left <= kDecided && (chooser_.is_drawn() || left <= kLatest);
    if (is_due && count_ + CellChooser::kFollowed <= pieces_.size()) {
        decide(music, wish);
    }
}

// To lay a piece takes time: the second one waits for the next hop.
void CellSequence::decide(const CellMusic& music, FigureWish& wish) noexcept {
    const auto steps = chooser_.decide();
    append(steps[0], music);
    second_ = steps[1];
    wish.is_another = false;
    wish.figure.reset();
    has_cut_ = false;
}

void CellSequence::append(const CellStep& step, const CellMusic& music) noexcept {
    Piece& last = pieces_[count_ - 1];
    rows_.note(step, last.until, music.song ? &*music.song : nullptr);
    last_ = step;
    if (!step.is_joined) {
        last.until += 1.0;
        return;
    }
    Piece& next = pieces_[count_];
    next = {};
    next.first_cell = step.cell;
    next.is_mirrored = step.is_mirrored;
    next.from = last.until;
    next.until = last.until + 1.0;
    lay(last, next);
    ++count_;
}

void CellSequence::jump(Beats phase) noexcept RAKS_NONBLOCKING {
    const CellGraph& graph = *content_->cells;
    const Piece& old = pieces_[piece_at(phase_)];
    const std::size_t cell = cell_of(old, phase_);
    const FloorMove place = floor_frame(unsized(phase_));
    Piece piece;
    piece.from = std::floor(phase.count());
    piece.until = piece.from + 1.0;
    piece.is_mirrored = old.is_mirrored;
    std::size_t next = cell;
    if (graph.cells[cell].is_second_half != is_odd(piece.from)) {
        if (graph.has_successor(cell)) {
            next = cell + 1;
        } else if (!graph.arcs_of(cell).empty()) {
            const CellArc& arc = graph.arcs_of(cell).front();
            next = arc.to;
            piece.is_mirrored = piece.is_mirrored != arc.is_mirrored;
        }
    }
    piece.first_cell = static_cast<std::uint16_t>(next);
    phase_ = phase.count();
    piece.floor = place * inverse(floor_frame(pose_of(piece, phase_)));
    begin_with(piece);
}

// Some beats of the take bring it back to the beat on which its half of the bar begins. Of the ways
// to do that, the one that is danced about as fast as the music and does not last long is taken.
void CellSequence::go_on_from(Beats key, Beats phase) noexcept RAKS_NONBLOCKING {
    const CellGraph& graph = *content_->cells;
    const Piece stood = pieces_[piece_at(key.count())];
    const std::size_t cell = cell_of(stood, key.count());
    const double into =
        shown(stood, key.count()) - stood.from - static_cast<double>(cell - stood.first_cell);
    const double now = phase.count();
    int best = 1;
    double back = std::ceil(now + 1.0);
    double least = 1e9;
    for (int beats = 0; beats <= kMostToComeBack; ++beats) {
        if (beats > 1 && !graph.has_successor(cell + static_cast<std::size_t>(beats) - 2)) {
            break;
        }
        const bool is_second = graph.cells[cell].is_second_half != (beats % 2 != 0);
        for (double at = std::ceil(now + kSoonestBack); at < now + kMostToComeBack; at += 1.0) {
            const double rate = (beats - into) / (at - now);
            const double cost = std::abs(rate - kRateBack) + kBackCost * (at - now);
            if (is_odd(at) == is_second && rate > -0.1 && cost < least) {
                least = cost;
                best = beats;
                back = at;
            }
        }
    }
    Piece piece;
    piece.first_cell = static_cast<std::uint16_t>(cell);
    piece.is_mirrored = stood.is_mirrored;
    piece.floor = stood.floor;
    piece.from = back - best;
    piece.until = best > 0 ? back : back + 1.0;
    piece.rest = {piece.from + into, now - kSeenBefore, back};
    phase_ = now;
    begin_with(piece);
}

const LibraryFigure& CellSequence::figure() const noexcept {
    return content_->figures[content_->cells->cells[present().first_cell].take];
}

double CellSequence::beat(Beats phase) const noexcept {
    return content_->cells->cells[present().first_cell].beat + shown(present(), phase.count()) -
           present().from;
}

Beats CellSequence::end() const noexcept { return Beats(kBar * (std::floor(phase_ / kBar) + 1.0)); }

}  // namespace raks::motion
