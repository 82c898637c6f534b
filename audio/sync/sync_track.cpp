#include "audio/sync/sync_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "audio/resample/resampler.hpp"

namespace raks::audio {
namespace {

constexpr float kSilence = 1e-4F;  // -80 dBFS: below it there is noise of the converter alone

// The whole of `samples` at another rate: as many as begin in it.
Expected<std::vector<float>> at_rate(std::span<const float> samples, SampleRate from, int to) {
    Resampler resampler;
    if (auto prepared = resampler.prepare(from, SampleRate(to)); !prepared) {
        return fail(std::move(prepared.error()));
    }
    const double length = static_cast<double>(samples.size()) * to / from.hertz();
    std::vector<float> result(static_cast<std::size_t>(std::ceil(length)));
    std::size_t made = 0;
    const auto feed = [&](std::span<const float> input) {
        while (!input.empty() && made < result.size()) {
            const auto progress = resampler.process(input, std::span(result).subspan(made));
            made += progress.made;
            input = input.subspan(progress.taken);
        }
    };
    feed(samples);
    // What is still inside the resampler comes out behind silence.
    const std::vector<float> silence(4'096);
    while (made < result.size()) {
        feed(silence);
    }
    return result;
}

// Does anything stand out from a constant?
bool is_silent(std::span<const float> samples) {
    const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
    return *high - *low < 2.0F * kSilence;
}

}  // namespace

Expected<SyncTrack> SyncTrack::prepare(std::span<const float> samples,
                                       SampleRate rate,
                                       std::string name) {
    if (!rate.is_supported()) {
        return fail(
            fmt::format("{}: its sound has {} samples a second; 8,000 to 192,000 can be aligned",
                        name,
                        rate.hertz()));
    }
    const double seconds = static_cast<double>(samples.size()) / rate.hertz();
    if (seconds < kWindow) {
        return fail(
            fmt::format("{}: {:.1f} s of sound are too short to tell its clock; at least "
                        "{:.0f} s are compared, and a minute is better",
                        name,
                        seconds,
                        kWindow));
    }
    std::vector<float> clean(samples.begin(), samples.end());
    std::replace_if(
        clean.begin(), clean.end(), [](float x) { return !std::isfinite(x); }, 0.0F);
    if (is_silent(clean)) {
        return fail(fmt::format(
            "{}: its sound is silent, so its clock cannot be told; set it by hand", name));
    }
    SyncTrack track;
    track.name_ = std::move(name);
    auto fine = at_rate(clean, rate, kRate);
    if (!fine) {
        return fail(std::move(fine.error()).in(track.name_));
    }
    auto coarse = at_rate(*fine, SampleRate(kRate), kCoarseRate);
    if (!coarse) {
        return fail(std::move(coarse.error()).in(track.name_));
    }
    track.fine_ = std::move(*fine);
    track.coarse_ = std::move(*coarse);
    return track;
}

}  // namespace raks::audio
