#include "audio/features/real_fft.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/assert.hpp"
#include "base/simd_lanes.hpp"

namespace raks::audio {
namespace {

// Eight complex numbers, and a row of them in memory: real parts, then imaginary ones.
struct Complex {
    Lanes re;
    Lanes im;
};
struct Row {
    float* re;
    float* im;
};

RAKS_LANES_INLINE Complex complex_at(const Row& row, std::size_t i) noexcept {
    return {lanes_at(row.re + i * kLanes), lanes_at(row.im + i * kLanes)};
}
RAKS_LANES_INLINE void store(const Complex& x, const Row& row, std::size_t i) noexcept {
    store_lanes(x.re, row.re + i * kLanes);
    store_lanes(x.im, row.im + i * kLanes);
}
RAKS_LANES_INLINE Complex sum(const Complex& a, const Complex& b) noexcept {
    return {a.re + b.re, a.im + b.im};
}
RAKS_LANES_INLINE Complex difference(const Complex& a, const Complex& b) noexcept {
    return {a.re - b.re, a.im - b.im};
}
// Times -j: a quarter turn.
RAKS_LANES_INLINE Complex quarter(const Complex& a) noexcept { return {a.im, -a.re}; }
template <class Turn>
RAKS_LANES_INLINE Complex turned(const Complex& a, const Turn& cosine, const Turn& sine) noexcept {
    return {a.re * cosine - a.im * sine, a.re * sine + a.im * cosine};
}

// The transform of four: in the place of each input comes the output of its number.
RAKS_LANES_INLINE void transform_4(Complex& a, Complex& b, Complex& c, Complex& d) noexcept {
    const Complex even = sum(a, c);
    const Complex odd = sum(b, d);
    const Complex even_left = difference(a, c);
    const Complex odd_left = quarter(difference(b, d));
    a = sum(even, odd);
    b = sum(even_left, odd_left);
    c = difference(even, odd);
    d = difference(even_left, odd_left);
}

// One of Stockham's passes of radix 4 over transforms of length `n`, of which `stride` lie side by
// side. `turns`: six numbers for each p in n / 4.
RAKS_LANES_INLINE void pass_4(
    const Row& from, const Row& to, std::size_t n, std::size_t stride, const float* turns) {
    const std::size_t quarter_n = n / 4;
    for (std::size_t p = 0; p < quarter_n; ++p, turns += 6) {
        for (std::size_t q = 0; q < stride; ++q) {
            Complex a = complex_at(from, q + stride * p);
            Complex b = complex_at(from, q + stride * (p + quarter_n));
            Complex c = complex_at(from, q + stride * (p + 2 * quarter_n));
            Complex d = complex_at(from, q + stride * (p + 3 * quarter_n));
            transform_4(a, b, c, d);
            if (p > 0) {
                b = turned(b, turns[0], turns[1]);
                c = turned(c, turns[2], turns[3]);
                d = turned(d, turns[4], turns[5]);
            }
            store(a, to, q + stride * (4 * p));
            store(b, to, q + stride * (4 * p + 1));
            store(c, to, q + stride * (4 * p + 2));
            store(d, to, q + stride * (4 * p + 3));
        }
    }
}

// The last pass where the length is twice a power of 4.
RAKS_LANES_INLINE void pass_2(const Row& from, const Row& to, std::size_t stride) {
    for (std::size_t q = 0; q < stride; ++q) {
        const Complex a = complex_at(from, q);
        const Complex b = complex_at(from, q + stride);
        store(sum(a, b), to, q);
        store(difference(a, b), to, q + stride);
    }
}

// Lane i of row k becomes lane k of row i.
RAKS_LANES_INLINE void transpose(std::array<Lanes, kLanes>& r) noexcept {
    std::array<Lanes, kLanes> t;  // NOLINT: filled below
    for (std::size_t i = 0; i < kLanes; i += 2) {
        t[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
        t[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
    }
    for (std::size_t i = 0; i < kLanes; i += 4) {
        for (std::size_t half = 0; half < 2; ++half) {
            const Lanes& a = t[i + half];
            const Lanes& b = t[i + half + 2];
            r[i + 2 * half] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
            r[i + 2 * half + 1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
        }
    }
    for (std::size_t i = 0; i < kLanes / 2; ++i) {
        const Lanes low = __builtin_shufflevector(r[i], r[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        r[i + 4] = __builtin_shufflevector(r[i], r[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        r[i] = low;
    }
}

// The transform of eight, in order.
RAKS_LANES_INLINE void transform_8(std::array<Complex, kLanes>& x) noexcept {
    constexpr float kHalfRoot = 0.70710678F;
    Complex even[4];  // NOLINT: filled below
    Complex odd[4];   // NOLINT: filled below
    for (std::size_t i = 0; i < 4; ++i) {
        even[i] = sum(x[i], x[i + 4]);
        odd[i] = difference(x[i], x[i + 4]);
    }
    odd[1] = {kHalfRoot * (odd[1].re + odd[1].im), kHalfRoot * (odd[1].im - odd[1].re)};
    odd[2] = quarter(odd[2]);
    odd[3] = {kHalfRoot * (odd[3].im - odd[3].re), -kHalfRoot * (odd[3].re + odd[3].im)};
    transform_4(even[0], even[1], even[2], even[3]);
    transform_4(odd[0], odd[1], odd[2], odd[3]);
    for (std::size_t i = 0; i < 4; ++i) {
        x[2 * i] = even[i];
        x[2 * i + 1] = odd[i];
    }
}

// What power_of() reads: of one transform.
struct Plan {
    std::size_t points;
    const float* turns;
    const float* lane_turns;
    const float* real_turns;
    Row work;
    Row other;
};

// Pairs of neighbouring samples as complex numbers, halved, as the real transform wants them:
// number j in lane j % 8 of register j / 8.
RAKS_LANES_INLINE void deal_out(const float* samples, const Plan& plan) {
    for (std::size_t i = 0; i < plan.points / kLanes; ++i) {
        const Lanes low = 0.5F * lanes_at(samples + 2 * i * kLanes);
        const Lanes high = 0.5F * lanes_at(samples + (2 * i + 1) * kLanes);
        const Complex x{__builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14),
                        __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15)};
        store(x, plan.work, i);
    }
}

// The transforms of the lanes, each of points / 8; the row that holds them in the end.
RAKS_LANES_INLINE std::pair<Row, Row> transform_lanes(const Plan& plan) {
    Row from = plan.work;
    Row to = plan.other;
    const float* turns = plan.turns;
    std::size_t n = plan.points / kLanes;
    std::size_t stride = 1;
    for (; n >= 4; n /= 4, stride *= 4) {
        pass_4(from, to, n, stride, turns);
        turns += 6 * (n / 4);
        std::swap(from, to);
    }
    if (n == 2) {
        pass_2(from, to, stride);
        std::swap(from, to);
    }
    return {from, to};
}

// Eight numbers of each lane at a time: turned, lanes and numbers exchanged, and joined.
RAKS_LANES_INLINE void join_lanes(const Row& from, const Row& to, const Plan& plan) {
    const std::size_t length = plan.points / kLanes;  // of a lane's transform
    for (std::size_t k = 0; k < length; k += kLanes) {
        std::array<Lanes, kLanes> re;  // NOLINT: filled below
        std::array<Lanes, kLanes> im;  // NOLINT: filled below
        for (std::size_t i = 0; i < kLanes; ++i) {
            const float* const turns = plan.lane_turns + (k + i) * 2 * kLanes;
            const Complex x =
                turned(complex_at(from, k + i), lanes_at(turns), lanes_at(turns + kLanes));
            re[i] = x.re;
            im[i] = x.im;
        }
        transpose(re);
        transpose(im);
        std::array<Complex, kLanes> x;  // NOLINT: filled below
        for (std::size_t i = 0; i < kLanes; ++i) {
            x[i] = {re[i], im[i]};
        }
        transform_8(x);
        for (std::size_t i = 0; i < kLanes; ++i) {
            store_lanes(x[i].re, to.re + i * length + k);
            store_lanes(x[i].im, to.im + i * length + k);
        }
    }
}

RAKS_LANES_INLINE Lanes reversed(const Lanes& a) noexcept {
    return __builtin_shufflevector(a, a, 7, 6, 5, 4, 3, 2, 1, 0);
}

// Bins k and points - k of the real transform, from the same two of the complex one: the even
// samples' transform plus and minus the odd ones', turned.
RAKS_LANES_INLINE void join_real(const Row& z, const Plan& plan, float* power) {
    const std::size_t points = plan.points;
    const float first = 2.0F * (z.re[0] + z.im[0]);
    const float last = 2.0F * (z.re[0] - z.im[0]);
    power[0] = first * first;
    power[points] = last * last;
    const float* turns = plan.real_turns;
    for (std::size_t k = 1; k < points / 2; k += kLanes, turns += 2 * kLanes) {
        const std::size_t mirror = points - k - (kLanes - 1);
        const Complex a{lanes_at(z.re + k), lanes_at(z.im + k)};
        const Complex b{reversed(lanes_at(z.re + mirror)), reversed(lanes_at(z.im + mirror))};
        const Complex even{a.re + b.re, a.im - b.im};
        const Complex odd =
            turned({a.im + b.im, b.re - a.re}, lanes_at(turns), lanes_at(turns + kLanes));
        const Complex up = sum(even, odd);
        const Complex down = difference(even, odd);
        store_lanes(up.re * up.re + up.im * up.im, power + k);
        store_lanes(reversed(down.re * down.re + down.im * down.im), power + mirror);
    }
}

RAKS_SIMD_CLONES void power_of(const float* samples, const Plan& plan, float* power) noexcept {
    deal_out(samples, plan);
    const auto [lanes, free] = transform_lanes(plan);
    join_lanes(lanes, free, plan);
    join_real(free, plan, power);
}

float cosine(double turns) { return static_cast<float>(std::cos(2.0 * M_PI * turns)); }
float sine(double turns) { return static_cast<float>(std::sin(2.0 * M_PI * turns)); }

}  // namespace

// All by their angles in whole turns, clockwise.
RealFft::RealFft(std::size_t size) : points_(size / 2), work_(size), other_(size) {
    RAKS_ASSERT(std::has_single_bit(size) && size >= 128 && size <= 65'536);
    for (std::size_t n = points_ / kLanes; n >= 4; n /= 4) {
        for (std::size_t p = 0; p < n / 4; ++p) {
            for (std::size_t power = 1; power <= 3; ++power) {
                const double angle = -static_cast<double>(power * p) / static_cast<double>(n);
                turns_.insert(turns_.end(), {cosine(angle), sine(angle)});
            }
        }
    }
    const auto add_lanes = [](std::vector<float>& row, const auto& angle_of) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            row.push_back(cosine(angle_of(lane)));
        }
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            row.push_back(sine(angle_of(lane)));
        }
    };
    for (std::size_t k = 0; k < points_ / kLanes; ++k) {
        add_lanes(lane_turns_, [&](std::size_t lane) {
            return -static_cast<double>(lane * k) / static_cast<double>(points_);
        });
    }
    for (std::size_t k = 1; k < points_ / 2; k += kLanes) {
        add_lanes(real_turns_, [&](std::size_t lane) {
            return -static_cast<double>(k + lane) / static_cast<double>(size);
        });
    }
}

void RealFft::power_spectrum(std::span<const float> samples,
                             std::span<float> power) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(samples.size() == 2 * points_ && power.size() == points_ + 1);
    const Plan plan{points_,
                    turns_.data(),
                    lane_turns_.data(),
                    real_turns_.data(),
                    {work_.data(), work_.data() + points_},
                    {other_.data(), other_.data() + points_}};
    power_of(samples.data(), plan, power.data());
}

}  // namespace raks::audio
