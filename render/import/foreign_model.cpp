#include "render/import/foreign_model.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "base/child_process.hpp"
#include "base/descriptor.hpp"
#include "base/printable.hpp"
#include "base/program_parts.hpp"
#include "render/import/gltf_reader.hpp"
#include "render/import/import_protocol.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostWanted = std::size_t{256} << 20U;  // bytes, of one file
constexpr std::size_t kMostParts = 5000;                      // wanted files and notes
constexpr std::size_t kMostNotes = 200;
constexpr std::size_t kLongestLine = 400;  // bytes

std::string_view characters_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// For people; empty: glTF.
const char* name_of(std::string_view format) {
    return format == "fbx" ? "FBX" : format == "dae" ? "Collada" : format == "obj" ? "OBJ" : "";
}

/// What raks-import made of a model.
struct Imported {
    std::string glb;
    std::vector<std::string> notes;
};

/// A running raks-import.
class ImportChild {
 public:
    static Expected<ImportChild> start(std::string_view format, std::chrono::milliseconds longest) {
        const auto program = find_program_part("raks-import", "libexec/raks", "RAKS_IMPORTER");
        if (!program) {
            return fail(program.error());
        }
        std::array<int, 2> pair{-1, -1};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) {
            return fail("raks-import cannot be started: " + std::generic_category().message(errno));
        }
        ImportChild child(longest);
        child.socket_ = pair[0];
        const Descriptor childs(pair[1]);
        ChildStart start{.program = *program,
                         .arguments = {std::string(format)},
                         .descriptors = std::span(&childs.number, 1)};
#ifdef RAKS_IMPORTS_UNCONFINED
        start.arguments.emplace_back("--no-sandbox");
        start.is_heard = true;
#endif
        const auto pid = spawn_child(start);
        if (!pid) {
            return fail(pid.error());
        }
        child.pid_ = *pid;
        return child;
    }

    ImportChild(const ImportChild&) = delete;
    ImportChild& operator=(const ImportChild&) = delete;
    ImportChild(ImportChild&& other) noexcept
        : pid_(std::exchange(other.pid_, -1)),
          socket_(std::exchange(other.socket_, -1)),
          longest_(other.longest_),
          deadline_(other.deadline_) {}
    ImportChild& operator=(ImportChild&&) = delete;
    ~ImportChild() {
        const Descriptor closed(socket_);
        if (pid_ >= 0) {
            end_child_group(pid_);
        }
    }

    /// Hands the model over and answers what is wanted until there is an end.
    Expected<Imported> import(std::span<const std::byte> model, const SideFiles& side) {
        ImportTalk talk = send_part(socket_, ImportKind::file, characters_of(model), deadline_);
        Imported imported;
        ImportPart part;
        for (std::size_t i = 0; i < kMostParts && talk == ImportTalk::good; ++i) {
            talk = receive_part(socket_, part, deadline_);
            if (talk != ImportTalk::good) {
                break;
            }
            switch (part.kind) {
                case ImportKind::want:
                    talk = answer(part.bytes, side);
                    break;
                case ImportKind::note:
                    if (imported.notes.size() < kMostNotes) {
                        imported.notes.push_back(printable(part.bytes, kLongestLine));
                    }
                    break;
                case ImportKind::failed:
                    return fail(printable(part.bytes, kLongestLine));
                case ImportKind::done:
                    imported.glb = std::move(part.bytes);
                    return imported;
                case ImportKind::file:
                case ImportKind::none:
                    talk = ImportTalk::nonsense;
                    break;
            }
        }
        return fail(why_ended(talk));
    }

 private:
    explicit ImportChild(std::chrono::milliseconds longest)
        : longest_(longest), deadline_(std::chrono::steady_clock::now() + longest) {}

    ImportTalk answer(const std::string& wanted, const SideFiles& side) const {
        const auto file = is_data_uri(wanted) ? read_data_uri(wanted, kMostWanted)
                                              : side.read(wanted, kMostWanted);
        return file ? send_part(socket_, ImportKind::file, characters_of(*file), deadline_)
                    : send_part(socket_, ImportKind::none, file.error().message, deadline_);
    }

    std::string why_ended(ImportTalk talk) {
        const std::string how = end_child_group(std::exchange(pid_, -1));
        switch (talk) {
            case ImportTalk::late:
                return fmt::format("its reader took more than {} s and was ended",
                                   std::chrono::duration<double>(longest_).count());
            case ImportTalk::broke:
                return fmt::format("its reader broke off ({}): it is damaged, or too large", how);
            case ImportTalk::good:
            case ImportTalk::nonsense:
                break;
        }
        return "its reader answered nonsense and was ended";
    }

    pid_t pid_ = -1;
    int socket_ = -1;
    std::chrono::milliseconds longest_;
    ImportDeadline deadline_;
};

}  // namespace

Expected<Model> read_foreign_model(std::string_view format,
                                   std::span<const std::byte> bytes,
                                   const SideFiles& side,
                                   std::chrono::milliseconds longest) {
#ifdef RAKS_WITHOUT_IMPORT
    static_cast<void>(bytes);
    static_cast<void>(side);
    static_cast<void>(longest);
    return fail(
        fmt::format("this build of raks reads no {} (RAKS_IMPORT=OFF); bring it as .glb", format));
#else
    auto child = ImportChild::start(format, longest);
    if (!child) {
        return fail(child.error());
    }
    auto imported = child->import(bytes, side);
    if (!imported) {
        return fail(imported.error());
    }
    auto model =
        read_gltf(std::as_bytes(std::span(imported->glb.data(), imported->glb.size())), side);
    if (!model) {
        return fail(fmt::format("as glTF: {}", model.error().message));
    }
    model->format = name_of(format);
    model->warnings.insert(model->warnings.begin(), imported->notes.begin(), imported->notes.end());
    return model;
#endif
}

bool uses_draco(std::span<const std::byte> gltf) {
    constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
    return characters_of(gltf).find(kDraco) != std::string_view::npos;
}

}  // namespace raks::render
