#include "audio/io/mended_head.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "audio/io/head_bytes.hpp"

namespace raks::audio {
namespace {

constexpr int kMostChunks = 10'000;                   // before the sound
constexpr std::int64_t kMostHeadBytes = 1 << 20;      // that are copied to be changed
constexpr std::uint64_t kNear2GiB = 0x7FFF'0000U;     // from here on: a length made up
constexpr std::int64_t kMostRiffBytes = 0xFFFF'0000;  // of sound in RIFF; more needs RF64
constexpr std::uint64_t kMostPlausible = std::uint64_t{1} << 50U;  // bytes

// Where the sound lies and how long the head says it is.
struct SoundChunk {
    std::int64_t at = 0;        // of its first byte
    std::uint64_t claimed = 0;  // bytes
    std::int64_t there = 0;     // bytes from `at` to the end of the file
    double bytes_a_second = 0.0;
    std::int64_t block = 1;            // bytes of an audio frame or of a block of the codec
    bool is_empty_on_purpose = false;  // nothing claimed, and other chunks follow
    bool is_wrapped = false;           // over 4 GiB, its length modulo 4 GiB

    [[nodiscard]] bool is_too_long() const { return claimed > static_cast<std::uint64_t>(there); }
    // Bytes that a decoder should take: whole blocks.
    [[nodiscard]] std::int64_t usable() const {
        const auto most = std::min<std::uint64_t>(claimed, static_cast<std::uint64_t>(there));
        const std::int64_t bytes = is_open_ended() ? there : static_cast<std::int64_t>(most);
        return bytes - bytes % std::max<std::int64_t>(block, 1);
    }
    [[nodiscard]] bool is_open_ended() const {
        const bool is_zero = claimed == 0 && there > 0 && !is_empty_on_purpose;
        const bool is_made_up = claimed >= kNear2GiB && is_too_long();
        return is_zero || is_made_up || is_wrapped || claimed > kMostPlausible;
    }
};

// What is said of a head once its sound chunk is known; the window is set by the caller.
MendedHead judged(const FileWindow& file, const SoundChunk& sound) {
    MendedHead head{.window = file};
    head.has_no_length = sound.is_open_ended();
    if (!head.has_no_length && sound.is_too_long() && sound.bytes_a_second > 0.0) {
        const auto missing = sound.claimed - static_cast<std::uint64_t>(sound.there);
        head.missing_seconds = static_cast<double>(missing) / sound.bytes_a_second;
    }
    head.is_complete = !head.has_no_length && !sound.is_too_long();
    return head;
}

// Do chunks of RIFF or AIFF follow from here exactly to the end of the file?
bool are_chunks_to_the_end(const FileWindow& file, std::int64_t at, ByteOrder order) {
    for (int i = 0; i < kMostChunks && at + 8 <= file.size(); ++i) {
        const std::string head = file.bytes(at, 8);
        const std::string_view name = std::string_view(head).substr(0, 4);
        const bool is_named =
            std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; });
        if (head.size() < 8 || !is_named) {
            return false;
        }
        const auto size = static_cast<std::int64_t>(number_at(head, 4, 4, order));
        at += 8 + size + size % 2;
    }
    return at == file.size() || at == file.size() + 1;
}

// --- WAV in RIFF, RIFX, RF64 and W64 ---

struct WaveHead {
    std::string format;  // body of the chunk "fmt "
    SoundChunk sound;
    bool is_found = false;
};

void take_format(WaveHead& head, ByteOrder order) {
    head.sound.bytes_a_second = static_cast<double>(number_at(head.format, 8, 4, order));
    head.sound.block = static_cast<std::int64_t>(number_at(head.format, 12, 2, order));
}

