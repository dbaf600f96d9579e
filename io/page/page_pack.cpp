#include "io/page/page_pack.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include <zlib.h>

#include "core/error.h"

namespace clsurf::io {
namespace {

constexpr int level = 6;
constexpr std::size_t sampled = 20'000;  ///< number of values by which the order is chosen

/// 0, −1, 1, −2 → 0, 1, 2, 3.
std::uint64_t fold(std::int64_t value) {
    return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}

/// The difference of an order at a value; values before the first count as zero.
std::int64_t difference(std::span<const std::int64_t> values, std::size_t i, int order, std::size_t stride) {
    const auto before = [&](std::size_t steps) { return i >= steps * stride ? values[i - steps * stride] : 0; };
    if (order == 0) return values[i];
    if (order == 1) return values[i] - before(1);
    return values[i] - 2 * before(1) + before(2);
}

/// The approximate bits that an order needs, estimated from values spread over the column.
double cost(std::span<const std::int64_t> values, int order, std::size_t stride) {
    const std::size_t step = std::max<std::size_t>(1, values.size() / sampled) | 1;
    double bits = 0;
    for (std::size_t i = 0; i < values.size(); i += step)
        bits += std::bit_width(fold(difference(values, i, order, stride)));
    return bits;
}

std::string deflated(std::string_view bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string packed(size, '\0');
    const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), level);
    if (code != Z_OK) throw SystemError("cannot compress: no memory");
    packed.resize(size);
    return packed;
}

}  // namespace

PackedColumn pack_integers(std::span<const std::int64_t> values, int stride) {
    PackedColumn packed;
    packed.count = values.size();
    packed.stride = stride;
    const auto apart = static_cast<std::size_t>(stride);
    double least = cost(values, 0, apart);
    for (const int order : {1, 2}) {
        const double bits = cost(values, order, apart);
        if (bits >= least) continue;
        least = bits;
        packed.order = order;
    }
    std::vector<std::uint64_t> folded(values.size());
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        folded[i] = fold(difference(values, i, packed.order, apart));
        all |= folded[i];
    }
    packed.planes = (std::bit_width(all) + 7) / 8;
    std::string bytes(values.size() * static_cast<std::size_t>(packed.planes), '\0');
    for (int plane = 0; plane < packed.planes; ++plane) {
        char* out = bytes.data() + static_cast<std::size_t>(plane) * values.size();
        for (std::size_t i = 0; i < values.size(); ++i) out[i] = static_cast<char>(folded[i] >> (8 * plane) & 0xff);
    }
    packed.base64 = to_base64(deflated(bytes));
    return packed;
}

PackedColumn pack_bytes(std::string_view bytes) {
    PackedColumn packed;
    packed.count = bytes.size();
    packed.planes = 1;
    packed.base64 = to_base64(deflated(bytes));
    return packed;
}

std::string to_base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const auto byte = [&](std::size_t k) {
            return k < left ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) : 0U;
        };
        const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        text += digits[bits >> 18];
        text += digits[bits >> 12 & 63];
        text += left > 1 ? digits[bits >> 6 & 63] : '=';
        text += left > 2 ? digits[bits & 63] : '=';
    }
    return text;
}

}  // namespace clsurf::io
