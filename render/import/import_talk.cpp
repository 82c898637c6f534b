#include "render/import/import_talk.hpp"

#include <string_view>
#include <utility>

#include "base/printable.hpp"
#include "render/import/characters.hpp"
#include "render/import/import_protocol.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostWanted = std::size_t{256} << 20U;  // bytes, of one file
constexpr std::size_t kMostParts = 5000;                      // wanted files and notes
constexpr std::size_t kMostNotes = 200;
constexpr std::size_t kLongestLine = 400;  // bytes

Talk answer(int socket, const std::string& uri, WantedFiles& wanted, TalkDeadline deadline) {
    const auto file = wanted.read(uri, kMostWanted);
    return file ? send_part(socket, ImportKind::file, characters_of(*file), deadline)
                : send_part(socket, ImportKind::none, file.error().message, deadline);
}

/// The next part. One who never lets us wait is late, too.
Talk next_part(int socket, ImportPart& part, TalkDeadline deadline) {
    return std::chrono::steady_clock::now() > deadline ? Talk::late
                                                       : receive_part(socket, part, deadline);
}

}  // namespace

Talk import_over(int socket,
                 std::span<const std::byte> model,
                 WantedFiles& wanted,
                 TalkDeadline deadline,
                 Expected<Imported>& imported) {
    Talk talk = send_part(socket, ImportKind::file, characters_of(model), deadline);
    std::vector<std::string> notes;
    ImportPart part;
    for (std::size_t i = 0; i < kMostParts && talk == Talk::good; ++i) {
        talk = next_part(socket, part, deadline);
        if (talk != Talk::good) {
            return talk;
        }
        switch (part.kind) {
            case ImportKind::want:
                talk = answer(socket, part.bytes, wanted, deadline);
                break;
            case ImportKind::note:
                if (notes.size() < kMostNotes) {
                    notes.push_back(printable(part.bytes, kLongestLine));
                }
                break;
            case ImportKind::failed:
                imported = fail(printable(part.bytes, kLongestLine));
                return Talk::good;
            case ImportKind::done:
                imported = Imported{.glb = std::move(part.bytes), .notes = std::move(notes)};
                return Talk::good;
            case ImportKind::file:
            case ImportKind::none:
                return Talk::nonsense;
        }
    }
    return talk == Talk::good ? Talk::nonsense : talk;
}

}  // namespace raks::render
