#include "apps/xbody/made_dance.hpp"

#include <stdlib.h>
#include <sys/wait.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "base/child_process.hpp"
#include "base/printable.hpp"

namespace raks::apps {
namespace {

namespace fs = std::filesystem;

fs::path file_in(const fs::path& folder) { return folder / "dance.bvh"; }

}  // namespace

Expected<MadeDance> MadeDance::begin(const fs::path& program, const fs::path& music) {
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    std::string folder = (temporary / "raks-dance-XXXXXX").string();
    if (error || mkdtemp(folder.data()) == nullptr) {
        return fail("no folder for a dance: " +
                    std::error_code(errno, std::system_category()).message());
    }
    MadeDance made;
    made.music_ = music;
    made.folder_ = folder;
    auto child = spawn_child(
        {.program = program,
         .arguments = {"dance", "-q", "-o", file_in(made.folder_).string(), "--", music.string()},
         .descriptors = {},
         .has_our_environment = true});
    if (!child) {
        return fail(std::move(child.error()));
    }
    made.child_ = *child;
    return made;
}

MadeDance::MadeDance(MadeDance&& other) noexcept
    : music_(std::move(other.music_)),
      folder_(std::exchange(other.folder_, fs::path())),
      child_(std::exchange(other.child_, -1)) {}

MadeDance& MadeDance::operator=(MadeDance&& other) noexcept {
    std::swap(music_, other.music_);
    std::swap(folder_, other.folder_);
    std::swap(child_, other.child_);
    return *this;
}

MadeDance::~MadeDance() {
    if (child_ >= 0) {
        static_cast<void>(end_child_group(child_));
    }
    if (!folder_.empty()) {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
}

Expected<std::optional<fs::path>> MadeDance::take() {
    int status = 0;
    const pid_t ended = child_ < 0 ? 0 : waitpid(child_, &status, WNOHANG);
    if (ended == 0) {
        return std::nullopt;
    }
    child_ = -1;
    std::error_code ignored;
    const bool is_made = ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0 &&
                         fs::exists(file_in(folder_), ignored);
    if (!is_made) {
        return fail(printable(music_.filename().string()) +
                    ": no dance could be made to it; raks dance tells why");
    }
    return file_in(folder_);
}

}  // namespace raks::apps
