#include "engine/show/screenshot.hpp"

#include <cstdint>
#include <ctime>
#include <system_error>
#include <vector>

#include "render/video/png.hpp"

#include <fmt/format.h>

namespace raks::engine {

std::string screenshot_name() {
    const std::time_t now = std::time(nullptr);
    // localtime_r: localtime() would share its result with other threads.
    std::tm local{};
    localtime_r(&now, &local);
    const std::string stem = fmt::format("raks-{:04}{:02}{:02}-{:02}{:02}{:02}",
                                         local.tm_year + 1900,
                                         local.tm_mon + 1,
                                         local.tm_mday,
                                         local.tm_hour,
                                         local.tm_min,
                                         local.tm_sec);
    std::string name = stem + ".png";
    std::error_code error;
    // Several pictures within one second get -2, -3 and so on.
    for (int i = 2; std::filesystem::exists(name, error); ++i) {
        name = fmt::format("{}-{}.png", stem, i);
    }
    return name;
}

Expected<void> write_screenshot(const std::filesystem::path& path,
                                const render::FrameTarget& frame) {
    // Four bytes a pixel, rows from the top as PNG has them.
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(frame.width) *
                                   static_cast<std::size_t>(frame.height) * 4);
    if (auto read = render::read_rgba(frame, rgba); !read) {
        return read;
    }
    return render::write_png(path, frame.width, frame.height, rgba);
}

}  // namespace raks::engine
