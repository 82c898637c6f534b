#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"

namespace raks::render {

/// One line of the list of keys. Lines of one group follow one another.
struct HelpRow {
    std::string group;              ///< "PLAYING"
    std::vector<std::string> keys;  ///< as written on the keys: "Left", "Right"
    std::string text;               ///< "back, forward 5 s"
};

/// One row of a list over the picture.
struct ListRow {
    std::string text;                   ///< what it is: "Monitor of Speakers"
    std::string detail{};               ///< behind it, dimmed: "PulseAudio"
    std::optional<bool> is_checked{};   ///< a box before it; none: no box
    std::optional<float> level_dbfs{};  ///< a meter at its end; none: no meter
    bool is_current = false;            ///< in use now
    bool is_title = false;              ///< it names the rows below it and cannot be taken
};

/// A list over the picture, from which a person takes something.
struct OverlayList {
    std::span<const std::string> pages{};  ///< titles of all pages; at least one
    std::size_t page = 0;                  ///< which of them is open
    std::span<const ListRow> rows{};       ///< of the open page
    std::size_t chosen = 0;                ///< the row that Enter would take
    std::string_view typed{};              ///< what somebody has typed
    std::string_view prompt{};             ///< what typing does, where nothing is typed
    std::string_view hint{};               ///< the keys that it knows, in one line
};

/// What moves through a clip, as a bar along the lower edge.
struct OverlayTransport {
    std::size_t frame = 0;           ///< that is shown, from 0
    std::size_t frame_count = 1;     ///< >= 1
    double frames_per_second = 1.0;  ///< of the clip, > 0
    double rate = 1.0;               ///< at which it plays; < 0: backward
    bool is_paused = false;          ///< stands at the frame
    std::string_view typed{};        ///< digits of a frame that somebody is typing
    /// By frame, [0, 1]: drawn over the bar, such as how far two motions are apart; NaN: nothing.
    std::span<const float> curve{};
    std::optional<std::size_t> mark{};  ///< a frame of interest: can be clicked
    std::string_view mark_name{};       ///< what is there: "worst"
};

/// A line over the picture, in pixels of the target, y down from its top.
struct OverlayLine {
    float from_x = 0.0F;
    float from_y = 0.0F;
    float to_x = 0.0F;
    float to_y = 0.0F;
    std::uint32_t rgb = 0;  ///< 0xRRGGBB
    float alpha = 1.0F;     ///< [0, 1]
};

/// A short name beside a place in the picture, in pixels as above. Names that would cover one
/// another are left out.
struct OverlayLabel {
    float x = 0.0F;
    float y = 0.0F;
    std::string_view text{};
};

/// How another program stands that is told of the music.
struct OverlayTarget {
    std::string text{};        ///< "--osc 127.0.0.1:9000   412 sent"
    bool is_troubled = false;  ///< it loses something: in amber
};

/// A square of light and dark modules that a phone's camera reads (QR code).
struct OverlayCode {
    std::size_t side = 0;                     ///< modules a row
    std::span<const std::uint8_t> modules{};  ///< row by row from the top; 1: dark
    std::string_view caption{};               ///< one line below it
};

/// Everything that the overlay shows, as it is at the moment that the picture is about. Views
/// need to live until draw() returns; empty text and empty optionals are not shown.
struct OverlayState {
    // Tempo.
    double bpm = 0.0;           ///< 0: none known
    float confidence = 0.0F;    ///< [0, 1]; below kLockedConfidence it reads "listening"
    double rival_bpm = 0.0;     ///< the tempo that it may be instead; 0: none is near
    double bar_position = 0.0;  ///< [0, beats_per_bar); whole part lights the dot
    int beats_per_bar = 4;      ///< 1 to 12
    bool is_bar_known = true;   ///< false: beats flash, no beat is called "1"
    bool is_silent = false;     ///< reads "silence", beats rest
    // Music and dance.
    std::string_view genre{};      ///< "salsa"
    float genre_posterior = 0.0F;  ///< [0, 1]
    bool is_genre_told = false;    ///< reads who told it
    std::string_view genre_teller = "as the file says";
    std::string_view dance{};   ///< "salsa"; empty: none
    std::string_view figure{};  ///< "basic step"
    int figure_count = 0;       ///< 1 to figure_counts; 0: none
    /// counts that the figure has, 1 to 16
    int figure_counts = 8;
    // Sound.
    std::string_view source{};  ///< file name or device
    /// What a player says that it plays there; empty: none does.
    std::string_view song{};
    /// What a tagger calls the music, the strongest word first; empty ones are not shown.
    std::array<std::string_view, 3> tags{};
    float level_dbfs = -120.0F;     ///< rms, >= -120
    float loudness_lufs = -120.0F;  ///< momentary, >= -120
    /// Who else is told of the music, in the source's card; the first four are shown.
    std::span<const OverlayTarget> targets{};
    std::optional<float> volume{};     ///< [0, 1]; none: nothing is played back
    std::optional<double> position{};  ///< seconds into the file; none when live
    std::optional<double> duration{};  ///< seconds, where known
    /// playback stands still
    bool is_paused = false;
    // Health.
    std::optional<double> latency_ms{};  ///< measured, sound to picture
    double fps = 0.0;                    ///< 0: not shown
    std::uint64_t drops = 0;             ///< events or blocks that found a full queue
    std::uint64_t xruns = 0;             ///< blocks that the device lost
    std::uint64_t late = 0;              ///< times that the file was decoded too late
    bool has_keys = false;               ///< whether keys are listened to: a hint how to list them
    std::string_view message{};          ///< one line, e.g. "screenshot saved: raks-....png"
    // Over the picture, below all cards, whatever the view is.
    std::span<const OverlayLine> lines{};         ///< such as trails of points
    std::span<const OverlayLabel> labels{};       ///< names of points
    std::optional<OverlayTransport> transport{};  ///< of a clip; none: none
    // Above all else.
    std::span<const HelpRow> help{};    ///< the keys; none: not asked for
    std::size_t help_page = 0;          ///< which page of them, where one has no room for all
    std::optional<OverlayCode> code{};  ///< whatever the view is; none: none
    std::optional<OverlayList> list{};  ///< from which somebody takes something; none: none
};

/// From this confidence on the tempo counts as found.
inline constexpr float kLockedConfidence = 0.35F;

/// Whether the cards are drawn.
enum class OverlayView : std::uint8_t {
    hidden,  ///< nothing but the message line and the keys
    shown,
};

/// What of the overlay a pointer can use.
enum class OverlayControl : std::uint8_t {
    play_sign,  ///< pauses, goes on
    position,   ///< the bar: a place of the file
    mark,       ///< OverlayTransport::mark
    help,       ///< opens the list of keys, goes to its next page, and closes it
};

/// What of the keys or of a list a pointer can use.
enum class PanelPart : std::uint8_t {
    ground,     ///< nothing is there
    keys_head,  ///< goes to the next page of the keys, and closes them
    key,        ///< a key
    list_row,   ///< takes a row of the list
    list_box,   ///< checks its box, or takes the check away
    list_page,  ///< opens a page of the list
};

/// A place of the keys or of a list.
struct OverlaySpot {
    PanelPart part{};      ///< what is there
    std::size_t row = 0;   ///< the row of the keys or of the list, or the page
    std::size_t item = 0;  ///< which key of the row
};

/// Where the controls of a drawn overlay are, in pixels of the target, y down from its top.
struct OverlayControls {
    /// A rectangle; of no size: it is not drawn.
    struct Area {
        float left = 0.0F;    ///< first pixel
        float top = 0.0F;     ///< first pixel
        float right = 0.0F;   ///< behind the last pixel
        float bottom = 0.0F;  ///< behind the last pixel
        /// Whether a place lies in it.
        [[nodiscard]] constexpr bool holds(float x, float y) const noexcept {
            return x >= left && x < right && y >= top && y < bottom;
        }
    };
    Area play_sign;     ///< with some room around it, so that it is easily hit
    Area position;      ///< likewise above and below
    Area mark;          ///< the words that name the frame of interest
    Area help;          ///< the sign "?"
    float from = 0.0F;  ///< x of the file's start on the bar
    float to = 0.0F;    ///< x of its end
    /// Those of the keys and of the list, which lie above the others; the later above the earlier.
    std::vector<std::pair<Area, OverlaySpot>> spots{};
    std::size_t help_pages = 1;  ///< in how many pages the keys have room

