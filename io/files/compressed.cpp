#include "io/files/compressed.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include "core/error.h"

namespace clsurf::io {
namespace {

// A log compresses to a tenth, rarely to a hundredth (a machine at rest). A few hundred MiB are always allowed,
// so that small files pass at any ratio.
constexpr std::size_t free_bytes = std::size_t{256} << 20;
constexpr std::size_t most_ratio = 100;
constexpr std::size_t first_bytes = std::size_t{1} << 16;
constexpr std::uint64_t most_decoder_memory = std::uint64_t{256} << 20;  ///< an xz header may request 4 GiB
constexpr int gzip_window = 15 + 16;                                     ///< 32 KiB, gzip wrapper only

/// The unpacked bytes. The buffer grows as needed, up to the limit for the input.
class Unpacked {
public:
    explicit Unpacked(const Source& packed) : packed_(packed), most_(free_bytes + most_ratio * packed.bytes.size()) {}

    /// Space for more bytes after the present ones. Throws InputError at the limit.
    std::span<std::byte> room() {
        if (used_ == bytes_->size()) {
            if (used_ >= most_) {
                throw InputError(
                    Place::of_file(packed_.name),
                    fmt::format("unpacks to more than {} MiB from {} bytes: this looks like a decompression bomb",
                                most_ >> 20, packed_.bytes.size()),
                    "if it is not, unpack it and pass the result");
            }
            bytes_->resize(std::min(most_, std::max(first_bytes, 2 * used_)));
        }
        return std::span(*bytes_).subspan(used_);
    }
    void grow(std::size_t count) { used_ += count; }

    [[noreturn]] void fail(std::size_t at, const std::string& what) const {
        throw InputError(Place::of_byte(packed_.name, at), what);
    }

    [[nodiscard]] Source finish() {
        bytes_->resize(used_);
        return {packed_.name, std::span<const std::byte>(*bytes_), bytes_};
    }

private:
    const Source& packed_;
    std::size_t most_;
    std::size_t used_ = 0;
    std::shared_ptr<std::vector<std::byte>> bytes_ = std::make_shared<std::vector<std::byte>>();
};

constexpr const char* cut_short = "the compressed data end here, in the middle of the stream";

Source unpack_gzip(const Source& packed) {
    Unpacked out(packed);
    z_stream stream{};
    if (inflateInit2(&stream, gzip_window) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, inflateEnd);
    std::size_t at = 0;
    for (;;) {
        const std::span<const std::byte> rest = packed.bytes.subspan(at);
        const std::span<std::byte> room = out.room();
        constexpr std::size_t most = std::numeric_limits<uInt>::max();
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(rest.data()));
        stream.avail_in = static_cast<uInt>(std::min(most, rest.size()));
        stream.next_out = reinterpret_cast<Bytef*>(room.data());
        stream.avail_out = static_cast<uInt>(std::min(most, room.size()));
        const uInt given = stream.avail_in;
        const uInt free = stream.avail_out;
        const int result = inflate(&stream, Z_NO_FLUSH);
        at += given - stream.avail_in;
        out.grow(free - stream.avail_out);
        if (result == Z_STREAM_END) {
            // Another member follows, or zeros that pad a tape block.
            while (at < packed.bytes.size() && packed.bytes[at] == std::byte{0}) ++at;
            if (at == packed.bytes.size()) return out.finish();
            inflateReset(&stream);
        } else if (result == Z_MEM_ERROR) {
            throw std::bad_alloc();
        } else if (result != Z_OK && result != Z_BUF_ERROR) {
            out.fail(at, fmt::format("damaged gzip data: {}", stream.msg != nullptr ? stream.msg : "not a stream"));
        } else if (at == packed.bytes.size() && stream.avail_out > 0) {
            out.fail(at, cut_short);
        }
    }
}

Source unpack_zstd(const Source& packed) {
    Unpacked out(packed);
    const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(), ZSTD_freeDStream);
    if (!stream) throw std::bad_alloc();
    ZSTD_inBuffer in{packed.bytes.data(), packed.bytes.size(), 0};
    std::size_t wanted = 1;  // 0: at the end of a frame
    while (in.pos < in.size || wanted != 0) {
        const std::span<std::byte> room = out.room();
        ZSTD_outBuffer to{room.data(), room.size(), 0};
        const std::size_t before = in.pos;
        wanted = ZSTD_decompressStream(stream.get(), &to, &in);
        if (ZSTD_isError(wanted) != 0)
            out.fail(in.pos, fmt::format("damaged Zstandard data: {}", ZSTD_getErrorName(wanted)));
        out.grow(to.pos);
        if (wanted != 0 && in.pos == in.size && in.pos == before && to.pos < room.size()) out.fail(in.pos, cut_short);
    }
    return out.finish();
}

