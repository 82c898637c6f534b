#include "base/pending_file.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "base/assert.hpp"
#include "base/descriptor.hpp"

namespace raks {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLetters = 6;
// Names of files may have 255 bytes; of longer ones the part's name keeps this much.
constexpr std::size_t kLongestStem = 200;
// Each try finds a name that nobody has, but for one in 57 thousand millions.
constexpr int kTries = 100;

// The system's words for an errno.
std::string system_reason(int error_number) {
    return std::generic_category().message(error_number);
}

Error cannot_write(const fs::path& path, int error_number) {
    return Error{path.string() + ": cannot be written: " + system_reason(error_number)};
}

// "x.bvh" -> "x.bvh.k3Zq0a.part", in the same folder.
fs::path part_of(const fs::path& path) {
    constexpr std::string_view kAll =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    std::random_device chance;
    std::string name = path.filename().string().substr(0, kLongestStem) + ".";
    for (std::size_t i = 0; i < kLetters; ++i) {
        name += kAll[chance() % kAll.size()];
    }
    return path.parent_path() / (name + ".part");
}

// Makes a new file or folder by `make`, which returns false and sets errno, under a part's name.
template <typename Make>
Expected<fs::path> make_part(const fs::path& path, Make make) {
    for (int i = 0; i < kTries; ++i) {
        fs::path part = part_of(path);
        if (make(part.c_str())) {
            return part;
        }
        if (errno != EEXIST) {
            break;
        }
    }
    return fail(cannot_write(path, errno));
}

// What a part bears that was left behind, and no file of a person.
constexpr const char* kMark = "user.raks.part";

// As long as a marked part is locked, its process is about to rename it.
bool mark(int file) {
    return ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fsetxattr(file, kMark, "", 0, 0) == 0;
}

// "x.bvh" -> "x.bvh.raks.part": the first name for a file that replaces another.
fs::path marked_part_of(const fs::path& path) {
    return path.parent_path() / (path.filename().string().substr(0, kLongestStem) + ".raks.part");
}

// Fails where something exists that must not be replaced by a file: anything but a plain file.
Expected<void> check_replaceable(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) {
        return fail(path.string() + ": is a folder; name a file to write");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        return fail(path.string() + ": is not a plain file; name a file to write");
    }
    return {};
}

// The file that is to be replaced: at the end of a link, which stays; also of one that leads to
// nothing yet.
fs::path end_of_links(fs::path path) {
    constexpr int kMostLinks = 40;  // as the system follows
    std::error_code error;
    for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
        const fs::path target = fs::read_symlink(path, error);
        if (error) {
            break;
        }
        path = target.is_absolute() ? target : path.parent_path() / target;
    }
    return path;
}

// Of the file that has this name, where there is one.
void take_rights_of(const fs::path& old, int file) {
    struct stat status {};
    if (file >= 0 && ::stat(old.c_str(), &status) == 0) {
        static_cast<void>(::fchmod(file, status.st_mode & 0777U));
    }
}

// Waits until the disk has a file, or which names a folder holds. Systems without it say EINVAL.
bool is_on_disk(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL; }

bool sync(const fs::path& path, int flags) {
    const Descriptor file(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW));
    return file.number >= 0 && is_on_disk(file.number);
}

bool sync_folder_of(const fs::path& path) {
    const fs::path folder = path.parent_path();
    return sync(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
}

// All files of a new folder, and itself; a plain file itself.
bool sync_all(const fs::path& part) {
    std::error_code error;
    if (!fs::is_directory(part, error)) {
        return sync(part, O_RDONLY);
    }
    for (const auto& entry : fs::recursive_directory_iterator(part, error)) {
        const bool is_folder = entry.is_directory(error);
        if (!sync(entry.path(), O_RDONLY | (is_folder ? O_DIRECTORY : 0))) {
            return false;
        }
    }
    return !error && sync(part, O_RDONLY | O_DIRECTORY);
}

std::atomic<PendingFiles*> g_shared{nullptr};

}  // namespace

