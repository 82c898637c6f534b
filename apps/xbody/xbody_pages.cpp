// The right pane of the Xbody pane.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include <imgui.h>

#include "apps/xbody/xbody_drawing.hpp"
#include "base/printable.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/panes/picture_view.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using render::Box;

namespace palette = render::palette;

/// A line of the page of the pose.
struct PoseLine {
    std::string text;           ///< a slider's name, else a title
    float* number = nullptr;    ///< what the slider moves; null: a title
    float most = 1.0F;          ///< and how far
    bool is_both_ways = false;  ///< to -most, too
    std::string_view unit{};    ///< of the number
};

/// How a bone was found, short enough for a row with its name and its node.
std::string_view short_words_of(render::BoneReason reason) noexcept {
    switch (reason) {
        case render::BoneReason::stated:
            return "by the file";
        case render::BoneReason::label:
            return "labelled";
        case render::BoneReason::name:
            return "by name";
        case render::BoneReason::shape:
            return "by place";
        case render::BoneReason::swapped:
            return "by name, sides swapped";
        default:
            return render::words_of(reason);
    }
}

/// The right pane while it is drawn.
class PagesPane {
 public:
    explicit PagesPane(XbodyDrawing& drawing) : d_(drawing) {}

    void draw() {
        constexpr std::array<const char*, 5> kPages = {"Bones", "Pose", "Meshes", "File", "Film"};
        // The view's own buttons have some of these names, too.
        ImGui::PushID("page");
        for (std::size_t i = 0; i < kPages.size(); ++i) {
            const auto one = static_cast<XbodyPage>(i);
            if (d_.button(d_.layout.pages[i], kPages[i], true, d_.session.page == one)) {
                d_.wish(ShowPage{one});
            }
        }
        ImGui::PopID();
        page();
        labelling();
    }

 private:
    void page() {
        switch (d_.session.page) {
            case XbodyPage::bones:
                return bones();
            case XbodyPage::pose:
                return pose();
            case XbodyPage::meshes:
                return texts(d_.view.meshes, 0);
            case XbodyPage::file:
                return file();
            case XbodyPage::film:
                return film();
        }
    }

    // Moves the list where the wheel says so; where it begins now. It is in the rows from `top` on.
    std::size_t scroll(std::size_t count, std::size_t top = 0) {
        const std::vector<Box> rows(d_.layout.lines.begin() + static_cast<std::ptrdiff_t>(top),
                                    d_.layout.lines.end());
        const std::size_t begin = d_.list_begin(rows, d_.session.first_line, count);
        if (const auto first = d_.scrolled(rows, begin, count)) {
            d_.wish(ScrollPage{*first});
        }
        return begin;
    }

    void bones() {
        const std::vector<motion::Bone> bones = listed_bones(d_.session.humanoid);
        const std::size_t begin = scroll(bones.size());
        for (std::size_t i = 0; i < d_.layout.lines.size() && begin + i < bones.size(); ++i) {
            bone_row(d_.layout.lines[i], bones[begin + i]);
        }
    }

    void bone_row(const Box& box, motion::Bone bone) {
        const std::size_t index = motion::index_of(bone);
        const int node = d_.session.humanoid.nodes[index];
        const render::BoneReason reason = d_.session.humanoid.reasons[index];
        const bool is_missing = node < 0 && is_needed(bone, d_.session.humanoid);
        const std::string note =
            node >= 0
                ? fmt::format(
                      "{}, {}",
                      printable(d_.session.model->nodes[static_cast<std::size_t>(node)].name, 24),
                      short_words_of(reason))
            : is_missing ? "missing"
                         : "";
        const render::PaneRow row{.name = motion::kBoneNames[index],
                                  .note = note,
                                  .swatch = is_missing  ? palette::kRed
                                            : node >= 0 ? palette::kAmber
                                                        : palette::kDim,
                                  .text = is_missing  ? palette::kRed
                                          : node >= 0 ? palette::kText
                                                      : palette::kDim,
                                  .is_chosen = d_.session.bone == bone,
                                  .is_ticked = reason == render::BoneReason::label ||
                                               reason == render::BoneReason::stated};
        if (pane_row(d_.frame, box, row)) {
            d_.wish(ChooseBone{bone});
        }
    }