// RIFF and RF64: chunks of a name of four letters and a size of four bytes.
WaveHead read_riff(const FileWindow& file, ByteOrder order) {
    WaveHead wave;
    std::uint64_t long_size = 0;  // of the sound, from RF64's "ds64"
    std::int64_t at = 12;
    for (int i = 0; i < kMostChunks && at + 8 <= file.size(); ++i) {
        const std::string head = file.bytes(at, 8);
        const std::string_view name = std::string_view(head).substr(0, 4);
        const auto size = static_cast<std::int64_t>(number_at(head, 4, 4, order));
        if (name == "ds64") {
            long_size = number_at(file.bytes(at + 16, 8), 0, 8, order);
        } else if (name == "fmt ") {
            wave.format =
                file.bytes(at + 8, static_cast<std::size_t>(std::min<std::int64_t>(size, 1024)));
        } else if (name == "data") {
            wave.is_found = !wave.format.empty();
            wave.sound.at = at + 8;
            const bool is_long = size == 0xFFFF'FFFF && long_size > 0;
            wave.sound.claimed = is_long ? long_size : static_cast<std::uint64_t>(size);
            break;
        }
        at += 8 + size + size % 2;
    }
    wave.sound.there = file.size() - wave.sound.at;
    const SoundChunk& sound = wave.sound;
    wave.sound.is_empty_on_purpose =
        sound.claimed == 0 && are_chunks_to_the_end(file, sound.at, order);
    wave.sound.is_wrapped =
        sound.there > kMostRiffBytes && sound.claimed <= 0xFFFF'FFFF && !sound.is_too_long() &&
        !are_chunks_to_the_end(
            file, sound.at + static_cast<std::int64_t>(sound.claimed + sound.claimed % 2), order);
    take_format(wave, order);
    return wave;
}

// W64: chunks of a name of 16 bytes and a size of 8, which counts these 24 bytes, too; each starts
// at a multiple of 8.
WaveHead read_w64(const FileWindow& file) {
    WaveHead wave;
    std::int64_t at = 40;
    for (int i = 0; i < kMostChunks && at + 24 <= file.size(); ++i) {
        const std::string head = file.bytes(at, 24);
        const std::string_view name = std::string_view(head).substr(0, 4);
        const std::uint64_t size = number_at(head, 16, 8, ByteOrder::little);
        if (name == "data") {
            wave.is_found = !wave.format.empty();
            wave.sound.at = at + 24;
            wave.sound.claimed = size >= 24 ? size - 24 : 0;
            break;
        }
        if (size < 24 || size > static_cast<std::uint64_t>(file.size())) {
            break;
        }
        if (name == "fmt ") {
            wave.format = file.bytes(
                at + 24, static_cast<std::size_t>(std::min<std::uint64_t>(size - 24, 1024)));
        }
        at += static_cast<std::int64_t>((size + 7) / 8 * 8);
    }
    wave.sound.there = file.size() - wave.sound.at;
    take_format(wave, ByteOrder::little);
    return wave;
}