// The parts that are not committed, for a process that is told to end.
struct PendingFiles {
    std::mutex mutex;
    struct Kept {
        fs::path part;
        fs::path path;  // that it would have got
    };
    std::vector<fs::path> to_remove;
    std::vector<Kept> to_keep;

    void forget(const fs::path& part) {
        std::erase(to_remove, part);
        std::erase_if(to_keep, [&](const Kept& kept) { return kept.part == part; });
    }
};

PendingFiles& pending_files() {
    static PendingFiles own;
    PendingFiles* const shared =
        g_shared.load(std::memory_order_acquire);  // pairs with the release below
    return shared != nullptr ? *shared : own;
}

void share_pending_files(PendingFiles& of_program) {
    g_shared.store(&of_program, std::memory_order_release);
}

EndOfWriting remove_pending_files() {
    PendingFiles& files = pending_files();
    std::unique_lock lock(files.mutex);
    for (const fs::path& part : files.to_remove) {
        std::error_code ignored;
        fs::remove_all(part, ignored);
    }
    files.to_remove.clear();
    EndOfWriting end{std::move(lock), {}};
    for (const PendingFiles::Kept& kept : files.to_keep) {
        std::error_code error;
        const fs::path stopped = stopped_name(kept.path);
        fs::rename(kept.part, stopped, error);
        if (!error) {
            end.kept.push_back(stopped);
        }  // else it lay in a folder that is removed, as a rule
    }
    files.to_keep.clear();
    return end;
}

fs::path stopped_name(const fs::path& path) {
    const fs::path folder = path.parent_path();
    const std::string stem = path.stem().string().substr(0, kLongestStem) + ".stopped";
    fs::path free = folder / (stem + path.extension().string());
    std::error_code ignored;
    for (int i = 2; fs::exists(fs::symlink_status(free, ignored)); ++i) {
        free = folder / (stem + "-" + std::to_string(i) + path.extension().string());
    }
    return free;
}

PendingFile::PendingFile(fs::path path, fs::path part, int file, bool is_named)
    : path_(std::move(path)), part_(std::move(part)), file_(file), is_named_(is_named) {}

// An empty part_ marks a file that has nothing to remove.
PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::move(other.path_)),
      part_(std::exchange(other.part_, {})),
      file_(std::exchange(other.file_, -1)),
      is_named_(other.is_named_),
      is_copy_(other.is_copy_) {}

PendingFile& PendingFile::operator=(PendingFile&& other) noexcept {
    if (this != &other) {
        remove_part();
        path_ = std::move(other.path_);
        part_ = std::exchange(other.part_, {});
        file_ = std::exchange(other.file_, -1);
        is_named_ = other.is_named_;
        is_copy_ = other.is_copy_;
    }
    return *this;
}

PendingFile::~PendingFile() { remove_part(); }

bool PendingFile::close() noexcept { return file_ < 0 || ::close(std::exchange(file_, -1)) == 0; }

void PendingFile::remove_part() noexcept {
    if (is_named_ && !part_.empty()) {
        const std::lock_guard lock(pending_files().mutex);
        std::error_code ignored;
        fs::remove_all(part_, ignored);
        pending_files().forget(part_);
    }
    part_.clear();
    static_cast<void>(close());  // last: the lock says that the part is ours
}

// The file is made at once: an error shows before the long work. It has the rights of the file that
// it will replace.
Expected<PendingFile> PendingFile::create(const fs::path& path, AtEnd at_end) {
    if (path.empty()) {
        return fail("a file name is empty; name a file to write");
    }
    const fs::path target = end_of_links(path);
    if (auto checked = check_replaceable(target); !checked) {
        return fail(std::move(checked.error()));
    }
    if (at_end == AtEnd::removed) {
        const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
        const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
        const std::string part = "/proc/self/fd/" + std::to_string(file);
        // It can be named by way of /proc alone.
        if (file >= 0 && ::access(part.c_str(), F_OK) == 0) {
            take_rights_of(target, file);
            return PendingFile(target, part, file, false);
        }
        ::close(file);  // none: nothing happens
    }
    const std::lock_guard lock(pending_files().mutex);
    int file = -1;
    auto part = make_part(target, [&](const char* name) {
        file = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        return file >= 0;
    });
    if (!part) {
        return fail(std::move(part.error()));
    }
    pending_files().to_remove.push_back(*part);
    take_rights_of(target, file);
    return PendingFile(target, std::move(*part), file);
}

