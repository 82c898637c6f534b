#include "engine/show/dance_preview.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "engine/show/written_figure.hpp"

namespace raks::engine {
namespace {

// BPM that one press of up or down adds.
constexpr double kTempoStep = 4.0;

// An error gives a time that no file has: a file that is being replaced is looked at again later.
std::filesystem::file_time_type time_saved(const std::filesystem::path& path) {
    std::error_code problem;  // a file that is being replaced is looked at again
    return std::filesystem::last_write_time(path, problem);
}

}  // namespace

Expected<DancePreview> DancePreview::create(const std::filesystem::path& path,
                                            const std::string& figure,
                                            std::optional<Bpm> tempo) {
    DancePreview preview;
    preview.path_ = path;
    preview.tempo_ = tempo;
    // Before the file is read: a save in between is then seen as newer.
    preview.saved_ = time_saved(path);
    auto dance = load_written_dance(path);
    if (!dance) {
        return fail(std::move(dance.error()));
    }
    const auto first = find_figure(*dance, figure);
    if (!first) {
        return fail(first.error());
    }
    preview.shown_ = *first;
    preview.take(std::move(*dance));
    return preview;
}

bool DancePreview::refresh() {
    const auto saved = time_saved(path_);
    // The time of change, not the content: this runs with every picture.
    if (saved == saved_) {
        return false;
    }
    saved_ = saved;
    auto dance = load_written_dance(path_);
    if (!dance) {
        // What is shown stays until a good text is saved.
        fault_ = std::move(dance.error().message);
        return true;
    }
    // The figure that is shown is kept by its name, as the text may have moved it; else the nearest
    // number.
    fault_.clear();
    const std::string name(figure());
    const motion::AuthoredFigure* const same = dance->figure(name);
    shown_ = same != nullptr ? static_cast<std::size_t>(same - dance->figures.data())
                             : std::min(shown_, dance->figures.size() - 1);
    take(std::move(*dance));
    return true;
}

void DancePreview::take(motion::AuthoredDance dance) {
    dance_ = std::move(dance);
    evaluate();
}

// Evaluates the figure that is shown, at the tempo; done anew whenever either changes.
void DancePreview::evaluate() {
    evaluated_ = danced_figure(dance_, shown_, tempo_.value_or(dance_.written));
}

// The beat runs over all repeats and begins again at the first.
void DancePreview::advance(double seconds) {
    if (!is_paused_) {
        const double whole = static_cast<double>(evaluated_.repeats) * evaluated_.beats;
        const Bpm tempo = tempo_.value_or(dance_.written);
        beat_ = std::fmod(beat_ + seconds * tempo.beats_per_second(), whole);
    }
}

bool DancePreview::handle(const KeyEvent& key) {
    const std::size_t count = dance_.figures.size();
    const double bpm = tempo_.value_or(dance_.written).bpm();
    switch (key.key) {
        case Key::left:
            show((shown_ + count - 1) % count);
            return true;
        case Key::right:
            show((shown_ + 1) % count);
            return true;
        case Key::up:
        case Key::down:
            tempo_ =
                // 30 to 300 BPM: the range of the preview, not of the tracker.
                Bpm(std::clamp(bpm + (key.key == Key::up ? kTempoStep : -kTempoStep), 30.0, 300.0));
            evaluate();
            return true;
        case Key::space:
            is_paused_ = !is_paused_;
            return true;
        default:
            return false;
    }
}

void DancePreview::show(std::size_t figure) {
    shown_ = figure;
    beat_ = 0.0;
    evaluate();
}

// Poses lie on a grid of frames: the beat's place between two of them is interpolated.
motion::Pose DancePreview::at_beat(double beat) const {
    return motion::pose_between(evaluated_.poses, evaluated_.frame_of(beat));
}

motion::Pose DancePreview::pose() const { return at_beat(beat_); }

std::vector<motion::Pose> DancePreview::sheet(int per_beat) const {
    // The second repeat: it begins from the figure itself and not from the margin before it.
    const int first = beats_of_sheet(shown_);
    std::vector<motion::Pose> poses;
    for (int i = 0; i < first * per_beat; ++i) {
        poses.push_back(at_beat(first + static_cast<double>(i) / per_beat));
    }
    return poses;
}

int DancePreview::beats_of_sheet(std::size_t number) const {
    const motion::AuthoredFigure& figure = dance_.figures.at(number);
    return (figure.is_mirrored ? 2 : 1) * figure.beats;
}

std::string DancePreview::status() const {
    if (!fault_.empty()) {
        return fault_;
    }
    const double beats = evaluated_.beats;
    return fmt::format("{}   {:.0f} BPM   beat {:.1f} of {}{}",
                       figure(),
                       tempo_.value_or(dance_.written).bpm(),
                       // The beat within its repeat, from 0.
                       beat_ - beats * std::floor(beat_ / beats),
                       evaluated_.beats,
                       is_paused_ ? "   paused" : "");
}

std::string_view DancePreview::figure() const noexcept { return dance_.figures[shown_].name; }

std::vector<std::string> DancePreview::figures() const {
    std::vector<std::string> names;
    for (const motion::AuthoredFigure& figure : dance_.figures) {
        names.push_back(figure.name);
    }
    return names;
}

}  // namespace raks::engine
