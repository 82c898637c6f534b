#include "apps/raks_capture/correct_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <glm/common.hpp>

namespace raks::apps {
namespace {

using capture::Edit;
using capture::EditKind;
using capture::Flag;

/// Changes a session by one action.
class CorrectChange {
 public:
    explicit CorrectChange(CorrectSession& session) : session_(session) {}

    void operator()(const ShowFrame& show) {
        session_.frame = std::min(show.frame, session_.tracks.frame_count - 1);
        session_.held.reset();
    }
    void operator()(const ChooseMarker& choose) {
        if (std::exchange(session_.is_swapping, false)) {
            if (choose.marker != session_.marker) {
                add({.kind = EditKind::swap,
                     .marker = name(),
                     .other = session_.tracks.markers[choose.marker],
                     .camera = {},
                     .first = session_.frame,
                     .last = session_.frame,
                     .pixel = {}});
            }
            return;
        }
        session_.marker = choose.marker;
        session_.stretch.reset();
        session_.held.reset();
    }
    void operator()(const ChooseView& choose) { session_.camera = choose.camera; }
    void operator()(const ShowView& show) {
        session_.alone = show.camera;
        session_.camera = show.camera.value_or(session_.camera);
    }
    void operator()(const TogglePlay& /*action*/) {
        const bool is_at_end = session_.frame + 1 >= session_.tracks.frame_count;
        session_.is_playing = !session_.is_playing;
        session_.frame = session_.is_playing && is_at_end ? 0 : session_.frame;
    }
    void operator()(const ShowFlag& show) {
        const auto& flags = session_.tracks.flags;
        // They are in order of their first frames, then of their markers.
        const std::pair here(session_.frame, session_.marker);
        const auto is_wanted = [&](const Flag& flag) {
            const std::pair there(flag.first, flag.marker);
            return show.is_next ? there > here : there < here;
        };
        const auto next = std::find_if(flags.begin(), flags.end(), is_wanted);
        const auto before = std::find_if(flags.rbegin(), flags.rend(), is_wanted);
        const Flag* const found = show.is_next ? (next != flags.end() ? &*next : nullptr)
                                               : (before != flags.rend() ? &*before : nullptr);
        if (found != nullptr) {
            look_at(found->marker, found->first);
            const auto camera =
                std::find(session_.cameras.begin(), session_.cameras.end(), found->camera);
            if (camera != session_.cameras.end()) {
                session_.camera = static_cast<std::size_t>(camera - session_.cameras.begin());
            }
        }
    }
    void operator()(const ShowWorst& /*action*/) {
        constexpr std::size_t kMost = 100;
        const auto apart = static_cast<std::size_t>(0.5 * session_.tracks.frames_per_second);
        const auto worst = worst_frames(session_.tracks, session_.marker, apart, kMost);
        const auto here = std::find(worst.begin(), worst.end(), session_.frame);
        if (!worst.empty()) {
            const bool goes_on = here != worst.end() && here + 1 != worst.end();
            look_at(session_.marker, goes_on ? *(here + 1) : worst.front());
        }
    }
    void operator()(const SetStretch& set) {
        FrameStretch stretch =
            session_.stretch.value_or(FrameStretch{session_.frame, session_.frame});
        (set.is_first ? stretch.first : stretch.last) = session_.frame;
        if (stretch.first > stretch.last) {
            (set.is_first ? stretch.last : stretch.first) = session_.frame;
        }
        session_.stretch = stretch;
    }
    void operator()(const HoldMarker& hold) { session_.held = hold.held; }
    void operator()(const LetGoOfMarker& /*action*/) {
        const auto held = std::exchange(session_.held, std::nullopt);
        if (held && held->has_moved) {
            set(*held);
        }
    }
    void operator()(const HideMarker& /*action*/) {
        if (session_.is_of_joints) {
            add_of_view({.kind = EditKind::hide, .marker = name()});
        } else {
            add_stretch(EditKind::hide);
        }
    }
    void operator()(const HideView& /*action*/) { add_of_view({.kind = EditKind::hide}); }
    void operator()(const ExchangeSides& exchange) {
        add_of_view({.kind = EditKind::exchange,
                     .limbs = exchange.is_of_limb ? limbs_of(name()) : std::string()});
    }
    void operator()(const FillMarker& /*action*/) { add_stretch(EditKind::fill); }
    void operator()(const BeginSwap& /*action*/) { session_.is_swapping = true; }
    void operator()(const ForgetStretch& /*action*/) {
        session_.stretch.reset();
        session_.held.reset();
        session_.is_swapping = false;
    }
    void operator()(const UndoEdit& /*action*/) { session_.edits.undo(); }
    void operator()(const RedoEdit& /*action*/) { session_.edits.redo(); }

 private:
    [[nodiscard]] const std::string& name() const {
        return session_.tracks.markers[session_.marker];
    }

    void look_at(std::size_t marker, std::size_t frame) {
        session_.marker = marker;
        session_.frame = std::min(frame, session_.tracks.frame_count - 1);
        session_.stretch.reset();
        session_.held.reset();
        session_.is_playing = false;
    }

    void add(Edit edit) {
        std::vector<Edit> edits = session_.edits.now();
        edits.push_back(std::move(edit));
        session_.edits.change(std::move(edits));
    }

    void add_stretch(EditKind kind) {
        const FrameStretch meant = session_.meant();
        add({.kind = kind,
             .marker = name(),
             .other = {},
             .camera = {},
             .first = meant.first,
             .last = meant.last,
             .pixel = {}});
        session_.stretch.reset();
    }

