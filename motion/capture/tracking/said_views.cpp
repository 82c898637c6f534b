#include "motion/capture/tracking/said_views.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/printable.hpp"

namespace raks::capture {
namespace {

/// What a person said, for the run.
class SaidReader {
 public:
    SaidReader(const TrackerInput& input,
               const Films& films,
               const TimeLine& line,
               TrackRunInput& run)
        : input_(input), films_(films), line_(line), rate_(line.frames_per_second), run_(run) {}

    Expected<void> read() {
        for (const MarkerLabel& label : input_.labels) {
            if (auto done = add_label(label); !done) {
                return fail(std::move(done.error())
                                .in(fmt::format("the label of \"{}\" in picture {}",
                                                printable(label.marker),
                                                label.picture)));
            }
        }
        for (std::size_t i = 0; i < input_.edits.size(); ++i) {
            if (auto done = add_edit(input_.edits[i]); !done) {
                return fail(std::move(done.error()).in(fmt::format("edit {}", i + 1)));
            }
        }
        return {};
    }

 private:
    [[nodiscard]] Expected<std::size_t> marker_called(const std::string& name) const {
        const auto marker = input_.markers.index_of(name);
        return marker
                   ? Expected<std::size_t>(*marker)
                   : fail(fmt::format("marker \"{}\" is not in the marker set", printable(name)));
    }

    [[nodiscard]] Expected<std::size_t> film_of(const std::string& camera) const {
        for (std::size_t i = 0; i < input_.seen.films.size(); ++i) {
            if (input_.seen.films[i].camera == camera) {
                return i;
            }
        }
        return fail(fmt::format("camera \"{}\" has no film", printable(camera)));
    }

    [[nodiscard]] Expected<void> check_pixel(std::size_t film, const glm::dvec2& pixel) const {
        const Camera& camera = input_.rig.cameras[films_.cameras[film]];
        if (is_in_picture(camera.lens, pixel)) {
            return {};
        }
        return fail(
            fmt::format("({:.1f}, {:.1f}) lies outside of the {} x {} picture of camera "
                        "\"{}\"",
                        pixel.x,
                        pixel.y,
                        camera.lens.width,
                        camera.lens.height,
                        printable(camera.name)));
    }

    Expected<void> add_label(const MarkerLabel& label) {
        const auto marker = marker_called(label.marker);
        const auto film = film_of(label.camera);
        if (!marker || !film) {
            return fail(marker ? film.error() : marker.error());
        }
        const auto& pictures = input_.seen.films[*film].pictures;
        if (label.picture >= pictures.size()) {
            return fail(fmt::format(
                "camera \"{}\" has {} pictures", printable(label.camera), pictures.size()));
        }
        const double time = films_.clocks[*film].capture_time(pictures[label.picture].time);
        const double frame = std::round((time - line_.first) * rate_);
        if (frame < 0.0 || frame >= static_cast<double>(line_.frame_count)) {
            return {};  // before the time line begins
        }
        run_.said.push_back({static_cast<std::size_t>(frame),
                             films_.cameras[*film],
                             *marker,
                             label.pixel,
                             time - line_.first - frame / rate_});
        return check_pixel(*film, label.pixel);
    }

    Expected<void> add_edit(const Edit& edit) {
        if (edit.kind == EditKind::exchange ||
            (edit.kind == EditKind::hide && !edit.camera.empty())) {
            return fail("edits of what one camera sees are for takes without markers");
        }
        const auto marker = marker_called(edit.marker);
        if (!marker) {
            return fail(marker.error());
        }
        switch (edit.kind) {
            case EditKind::set:
                return add_set(edit, *marker);
            case EditKind::hide:
            case EditKind::fill:
                run_.hidden.push_back({*marker, edit.first, edit.last});
                return {};
            case EditKind::swap:
            case EditKind::exchange:
                break;
        }
        const auto other = marker_called(edit.other);
        if (!other) {
            return fail(other.error());
        }
        run_.swaps.push_back({edit.first, *marker, *other});
        return {};
    }

    Expected<void> add_set(const Edit& edit, std::size_t marker) {
        const auto film = film_of(edit.camera);
        if (!film) {
            return fail(film.error());
        }
        // By the picture of that camera that is nearest to the frame.
        const double time = line_.first + static_cast<double>(edit.first) / rate_;
        double late = std::numeric_limits<double>::infinity();
        for (const SeenPicture& picture : input_.seen.films[*film].pictures) {
            const double other = films_.clocks[*film].capture_time(picture.time) - time;
            late = std::abs(other) < std::abs(late) ? other : late;
        }
        run_.said.push_back({edit.first,
                             films_.cameras[*film],
                             marker,
                             edit.pixel,
                             std::isfinite(late) ? late : 0.0});
        return check_pixel(*film, edit.pixel);
    }

    const TrackerInput& input_;
    const Films& films_;
    const TimeLine& line_;
    double rate_;
    TrackRunInput& run_;
};

}  // namespace

Expected<void> read_said(const TrackerInput& input,
                         const Films& films,
                         const TimeLine& line,
                         TrackRunInput& run) {
    return SaidReader(input, films, line, run).read();
}

}  // namespace raks::capture
