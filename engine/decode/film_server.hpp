#pragma once

#include <cstdint>
#include <string_view>

#include "audio/io/decode_protocol.hpp"
#include "engine/decode/film_decoder.hpp"

namespace raks::engine {

/// Decodes the films that it is sent, one after the other, each to its end: a message a picture,
/// and its pixels behind it (audio/io/decode_protocol.hpp). Threads: one. Real-time: no.
class FilmServer {
 public:
    /// `pictures`: a socket of bytes, to which pixels go.
    FilmServer(int socket, int pictures, bool is_confined)
        : socket_(socket), pictures_(pictures), is_confined_(is_confined) {}

    /// Returns when raks closes the socket.
    void run();

 private:
    [[nodiscard]] bool serve(int descriptor);
    [[nodiscard]] bool send_film(FilmDecoder& film);
    [[nodiscard]] bool send_picture(const DecodedFilmPicture& picture);
    [[nodiscard]] bool send(audio::DecodeKind kind, std::string_view text);

    int socket_;
    int pictures_;
    bool is_confined_;
    audio::DecodeMessage asked_;
    audio::DecodeMessage answer_;
};

}  // namespace raks::engine
