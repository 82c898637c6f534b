#pragma once

#include <memory>
#include <utility>

#include "base/realtime.hpp"
#include "models/recurrent_network.hpp"

namespace raks::models {

/// Listens with one network, frame by frame. `Network` is a RecurrentNetwork that names its `Frame`
/// (what it gets) and its `Evidence` (what it says), and reads the one from its outputs:
/// `static Evidence evidence_of(const RecurrentStream::Logits&) noexcept`.
/// Threads: one. Real-time: next, reset yes.
template <class Network>
class NetworkStream {
 public:
    /// `network`: not null.
    explicit NetworkStream(std::shared_ptr<const Network> network) : network_(std::move(network)) {}

    /// About the frame, or what lies the network's look-ahead before it.
    typename Network::Evidence next(const typename Network::Frame& frame) noexcept
        RAKS_NONBLOCKING {
        return Network::evidence_of(stream_.next(*network_, frame));
    }
    void reset() noexcept RAKS_NONBLOCKING { stream_.reset(); }

 private:
    std::shared_ptr<const Network> network_;
    RecurrentStream stream_;
};

}  // namespace raks::models