// A head for `bytes` bytes of sound of this format: RIFF, or RF64 from 4 GiB on.
std::string wave_head(const std::string& format, std::int64_t bytes, ByteOrder order) {
    const auto size = static_cast<std::uint64_t>(bytes);
    const bool is_long = bytes > kMostRiffBytes;
    const auto number = [order](std::uint64_t value, std::size_t width) {
        return bytes_of(value, width, order);
    };
    std::string body = "WAVE";
    if (is_long) {
        const std::uint64_t all = 4 + 36 + 8 + format.size() + 8 + size;
        body +=
            "ds64" + number(28, 4) + number(all, 8) + number(size, 8) + number(0, 8) + number(0, 4);
    }
    body += "fmt " + number(format.size(), 4) + format;
    body += "data" + number(is_long ? 0xFFFF'FFFF : size, 4);
    const char* name = is_long ? "RF64" : (order == ByteOrder::big ? "RIFX" : "RIFF");
    return name + number(is_long ? 0xFFFF'FFFF : body.size() + size, 4) + body;
}

MendedHead mend_wave(const FileWindow& file, const WaveHead& wave, ByteOrder order) {
    if (!wave.is_found) {
        return {.window = file};
    }
    MendedHead head = judged(file, wave.sound);
    const std::int64_t bytes = wave.sound.usable();
    const bool is_writable = order == ByteOrder::little || bytes <= kMostRiffBytes;
    if (!head.is_complete && is_writable) {
        head.window = file.part(0, wave.sound.at + bytes)
                          .with_head(wave_head(wave.format, bytes, order), wave.sound.at);
    }
    return head;
}

// --- AIFF and AIFF-C ---

// Bytes of one sample; 0 where the codec is none of the simple ones.
std::int64_t aiff_sample_bytes(std::string_view codec, std::int64_t bits) {
    if (codec == "ulaw" || codec == "ULAW" || codec == "alaw" || codec == "ALAW") {
        return 1;
    }
    constexpr std::string_view kPlain = "NONE sowt twos raw  in24 in32 fl32 FL32 fl64 FL64";
    return codec.empty() || kPlain.find(codec) != std::string_view::npos ? (bits + 7) / 8 : 0;
}

// The sample rate: 80 bits of IEEE 754, with 15 of exponent and 64 of mantissa.
double long_double_at(std::string_view bytes, std::size_t at) {
    const auto exponent = static_cast<int>(number_at(bytes, at, 2, ByteOrder::big) & 0x7FFFU);
    const std::uint64_t mantissa = number_at(bytes, at + 2, 8, ByteOrder::big);
    return std::ldexp(static_cast<double>(mantissa), exponent - 16383 - 63);
}

struct AiffHead {
    std::int64_t comm_at = 0;  // of the body of "COMM"; 0: none before the sound
    std::int64_t ssnd_at = 0;  // of the body of "SSND"
    std::uint64_t frames = 0;  // as "COMM" says
    SoundChunk sound;
};

void take_comm(const FileWindow& file, std::int64_t at, std::int64_t size, AiffHead& aiff) {
    const std::string comm = file.bytes(at, 22);
    const auto channels = static_cast<std::int64_t>(number_at(comm, 0, 2, ByteOrder::big));
    const auto bits = static_cast<std::int64_t>(number_at(comm, 6, 2, ByteOrder::big));
    const std::string_view codec =
        size >= 22 ? std::string_view(comm).substr(std::min<std::size_t>(18, comm.size())) : "";
    aiff.comm_at = at;
    aiff.frames = number_at(comm, 2, 4, ByteOrder::big);
    aiff.sound.block = channels * aiff_sample_bytes(codec, bits);
    aiff.sound.bytes_a_second = long_double_at(comm, 8) * static_cast<double>(aiff.sound.block);
}

AiffHead read_aiff(const FileWindow& file) {
    AiffHead aiff;
    std::int64_t at = 12;
    for (int i = 0; i < kMostChunks && at + 8 <= file.size(); ++i) {
        const std::string head = file.bytes(at, 12);
        const std::string_view name = std::string_view(head).substr(0, 4);
        const auto size = static_cast<std::int64_t>(number_at(head, 4, 4, ByteOrder::big));
        if (name == "COMM") {
            take_comm(file, at + 8, size, aiff);
        } else if (name == "SSND") {
            const auto offset = static_cast<std::int64_t>(number_at(head, 8, 4, ByteOrder::big));
            aiff.ssnd_at = at + 8;
            aiff.sound.at = aiff.ssnd_at + 8 + offset;
            aiff.sound.claimed =
                static_cast<std::uint64_t>(std::max<std::int64_t>(size - 8 - offset, 0));
            break;
        }
        at += 8 + size + size % 2;
    }
    aiff.sound.there = std::max<std::int64_t>(file.size() - aiff.sound.at, 0);
    aiff.sound.is_empty_on_purpose =
        aiff.sound.claimed == 0 && are_chunks_to_the_end(file, aiff.sound.at, ByteOrder::big);
    return aiff;
}

MendedHead mend_aiff(const FileWindow& file) {
    const AiffHead aiff = read_aiff(file);
    const SoundChunk& sound = aiff.sound;
    if (aiff.comm_at == 0 || aiff.ssnd_at == 0 || sound.block <= 0 || sound.at > file.size() ||
        sound.at > kMostHeadBytes) {
        return {.window = file};
    }
    MendedHead head = judged(file, sound);
    const std::int64_t bytes = sound.usable();
    const auto frames = static_cast<std::uint64_t>(bytes / sound.block);
    // A recorder that came back to one of the two lengths only.
    const bool is_count_wrong = aiff.frames == 0 || aiff.frames > frames;
    if (head.is_complete && !(is_count_wrong && frames > 0)) {
        return head;
    }
    head.has_no_length = head.has_no_length || (head.is_complete && aiff.frames == 0);
    std::string bent = file.bytes(0, static_cast<std::size_t>(sound.at));
    bent.resize(static_cast<std::size_t>(sound.at));  // another program may have cut the file
    const auto put = [&bent](std::int64_t at, std::uint64_t value) {
        bent.replace(static_cast<std::size_t>(at), 4, bytes_of(value, 4, ByteOrder::big));
    };
    put(4, static_cast<std::uint64_t>(sound.at + bytes - 8));
    put(aiff.comm_at + 2, frames);
    put(aiff.ssnd_at - 4, static_cast<std::uint64_t>(sound.at + bytes - aiff.ssnd_at));
    head.window = file.part(0, sound.at + bytes).with_head(std::move(bent), sound.at);
    return head;
}

// --- AU and CAF: "all bits set" is their own way to say that the length is unknown ---

MendedHead mend_au(const FileWindow& file, ByteOrder order) {
    std::string start = file.bytes(0, 24);
    const std::uint64_t encoding = number_at(start, 12, 4, order);
    // Of G.711 (1, 27), whole numbers of 1 to 4 bytes (2 to 5), float (6) and double (7).
    constexpr std::array<std::int64_t, 8> kBytes{0, 1, 1, 2, 3, 4, 4, 8};
    SoundChunk sound;
    sound.at = static_cast<std::int64_t>(number_at(start, 4, 4, order));
    sound.claimed = number_at(start, 8, 4, order);
    sound.there = file.size() - sound.at;
    sound.block = static_cast<std::int64_t>(number_at(start, 20, 4, order)) *
                  (encoding < kBytes.size() ? kBytes[encoding] : 1);
    sound.bytes_a_second =
        static_cast<double>(number_at(start, 16, 4, order)) * static_cast<double>(sound.block);
    if (start.size() < 24 || sound.there < 0 || sound.claimed == 0xFFFF'FFFF) {
        return {.window = file};
    }
    MendedHead head = judged(file, sound);
    if (!head.is_complete) {
        start.replace(8, 4, std::string(4, '\xff'));
        head.window = file.with_head(start, static_cast<std::int64_t>(start.size()));
    }
    return head;
}

MendedHead mend_caf(const FileWindow& file) {
    SoundChunk sound;
    std::int64_t at = 8;
    for (int i = 0; i < kMostChunks && at + 12 <= file.size(); ++i) {
        const std::string head = file.bytes(at, 12);
        const std::string_view name = std::string_view(head).substr(0, 4);
        const std::uint64_t size = number_at(head, 4, 8, ByteOrder::big);
        if (name == "desc") {
            // The rate is a double; bytes and frames of a packet follow the flags.
            const std::string body = file.bytes(at + 12, 32);
            const auto rate = std::bit_cast<double>(number_at(body, 0, 8, ByteOrder::big));
            sound.block = static_cast<std::int64_t>(number_at(body, 16, 4, ByteOrder::big));
            sound.bytes_a_second = rate * static_cast<double>(sound.block);
        } else if (name == "data") {
            // Four bytes that count the editions come first.
            sound.at = at + 16;
            sound.claimed = size >= 4 ? size - 4 : 0;
            break;
        }
        if (size > static_cast<std::uint64_t>(file.size())) {
            break;
        }
        at += 12 + static_cast<std::int64_t>(size);
    }
    sound.there = file.size() - sound.at;
    const bool is_unknown = sound.claimed > kMostPlausible;
    if (sound.at == 0 || sound.there < 0 || sound.block <= 0 || is_unknown ||
        sound.at > kMostHeadBytes) {
        return {.window = file};
    }
    sound.is_empty_on_purpose = sound.claimed == 0;  // other chunks may follow: not to be told
    MendedHead head = judged(file, sound);
    if (!head.is_complete) {
        std::string bent = file.bytes(0, static_cast<std::size_t>(sound.at));
        bent.resize(static_cast<std::size_t>(sound.at));  // another program may have cut the file
        bent.replace(bent.size() - 12, 8, std::string(8, '\xff'));
        head.window = file.with_head(std::move(bent), sound.at);
    }
    return head;
}

}  // namespace

MendedHead mend_head(const FileWindow& file) {
    const std::string start = file.bytes(0, 12);
    const std::string_view name =
        std::string_view(start).substr(0, std::min<std::size_t>(4, start.size()));
    const std::string_view kind = start.size() == 12 ? std::string_view(start).substr(8) : "";
    if (kind == "WAVE" && (name == "RIFF" || name == "RF64" || name == "BW64")) {
        return mend_wave(file, read_riff(file, ByteOrder::little), ByteOrder::little);
    }
    if (kind == "WAVE" && name == "RIFX") {
        return mend_wave(file, read_riff(file, ByteOrder::big), ByteOrder::big);
    }
    if (name == "riff") {
        return mend_wave(file, read_w64(file), ByteOrder::little);
    }
    if (name == "FORM" && (kind == "AIFF" || kind == "AIFC")) {
        return mend_aiff(file);
    }
    if (name == ".snd" || name == "dns.") {
        return mend_au(file, name == ".snd" ? ByteOrder::big : ByteOrder::little);
    }
    return name == "caff" ? mend_caf(file) : MendedHead{.window = file};
}

}  // namespace raks::audio
