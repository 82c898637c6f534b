#include "motion/capture/markerless/followed_keypoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/printable.hpp"
#include "motion/capture/markerless/keypoint_jumps.hpp"
#include "motion/capture/markerless/keypoint_tracks.hpp"
#include "motion/capture/markerless/side_exchange.hpp"

namespace raks::capture {
namespace {

Expected<void> check_edit(const Edit& edit, const Rig& rig) {
    if (edit.kind == EditKind::swap || edit.kind == EditKind::fill) {
        return fail("swap and fill are for markers; without them there are set, hide and exchange");
    }
    if (!edit.marker.empty() && !body_point_named(edit.marker)) {
        return fail(fmt::format("\"{}\" is none of the joints that a network sees",
                                printable(edit.marker, 40)));
    }
    const auto camera = rig.index_of(edit.camera);
    if (!edit.camera.empty() && !camera) {
        return fail(fmt::format("there is no camera \"{}\"", printable(edit.camera, 40)));
    }
    if (edit.kind == EditKind::set && !is_in_picture(rig.cameras[*camera].lens, edit.pixel)) {
        return fail(fmt::format("({:.1f}, {:.1f}) lies outside of the picture of \"{}\"",
                                edit.pixel.x,
                                edit.pixel.y,
                                printable(edit.camera, 40)));
    }
    return {};
}

void exchange_limbs(const Edit& edit, std::size_t camera, std::size_t frame, KeypointTake& take) {
    if (edit.limbs != "legs") {
        exchange_sides({camera, ExchangedLimbs::arms, frame, frame}, take);
    }
    if (edit.limbs != "arms") {
        exchange_sides({camera, ExchangedLimbs::legs, frame, frame}, take);
    }
}

void apply_edit(const Edit& edit, std::size_t camera, std::size_t frame, KeypointTake& take) {
    if (edit.kind == EditKind::exchange) {
        exchange_limbs(edit, camera, frame, take);
        return;
    }
    auto& points = take.at(frame, camera);
    if (edit.marker.empty()) {
        points = {};
        return;
    }
    const auto point = body_point_named(edit.marker);
    if (point) {
        points[static_cast<std::size_t>(*point)] =
            edit.kind == EditKind::set ? Keypoint{edit.pixel, 1.0} : Keypoint{};
    }
}

bool hides_whole_view(const Edit& edit) {
    return edit.kind == EditKind::hide && edit.marker.empty();
}

template <typename Items>
void append(const Items& items, Items& all) {
    all.insert(all.end(), items.begin(), items.end());
}

}  // namespace

Expected<void> check_keypoint_edits(const std::vector<Edit>& edits, const Rig& rig) {
    for (std::size_t i = 0; i < edits.size(); ++i) {
        if (auto checked = check_edit(edits[i], rig); !checked) {
            return fail(fmt::format("edit {}: {}", i + 1, checked.error().message));
        }
    }
    return {};
}

void apply_keypoint_edits(const std::vector<Edit>& edits, const Rig& rig, KeypointTake& take) {
    for (const Edit& edit : edits) {
        const auto named = rig.index_of(edit.camera);
        for (std::size_t camera = 0; camera < take.cameras; ++camera) {
            const bool is_meant = edit.camera.empty() || named == camera;
            for (std::size_t frame = edit.first;
                 is_meant && frame <= edit.last && frame < take.frame_count;
                 ++frame) {
                apply_edit(edit, camera, frame, take);
            }
        }
    }
}

Expected<FollowedKeypoints> follow_keypoints(const Rig& rig,
                                             const KeypointTake& take,
                                             const std::vector<Edit>& edits) {
    if (auto checked = check_keypoint_edits(edits, rig); !checked) {
        return fail(std::move(checked.error()));
    }
    std::vector<std::string> names;
    std::vector<double> errors;
    for (std::size_t camera = 0; camera < take.cameras; ++camera) {
        names.push_back(rig.cameras[camera].name);
        errors.push_back(usual_error(take, camera));
    }
    std::vector<Edit> hidden;
    std::copy_if(edits.begin(), edits.end(), std::back_inserter(hidden), hides_whole_view);
    KeypointTake used = take;
    apply_keypoint_edits(hidden, rig, used);
    std::vector<KeypointJump> jumps = find_other_people(errors, used);
    hide_jumps(jumps, used);
    const auto exchanges = put_sides_right(rig, errors, used);

    FollowedKeypoints followed;
    followed.shown = take;
    for (const SideExchange& stretch : exchanges) {
        exchange_sides(stretch, followed.shown);
    }
    used = followed.shown;
    apply_keypoint_edits(edits, rig, used);
    hide_jumps(jumps, used);
    const auto found = find_jumps(rig, errors, used);
    hide_jumps(found, used);
    append(found, jumps);
    followed.tracks = keypoint_tracks(rig, used, errors);
    add_flags(exchanges, names, followed.tracks);
    add_flags(jumps, names, followed.tracks);
    followed.lines = words_of(exchanges, names, followed.tracks);
    append(words_of(jumps, names, followed.tracks), followed.lines);
    return followed;
}

}  // namespace raks::capture
