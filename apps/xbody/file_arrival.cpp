#include "apps/xbody/file_arrival.hpp"

#include <chrono>
#include <utility>

namespace raks::apps {
namespace {

constexpr std::chrono::seconds kNoTime(0);

}  // namespace

void FileArrival::ask(std::vector<DroppedFile> files, MotionWearer wearer) {
    files_ = std::move(files);
    asked_ = std::move(wearer);
}

void FileArrival::ask_again(MotionWearer wearer) {
    if (is_awaited()) {
        asked_ = std::move(wearer);
    }
}

bool FileArrival::is_due() const {
    return loading_.valid() ? loading_.wait_for(kNoTime) == std::future_status::ready
                            : asked_.has_value();
}

std::optional<DroppedFiles> FileArrival::take() {
    if (!is_due()) {
        return std::nullopt;
    }
    std::optional<DroppedFiles> arrived;
    if (loading_.valid()) {
        arrived = loading_.get();
    }
    if (!asked_) {
        return arrived;
    }
    loading_ =
        std::async(std::launch::async,
                   [files = files_, wearer = *std::exchange(asked_, {}), prepare = prepare_] {
                       DroppedFiles read = read_dropped(files, wearer);
                       prepare(read);
                       return read;
                   });
    return std::nullopt;
}

}  // namespace raks::apps