    void add_of_view(Edit edit) {
        const FrameStretch meant = session_.meant_in_view();
        edit.camera = session_.cameras[session_.camera];
        edit.first = meant.first;
        edit.last = meant.last;
        add(std::move(edit));
    }

    // "arms" or "legs"; empty: of neither, as the nose.
    static std::string limbs_of(const std::string& joint) {
        const auto has = [&joint](std::string_view word) {
            return joint.find(word) != std::string::npos;
        };
        if (has("hip") || has("knee") || has("ankle") || has("heel") || has("foot")) {
            return "legs";
        }
        return joint == "nose" || has("ear") ? std::string() : std::string("arms");
    }

    void set(const HeldMarker& held) {
        Edit edit{.kind = EditKind::set,
                  .marker = name(),
                  .other = {},
                  .camera = session_.cameras[held.camera],
                  .first = session_.frame,
                  .last = session_.frame,
                  .pixel = glm::round(held.pixel * 100.0) / 100.0};
        std::vector<Edit> edits = session_.edits.now();
        const bool is_same = !edits.empty() && edits.back().kind == EditKind::set &&
                             edits.back().marker == edit.marker &&
                             edits.back().camera == edit.camera && edits.back().first == edit.first;
        if (is_same) {
            edits.pop_back();
        }
        edits.push_back(std::move(edit));
        session_.edits.change(std::move(edits));
    }

    CorrectSession& session_;
};

Expected<void> check_name(std::string_view what,
                          const std::string& name,
                          const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) {
        return {};
    }
    const std::vector<std::string_view> views(known.begin(), known.end());
    return fail(unknown_name(what, printable(name, 40), views));
}

std::vector<std::string> names_of(const capture::Rig& rig) {
    std::vector<std::string> cameras;
    for (const capture::Camera& camera : rig.cameras) {
        cameras.push_back(camera.name);
    }
    return cameras;
}

Expected<void> check_pixel(const Edit& edit, const capture::Rig& rig) {
    auto checked = check_name("camera", edit.camera, names_of(rig));
    const auto camera = rig.index_of(edit.camera);
    if (checked && !capture::is_in_picture(rig.cameras[*camera].lens, edit.pixel)) {
        return fail(fmt::format("({:.1f}, {:.1f}) lies outside of the picture of \"{}\"",
                                edit.pixel.x,
                                edit.pixel.y,
                                printable(edit.camera, 40)));
    }
    return checked;
}

}  // namespace

FrameStretch CorrectSession::meant() const {
    if (stretch) {
        return *stretch;
    }
    for (const Flag& flag : tracks.flags) {
        if (flag.marker == marker && flag.first <= frame && frame <= flag.last) {
            return {flag.first, flag.last};
        }
    }
    return {frame, frame};
}

FrameStretch CorrectSession::meant_in_view() const {
    if (stretch) {
        return *stretch;
    }
    // A flag of the marker in this view comes first, then one of the view, then one of the marker.
    const Flag* best = nullptr;
    int most = 0;
    for (const Flag& flag : tracks.flags) {
        const int fit = (flag.camera == cameras[camera] ? 2 : 0) + (flag.marker == marker ? 1 : 0);
        const bool is_of_other_view = !flag.camera.empty() && flag.camera != cameras[camera];
        // What is not seen is neither exchanged nor somebody else.
        if (flag.doubt != capture::Doubt::lost && flag.first <= frame && frame <= flag.last &&
            fit > most && !is_of_other_view) {
            best = &flag;
            most = fit;
        }
    }
    return best != nullptr ? FrameStretch{best->first, best->last} : FrameStretch{frame, frame};
}

void apply(const CorrectAction& action, CorrectSession& session) {
    std::visit(CorrectChange(session), action);
}

std::vector<std::size_t> worst_frames(const capture::Tracks& tracks,
                                      std::size_t marker,
                                      std::size_t apart,
                                      std::size_t count) {
    const auto badness = [&](std::size_t frame) {
        const capture::MarkerPlace& place = tracks.at(frame, marker);
        return place.source == capture::PlaceSource::lost ? std::numeric_limits<double>::infinity()
                                                          : place.deviation;
    };
    std::vector<std::size_t> order(tracks.frame_count);
    for (std::size_t frame = 0; frame < order.size(); ++frame) {
        order[frame] = frame;
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
        return badness(one) > badness(other);
    });
    std::vector<std::size_t> worst;
    for (const std::size_t frame : order) {
        const bool is_near = std::any_of(worst.begin(), worst.end(), [&](std::size_t other) {
            return std::max(frame, other) - std::min(frame, other) < apart;
        });
        if (!is_near && worst.size() < count) {
            worst.push_back(frame);
        }
    }
    return worst;
}

Expected<void> check_edits(const std::vector<Edit>& edits,
                           const capture::MarkerSet& markers,
                           const capture::Rig& rig) {
    std::vector<std::string> names;
    for (const capture::Marker& marker : markers.markers) {
        names.push_back(marker.name);
    }
    for (std::size_t i = 0; i < edits.size(); ++i) {
        const Edit& edit = edits[i];
        auto checked =
            edit.marker.empty() ? Expected<void>{} : check_name("marker", edit.marker, names);
        if (checked && edit.kind != EditKind::set && !edit.camera.empty()) {
            checked = check_name("camera", edit.camera, names_of(rig));
        }
        if (checked && edit.kind == EditKind::swap) {
            checked = check_name("marker", edit.other, names);
        }
        if (checked && edit.kind == EditKind::set) {
            checked = check_pixel(edit, rig);
        }
        if (!checked) {
            return fail(fmt::format("edit {}: {}", i + 1, checked.error().message));
        }
    }
    return {};
}

}  // namespace raks::apps
