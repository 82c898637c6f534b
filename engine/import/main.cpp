// The program raks-import: makes a plain binary glTF of a model in another format for raks, which
// starts it, hands it the model and what lies beside it, and reads the glTF with its own reader. A
// process a model, in a cage, which a damaged or malicious file can at worst end.
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "engine/decode/confine.hpp"
#include "engine/import/assimp_reader.hpp"
#include "engine/import/draco_unpacker.hpp"
#include "render/export/glb_writer.hpp"
#include "render/import/import_protocol.hpp"

namespace raks::engine {
namespace {

using render::ImportKind;
using render::kImportSocket;

constexpr std::uint64_t kMemory = std::uint64_t{1} << 30U;  // bytes, beside what libraries take
constexpr rlim_t kSeconds = 20;                             // of the processor

// raks, which waits, knows when it is too late.
constexpr TalkDeadline kNever = TalkDeadline::max();

bool is_started_by_raks() {
    struct stat status {};
    return fstat(kImportSocket, &status) == 0 && S_ISSOCK(status.st_mode);
}

/// Without raks there is nobody to read for.
void insist(Talk talk) {
    if (talk != Talk::good) {
        _exit(1);
    }
}

void say(ImportKind kind, std::string_view bytes) {
    insist(render::send_part(kImportSocket, kind, bytes, kNever));
}

Expected<std::string> fetch(std::string_view name) {
    say(ImportKind::want, name);
    render::ImportPart part;
    insist(render::receive_part(kImportSocket, part, kNever));
    return part.kind == ImportKind::file ? Expected<std::string>(std::move(part.bytes))
                                         : fail(std::move(part.bytes));
}

Expected<std::string> glb_of(std::string_view format, const std::string& bytes) {
    const ImportWays ways{.fetch = fetch,
                          .note = [](const std::string& line) { say(ImportKind::note, line); }};
    if (format == "draco") {
        return unpack_draco(bytes, ways);
    }
    constexpr std::array<std::pair<std::string_view, ForeignFormat>, 3> kFormats = {
        {{"fbx", ForeignFormat::fbx},
         {"dae", ForeignFormat::collada},
         {"obj", ForeignFormat::obj}}};
    for (const auto& [name, known] : kFormats) {
        if (name == format) {
            const auto model = read_with_assimp(known, bytes, ways);
            return model ? render::glb_bytes(*model) : fail(model.error());
        }
    }
    return fail("no format that raks-import reads");
}

/// Takes the model, gives the glTF.
void serve(std::string_view format) {
    render::ImportPart model;
    insist(render::receive_part(kImportSocket, model, kNever));
    const auto glb = glb_of(format, model.bytes);
    if (glb) {
        say(ImportKind::done, *glb);
    } else {
        say(ImportKind::failed, glb.error().message);
    }
}

bool is_caged(bool is_to_be) {
    const rlimit processor{kSeconds, kSeconds};
    static_cast<void>(setrlimit(RLIMIT_CPU, &processor));
    return !is_to_be || confine(kMemory) == Confinement::whole;
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    if (argc < 2 || !is_started_by_raks()) {
        std::fputs("raks-import: is started by raks, to read models; use raks\n", stderr);
        return 2;
    }
    const bool is_to_be_caged = argc < 3 || std::string_view(argv[2]) != "--no-sandbox";
    try {
        if (!is_caged(is_to_be_caged)) {
            say(ImportKind::note,
                "it is read without protection against damaged files: this kernel refuses seccomp");
        }
        serve(argv[1]);
    } catch (const std::bad_alloc&) {
        say(ImportKind::failed, "it takes more than 1 GiB to read: it is damaged, or too large");
    } catch (const std::exception& problem) {
        say(ImportKind::failed, std::string("it cannot be read: ") + problem.what());
    }
    // Destructors of deep trees call themselves as deep.
    _exit(0);
}
