#include "render/overlay/overlay.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "render/overlay/fonts.hpp"
#include "render/overlay/panels.hpp"

namespace raks::render {
namespace {

constexpr float kUnitsHigh = 720.0F;  // a picture of this size or wider has one pixel a unit
constexpr float kUnitsWide = 640.0F;
constexpr float kSmallestScale = 0.8F;
constexpr float kLargestScale = 4.0F;

/// Steps of a quarter: fonts are made anew when a window is pulled far, not for every pixel.
float scale_for(const FrameTarget& target, float content_scale) {
    const float by_size = std::min(static_cast<float>(target.height) / kUnitsHigh,
                                   static_cast<float>(target.width) / kUnitsWide);
    const float wanted = std::max({by_size, kSmallestScale * content_scale, kSmallestScale});
    return std::min(std::floor(wanted * 4.0F + 0.5F) / 4.0F, kLargestScale);
}

/// `value` within its range; NaN is the lower bound.
template <typename Number>
Number finite(Number value, Number low, Number high) {
    return std::isnan(value) ? low : std::clamp(value, low, high);
}

/// The same; NaN counts as not known.
std::optional<double> finite(std::optional<double> value, double low, double high) {
    return value && !std::isnan(*value) ? std::optional(std::clamp(*value, low, high))
                                        : std::nullopt;
}

/// The same state with every number in its documented range: what comes from outside is not
/// trusted further in.
OverlayState in_range(OverlayState state) {
    constexpr double kLongest = 1e6;  // seconds, milliseconds, pictures a second
    state.bpm = finite(state.bpm, 0.0, 999.9);
    state.confidence = finite(state.confidence, 0.0F, 1.0F);
    state.rival_bpm = finite(state.rival_bpm, 0.0, 999.9);
    state.beats_per_bar = std::clamp(state.beats_per_bar, 1, 12);
    state.bar_position = finite(state.bar_position, 0.0, static_cast<double>(state.beats_per_bar));
    state.genre_posterior = finite(state.genre_posterior, 0.0F, 1.0F);
    state.figure_counts = std::clamp(state.figure_counts, 1, 16);
    state.figure_count = std::clamp(state.figure_count, 0, state.figure_counts);
    state.level_dbfs = finite(state.level_dbfs, -120.0F, 20.0F);
    state.loudness_lufs = finite(state.loudness_lufs, -120.0F, 20.0F);
    if (state.volume) {
        state.volume = finite(*state.volume, 0.0F, 1.0F);
    }
    state.position = finite(state.position, 0.0, kLongest);
    state.duration = finite(state.duration, 0.0, kLongest);
    state.latency_ms = finite(state.latency_ms, -kLongest, kLongest);
    state.fps = finite(state.fps, 0.0, kLongest);
    if (state.list && !state.list->rows.empty()) {
        state.list->chosen = std::min(state.list->chosen, state.list->rows.size() - 1);
    } else if (state.list) {
        state.list->chosen = 0;
    }
    return state;
}

/// Binds a framebuffer and puts back the one that was bound.
class FramebufferScope {
 public:
    explicit FramebufferScope(std::uint32_t framebuffer) {
        GLint bound = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
        before_ = static_cast<GLuint>(bound);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    }
    ~FramebufferScope() { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, before_); }
    FramebufferScope(const FramebufferScope&) = delete;
    FramebufferScope& operator=(const FramebufferScope&) = delete;

 private:
    GLuint before_ = 0;
};

}  // namespace

struct Overlay::Impl {
    ImGuiContext* context = nullptr;
    bool has_backend = false;
    float font_scale = 0.0F;  // 0: none made yet
    OverlayFonts fonts;