Expected<PendingFile> PendingFile::create_changed_folder(const fs::path& path) {
    if (auto made = make_folders(path); !made) {
        return fail(std::move(made.error()));
    }
    // At the end of links, and without dots: what is exchanged must have a name.
    std::error_code error;
    const fs::path folder = fs::canonical(path, error);
    if (error) {
        return fail(cannot_write(path, error.value()));
    }
    auto copy = make_marked_folder_part(folder);
    if (!copy) {
        return copy;
    }
    copy->is_copy_ = true;
    fs::permissions(copy->part_, fs::status(folder, error).permissions(), error);
    fs::copy(folder,
             copy->part_,
             fs::copy_options::recursive | fs::copy_options::create_hard_links |
                 fs::copy_options::copy_symlinks,
             error);
    return error ? fail(cannot_write(path, error.value())) : std::move(copy);
}

Expected<PendingFile> PendingFile::create_folder(const fs::path& path) {
    if (path.empty()) {
        return fail("a folder name is empty; name a folder to write");
    }
    // "folder/" has no file name: ".part" must not be appended behind the slash.
    const fs::path folder = path.has_filename() ? path : path.parent_path();
    std::error_code error;
    if (fs::exists(folder, error) &&
        !(fs::is_directory(folder, error) && fs::is_empty(folder, error))) {
        return fail(folder.string() + ": exists already and is not an empty folder; name another");
    }
    return make_folder_part(folder);
}

// An empty one beside the folder.
Expected<PendingFile> PendingFile::make_folder_part(const fs::path& folder) {
    const std::lock_guard lock(pending_files().mutex);
    auto part = make_part(folder, [](const char* name) { return ::mkdir(name, 0777) == 0; });
    if (!part) {
        return fail(std::move(part.error()));
    }
    pending_files().to_remove.push_back(*part);
    return PendingFile(folder, std::move(*part));
}

// The same under the name that the next process looks at, as of a file that replaces another.
Expected<PendingFile> PendingFile::make_marked_folder_part(const fs::path& folder) {
    const fs::path part = marked_part_of(folder);
    remove_abandoned_part(part);
    {
        const std::lock_guard lock(pending_files().mutex);
        if (::mkdir(part.c_str(), 0777) == 0) {
            const int held = ::open(part.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
            if (held >= 0 && mark(held)) {
                pending_files().to_remove.push_back(part);
                return PendingFile(folder, part, held);
            }
            ::close(held);
            ::rmdir(part.c_str());
        }
    }
    return make_folder_part(folder);
}

// All of it, whatever pieces the system takes.
Expected<void> PendingFile::write(std::string_view bytes) {
    RAKS_ASSERT(file_ >= 0);
    while (!bytes.empty()) {
        const ssize_t wrote = ::write(file_, bytes.data(), bytes.size());
        if (wrote < 0 && errno != EINTR) {
            return fail(cannot_write(path_, errno));
        }
        bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(wrote, 0)));
    }
    return {};
}

