#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "motion/dance/cell_chooser.hpp"
#include "motion/dance/cell_rows.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/dance/dancer_part.hpp"

namespace raks::motion {

/// What the music asks of a dance of cells at a hop. Phases are whole numbers.
struct CellMusic {
    double energy = 0.5;               ///< share of the dance's cells that are calmer, [0, 1]
    std::optional<double> rests_at{};  ///< phase at which a cell shall end at rest
    std::optional<double> drop_at{};   ///< phase from which the greatest cells are danced
    std::optional<double> anew_at{};   ///< phase at which another piece of a take shall begin
    bool has_come_in = false;          ///< at this hop; unforeseen: what comes next is chosen again
    std::optional<SongBars> song{};    ///< of a song that is known
};

/// A dance of cells over one continuous phase: pieces of takes, each danced for some beats and
/// joined to the next one on a beat. Around a join both pieces are danced and averaged (Ofli 2008,
/// section 5); the next one is laid so that feet that stand in both do not move. First halves of
/// the bar begin at even phases. It does for cells what FigureSequence does for figures.
/// Threads: one. Real-time: yes.
class CellSequence {
 public:
    /// Beats ahead that are decided, at least, but for the beat in which something has come in.
    static constexpr double kDecided = 1.0;

    /// Begins with a first cell at phase 0, facing the audience at `stage`.
    void start(const DanceContent& content,
               const FloorMove& stage,
               const DancerPart& part) noexcept RAKS_NONBLOCKING;
    /// Advances to a phase: thinks a little about what comes next, and decides when it is due.
    /// `wish`: cleared as far as it was granted; another figure is another cell at the next beat, a
    /// wished figure is the take, and locked the last beats are danced again and again.
    void advance(Beats phase, const CellMusic& music, FigureWish& wish) noexcept RAKS_NONBLOCKING;
    /// The phase was re-anchored: goes on with the same cell or one beside it, at its part of the
    /// beat.
    void jump(Beats phase) noexcept RAKS_NONBLOCKING;
    /// The dance has stood still as at the phase `key`, and goes on from there at `phase`: what is
    /// left of the cell and some beats after it are danced so that they are on the beat again.
    void go_on_from(Beats key, Beats phase) noexcept RAKS_NONBLOCKING;
    /// Goes on with the same takes, solved for another body.
    void go_on_in(const DanceContent& content, const FloorMove& stage) noexcept;
    /// The pose in the world at a phase up to kDecided after the last advance; later the present
    /// take goes on. Steps are as in the takes, whatever the manner.
    [[nodiscard]] Pose at(Beats phase, const Manner& manner = {}) const noexcept RAKS_NONBLOCKING;

    /// The take that is danced, as a figure.
    [[nodiscard]] const LibraryFigure& figure() const noexcept;
    /// Beats of the take at a phase.
    [[nodiscard]] double beat(Beats phase) const noexcept;
    /// The phase at which the present bar ends.
    [[nodiscard]] Beats end() const noexcept;
    /// The cell that is danced at a phase that is decided.
    [[nodiscard]] CellStep step_at(Beats phase) const noexcept RAKS_NONBLOCKING;
    /// Whether the cell that ends at a phase ends at rest.
    [[nodiscard]] bool rests_at(Beats phase) const noexcept RAKS_NONBLOCKING;
    /// Whether the present piece is danced left for right.
    [[nodiscard]] bool is_mirrored() const noexcept { return present().is_mirrored; }
    /// How many pieces were begun before this one.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }

 private:
    /// A piece that comes out of a rest: it stands as at `at` until `from`, and has made up for
    /// that at `to`. Phases, of which `at` is the one that would be shown without the rest.
    struct Rest {
        double at = 0.0;
        double from = -1.0;
        double to = -1.0;
    };
    /// How a foot comes from one piece to the next; times are beats from the join.
    struct FootJoin {
        double from = 0.0;       // when it begins to go over; not of one that stays
        double to = 0.0;         // when it has
        bool stays = false;      // where it stood in the piece before, until this one moves it
        glm::vec2 aside{};       // of one that stays: from where this piece has it; metres
        float yaw = 0.0F;        // likewise, radians
        double leaves = 0.0;     // when it begins to come to where this piece has it
        double lands = 0.0;      // when it is there
        bool is_lifted = false;  // by a step of its own
    };
    /// When feet stand about a join, by Side; beats from it.
    struct JoinStands {
        std::array<double, 2> until{};     // of the piece before: last
        std::array<FootStand, 2> after{};  // of the next piece
    };
    /// Some beats of one take.
    struct Piece {
        std::uint16_t first_cell = 0;
        bool is_mirrored = false;
        double from = 0.0;               // phase at which it begins
        double until = 0.0;              // phase up to which it is decided
        FloorMove floor{};               // from the take's frame to the world
        Rest rest{};                     // that it comes from
        std::array<FootJoin, 2> feet{};  // by Side: how it comes from the piece before
    };
    [[nodiscard]] const Piece& present() const noexcept { return pieces_[present_]; }
    [[nodiscard]] static double shown(const Piece& piece, double phase) noexcept;
    [[nodiscard]] std::size_t piece_at(double phase) const noexcept;
    [[nodiscard]] std::size_t cell_of(const Piece& piece, double phase) const noexcept;
    [[nodiscard]] Pose pose_of(const Piece& piece, double phase) const noexcept;
    [[nodiscard]] Pose joined(const Piece& before, const Piece& after, double phase) const noexcept;
    [[nodiscard]] Pose unsized(double phase) const noexcept;
    [[nodiscard]] CellWish wished(const CellMusic& music, const FigureWish& wish) const noexcept;
    void take_wishes(const CellMusic& music, const FigureWish& wish) noexcept;
    void decide(const CellMusic& music, FigureWish& wish) noexcept;
    void cut() noexcept;
    void begin_with(const Piece& piece) noexcept;
    void forget_choice() noexcept;
    void append(const CellStep& step, const CellMusic& music) noexcept;
    [[nodiscard]] Pose with_feet(const Piece& piece, double phase) const noexcept;
    [[nodiscard]] JoinStands stands_at(const Piece& before, const Piece& after) const noexcept;
    [[nodiscard]] double turn_to_us(const Pose& pose) const noexcept;
    void lay(const Piece& before, Piece& after) const noexcept;
    [[nodiscard]] FloorMove end_on_stage() const noexcept;

    static constexpr std::size_t kMostPieces = 6;

    const DanceContent* content_ = nullptr;
    FloorMove stage_;
    CellChooser chooser_;
    CellRows rows_;
    CellStep last_;                   // that was laid
    std::optional<CellStep> second_;  // of a decision, not laid yet
    std::array<Piece, kMostPieces> pieces_{};
    std::size_t count_ = 0;
    std::size_t present_ = 0;
    double phase_ = 0.0;
    bool faces_us_ = true;
    double room_ = 0.0;
    bool has_cut_ = false;  // for the wish that is not granted yet
    std::uint64_t number_ = 0;
};

}  // namespace raks::motion
