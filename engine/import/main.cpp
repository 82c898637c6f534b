// The program raks-import: makes a plain binary glTF of a model in another format for raks, which
// starts it, hands it the model and what lies beside it, and reads the glTF with its own reader. A
// process a model, in a cage, which a damaged or malicious file can at worst end.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "engine/decode/caged_program.hpp"
#include "engine/import/assimp_reader.hpp"
#include "engine/import/draco_unpacker.hpp"
#include "render/export/glb_writer.hpp"
#include "render/import/import_protocol.hpp"

namespace raks::engine {
namespace {

using render::ImportKind;

constexpr Cage kCage{.more_memory = std::uint64_t{1} << 30U, .seconds = 20};

/// Without raks there is nobody to read for.
void insist(Talk talk) {
    if (talk != Talk::good) {
        _exit(1);
    }
}

void say(ImportKind kind, std::string_view bytes) {
    insist(render::send_part(kTalkSocket, kind, bytes, kNever));
}

Expected<std::string> fetch(std::string_view name) {
    say(ImportKind::want, name);
    render::ImportPart part;
    insist(render::receive_part(kTalkSocket, part, kNever));
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
    insist(render::receive_part(kTalkSocket, model, kNever));
    const auto glb = glb_of(format, model.bytes);
    if (glb) {
        say(ImportKind::done, *glb);
    } else {
        say(ImportKind::failed, glb.error().message);
    }
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    const auto arguments = arguments_of_raks(argc, argv);
    if (!arguments || arguments->words.empty()) {
        std::fputs("raks-import: is started by raks, to read models; use raks\n", stderr);
        return kWrongUsage;
    }
    try {
        if (!enter_cage(*arguments, kCage)) {
            say(ImportKind::note,
                "it is read without protection against damaged files: this kernel refuses seccomp");
        }
        serve(arguments->words.front());
    } catch (const std::bad_alloc&) {
        say(ImportKind::failed, "it takes more than 1 GiB to read: it is damaged, or too large");
    } catch (const std::exception& problem) {
        say(ImportKind::failed, std::string("it cannot be read: ") + problem.what());
    }
    // Destructors of deep trees call themselves as deep.
    _exit(0);
}