    Impl() {
        IMGUI_CHECKVERSION();
        context = ImGui::CreateContext();
        ImGui::SetCurrentContext(context);
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;  // no imgui.ini
        io.LogFilename = nullptr;
        // Nothing here reacts to the mouse.
        io.ConfigFlags |= ImGuiConfigFlags_NoMouse;
        has_backend = ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~Impl() {
        ImGui::SetCurrentContext(context);
        if (has_backend) {
            ImGui_ImplOpenGL3_Shutdown();
        }
        ImGui::DestroyContext(context);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void make_fonts(float scale);
};

/// Rasterizes the fonts for a scale, unless it is the one that they have.
void Overlay::Impl::make_fonts(float scale) {
    if (scale == font_scale) {
        return;
    }
    const bool is_first = font_scale == 0.0F;
    font_scale = scale;
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    // All four share one texture, which is built anew as a whole.
    atlas.Clear();
    const auto pixels = [&](float units) { return std::round(units * scale); };
    fonts.body = add_font(atlas, FontFace::plain, pixels(15.0F), Glyphs::names);
    fonts.small = add_font(atlas, FontFace::plain, pixels(12.0F), Glyphs::labels);
    fonts.bold = add_font(atlas, FontFace::bold, pixels(17.0F), Glyphs::labels);
    fonts.large = add_font(atlas, FontFace::bold, pixels(46.0F), Glyphs::labels);
    if (!is_first) {  // the first texture is made by NewFrame(), with all else
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
}

Overlay::Overlay(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Overlay::Overlay(Overlay&&) noexcept = default;
Overlay& Overlay::operator=(Overlay&&) noexcept = default;
Overlay::~Overlay() = default;

Expected<Overlay> Overlay::create() {
    auto impl = std::make_unique<Impl>();
    if (!impl->has_backend) {
        return fail("overlay: no OpenGL 3.3 context, or libGL.so.1 is missing (package libgl1)");
    }
    return Overlay(std::move(impl));
}

std::optional<OverlayControl> OverlayControls::at(float x, float y) const noexcept {
    if (play_sign.holds(x, y)) {
        return OverlayControl::play_sign;
    }
    if (mark.holds(x, y)) {
        return OverlayControl::mark;
    }
    if (help.holds(x, y)) {
        return OverlayControl::help;
    }
    return position.holds(x, y) ? std::optional(OverlayControl::position) : std::nullopt;
}

// The one that was drawn last lies on top.
std::optional<OverlaySpot> OverlayControls::spot_at(float x, float y) const noexcept {
    const auto at = std::find_if(
        spots.rbegin(), spots.rend(), [&](const auto& spot) { return spot.first.holds(x, y); });
    return at != spots.rend() ? std::optional(at->second) : std::nullopt;
}

double OverlayControls::share_at(float x) const noexcept {
    return to > from ? std::clamp(static_cast<double>((x - from) / (to - from)), 0.0, 1.0) : 0.0;
}

OverlayControls Overlay::draw(const OverlayState& given,
                              OverlayView view,
                              const FrameTarget& target,
                              float content_scale) {
    const OverlayState state = in_range(given);
    // A hidden overlay costs nothing.
    const bool has_nothing = view == OverlayView::hidden && state.message.empty() &&
                             state.help.empty() && !state.list && !state.transport && !state.code &&
                             state.lines.empty() && state.labels.empty();
    if (target.width <= 0 || target.height <= 0 || has_nothing) {
        return {};
    }
    ImGui::SetCurrentContext(impl_->context);
    const float scale = scale_for(target, content_scale);
    impl_->make_fonts(scale);
    // ImGui draws from (0, 0) on: the display is what lies left of and below the target, too.
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(target.x + target.width),
                      static_cast<float>(target.y + target.height)};
    // ImGui asks for a time > 0; nothing here is animated by it.
    io.DeltaTime = 1.0F / 60.0F;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();

    // ImGui's y starts at the top of the display, which is the target's upper edge.
    const Pen pen(
        *ImGui::GetBackgroundDrawList(), impl_->fonts, scale, {static_cast<float>(target.x), 0.0F});
    const Canvas canvas{static_cast<float>(target.width) / scale,
                        static_cast<float>(target.height) / scale};
    const bool is_help = !state.help.empty();
    const bool is_covered = (is_help && !has_room_beside(kKeysPanelWidth, canvas)) ||
                            (state.list && !has_room_beside(kListPanelWidth, canvas));
    OverlayControls controls;
    draw_marks(pen, state);
    // Cards below a panel would shine through it.
    const bool has_cards = view == OverlayView::shown && !is_covered;
    if (has_cards && !has_room_for_cards(canvas)) {
        draw_small_tempo(pen, state);
    } else if (has_cards) {
        draw_tempo(pen, state);
        draw_dance(pen, state, canvas);
        controls = draw_source(pen, state, canvas);
        draw_level(pen, state, canvas);
    }
    if (state.transport) {
        controls = draw_transport(pen, *state.transport, canvas);
    }
    draw_message(pen, state, canvas);
    if (state.code && !is_help && !state.list) {
        draw_code(pen, *state.code, canvas);
    }
    if (is_help) {
        draw_help(pen, state.help, state.help_page, canvas, controls);
    }
    if (state.list) {
        draw_list(pen, *state.list, canvas, controls);
    }

    ImGui::Render();
    const FramebufferScope bound(target.framebuffer);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    return controls;
}

}  // namespace raks::render
