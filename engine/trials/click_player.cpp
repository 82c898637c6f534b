#include "engine/trials/click_player.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace raks::engine {

// Plays the sound once, then silence; keeps the time of every block.
class ClickPlayer::Tape final : public audio::StreamCallback {
 public:
    // `stream`: which calls back.
    Tape(std::vector<float> sound, const audio::DeviceStream& stream)
        : stream_(stream),
          sound_(std::move(sound)),
          marks_(sound_.size() / BlockClock::kSmallestBlock + 1) {}

    void on_output(std::span<float> interleaved,
                   int channels,
                   const audio::BlockTime& time) noexcept RAKS_NONBLOCKING override {
        const auto stride = static_cast<std::size_t>(channels);
        const std::size_t at = frames_.load(std::memory_order_relaxed);  // only we write it
        const std::size_t frames = std::min(interleaved.size() / stride, sound_.size() - at);
        if (frames == 0) {
            return;
        }
        const std::size_t block = blocks_.load(std::memory_order_relaxed);  // likewise
        if (block < marks_.size()) {
            marks_[block] = {static_cast<std::int64_t>(at), time.entered + stream_.heard_after()};
            // release: pairs with the acquire in marks().
            blocks_.store(block + 1, std::memory_order_release);
        }
        for (std::size_t i = 0; i < frames; ++i) {
            std::fill_n(interleaved.begin() + static_cast<std::ptrdiff_t>(i * stride),
                        stride,
                        sound_[at + i]);
        }
        frames_.store(at + frames, std::memory_order_relaxed);  // a number by itself
    }

    [[nodiscard]] double progress() const noexcept {
        return static_cast<double>(frames_.load(std::memory_order_relaxed)) /
               static_cast<double>(sound_.size());
    }
    // Of the blocks so far.
    [[nodiscard]] std::vector<BlockClock::Mark> marks() const {
        const std::size_t blocks = blocks_.load(std::memory_order_acquire);
        return {marks_.begin(), marks_.begin() + static_cast<std::ptrdiff_t>(blocks)};
    }

 private:
    const audio::DeviceStream& stream_;
    std::vector<float> sound_;
    std::atomic<std::size_t> frames_{0};
    std::atomic<std::size_t> blocks_{0};
    std::vector<BlockClock::Mark> marks_;
};

ClickPlayer::ClickPlayer() = default;

ClickPlayer::~ClickPlayer() = default;

Expected<std::unique_ptr<ClickPlayer>> ClickPlayer::start(const audio::AudioDevice& output,
                                                          const ClickTrain& train) {
    std::unique_ptr<ClickPlayer> player(new ClickPlayer);
    auto stream = audio::DeviceStream::open_output(output, {.stays = true});
    if (!stream) {
        return fail(stream.error());
    }
    player->stream_ = std::move(*stream);
    player->tape_ =
        std::make_unique<Tape>(sound_of(train, player->stream_->rate()), *player->stream_);
    player->stream_->connect(*player->tape_);
    return player;
}

double ClickPlayer::progress() const noexcept { return tape_->progress(); }

Expected<BlockClock> ClickPlayer::clock() const {
    auto marks = tape_->marks();
    if (marks.empty()) {
        return fail("the loudspeaker takes no sound");
    }
    return BlockClock(stream_->rate(), std::move(marks));
}

}  // namespace raks::engine
