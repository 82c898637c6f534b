// What is done with the files that the steps of a capture hand on: what was read is written, and
// reads back to the same.
#include <string>
#include <vector>

#include "motion/capture/angles/angle_track.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/solving/body_file.hpp"
#include "motion/capture/tracking/camera_moves.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

/// Reads a text, writes what it says and reads that: written again it must be the same bytes.
template <typename Read, typename Write>
bool reads_back(std::string_view text, Read read, Write write) {
    const auto values = read(text, "x");
    if (!values) {
        must_be_one_line(values.error().message);
        return false;
    }
    const std::string written = write(*values);
    const auto again = read(written, "y");
    must(again && write(*again) == written);
    return true;
}

/// Tracks of two markers over ten frames, for flags to be read into.
capture::Tracks small_tracks() {
    capture::Tracks tracks;
    tracks.markers = {"head", "left_wrist"};
    tracks.frames_per_second = 60.0;
    tracks.frame_count = 10;
    tracks.places.resize(20);
    return tracks;
}

}  // namespace

bool read_marker_set_file(std::string_view text) {
    return reads_back(text, capture::read_marker_set, capture::marker_set_text);
}

bool read_body_model_file(std::string_view text) {
    const auto model = capture::read_body_model(text, "x");
    if (!model) {
        must_be_one_line(model.error().message);
        return false;
    }
    // Degrees and radians do not give the same digits back; the joints must be the same.
    const auto again = capture::read_body_model(capture::body_model_text(*model), "y");
    must(again && again->variables() == model->variables());
    for (std::size_t i = 0; i < model->joints().size(); ++i) {
        must(again->joints()[i].name == model->joints()[i].name &&
             again->joints()[i].bones == model->joints()[i].bones &&
             again->parent_of(i) == model->parent_of(i));
    }
    return true;
}

bool read_clocks_file(std::string_view text) {
    return reads_back(text, capture::read_clocks, capture::clocks_text);
}

bool read_marker_labels(std::string_view text) {
    return reads_back(text, capture::read_labels, capture::labels_text);
}

bool read_detections(std::string_view text) {
    return reads_back(text, capture::read_observations, capture::observations_text);
}

bool read_angles_file(std::string_view text) {
    const capture::BodyModel model(capture::BodyKind::paper);
    const auto track = capture::read_angles(text, "x", model);
    if (!track) {
        must_be_one_line(track.error().message);
        return false;
    }
    // Turns are kept as quaternions, which does not give the same digits; the rest must be the
    // same.
    const auto again = capture::read_angles(capture::angles_text(*track, model), "y", model);
    must(again && again->states.size() == track->states.size() && again->is_lost == track->is_lost);
    return true;
}

bool read_tracks_file(std::string_view text) {
    const auto tracks = capture::read_tracks(text, "x");
    if (tracks) {
        must(tracks->places.size() == tracks->frame_count * tracks->markers.size());
        static_cast<void>(capture::trc_text(*tracks, "x.trc"));
    }
    return reads_back(text, capture::read_tracks, capture::tracks_text);
}

bool read_flags_file(std::string_view text) {
    const auto read = [](std::string_view table, const std::string& file) {
        capture::Tracks tracks = small_tracks();
        const auto flags = capture::read_flags(table, file, tracks);
        return flags ? Expected<capture::Tracks>(std::move(tracks)) : fail(flags.error());
    };
    return reads_back(text, read, capture::flags_text);
}

bool read_moves_file(std::string_view text) {
    return reads_back(text, capture::read_moves, capture::moves_text);
}

bool read_edits_file(std::string_view text) {
    return reads_back(text, capture::read_edits, capture::edits_text);
}

}  // namespace raks::fuzz
