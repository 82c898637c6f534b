#pragma once

#include <memory>
#include <utility>

#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::models {

/// Runs one network on a stream, frame by frame. `Network` is a RecurrentNetwork that names its
/// `Frame` (the input) and its `Evidence` (the output), and converts the raw outputs: `static
/// Evidence evidence_of(const RecurrentStream::Logits&) noexcept`.
/// Threads: one. Real-time: next, reset yes.
template <class Network>
class NetworkStream {
 public:
    /// `network`: not null; shared with other streams.
    explicit NetworkStream(std::shared_ptr<const Network> network) : network_(std::move(network)) {}

    /// Output after this frame. It describes the frame that lies the network's look-ahead before
    /// it.
    typename Network::Evidence next(const typename Network::Frame& frame) noexcept
        RAKS_NONBLOCKING {
        return Network::evidence_of(stream_.next(*network_, frame));
    }
    void reset() noexcept RAKS_NONBLOCKING { stream_.reset(); }  ///< back to zero states

 private:
    std::shared_ptr<const Network> network_;
    RecurrentStream stream_;
};

}  // namespace raks::models
