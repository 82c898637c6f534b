#include "engine/players/known_song.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "audio/resample/resampler.hpp"
#include "audio/sync/place_finder.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/offline/song_planner.hpp"

namespace raks::engine {
namespace {

using audio::PlaceFinder;

constexpr int kNice = 10;  // sound and pictures come first
constexpr std::chrono::milliseconds kRound(50);
constexpr int kMostPieces = 1'000;         // of sound in a round: more than can have come
constexpr double kBetweenSearches = 0.25;  // seconds of sound
constexpr double kBetweenChecks = 1.0;
constexpr double kReach = 0.2;                            // seconds around where the song should be
constexpr double kMostApart = 0.01;                       // seconds by which a check may be off
constexpr int kMostMissed = 3;                            // checks
constexpr Nanos kLongestFile = std::chrono::minutes(20);  // 70 MB while it is sought

std::size_t samples_in(double seconds) {
    return static_cast<std::size_t>(seconds * PlaceFinder::kRate);
}

// Mono at PlaceFinder's rate, piece by piece.
class Reducer {
 public:
    [[nodiscard]] bool begin(SampleRate rate) {
        if (rate == rate_) {
            resampler_.reset();
            return true;
        }
        rate_ = rate;
        return resampler_.prepare(rate, SampleRate(PlaceFinder::kRate)).has_value();
    }
    [[nodiscard]] SampleRate rate() const noexcept { return rate_; }
    void add(std::span<const float> mono, std::vector<float>& to) {
        std::array<float, 512> made{};
        while (!mono.empty()) {
            const auto progress = resampler_.process(mono, made);
            to.insert(
                to.end(), made.begin(), made.begin() + static_cast<std::ptrdiff_t>(progress.made));
            mono = mono.subspan(progress.taken);
        }
    }

 private:
    SampleRate rate_{0};
    audio::Resampler resampler_;
};

// The newest sound without a hole.
class HeardSound {
 public:
    void add(const SoundTap::Piece& piece) {
        const SampleRate rate(piece.rate);
        const Nanos off = piece.begins - next_;
        if (rate != reducer_.rate() || piece.source != source_ ||
            std::chrono::abs(off) > std::chrono::milliseconds(1)) {
            begin(piece, rate);
        }
        mono_.clear();
        for (std::size_t i = 0; i + 1 < piece.stereo.size(); i += 2) {
            mono_.push_back(0.5F * (piece.stereo[i] + piece.stereo[i + 1]));
        }
        reducer_.add(mono_, sound_);
        next_ =
            piece.begins + rate.time_of(static_cast<std::int64_t>(mono_.size())).time_since_epoch();
        // Twice as much is kept, so that the oldest is thrown away seldom.
        if (const std::size_t most = samples_in(PlaceFinder::kLongest); sound_.size() > 2 * most) {
            first_ += static_cast<std::int64_t>(sound_.size() - most);
            sound_.erase(sound_.begin(), sound_.end() - static_cast<std::ptrdiff_t>(most));
        }
    }
    /// Samples since the hole before it.
    [[nodiscard]] std::int64_t count() const noexcept {
        return first_ + static_cast<std::int64_t>(sound_.size());
    }
    /// Another hole begins another number.
    [[nodiscard]] int holes() const noexcept { return holes_; }
    /// From sample `from` on, or as much of it as is kept, at most `longest` seconds of the newest.
    [[nodiscard]] std::span<const float> since(std::int64_t from, double longest) const {
        const auto count =
            static_cast<std::size_t>(std::max<std::int64_t>(this->count() - from, 0));
        const std::size_t size = std::min({count, sound_.size(), samples_in(longest)});
        return std::span(sound_).last(size);
    }
    /// Stream time of the first sample of since()'s answer.
    [[nodiscard]] StreamTime time_of(std::span<const float> part) const {
        const double index = static_cast<double>(count() - static_cast<std::int64_t>(part.size()));
        return begins_ + nanos_from_seconds(index / PlaceFinder::kRate);
    }

 private:
    void begin(const SoundTap::Piece& piece, SampleRate rate) {
        sound_.clear();
        first_ = 0;
        ++holes_;
        begins_ = piece.begins;
        source_ = piece.source;
        static_cast<void>(reducer_.begin(rate));
    }

    Reducer reducer_;
    std::vector<float> mono_;
    std::vector<float> sound_;
    std::int64_t first_ = 0;  // number of sound_.front()
    std::uint32_t source_ = 0;
    int holes_ = 0;
    StreamTime begins_{};
    StreamTime next_{};
};

// The whole file at PlaceFinder's rate; empty: it cannot be read, or is too long.
std::vector<float> sound_of(const std::filesystem::path& file,
                            const std::function<bool()>& is_stopped) {
    auto source = MusicSource::open(file, 0.0, std::nullopt, is_stopped);
    Reducer reducer;
    if (!source || !reducer.begin(source->rate())) {
        return {};
    }
    std::vector<float> sound;
    for (auto block = source->next(); !block.mono.empty(); block = source->next()) {
        reducer.add(block.mono, sound);
        if (source->given() > kLongestFile || is_stopped()) {
            return {};
        }
    }
    // What is still inside the resampler.
    reducer.add(std::vector<float>(static_cast<std::size_t>(source->rate().hertz()) / 20), sound);
    return sound;
}

}  // namespace

struct KnownSong::Impl {
    explicit Impl(AnalyzerModels models) : planner(std::move(models)) {}

