#include "audio/beat/paper_file.hpp"

#include <algorithm>
#include <array>

namespace raks::audio {

Expected<void> PaperFile::prepare(SampleRate rate) {
    flux_.reset();
    frames_.clear();
    return windows_.prepare(rate);
}

void PaperFile::add(std::span<const float> mono) {
    windows_.process(
        mono, [this](std::span<const float> window) { frames_.push_back(flux_.add(window)); });
}

std::vector<BeatEvent> PaperFile::finish(Nanos duration) {
    // Rounded up: the last hop may be cut by the end of the file.
    const auto hops = static_cast<std::size_t>((duration + kHop - Nanos(1)) / kHop);
    // Frames come kDelay hops late: silence after the file brings the last ones out.
    const std::array<float, 256> silence{};
    while (frames_.size() < hops + PaperFlux::kDelay) {
        add(silence);
    }
    return paper_beats(std::span(frames_).subspan(PaperFlux::kDelay, hops));
}

}  // namespace raks::audio
