// What our own programs in cages may answer once what they read has taken them over: any bytes.
#include <fcntl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "audio/io/decoder_client.hpp"
#include "audio/music/instruments/soundfont_protocol.hpp"
#include "base/descriptor.hpp"
#include "render/import/gltf_reader.hpp"
#include "render/import/import_talk.hpp"
#include "render/import/model_unpacker.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

/// Our end of a socket, and that of a child who has said all that it will ever say.
struct Line {
    Descriptor ours, childs;

    explicit Line(int kind) {
        std::array<int, 2> pair{-1, -1};
        must(::socketpair(AF_UNIX, kind | SOCK_CLOEXEC, 0, pair.data()) == 0);
        ours.number = pair[0];
        childs.number = pair[1];
    }
    /// What finds no room is lost.
    void say(std::string_view bytes) const {
        static_cast<void>(
            ::send(childs.number, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
    }
    void end() const { ::shutdown(childs.number, SHUT_WR); }
};

TalkDeadline soon() { return std::chrono::steady_clock::now() + std::chrono::milliseconds(200); }

/// Packets of a talk: each with its length in two bytes before it.
void say_packets(const Line& line, std::string_view bytes) {
    while (bytes.size() > 2) {
        const std::size_t size = static_cast<unsigned char>(bytes[0]) +
                                 std::size_t{256} * static_cast<unsigned char>(bytes[1]);
        bytes.remove_prefix(2);
        line.say(bytes.substr(0, size));
        bytes.remove_prefix(std::min(size, bytes.size()));
    }
}

/// All that is left; a decoder has not more than that to say.
void read_to_the_end(audio::AudioFileReader& reader) {
    std::vector<float> block(1000 * static_cast<std::size_t>(reader.info().channels));
    for (int i = 0; i < 100; ++i) {
        const std::size_t frames = reader.read(block);
        must(frames <= 1000);
        if (frames == 0) {
            return;
        }
    }
}

}  // namespace

bool read_import_talk(std::string_view bytes) {
    const Line line(SOCK_STREAM);
    line.say(bytes);
    line.end();
    const std::array<std::byte, 8> model{};
    const render::SideFiles side;
    render::WantedFiles wanted(model, side);
    Expected<render::Imported> imported;
    const Talk talk = render::import_over(line.ours.number, model, wanted, soon(), imported);
    if (talk != Talk::good) {
        return false;
    }
    if (!imported) {
        must_be_one_line(imported.error().message);
        return true;
    }
    for (const std::string& note : imported->notes) {
        must_be_one_line(note);
    }
    const auto read = render::read_gltf(std::as_bytes(std::span(imported->glb)), side);
    if (!read) {
        must_be_one_line(read.error().message);
    }
    return true;
}

bool read_unpack_talk(std::string_view bytes) {
    const Line line(SOCK_STREAM);
    line.say(bytes);
    line.end();
    std::vector<std::byte> out(32);
    TalkAnswer answer;
    const render::UnpackRequest what{.row_bytes = 16, .rows = 2};
    const Talk talk = render::unpack_over(line.ours.number, what, {}, out, soon(), answer);
    if (talk == Talk::good && !answer.done) {
        must_be_one_line(answer.done.error().message);
    }
    return talk == Talk::good;
}

bool read_soundfont_talk(std::string_view bytes) {
    const Line line(SOCK_STREAM);
    line.say(bytes);
    line.end();
    Expected<std::vector<float>> samples(8);
    if (audio::receive_played(line.ours.number, soon(), samples) != Talk::good) {
        return false;
    }
    if (!samples) {
        must_be_one_line(samples.error().message);
        return true;
    }
    must(samples->size() == 8 && std::all_of(samples->begin(), samples->end(), [](float sample) {
             return std::isfinite(sample);
         }));
    return true;
}

bool read_decode_talk(std::string_view bytes) {
    const Line line(SOCK_SEQPACKET);
    say_packets(line, bytes);
    line.end();
    const Descriptor file(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    audio::DecodedSource source;
    source.name = "x";
    source.descriptor = file.number;
    Descriptor ours(::fcntl(line.ours.number, F_DUPFD_CLOEXEC, 0));
    const auto client =
        audio::DecoderClient::open(std::move(source), audio::DecoderProcess::over(ours).value());
    if (!client) {
        must_be_one_line(client.error().message);
        return false;
    }
    const audio::AudioFileInfo& info = (*client)->info();
    must(info.channels >= 1 && info.channels <= audio::kMaxFileChannels);
    must(info.rate.is_supported());
    must_be_one_line(info.format);
    if (const auto sought = (*client)->seek(100); !sought) {
        must_be_one_line(sought.error().message);
    }
    read_to_the_end(**client);
    must_be_one_line((*client)->warning());
    return true;
}

}  // namespace raks::fuzz
