#pragma once

#include <filesystem>
#include <mutex>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Writing files and folders whole or not at all.
namespace raks {

/// A file that appears under its name only when it is complete. Until commit() it has no name at
/// all where the file system allows that (O_TMPFILE), so that nothing is left of it however the
/// process ends; else it is `NAME.XXXXXX.part` (six letters of our own choice) in the same folder,
/// which the destructor removes. A process that is killed just while commit() replaces a file
/// leaves the new one, whole, as `NAME.raks.part`, which the next that replaces NAME removes: it
/// bears our mark (an extended attribute; where the file system has none the name is as above, and
/// it stays) and no process holds it. Nothing else is ever touched: two that write the same name do
/// not meet, and where the name is a link the file that it leads to is replaced. Threads: one.
/// Real-time: no.
class PendingFile {
 public:
    /// What becomes of the part where the process is told to end before it is committed.
    enum class AtEnd { removed, kept };

    /// `at_end`: kept where a part may be of use by itself, such as a film that plays up to there:
    /// from keep_from_here() on. Errors: no name, the folder does not exist, the part cannot be
    /// made there; what has the name is not a plain file (a device is never replaced by a file).
    [[nodiscard]] static Expected<PendingFile> create(const std::filesystem::path& path,
                                                      AtEnd at_end = AtEnd::removed);
    /// The same for a folder: part() is an empty one. Errors: the folder exists and is not empty,
    /// or cannot be made.
    [[nodiscard]] static Expected<PendingFile> create_folder(const std::filesystem::path& path);
    /// The same to change a folder as a whole: part() is a copy of it (its files are hard links:
    /// they are to be replaced, not written into), which takes its place in commit(). Where there
    /// is no folder an empty one is made first. A process that is killed leaves the old folder or
    /// the new one, and beside it NAME.raks.part, as of a file that is replaced. Errors: it cannot
    /// be made; it cannot be copied, as where there are no hard links.
    [[nodiscard]] static Expected<PendingFile> create_changed_folder(
        const std::filesystem::path& path);
    PendingFile(PendingFile&& other) noexcept;             ///< the source then owns nothing
    PendingFile& operator=(PendingFile&& other) noexcept;  ///< removes its own part first
    ~PendingFile();                                        ///< removes the part, unless committed

    /// Where to write until commit(): a path that can be opened; of a file without a name one below
    /// /proc/self.
    [[nodiscard]] const std::filesystem::path& part() const noexcept { return part_; }
    /// Appends to a file: all of it, or an error. Errors: the system's (a full disk).
    [[nodiscard]] Expected<void> write(std::string_view bytes);
    /// Waits until the disk has all of it and renames the part to its final name, replacing what
    /// was there. After a failure the old file is there, whole. Errors: the system's.
    [[nodiscard]] Expected<void> commit();
    /// As commit(), but of what ended before it was complete: what has the name stays, and the part
    /// lies beside it under the first stopped_name() that is free. Returns that path.
    [[nodiscard]] Expected<std::filesystem::path> commit_stopped();
    /// From now on what is written is of use by itself: where the process is told to end, it is
    /// kept under its stopped_name(). Of a folder, or of a file that was made with AtEnd::kept.
    void keep_from_here();

 private:
    PendingFile(std::filesystem::path path,
                std::filesystem::path part,
                int file = -1,
                bool is_named = true);
    [[nodiscard]] static Expected<PendingFile> make_folder_part(
        const std::filesystem::path& folder);
    [[nodiscard]] static Expected<PendingFile> make_marked_folder_part(
        const std::filesystem::path& folder);
    [[nodiscard]] bool exchange();
    void remove_part() noexcept;
    [[nodiscard]] bool close() noexcept;
    [[nodiscard]] bool give_name();

    std::filesystem::path path_;
    std::filesystem::path part_;  // empty once committed or moved from
    int file_ = -1;               // open for writing, or a folder's copy; -1: none, or moved from
    bool is_named_ = true;        // the part is an entry of its folder
    bool is_copy_ = false;        // of a folder, which it is exchanged with
};

/// All that are not committed.
struct PendingFiles;
/// Those of this program; in a module that was given the program's, these. Threads: any.
[[nodiscard]] PendingFiles& pending_files();
/// For a module, which has code of its own for pending files: from now on they count among the
/// program's. Threads: any, before the module's first file.
void share_pending_files(PendingFiles& of_program);

/// What has ended early lies beside `path` as this: x.mp4 -> x.stopped.mp4; where something has
/// that name x.stopped-2.mp4, and so on.
[[nodiscard]] std::filesystem::path stopped_name(const std::filesystem::path& path);

/// As long as one lives, nothing can be committed.
struct EndOfWriting {
    std::unique_lock<std::mutex> lock;        ///< held until the process ends
    std::vector<std::filesystem::path> kept;  ///< what is of use by itself, under its stopped_name
};
/// Removes every part that is not committed; those that are of use by themselves get their
/// stopped_name(). For a process that must end now. Threads: any.
[[nodiscard]] EndOfWriting remove_pending_files();

/// Removes this file if it is a part that a killed process left (PendingFile); nothing else.
void remove_abandoned_part(const std::filesystem::path& part);

/// Checks before long work that its output can be written at the end. Errors: as
/// PendingFile::create; `output` is one of the `inputs` (by whatever name), which it would replace.
[[nodiscard]] Expected<void> check_output(const std::filesystem::path& output,
                                          const std::vector<std::filesystem::path>& inputs);
/// The second of these checks alone, for outputs that may be folders.
[[nodiscard]] Expected<void> check_is_no_input(const std::filesystem::path& output,
                                               const std::vector<std::filesystem::path>& inputs);

/// Makes a folder and those above it; one that is there stays. Errors: the system's.
[[nodiscard]] Expected<void> make_folders(const std::filesystem::path& folder);

/// Writes all of `bytes` to `path`, or leaves what was there. Errors: as PendingFile, and a full
/// disk.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace raks
