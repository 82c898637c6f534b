#pragma once

#include <bitset>
#include <memory>

#include "audio/io/audio_file.hpp"
#include "audio/io/decode_protocol.hpp"

namespace raks::engine {

/// Decodes the one file that it is sent, ahead into all slots that are free, until raks closes the
/// socket. Threads: one. Real-time: no.
class DecodeServer {
 public:
    /// `memory`: what raks sees, too.
    DecodeServer(int socket, audio::DecodeMemory& memory, bool is_confined)
        : socket_(socket), memory_(memory), is_confined_(is_confined) {}

    /// Returns when nothing more is wanted of it.
    void run();

 private:
    [[nodiscard]] bool open();
    [[nodiscard]] Expected<std::unique_ptr<audio::AudioFileReader>> open_source(int descriptor);
    [[nodiscard]] bool obey();
    [[nodiscard]] bool seek(std::int64_t frame);
    [[nodiscard]] bool fill_slot();
    [[nodiscard]] bool is_asked() const;
    [[nodiscard]] bool send(audio::DecodeKind kind, std::string_view text);

    int socket_;
    audio::DecodeMemory& memory_;
    bool is_confined_;
    audio::DecodeMessage asked_;
    audio::DecodeMessage answer_;
    std::unique_ptr<audio::AudioFileReader> reader_;
    std::bitset<audio::kDecodeSlots> free_ = ~std::bitset<audio::kDecodeSlots>();
    bool is_at_end_ = false;
};

}  // namespace raks::engine
