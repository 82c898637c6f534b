#include "tests/end_to_end/window.hpp"

#include <algorithm>
#include <cstdlib>

#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/pending_file.hpp"
#include "tests/support/run_program.hpp"

namespace raks::test {
namespace {

constexpr int kMostLooks = 300;  // 0.1 s each, about
constexpr int kSameInARow = 4;

}  // namespace

void WindowTest::SetUp() {
    ProgramTest::SetUp();
    display_.emplace(960, 540);
    // Composed once; each test gets it under both names.
    static const TemporaryFolder shared;
    if (shared.is_empty()) {
        audio::MusicPlan plan;
        plan.seconds = 60.0;
        write_music("one.wav", plan);
        std::filesystem::rename(folder_ / "one.wav", shared / "song.wav");
    }
    for (const char* name : {"one.wav", "two.wav"}) {
        std::filesystem::create_hard_link(shared / "song.wav", folder_ / name);
    }
    // The user's folder of pictures, as a desktop says it.
    std::filesystem::create_directories(folder_ / "pictures");
    std::filesystem::create_directories(folder_ / "config");
    ASSERT_TRUE(write_file(path("config/user-dirs.dirs"),
                           "XDG_PICTURES_DIR=\"" + path("pictures") + "\"\nXDG_VIDEOS_DIR=\"" +
                               path("pictures") + "\"\n"));
}

std::vector<std::string> WindowTest::screenshots() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "pictures")) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

void WindowTest::click(int x, int y, int by_x) {
    const auto place = [&](int at) {
        return std::vector<std::string>{
            "mousemove", "--window", "%1", std::to_string(at), std::to_string(y)};
    };
    std::vector<std::string> command = {"xdotool", "search", "--sync", "--name", "Raks"};
    const auto add = [&](const std::vector<std::string>& words) {
        command.insert(command.end(), words.begin(), words.end());
    };
    add(place(x));
    add({"mousedown", "1"});
    if (by_x != 0) {
        add(place(x + by_x / 2));
        add(place(x + by_x));
    }
    add({"mouseup", "1"});
    run_program(command);
}

ProcessPlan WindowTest::in_window(std::vector<std::string> arguments) const {
    // Of a quality that is asked for nothing is said, over the picture.
    arguments.insert(arguments.end(),
                     {"--size",
                      std::to_string(kWindowWidth) + "x" + std::to_string(kWindowHeight),
                      "--quality",
                      "fast"});
    ProcessPlan result = plan(std::move(arguments));
    std::erase(result.unset, "DISPLAY");
    result.folder = folder_.path();
    return result;
}

void WindowTest::press(const std::vector<std::string>& keys) {
    std::vector<std::string> command = {
        "xdotool", "search", "--sync", "--name", "Raks", "windowfocus", "--sync"};
    for (const std::string& key : keys) {
        command.insert(command.end(), {"key", key});
    }
    run_program(command);
}

std::string WindowTest::picture() {
    // `import` fails now and then while the window is being mapped or changes its size.
    constexpr int kMostTries = 5;
    for (int tries = 1;; ++tries) {
        std::string id = run_program({"xdotool", "search", "--sync", "--name", "Raks"});
        id.erase(id.find('\n'));
        try {
            return run_program({"import", "-window", id, "-depth", "8", "rgb:-"});
        } catch (const std::exception&) {
            if (tries == kMostTries) {
                throw;
            }
        }
    }
}

bool WindowTest::shows(const std::function<bool(const std::string&)>& is_right) {
    for (int look = 0; look < kMostLooks; ++look) {
        if (is_right(picture())) {
            return true;
        }
    }
    return false;
}

std::string WindowTest::still_picture() {
    std::string last;
    int same = 0;
    const bool is_still = shows([&](const std::string& now) {
        const bool is_drawn = difference(now, std::string(now.size(), '\0')) > 1.0;
        same = is_drawn && lower(now) == lower(last) ? same + 1 : 0;
        last = now;
        return same >= kSameInARow;
    });
    EXPECT_TRUE(is_still) << "the picture never stands still";
    return last;
}

std::string WindowTest::pause(CapturedProcess& raks) {
    press({"space"});
    EXPECT_TRUE(raks.wait_for_output("raks: paused"));
    return still_picture();
}

std::string lower(const std::string& picture) { return picture.substr(picture.size() / 9 * 7); }

int count_of(const std::string& text, const std::string& said) {
    int count = 0;
    for (auto at = said.find(text); at != std::string::npos; at = said.find(text, at + 1)) {
        ++count;
    }
    return count;
}

double difference(const std::string& a, const std::string& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        sum += std::abs(static_cast<unsigned char>(a[i]) - static_cast<unsigned char>(b[i]));
    }
    return sum / static_cast<double>(a.size());
}

}  // namespace raks::test
