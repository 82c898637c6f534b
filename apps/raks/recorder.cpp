#include "apps/raks/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/file.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Pictures that wait for the encoder; more are shown by the one before.
constexpr std::size_t kMostWaiting = 8;
constexpr auto kNap = std::chrono::milliseconds(20);
// With less than that on the disk the film ends: what else writes there needs room, too.
constexpr std::uintmax_t kLeastFree = 500'000'000;
constexpr Nanos kBetweenLooks = std::chrono::seconds(1);
// Less than this between two pieces of sound is rounding.
constexpr std::int64_t kHole = 48;  // frames

}  // namespace

Expected<std::unique_ptr<Recorder>> Recorder::start(const Path& file,
                                                    render::VideoOptions options,
                                                    engine::SoundTap& tap) {
    if (is_there(file)) {
        return fail(file.string() + ": is there already; give a new name");
    }
    options.audio_rate = 48'000;
    options.audio_channels = 2;
    options.is_live = true;
    auto writer = render::VideoWriter::create(file, options);
    if (!writer) {
        return fail(writer.error());
    }
    return std::unique_ptr<Recorder>(new Recorder(file, options, std::move(*writer), tap));
}

Recorder::Recorder(Path file,
                   const render::VideoOptions& options,
                   std::unique_ptr<render::VideoWriter> writer,
                   engine::SoundTap& tap)
    : file_(std::move(file)),
      options_(options),
      tap_(tap),
      writer_(std::move(writer)),
      thread_([this] { run(); }) {}

Recorder::~Recorder() { static_cast<void>(stop()); }

Nanos Recorder::time_of(std::int64_t picture) const noexcept {
    return Nanos(picture * options_.rate.denominator * 1'000'000'000 / options_.rate.numerator);
}

void Recorder::follow(std::uint32_t source) {
    source_ = source;
    if (first_source_ == 0) {
        first_source_ = source;
    }
}

std::optional<StreamTime> Recorder::wanted(StreamTime passing) {
    const std::lock_guard lock(mutex_);
    if (!anchor_ || anchor_->source != source_ || has_ended_) {
        return std::nullopt;
    }
    const Nanos period = time_of(1);
    const auto moment = [&] { return anchor_->begins + time_of(next_ - anchor_->first); };
    while (moment() + period < passing) {
        ++next_;
        ++owed_;
    }
    return moment() <= passing + period ? std::optional(moment()) : std::nullopt;
}

void Recorder::give(std::span<const std::uint8_t> rgba) {
    const std::lock_guard lock(mutex_);
    ++next_;
    if (waiting_.size() >= kMostWaiting) {
        ++owed_;
        return;
    }
    Picture picture{.repeats = std::exchange(owed_, 0), .rgba = {}};
    if (!spare_.empty()) {
        picture.rgba = std::move(spare_.back());
        spare_.pop_back();
    }
    picture.rgba.assign(rgba.begin(), rgba.end());
    waiting_.push_back(std::move(picture));
    changed_.notify_one();
}

std::optional<std::string> Recorder::take_trouble() {
    const std::lock_guard lock(mutex_);
    return std::exchange(trouble_, std::nullopt);
}

void Recorder::run() noexcept {
    while (!has_ended_) {
        const bool is_last = is_stopping_;
        auto done = write_sound();
        done = done ? write_pictures() : done;
        done = done ? check_disk() : done;
        if (!done) {
            end(done.error());
        } else if (is_last) {
            return;
        }
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, kNap, [&] { return !waiting_.empty() || is_stopping_; });
    }
}

// What is there already is kept: a whole film.
void Recorder::end(const Error& why) {
    const auto kept = writer_->finish();
    const std::lock_guard lock(mutex_);
    trouble_ = "recording ended: " + why.message +
               (kept ? "; the film up to there is " + file_.string() : std::string());
    has_ended_ = true;
}

Expected<void> Recorder::write_sound() {
    engine::SoundTap::Piece piece;
    while (tap_.take(piece)) {
        const std::uint32_t first = first_source_;
        if (first == 0 || piece.source < first) {
            continue;
        }
        if (auto written = write_piece(piece); !written) {
            return written;
        }
    }
    return {};
}

