#include "audio/io/pipe_reader.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "audio/io/decoder_client.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

std::string name_of(const fs::path& path) {
    return path == "-" ? std::string("standard input") : path.string();
}

// Opens without waiting for a writer.
Expected<int> open_pipe(const fs::path& path) {
    if (path == "-" && ::isatty(STDIN_FILENO) == 1) {
        return fail(
            "standard input is a terminal; send sound into it, as in: "
            "cat song.mp3 | raks play -");
    }
    const int descriptor = path == "-" ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                                       : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) {
        return fail(name_of(path) +
                    ": cannot be opened: " + std::generic_category().message(errno));
    }
    return descriptor;
}

}  // namespace

PipeReader::PipeReader(std::string name,
                       std::unique_ptr<AudioFileReader> decoder,
                       std::shared_ptr<std::atomic<bool>> stop)
    : name_(std::move(name)), decoder_(std::move(decoder)), stop_(std::move(stop)) {
    info_ = decoder_->info();
}

Expected<std::unique_ptr<PipeReader>> PipeReader::open(const fs::path& path,
                                                       const PipeOptions& options) {
    const auto descriptor = open_pipe(path);
    if (!descriptor) {
        return fail(descriptor.error());
    }
    auto stop = std::make_shared<std::atomic<bool>>(false);
    auto client = DecoderClient::open(
        {.name = name_of(path),
         .descriptor = *descriptor,
         .is_pipe = true,
         .longest_wait = options.longest_wait,
         .is_stop_requested = [stop, ask = options.is_stop_requested] {
             return stop->load(std::memory_order_relaxed) || ask();  // relaxed: orders nothing
         }});
    ::close(*descriptor);
    if (!client) {
        return fail(client.error());
    }
    return std::unique_ptr<PipeReader>(
        new PipeReader(name_of(path), std::move(*client), std::move(stop)));
}

std::size_t PipeReader::read(std::span<float> interleaved) {
    const std::size_t frames = decoder_->read(interleaved);
    warning_ = decoder_->warning();
    position_ += static_cast<std::int64_t>(frames);
    return frames;
}

Expected<void> PipeReader::seek(std::int64_t frame) {
    return frame == position_
               ? Expected<void>()
               : fail(name_ + ": comes through a pipe, in which there is no going back or ahead");
}

std::shared_ptr<std::atomic<bool>> PipeReader::stop_flag() const noexcept { return stop_; }

}  // namespace raks::audio