Source unpack_xz(const Source& packed) {
    Unpacked out(packed);
    lzma_stream stream = LZMA_STREAM_INIT;
    if (lzma_stream_decoder(&stream, most_decoder_memory, LZMA_CONCATENATED) != LZMA_OK) throw std::bad_alloc();
    const std::unique_ptr<lzma_stream, decltype(&lzma_end)> owner(&stream, lzma_end);
    stream.next_in = reinterpret_cast<const std::uint8_t*>(packed.bytes.data());
    stream.avail_in = packed.bytes.size();
    for (;;) {
        const std::span<std::byte> room = out.room();
        stream.next_out = reinterpret_cast<std::uint8_t*>(room.data());
        stream.avail_out = room.size();
        const lzma_ret result = lzma_code(&stream, LZMA_FINISH);
        out.grow(room.size() - stream.avail_out);
        const std::size_t at = packed.bytes.size() - stream.avail_in;
        switch (result) {
            case LZMA_OK: continue;
            case LZMA_STREAM_END: return out.finish();
            case LZMA_BUF_ERROR: out.fail(at, cut_short);
            case LZMA_MEM_ERROR: throw std::bad_alloc();
            case LZMA_MEMLIMIT_ERROR:
                out.fail(at,
                         fmt::format("the xz header asks for more than {} MiB to unpack", most_decoder_memory >> 20));
            default: out.fail(at, "damaged xz data");
        }
    }
}

struct Packing {
    std::array<unsigned char, 6> magic;
    std::size_t magic_bytes;
    Source (*unpack)(const Source& packed);
};

constexpr auto packings = std::to_array<Packing>({
    {{0x1f, 0x8b, 0x08}, 3, unpack_gzip},
    {{0x28, 0xb5, 0x2f, 0xfd}, 4, unpack_zstd},
    {{0x50, 0x2a, 0x4d, 0x18}, 4, unpack_zstd},  // a skippable frame, with which pzstd begins
    {{0xfd, '7', 'z', 'X', 'Z', 0x00}, 6, unpack_xz},
});

/// The format that packed the bytes; nullptr: unknown.
const Packing* packing_of(std::span<const std::byte> bytes) {
    for (const Packing& packing : packings) {
        if (bytes.size() < packing.magic_bytes) continue;
        const auto same = [](unsigned char magic, std::byte b) { return std::byte{magic} == b; };
        if (std::equal(packing.magic.begin(), packing.magic.begin() + static_cast<std::ptrdiff_t>(packing.magic_bytes),
                       bytes.begin(), same)) {
            return &packing;
        }
    }
    return nullptr;
}

}  // namespace

Source unpacked(const Source& source) {
    const Packing* packing = packing_of(source.bytes);
    return packing != nullptr ? packing->unpack(source) : source;
}

bool is_compressed(std::span<const std::byte> bytes) { return packing_of(bytes) != nullptr; }

Source open_source(const std::string& path) { return unpacked(map_file(path)); }

}  // namespace clsurf::io