    static bool is_needed(motion::Bone bone, const render::HumanoidMap& humanoid) {
        const auto bones = render::required_bones(humanoid);
        return std::find(bones.begin(), bones.end(), bone) != bones.end();
    }

    void texts(const std::vector<XbodyLine>& all, std::size_t from_row) {
        const std::size_t begin = scroll(all.size(), from_row);
        for (std::size_t i = 0; i + from_row < d_.layout.lines.size() && begin + i < all.size();
             ++i) {
            const XbodyLine& line = all[begin + i];
            d_.text(d_.layout.lines[i + from_row],
                    line.is_title ? 4.0F : 14.0F,
                    line.is_warning ? palette::kAmber
                    : line.is_title ? palette::kTeal
                                    : palette::kText,
                    line.text);
        }
    }

    void pose() {
        if (!d_.view.can_pose) {
            d_.text(d_.layout.lines[0],
                    4.0F,
                    palette::kAmber,
                    "It lacks bones, red on Bones: label them");
            return;
        }
        PoseTuning tuning = d_.session.tuning;
        tuning.expressions.resize(d_.view.expressions.size(), 0.0F);
        const std::vector<PoseLine> lines = pose_lines(tuning);
        const std::size_t begin = scroll(lines.size(), 1);
        if (d_.button(d_.layout.lines[0], "As it rests, or as its clip has it", true)) {
            d_.wish(TunePose{});
        }
        bool is_changed = false;
        for (std::size_t i = 0; i + 1 < d_.layout.lines.size() && begin + i < lines.size(); ++i) {
            is_changed |= pose_line(d_.layout.lines[i + 1], lines[begin + i]);
        }
        if (is_changed) {
            d_.wish(TunePose{std::move(tuning)});
        }
    }

    std::vector<PoseLine> pose_lines(PoseTuning& tuning) const {
        std::vector<PoseLine> lines;
        if (d_.session.bone) {
            const std::size_t bone = motion::index_of(*d_.session.bone);
            lines.push_back({fmt::format("Turn of {}", motion::kBoneNames[bone])});
            constexpr std::array<const char*, 3> kAxes = {"about x", "about y", "about z"};
            for (int axis = 0; axis < 3; ++axis) {
                lines.push_back({kAxes[static_cast<std::size_t>(axis)],
                                 &tuning.turns[bone][axis],
                                 PoseTuning::kMostTurn,
                                 true,
                                 "\u00B0"});
            }
        } else {
            lines.push_back({"Pick a bone on Bones, in the tree or in the picture"});
        }
        if (d_.view.can_gaze) {
            lines.push_back({"Gaze"});
            lines.push_back({"to its left", &tuning.gaze.x, PoseTuning::kMostGaze, true, "\u00B0"});
            lines.push_back({"up", &tuning.gaze.y, PoseTuning::kMostGaze, true, "\u00B0"});
        }
        lines.push_back(
            {tuning.expressions.empty() ? "No expressions in this file" : "Expressions"});
        for (std::size_t i = 0; i < tuning.expressions.size(); ++i) {
            lines.push_back({d_.view.expressions[i], &tuning.expressions[i]});
        }
        return lines;
    }

    // True: the number has changed.
    bool pose_line(const Box& box, const PoseLine& line) const {
        if (line.number == nullptr) {
            d_.text(box, 4.0F, palette::kTeal, line.text);
            return false;
        }
        const auto moved = pane_slider(
            d_.frame,
            box,
            {.name = line.text,
             .value = line.unit.empty() ? fmt::format("{:.2f}", *line.number)
                                        : fmt::format("{:.0f}{}", *line.number, line.unit),
             .at = *line.number,
             .low = line.is_both_ways ? -line.most : 0.0F,
             .high = line.most});
        if (!moved || *moved == *line.number) {
            return false;
        }
        *line.number = *moved;
        return true;
    }