    /// The control of the keys or of the list at a place, if there is one.
    [[nodiscard]] std::optional<OverlaySpot> spot_at(float x, float y) const noexcept;
    /// The control at a place, if there is one.
    [[nodiscard]] std::optional<OverlayControl> at(float x, float y) const noexcept;
    /// The share of the file that an x on the bar means, [0, 1]; 0 without a bar.
    [[nodiscard]] double share_at(float x) const noexcept;
};

/// The information over the picture: tempo and bar, genre and figure, level, position, health.
/// Needs an OpenGL 3.3 core context, current at create(), draw() and destruction: a window's or
/// an off-screen one. Draws over what the target holds and restores OpenGL's state.
/// The same state, view and size draw the same picture.
/// Threads: the one that owns the context. Real-time: no.
class Overlay {
 public:
    /// Errors: no usable OpenGL context.
    [[nodiscard]] static Expected<Overlay> create();
    /// The source may only be destroyed or assigned to.
    Overlay(Overlay&&) noexcept;
    /// As the constructor.
    Overlay& operator=(Overlay&&) noexcept;
    /// Frees fonts and shaders; the context must be current.
    ~Overlay();

    /// Draws over `target`. Text grows with the height of the picture, and with `content_scale`
    /// (Window::content_scale) on fine monitors. Returns where a pointer can use it.
    OverlayControls draw(const OverlayState& state,
                         OverlayView view,
                         const FrameTarget& target,
                         float content_scale = 1.0F);

 private:
    struct Impl;
    explicit Overlay(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace raks::render
