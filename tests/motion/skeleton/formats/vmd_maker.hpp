// Bytes of a VMD, put together record by record, for tests that know what its reader must say.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raks::test {

/// Names as the bytes of code page 932, as published with the format.
inline const std::string kVmdCenter = "\x83\x5A\x83\x93\x83\x5E\x81\x5B";
inline const std::string kVmdLeftLegIk = "\x8D\xB6\x91\xAB\x82\x68\x82\x6A";
inline const std::string kVmdLeftToeIk = "\x8D\xB6\x82\xC2\x82\xDC\x90\xE6\x82\x68\x82\x6A";
inline const std::string kVmdLeftIndex1 = "\x8D\xB6\x90\x6C\x8E\x77\x82\x50";

/// A VMD that grows.
class VmdMaker {
 public:
    VmdMaker() {
        bytes_ = "Vocaloid Motion Data 0002";
        bytes_.resize(30, '\0');
        name("test", 20);
    }
    /// As before there were several models: another mark, a shorter name.
    static VmdMaker old() {
        VmdMaker maker;
        maker.bytes_ = "Vocaloid Motion Data file";
        maker.bytes_.resize(30, '\0');
        maker.name("test", 10);
        return maker;
    }

    /// A number as it lies.
    template <typename Number>
    VmdMaker& put(Number value) {
        std::array<char, sizeof(Number)> raw{};
        std::memcpy(raw.data(), &value, raw.size());
        bytes_.append(raw.data(), raw.size());
        return *this;
    }
    VmdMaker& count(std::uint32_t value) { return put(value); }
    /// Cut or filled up with zeros.
    VmdMaker& name(std::string text, std::size_t field) {
        text.resize(field, '\0');
        bytes_ += text;
        return *this;
    }
    /// A key of a bone with straight curves; units, in the file's axes; the turn as x, y, z, w.
    VmdMaker& bone(const std::string& bytes,
                   std::uint32_t frame,
                   std::array<float, 3> place,
                   std::array<float, 4> turn = {0, 0, 0, 1}) {
        std::array<std::uint8_t, 64> curves{};
        for (std::size_t channel = 0; channel < 4; ++channel) {
            set_curve(curves, channel, {20, 20, 107, 107});
        }
        return bone(bytes, frame, place, turn, curves);
    }
    VmdMaker& bone(const std::string& bytes,
                   std::uint32_t frame,
                   std::array<float, 3> place,
                   std::array<float, 4> turn,
                   const std::array<std::uint8_t, 64>& curves) {
        name(bytes, 15).put(frame);
        for (const float number : place) {
            put(number);
        }
        for (const float number : turn) {
            put(number);
        }
        for (const std::uint8_t number : curves) {
            put(number);
        }
        return *this;
    }
    /// x1, y1, x2, y2 of X, Y, Z or the turn, in all four rows.
    static void set_curve(std::array<std::uint8_t, 64>& curves,
                          std::size_t channel,
                          std::array<std::uint8_t, 4> handles) {
        for (std::size_t row = 0; row < 4; ++row) {
            for (std::size_t i = 0; i < 4; ++i) {
                const std::size_t at = 4 * i + channel;
                if (at >= row) {
                    curves[16 * row + at - row] = handles[i];
                }
            }
        }
    }
    VmdMaker& morph(const std::string& bytes, std::uint32_t frame, float weight) {
        return name(bytes, 15).put(frame).put(weight);
    }
    /// A key of all switches.
    VmdMaker& switches(std::uint32_t frame, const std::vector<std::pair<std::string, bool>>& on) {
        put(frame).put(std::uint8_t{1}).count(static_cast<std::uint32_t>(on.size()));
        for (const auto& [bytes, is_on] : on) {
            name(bytes, 20).put(static_cast<std::uint8_t>(is_on ? 1 : 0));
        }
        return *this;
    }
    VmdMaker& camera(std::uint32_t frame,
                     float distance,
                     std::array<float, 3> target,
                     std::array<float, 3> turn,
                     std::uint32_t angle) {
        put(frame).put(distance);
        for (const float number : target) {
            put(number);
        }
        for (const float number : turn) {
            put(number);
        }
        for (int i = 0; i < 24; ++i) {
            put(static_cast<std::uint8_t>(i % 2 == 0 ? 20 : 107));
        }
        return put(angle).put(std::uint8_t{0});
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
    std::string bytes_;
};

}  // namespace raks::test
