#include "render/panes/pane_context.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "render/overlay/fonts.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kButtons = 3;

std::size_t index_of(MouseButton button) { return static_cast<std::size_t>(button); }

// ImGui's names of the keys that its text fields use.
void tell_key(ImGuiIO& io, const KeyEvent& key, bool is_down) {
    constexpr std::pair<Key, ImGuiKey> kKnown[] = {{Key::tab, ImGuiKey_Tab},
                                                   {Key::left, ImGuiKey_LeftArrow},
                                                   {Key::right, ImGuiKey_RightArrow},
                                                   {Key::home, ImGuiKey_Home},
                                                   {Key::end, ImGuiKey_End},
                                                   {Key::backspace, ImGuiKey_Backspace},
                                                   {Key::enter, ImGuiKey_Enter},
                                                   {Key::escape, ImGuiKey_Escape}};
    for (const auto& [known, name] : kKnown) {
        if (key.key == known) {
            io.KeysDown[name] = is_down;
        }
    }
}

}  // namespace

float pane_scale(int width, int height, float content_scale) noexcept {
    constexpr float kUsualWidth = 1280.0F;
    constexpr float kUsualHeight = 720.0F;
    constexpr float kMost = 2.5F;
    const float times = std::min(static_cast<float>(width) / kUsualWidth,
                                 static_cast<float>(height) / kUsualHeight) /
                        content_scale;
    const float half = std::floor(4.0F * (0.5F + 0.5F * times)) / 4.0F;
    return content_scale * std::clamp(half, 1.0F, kMost);
}

bool PaneFrame::holds(MouseButton button) const noexcept {
    return std::find(held.begin(), held.end(), button) != held.end();
}

bool PaneFrame::has_pressed(MouseButton button) const noexcept {
    return std::find(went_down.begin(), went_down.end(), button) != went_down.end();
}

FrameTarget PaneFrame::target_of(const Box& box) const noexcept {
    const auto pixels = [this](float units) {
        return static_cast<int>(std::lround(units * pen.unit()));
    };
    return {.framebuffer = 0,
            .x = pixels(box.x),
            .y = pixels(area.height) - pixels(box.bottom()),
            .width = pixels(box.right()) - pixels(box.x),
            .height = pixels(box.bottom()) - pixels(box.y)};
}

PaneContext::PaneContext() {
    IMGUI_CHECKVERSION();
    // The overlay may have a context of its own that is current now.
    ImGuiContext* const before = ImGui::GetCurrentContext();
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) {
        io.KeyMap[key] = key;
    }
    ImGui::StyleColorsDark();
    ImGui::SetCurrentContext(before);
}

PaneContext::~PaneContext() { ImGui::DestroyContext(context_); }

void PaneContext::make_fonts(float scale) {
    if (scale == font_scale_) {
        return;
    }
    ImGui::SetCurrentContext(context_);
    font_scale_ = scale;
    ++font_generation_;
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    const auto pixels = [scale](float units) { return std::round(units * scale); };
    fonts_.body = add_font(atlas, FontFace::plain, pixels(14.0F), Glyphs::names);
    fonts_.small = add_font(atlas, FontFace::plain, pixels(12.0F), Glyphs::names);
    fonts_.bold = add_font(atlas, FontFace::bold, pixels(14.0F), Glyphs::names);
    fonts_.large = fonts_.bold;
    atlas.Build();
}

void PaneContext::take(std::span<const WindowEvent> events) {
    waiting_.insert(waiting_.end(), events.begin(), events.end());
}

// One key, one change of a button, or all motion up to the next of them: what a frame asks for
// follows from what is there when it begins, so that a key behind a key, or behind a click, must
// find what that has changed. The first frame takes nothing up: what lies under the pointer is not
// known before.
void PaneContext::take_up(const PointerPlace& pointer) {
    keys_.clear();
    dropped_.clear();
    wheel_ = 0.0F;
    std::fill(std::begin(went_down_), std::end(went_down_), false);
    pointer_ = waiting_.empty() ? pointer : pointer_;
    if (!std::exchange(has_begun_, true)) {
        return;
    }
    bool has_motion = false;
    while (!waiting_.empty()) {
        const WindowEvent event = waiting_.front();
        const auto* const button = std::get_if<MouseButtonEvent>(&event);
        const auto* const key = std::get_if<KeyEvent>(&event);
        const auto* const drop = std::get_if<DropEvent>(&event);
        if ((button != nullptr || key != nullptr || drop != nullptr) && has_motion) {
            return;
        }
        waiting_.pop_front();
        if (button != nullptr) {
            pointer_ = {button->x, button->y};
            is_down_[index_of(button->button)] = button->is_down;
            went_down_[index_of(button->button)] = button->is_down;
            return;
        }
        if (key != nullptr) {
            keys_.push_back(*key);
            return;
        }
        if (drop != nullptr) {
            dropped_ = drop->paths;
            return;
        }
        has_motion = true;
        if (const auto* const drag = std::get_if<MouseDragEvent>(&event)) {
            pointer_ = {drag->x, drag->y};
        } else if (const auto* const scroll = std::get_if<ScrollEvent>(&event)) {
            pointer_ = pointer;
            wheel_ += scroll->dy;
        }
    }
}

PaneFrame PaneContext::begin(const PaneArea& area, const PointerPlace& pointer) {
    ImGui::SetCurrentContext(context_);
    make_fonts(area.scale);
    take_up(pointer);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(area.width), static_cast<float>(area.height)};
    io.DeltaTime = 1.0F / 60.0F;
    io.MousePos = {pointer_.x, pointer_.y};
    io.MouseWheel = wheel_;
    for (std::size_t i = 0; i < kButtons; ++i) {
        io.MouseDown[i] = is_down_[i];
    }
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    for (const KeyEvent& key : keys_) {
        tell_key(io, key, true);
        const auto character = static_cast<unsigned int>(key.key);
        if (!key.has_control && character < static_cast<unsigned int>(Key::escape)) {
            io.AddInputCharacter(character);
        }
    }
    ImGui::NewFrame();
    // One window without any frame over all of the area, in which panes put their items.
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
    ImGui::Begin("panes",
                 nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollWithMouse |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
    return frame_of(area);
}

PaneFrame PaneContext::frame_of(const PaneArea& area) {
    PaneFrame frame{Pen(*ImGui::GetWindowDrawList(), fonts_, area.scale, {0.0F, 0.0F}),
                    {0.0F,
                     0.0F,
                     static_cast<float>(area.width) / area.scale,
                     static_cast<float>(area.height) / area.scale},
                    {pointer_.x / area.scale, pointer_.y / area.scale},
                    {},
                    wheel_,
                    {},
                    {},
                    dropped_};
    // Keys belong to a text field while one is typed into.
    if (!ImGui::GetIO().WantTextInput) {
        frame.keys = keys_;
    }
    for (std::size_t i = 0; i < kButtons; ++i) {
        if (is_down_[i]) {
            frame.held.push_back(static_cast<MouseButton>(i));
        }
        if (went_down_[i]) {
            frame.went_down.push_back(static_cast<MouseButton>(i));
        }
    }
    return frame;
}

void PaneContext::end() {
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::Render();
}

}  // namespace raks::render