    void file() {
        std::size_t rows = 0;
        if (d_.view.thumbnail != nullptr) {
            rows = std::min<std::size_t>(8, d_.layout.lines.size() / 3);
            const Box& first = d_.layout.lines.front();
            const float height = d_.layout.lines[rows - 1].bottom() - first.y - 6.0F;
            const float width = std::min(height * d_.view.thumbnail_aspect, first.width);
            const Box place{first.x + 4.0F, first.y, width, width / d_.view.thumbnail_aspect};
            constexpr float kSide = 1000.0F;
            const auto side = [](float length) { return std::max(1, static_cast<int>(length)); };
            static_cast<void>(render::picture_view(
                d_.frame,
                "thumbnail",
                {place, side(kSide * d_.view.thumbnail_aspect), side(kSide), {}},
                d_.view.thumbnail));
        }
        texts(d_.view.file, rows);
    }

    void film() {
        constexpr std::array<std::pair<const char*, const char*>, 4> kKinds = {
            {{"Picture (.png)", ".png"},
             {"Film (.mp4)", ".mp4"},
             {"Film that plays everywhere (.avi)", ".avi"},
             {"Folder of pictures", ""}}};
        const bool is_free = !d_.view.film_share;
        for (std::size_t i = 0; i < kKinds.size(); ++i) {
            if (d_.button(d_.layout.films[i], kKinds[i].first, is_free)) {
                d_.wishes.emplace_back(WriteFilm{kKinds[i].second});
            }
        }
        const Box& last = d_.layout.films.back();
        if (is_free) {
            d_.text(last, 4.0F, palette::kDim, "of what is shown: view, bones, colours, sliders");
        } else {
            const auto share = static_cast<float>(*d_.view.film_share);
            if (d_.button(last, fmt::format("Stop at {:.0f} %", 100.0F * share), true)) {
                d_.wishes.emplace_back(StopFilm{});
            }
            d_.pen().bar({last.x, last.bottom() + 4.0F, last.width, 6.0F}, share, palette::kTeal);
        }
        constexpr std::size_t kRows = 8;  // that the buttons take
        texts(d_.view.film, kRows);
    }

    void labelling() {
        const bool can_label = d_.session.can_label();
        if (d_.button(d_.layout.label, "Label", can_label && d_.session.node && d_.session.bone)) {
            d_.wish(GiveLabel{});
        }
        if (d_.button(d_.layout.unlabel, "Remove", can_label && d_.session.bone)) {
            d_.wish(TakeLabel{});
        }
        if (d_.button(d_.layout.undo, "Undo", d_.session.labels.can_undo())) {
            d_.wish(UndoLabel{});
        }
        if (d_.button(d_.layout.redo, "Redo", d_.session.labels.can_redo())) {
            d_.wish(RedoLabel{});
        }
        if (d_.button(d_.layout.save,
                      d_.session.labels.is_saved() ? "Saved" : "Save",
                      !d_.session.labels.is_saved())) {
            d_.wishes.emplace_back(SaveXbody{});
        }
        axis(can_label);
    }

    void axis(bool can_label) {
        if (d_.session.page != XbodyPage::bones) {
            return;
        }
        const auto& labels = d_.session.labels.now();
        const auto label = std::find_if(labels.begin(), labels.end(), [this](const auto& one) {
            return d_.session.bone == one.bone;
        });
        if (label == labels.end()) {
            static_cast<void>(
                d_.button(d_.layout.axis, "Rest axis (A): of a bone that is labelled", false));
            return;
        }
        const std::string name = render::name_of_axis(label->axis);
        if (d_.button(d_.layout.axis,
                      fmt::format("Rest axis (A) of {}: {}",
                                  motion::kBoneNames[motion::index_of(label->bone)],
                                  name.empty() ? "found by what hangs on it" : name),
                      can_label)) {
            d_.wish(NextAxis{});
        }
    }

    XbodyDrawing& d_;
};

}  // namespace

void draw_pages(XbodyDrawing& drawing) { PagesPane(drawing).draw(); }

}  // namespace raks::apps
