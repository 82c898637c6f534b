#include "audio/features/mfcc_hops.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kHopSamples = MfccStream::kHop;  // at 16 kHz
constexpr std::size_t kCapacity = 4096;                // samples: 256 ms at 16 kHz

// Takes over the vector of a hop, if the hop's frame has one.
class KeepLast final : public MfccStream::Sink {
 public:
    explicit KeepLast(MfccVector& kept) : kept_(kept) {}
    void on_vector(const MfccVector& vector) noexcept RAKS_NONBLOCKING override {
        kept_ = vector;
        has_vector_ = true;
    }
    [[nodiscard]] bool has_vector() const noexcept { return has_vector_; }

 private:
    MfccVector& kept_;
    bool has_vector_ = false;
};

}  // namespace

Expected<void> MfccHops::prepare(SampleRate rate, const MfccConfig& config) {
    if (auto prepared = resampler_.prepare(rate, SampleRate(MfccStream::kSampleRate)); !prepared) {
        return prepared;
    }
    stream_ = MfccStream(config);
    queue_.assign(kCapacity, 0.0F);
    reset();
    return {};
}

Expected<void> MfccHops::change_rate(SampleRate rate) {
    return resampler_.prepare(rate, SampleRate(MfccStream::kSampleRate));
}

void MfccHops::reset() noexcept RAKS_NONBLOCKING {
    resampler_.reset();
    stream_.reset();
    queued_ = 0;
    newest_ = {};
}

// Resamples straight into the free end of the queue; a call may take a part of the samples only.
void MfccHops::push(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    while (!mono.empty()) {
        const std::span<float> room = std::span(queue_).subspan(queued_);
        RAKS_ASSERT(!room.empty());
        const auto progress = resampler_.process(mono, room);
        if (progress.taken == 0 && progress.made == 0) {
            return;  // full, against the caller's promise: the rest is lost
        }
        for (float& sample : room.first(progress.made)) {
            sample *= kScale;
        }
        queued_ += progress.made;
        mono = mono.subspan(progress.taken);
    }
}

std::span<const float> MfccHops::coming() const noexcept RAKS_NONBLOCKING {
    return std::span(queue_).first(std::min(queued_, kHopSamples));
}

// One hop of samples completes at most one frame, so at most one vector comes out.
const MfccVector* MfccHops::next() noexcept RAKS_NONBLOCKING {
    KeepLast keep(newest_);
    const std::size_t count = std::min(queued_, kHopSamples);
    RAKS_ASSERT(count == kHopSamples);
    stream_.process(std::span(queue_).first(count), keep);
    std::copy_n(
        queue_.begin() + static_cast<std::ptrdiff_t>(count), queued_ - count, queue_.begin());
    queued_ -= count;
    return keep.has_vector() ? &newest_ : nullptr;
}

// A frame that spans a gap would hold a false onset: all frames so far are dropped.
void MfccHops::discard() noexcept RAKS_NONBLOCKING {
    const std::size_t count = std::min(queued_, kHopSamples);
    std::copy_n(
        queue_.begin() + static_cast<std::ptrdiff_t>(count), queued_ - count, queue_.begin());
    queued_ -= count;
    stream_.reset();
}

void MfccHops::push_lost(int samples) noexcept RAKS_NONBLOCKING {
    const std::size_t count =
        std::min(queue_.size() - queued_, static_cast<std::size_t>(std::max(samples, 0)));
    std::fill_n(queue_.begin() + static_cast<std::ptrdiff_t>(queued_), count, 0.0F);
    queued_ += count;
}

}  // namespace raks::audio