// The first sound of a source lies at the next picture, but behind all sound before it: what a song
// that was left had already given.
void Recorder::begin_source(const engine::SoundTap::Piece& piece) {
    const std::lock_guard lock(mutex_);
    const double rate = static_cast<double>(options_.audio_rate) / options_.rate.fps();
    const auto heard = static_cast<std::int64_t>(std::ceil(static_cast<double>(frames_) / rate));
    owed_ += std::max<std::int64_t>(0, heard - next_);
    next_ = std::max(next_, heard);
    heard_source_ = piece.source;
    heard_ = {piece.source, piece.begins, next_};
    anchor_ = heard_;
}

// What is missing is silence.
Expected<void> Recorder::write_piece(const engine::SoundTap::Piece& piece) {
    if (piece.source != heard_source_) {
        begin_source(piece);
    }
    if (piece.rate != resampled_rate_) {
        const SampleRate rate(piece.rate);
        if (auto ready = resampler_.prepare(rate, SampleRate(options_.audio_rate), 2); !ready) {
            return ready;
        }
        resampled_rate_ = piece.rate;
    }
    const double begins = to_seconds(time_of(heard_.first) + (piece.begins - heard_.begins));
    const auto place = static_cast<std::int64_t>(std::llround(begins * options_.audio_rate));
    if (place > frames_ + kHole) {
        resampler_.reset();
        const std::vector<float> silence(static_cast<std::size_t>(place - frames_) * 2);
        frames_ = place;
        if (auto added = writer_->add_sound(silence); !added) {
            return added;
        }
    }
    const double ratio = static_cast<double>(options_.audio_rate) / piece.rate;
    const std::size_t frames = piece.stereo.size() / 2;
    constexpr std::size_t kMore = 64;  // that the resampler may have held back
    const auto most = static_cast<std::size_t>(std::ceil(ratio * static_cast<double>(frames)));
    resampled_.resize(2 * (most + kMore));
    std::span<const float> input = piece.stereo;
    while (!input.empty()) {
        const auto [taken, made] = resampler_.process(input, resampled_);
        input = input.subspan(2 * taken);
        frames_ += static_cast<std::int64_t>(made);
        if (auto added = writer_->add_sound(std::span(resampled_).first(2 * made)); !added) {
            return added;
        }
    }
    return {};
}

Expected<void> Recorder::write_pictures() {
    for (;;) {
        Picture picture;
        {
            const std::lock_guard lock(mutex_);
            if (waiting_.empty()) {
                return {};
            }
            picture = std::move(waiting_.front());
            waiting_.pop_front();
        }
        if (last_.empty()) {
            last_ = picture.rgba;
        }
        for (std::int64_t i = 0; i < picture.repeats; ++i) {
            if (auto added = writer_->add_picture(last_); !added) {
                return added;
            }
        }
        std::swap(last_, picture.rgba);
        if (auto added = writer_->add_picture(last_); !added) {
            return added;
        }
        const std::lock_guard lock(mutex_);
        spare_.push_back(std::move(picture.rgba));
    }
}

Expected<void> Recorder::check_disk() {
    const HostTime now = std::chrono::time_point_cast<Nanos>(HostClock::now());
    if (now - looked_ < kBetweenLooks) {
        return {};
    }
    looked_ = now;
    std::error_code unknown;
    const auto space =
        std::filesystem::space(file_.has_parent_path() ? file_.parent_path() : Path("."), unknown);
    if (!unknown && space.available < kLeastFree) {
        return fail(fmt::format("less than {} MB are free on the disk", kLeastFree / 1'000'000));
    }
    return {};
}

std::string Recorder::stop() {
    if (!thread_.joinable()) {
        return {};
    }
    is_stopping_ = true;
    changed_.notify_one();
    thread_.join();
    if (has_ended_) {
        return take_trouble().value_or("");
    }
    has_ended_ = true;
    const auto finished = writer_->finish();
    return finished
               ? fmt::format("recorded: {} ({:.1f} s)", file_.string(), to_seconds(time_of(next_)))
               : finished.error().message;
}

}  // namespace raks::apps