// Whoever has the lock and still finds the file under the name knows that it was left: only a
// living process would rename it, and that has the lock.
void remove_abandoned_part(const fs::path& part) {
    const Descriptor file(::open(part.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW));
    struct stat held {};
    struct stat named {};
    if (file.number >= 0 && ::fgetxattr(file.number, kMark, nullptr, 0) >= 0 &&
        ::flock(file.number, LOCK_EX | LOCK_NB) == 0 && ::fstat(file.number, &held) == 0 &&
        ::lstat(part.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
        held.st_ino == named.st_ino) {
        std::error_code ignored;
        fs::remove_all(part, ignored);
    }
}

// Under its own name at once where nothing has it yet, else under a part's, to be renamed.
bool PendingFile::give_name() {
    const std::string file = part_.string();
    const auto link_to = [&](const char* name) {
        return ::linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    };
    if (link_to(path_.c_str())) {
        part_.clear();
        return true;
    }
    if (errno != EEXIST) {
        return false;
    }
    if (mark(file_)) {
        const fs::path part = marked_part_of(path_);
        remove_abandoned_part(part);
        if (link_to(part.c_str())) {
            part_ = part;
            is_named_ = true;
            return true;
        }
    }
    auto part = make_part(path_, link_to);
    if (part) {
        part_ = std::move(*part);
        is_named_ = true;
    }
    return part.has_value();
}

// The old folder is marked: where we are killed before it is removed, the next process does that.
bool PendingFile::exchange() {
    const Descriptor old(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    const bool is_marked = mark(old.number);
    if (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) != 0) {
        const int reason = errno;
        if (is_marked) {
            ::fremovexattr(old.number, kMark);
        }
        errno = reason;
        return false;
    }
    std::error_code ignored;
    fs::remove_all(part_, ignored);
    return true;
}

// Within one folder, so the rename is atomic. Once it is done the new file is there, whatever the
// folder's disk says then.
Expected<void> PendingFile::commit() {
    // What has the part's name may by now be another file than the one that was made.
    if (!(is_named_ ? sync_all(part_) : is_on_disk(file_))) {
        return fail(cannot_write(path_, errno));
    }
    const std::lock_guard lock(pending_files().mutex);
    // Some disks say only when it is closed that they are full. A file without a name must be open
    // until it has one.
    if (is_named_ ? !is_copy_ && !close() : !give_name()) {
        return fail(cannot_write(path_, errno));
    }
    // On an error the destructor removes the part.
    if (!part_.empty() && !(is_copy_ ? exchange() : ::rename(part_.c_str(), path_.c_str()) == 0)) {
        return fail(cannot_write(path_, errno));
    }
    pending_files().forget(part_);
    part_.clear();
    if (file_ >= 0) {
        ::fremovexattr(file_, kMark);  // where it has none nothing happens
    }
    static_cast<void>(close());
    static_cast<void>(sync_folder_of(path_));
    return {};
}

Expected<fs::path> PendingFile::commit_stopped() {
    path_ = stopped_name(path_);
    auto committed = commit();
    return committed ? Expected<fs::path>(path_) : fail(std::move(committed.error()));
}

void PendingFile::keep_from_here() {
    const std::lock_guard lock(pending_files().mutex);
    if (std::erase(pending_files().to_remove, part_) > 0) {
        pending_files().to_keep.push_back({part_, path_});
    }
}

Expected<void> check_is_no_input(const fs::path& output, const std::vector<fs::path>& inputs) {
    const bool is_input = std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
        // Same file by device and inode, so links and other spellings count.
        std::error_code ignored;
        return fs::equivalent(output, input, ignored);
    });
    if (is_input) {
        return fail(output.string() + ": is what is to be read; write to another name");
    }
    return {};
}

Expected<void> check_output(const fs::path& output, const std::vector<fs::path>& inputs) {
    if (auto checked = check_is_no_input(output, inputs); !checked) {
        return checked;
    }
    // Tries to create the part; the destructor removes it again.
    const auto probe = PendingFile::create(output);
    return probe ? Expected<void>() : fail(probe.error());
}

Expected<void> make_folders(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    return error ? Expected<void>(fail(cannot_write(folder, error.value()))) : Expected<void>();
}

Expected<void> write_file(const fs::path& path, std::string_view bytes) {
    auto pending = PendingFile::create(path);
    if (!pending) {
        return fail(pending.error());
    }
    auto wrote = pending->write(bytes);
    return wrote ? pending->commit() : wrote;
}

}  // namespace raks