    /// What main asks for.
    struct Wish {
        std::filesystem::path file;  // empty: nothing plays
        bool from_start = false;
        int number = 0;
    };

    void run();
    void turn();
    void take_wish(const Wish& asked);
    void search();
    void check();
    void find(double place, std::span<const float> part);
    void lose();
    void say(Heard what) {
        const std::lock_guard lock(mutex);
        news = std::move(what);
    }
    [[nodiscard]] bool is_superseded() {
        const std::lock_guard lock(mutex);
        return is_over || wish.number != taken;
    }

    SoundTap tap;
    std::mutex mutex;  // of the next five
    std::condition_variable woken;
    bool is_over = false;
    Wish wish;
    std::optional<Heard> news;

    // Of the thread.
    SongPlanner planner;
    HeardSound heard;
    SoundTap::Piece piece;
    int taken = 0;  // number of the wish that is carried out
    std::filesystem::path file;
    std::optional<PlaceFinder> finder;
    std::shared_ptr<const audio::SongPlan> plan;
    int holes = 0;
    std::int64_t since = 0;      // the song sounds without a jump from this sample of `heard` on
    std::int64_t looked_at = 0;  // the newest sample at the last search or check
    bool from_start = false;
    bool is_found = false;
    double shift = 0.0;
    int missed = 0;
    std::thread thread;
};

// A wish, sound, then what follows from both.
void KnownSong::Impl::run() {
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
    for (;;) {
        Wish asked;
        {
            std::unique_lock lock(mutex);
            woken.wait_for(lock, kRound, [this] { return is_over || wish.number != taken; });
            if (is_over) {
                return;
            }
            asked = wish;
        }
        for (int i = 0; i < kMostPieces && tap.take(piece); ++i) {
            heard.add(piece);
        }
        if (asked.number != taken) {
            take_wish(asked);
        }
        turn();
    }
}

void KnownSong::Impl::take_wish(const Wish& asked) {
    taken = asked.number;
    since = looked_at = heard.count();
    from_start = asked.from_start;
    if (std::exchange(is_found, false)) {
        say({});
    }
    if (asked.file == file) {
        return;
    }
    file = asked.file;
    finder.reset();
    plan.reset();
    std::error_code error;
    if (file.empty() || !std::filesystem::is_regular_file(file, error)) {
        return;
    }
    planner.prepare(file);
    std::vector<float> sound = sound_of(file, [this] { return is_superseded(); });
    if (!sound.empty()) {
        finder.emplace(std::move(sound));
    }
    if (is_superseded()) {
        file.clear();  // it may have been read in part
    }
}

void KnownSong::Impl::turn() {
    if (std::exchange(holes, heard.holes()) != heard.holes()) {
        lose();
        since = looked_at = 0;  // all that is kept came behind the hole
    }
    if (!finder) {
        return;
    }
    if (!plan) {
        plan = planner.look(file).plan;
        return;
    }
    const double unseen = static_cast<double>(heard.count() - looked_at) / PlaceFinder::kRate;
    if (unseen < (is_found ? kBetweenChecks : kBetweenSearches)) {
        return;
    }
    looked_at = heard.count();
    is_found ? check() : search();
}

void KnownSong::Impl::search() {
    const std::span<const float> part = heard.since(since, PlaceFinder::kLongest);
    // A player says that a song begins some tenths of a second before or behind its sound.
    const auto hint = from_start && since + static_cast<std::int64_t>(part.size()) == heard.count()
                          ? std::optional(0.0)
                          : std::nullopt;
    if (const auto place = finder->find(part, hint)) {
        find(*place, part);
    }
}

void KnownSong::Impl::find(double place, std::span<const float> part) {
    is_found = true;
    missed = 0;
    shift = place - to_seconds(heard.time_of(part));
    say({plan, nanos_from_seconds(shift)});
}

// Is it still there? A quiet bar says nothing, another place says all.
void KnownSong::Impl::check() {
    const std::span<const float> part = heard.since(since, kBetweenChecks);
    const double expected = to_seconds(heard.time_of(part)) + shift;
    const auto place = finder->find_near(part, expected, kReach);
    if (place && std::abs(*place - expected) <= kMostApart) {
        missed = 0;
    } else if (const auto elsewhere = finder->find(part)) {
        find(*elsewhere, part);
    } else if (++missed == kMostMissed) {
        lose();
    }
}

void KnownSong::Impl::lose() {
    since = heard.count();
    from_start = false;
    if (std::exchange(is_found, false)) {
        say({});
    }
}

KnownSong::KnownSong(AnalyzerModels models) : impl_(std::make_unique<Impl>(std::move(models))) {
    impl_->thread = std::thread([this] { impl_->run(); });
}

KnownSong::~KnownSong() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->is_over = true;
    }
    impl_->woken.notify_one();
    impl_->thread.join();
}

SoundTap& KnownSong::tap() noexcept { return impl_->tap; }

void KnownSong::listen(const std::filesystem::path& file, bool from_start) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->wish = {file, from_start, impl_->wish.number + 1};
    }
    impl_->woken.notify_one();
}

void KnownSong::forget() { listen({}, false); }

std::optional<KnownSong::Heard> KnownSong::take() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->news, std::nullopt);
}

}  // namespace raks::engine
