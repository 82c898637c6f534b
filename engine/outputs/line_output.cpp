#include "engine/outputs/line_output.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/descriptor.hpp"
#include "base/json.hpp"

namespace raks::engine {
namespace {

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

// One line, with its end.
std::string line_of(const OutputMoment& moment) {
    const Notice& notice = moment.notice;
    const double in_ms = to_seconds(moment.heard_at - HostClock::now()) * 1e3;
    Json line = Json::object();
    if (notice.kind == Notice::Kind::beat) {
        line["do"] = "beat";
        line["count"] = notice.count;
        line["bar"] = notice.bar;
        line["bpm"] = rounded(notice.paced_tempo.bpm(), 100.0);
        line["confidence"] = rounded(notice.confidence, 100.0);
        line["change"] = notice.is_change;
    } else {
        line["do"] = music_event_name(notice.event);
    }
    line["in_ms"] = static_cast<std::int64_t>(std::lround(in_ms));
    return line.text() + "\n";
}

// Writes lines to a descriptor that does not block.
class LineOutput final : public Output {
 public:
    /// Takes the descriptor over.
    LineOutput(int file, std::string name, const OutputTiming& timing)
        : Output(timing), file_(file), name_(std::move(name)) {}

    void tell(const OutputMoment& moment) override {
        if (moment.notice.kind == Notice::Kind::accent || !moment.notice.is_paced) {
            return;
        }
        say(line_of(moment));
    }

    void name_song(const SongName& song) override {
        say(Json({{"do", "now"}, {"title", song.title}, {"artist", song.artist}}).text() + "\n");
    }

    std::optional<std::string> take_trouble() override {
        return std::exchange(trouble_, std::nullopt);
    }

 private:
    // The rest of a line that was begun comes first: lines are whole, or missing.
    void say(std::string line) {
        flush();
        if (!waiting_.empty() || has_ended_) {
            count_dropped();
            return;
        }
        waiting_ = std::move(line);
        flush();
        has_ended_ ? count_dropped() : count_sent();
    }

    // As another process may share what is open, it stays a blocking one: asked before each write.
    [[nodiscard]] bool takes_more() const {
        pollfd state{file_.number, POLLOUT, 0};
        return poll(&state, 1, 0) > 0;
    }

    // What is offered at once is at most PIPE_BUF, for which a pipe that takes more has room.
    void flush() {
        while (!waiting_.empty() && !has_ended_ && takes_more()) {
            const ssize_t written = write(file_.number, waiting_.data(), waiting_.size());
            if (written > 0) {
                waiting_.erase(0, static_cast<std::size_t>(written));
            } else if (errno != EINTR && errno != EAGAIN) {
                has_ended_ = true;
                trouble_ = name_ + ": " + std::generic_category().message(errno) +
                           "; no more lines go there";
            } else {
                return;
            }
        }
    }

    Descriptor file_;
    std::string name_;
    std::string waiting_;
    bool has_ended_ = false;
    std::optional<std::string> trouble_;
};

// Errors: the system's.
Expected<int> open_target(const std::string& target) {
    if (target == "-") {
        const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
        return copy >= 0 ? Expected<int>(copy) : fail("standard output is closed");
    }
    struct stat state {};
    const bool is_there = stat(target.c_str(), &state) == 0;
    if (is_there && S_ISREG(state.st_mode)) {
        return fail("the file is there already; give a new name, or a pipe");
    }
    // Both ways, so that opening a pipe waits for no reader.
    const int flags = is_there ? O_RDWR : O_WRONLY | O_CREAT | O_EXCL;
    const int file = open(target.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0666);
    return file >= 0 ? Expected<int>(file) : fail(std::generic_category().message(errno));
}

}  // namespace

Expected<std::unique_ptr<Output>> open_lines(const std::string& target) {
    TargetReader reader = TargetReader::of_file(target);
    const OutputTiming timing = reader.timing();
    if (auto read = reader.finish(); !read) {
        return fail("--lines " + target + ": " + read.error().message);
    }
    const auto file = open_target(reader.place());
    if (!file) {
        return fail("--lines " + reader.place() + ": " + file.error().message);
    }
    return std::make_unique<LineOutput>(*file, reader.place(), timing);
}

Expected<void> check_lines(const std::string& target) {
    TargetReader reader = TargetReader::of_file(target);
    static_cast<void>(reader.timing());
    return reader.finish();
}

}  // namespace raks::engine
