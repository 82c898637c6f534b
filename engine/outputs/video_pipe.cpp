#include "engine/outputs/video_pipe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <system_error>
#include <utility>
#include <vector>

#include "base/descriptor.hpp"

#include <fmt/format.h>

namespace raks::engine {

// Integers of 8 bits behind the point; the sums are the matrix of BT.601 from full to limited
// range.
void to_yuv444(std::span<const std::uint8_t> rgba, std::span<std::uint8_t> planes) noexcept {
    const std::size_t pixels = rgba.size() / 4;
    std::uint8_t* const luma = planes.data();
    std::uint8_t* const blue = luma + pixels;
    std::uint8_t* const red = blue + pixels;
    for (std::size_t i = 0; i < pixels; ++i) {
        const int r = rgba[4 * i];
        const int g = rgba[4 * i + 1];
        const int b = rgba[4 * i + 2];
        luma[i] = static_cast<std::uint8_t>((66 * r + 129 * g + 25 * b + 128 + (16 << 8)) >> 8);
        blue[i] = static_cast<std::uint8_t>((-38 * r - 74 * g + 112 * b + 128 + (128 << 8)) >> 8);
        red[i] = static_cast<std::uint8_t>((112 * r - 94 * g - 18 * b + 128 + (128 << 8)) >> 8);
    }
}

namespace {

// The largest pipe that an ordinary user may have.
constexpr int kPipeBytes = 1 << 20;

std::string y4m_head(const VideoFormat& format) {
    return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444\n",
                       format.width,
                       format.height,
                       format.rate_numerator,
                       format.rate_denominator);
}

bool is_pipe(const struct stat& state) { return S_ISFIFO(state.st_mode); }

class VideoPipe final : public VideoSink {
 public:
    VideoPipe(std::string target, PixelForm form, const VideoFormat& format)
        : target_(std::move(target)), form_(form), format_(format) {}

    // Standard output may be shared with other processes: a pipe is opened anew, so that ours alone
    // does not block. Errors: it is closed.
    [[nodiscard]] Expected<void> open_stdout() {
        struct stat state {};
        if (fstat(STDOUT_FILENO, &state) != 0) {
            return fail("standard output is closed");
        }
        if (is_pipe(state)) {
            file_.number = open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK | O_CLOEXEC);
            fcntl(file_.number, F_SETPIPE_SZ, kPipeBytes);
        }
        if (file_.number < 0) {
            file_.number = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
            most_at_once_ = PIPE_BUF;
        }
        begin();
        return file_.number >= 0 ? Expected<void>() : fail("standard output is closed");
    }

    void send(std::span<const std::uint8_t> rgba) override {
        if (has_ended_ || !has_reader()) {
            return;
        }
        // The rest of a picture that was begun comes first.
        flush();
        if (!waiting_.empty() || has_ended_) {
            count_dropped();
            return;
        }
        fill(rgba);
        flush();
        count_sent();
    }

    std::optional<std::string> take_trouble() override {
        return std::exchange(trouble_, std::nullopt);
    }

    ~VideoPipe() override { finish_picture(); }

 private:
    [[nodiscard]] bool is_stdout() const noexcept { return target_ == "-"; }

    void begin() {
        at_ = 0;
        waiting_.clear();
        if (form_ == PixelForm::y4m) {
            const std::string head = y4m_head(format_);
            waiting_.assign(head.begin(), head.end());
        }
    }

    // A pipe with a name can be opened as soon as somebody reads it.
    [[nodiscard]] bool has_reader() {
        if (file_.number < 0 && !is_stdout()) {
            file_.number = open(target_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
            fcntl(file_.number, F_SETPIPE_SZ, kPipeBytes);
            begin();
        }
        return file_.number >= 0;
    }

    void fill(std::span<const std::uint8_t> rgba) {
        at_ = 0;
        if (form_ == PixelForm::rgba) {
            waiting_.assign(rgba.begin(), rgba.end());
            return;
        }
        constexpr std::string_view kFrame = "FRAME\n";
        waiting_.resize(kFrame.size() + rgba.size() / 4 * 3);
        std::copy(kFrame.begin(), kFrame.end(), waiting_.begin());
        to_yuv444(rgba, std::span(waiting_).subspan(kFrame.size()));
    }

    [[nodiscard]] bool takes_more(int milliseconds) const {
        pollfd state{file_.number, POLLOUT, 0};
        return poll(&state, 1, milliseconds) > 0;
    }

    // As much of what waits as the reader takes now.
    void flush(int patience_ms = 0) {
        while (at_ < waiting_.size() && takes_more(patience_ms)) {
            const std::size_t bytes = std::min(most_at_once_, waiting_.size() - at_);
            const ssize_t written = write(file_.number, waiting_.data() + at_, bytes);
            if (written > 0) {
                at_ += static_cast<std::size_t>(written);
            } else if (errno != EINTR && errno != EAGAIN) {
                leave(errno);
                return;
            }
        }
        if (at_ == waiting_.size()) {
            waiting_.clear();
        }
    }

    void leave(int error) {
        file_.close();
        waiting_.clear();
        const std::string what =
            error == EPIPE ? "its reader has left" : std::generic_category().message(error);
        has_ended_ = is_stdout();
        trouble_ = fmt::format("--video-out {}: {}; {}",
                               target_,
                               what,
                               has_ended_ ? "no more pictures go there" : "waiting for another");
    }

    // A reader that still reads gets a whole last picture.
    void finish_picture() {
        constexpr int kPatience = 200;  // milliseconds between two steps of the reader
        if (file_.number >= 0 && at_ > 0) {
            flush(kPatience);
        }
    }

    std::string target_;
    PixelForm form_;
    VideoFormat format_;
    Descriptor file_;
    std::size_t most_at_once_ = SSIZE_MAX;
    std::vector<std::uint8_t> waiting_;
    std::size_t at_ = 0;  // of what waits, already written
    bool has_ended_ = false;
    std::optional<std::string> trouble_;
};

}  // namespace

Expected<std::unique_ptr<VideoSink>> open_video_pipe(const std::string& target,
                                                     PixelForm form,
                                                     const VideoFormat& format) {
    auto pipe = std::make_unique<VideoPipe>(target, form, format);
    if (target == "-") {
        if (auto opened = pipe->open_stdout(); !opened) {
            return fail(std::move(opened.error()).in("--video-out -"));
        }
        return pipe;
    }
    struct stat state {};
    if (stat(target.c_str(), &state) != 0) {
        return fail(
            fmt::format("--video-out {}: {}; make a pipe with \"mkfifo {}\", or write -, "
                        "pipewire or pipewire:NAME",
                        target,
                        std::generic_category().message(errno),
                        target));
    }
    if (!is_pipe(state)) {
        return fail(fmt::format(
            "--video-out {}: is no pipe; make one with mkfifo, or use raks render for a file",
            target));
    }
    return pipe;
}

}  // namespace raks::engine
