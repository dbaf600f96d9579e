#include "io/files/compressed.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>

#include <gtest/gtest.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include "core/error.h"
#include "io/formats/log_format.h"
#include "io/readers/program_file.h"
#include "support/temporary_folder.h"

namespace clsurf::io::compressed_test {
namespace {

std::string gzip_at(int level, const std::string& text) {
    z_stream stream{};
    deflateInit2(&stream, level, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY);
    std::string out(deflateBound(&stream, text.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

std::string gzip(const std::string& text) { return gzip_at(Z_BEST_COMPRESSION, text); }
std::string stored_gzip(const std::string& text) { return gzip_at(Z_NO_COMPRESSION, text); }

std::string zstd(const std::string& text) {
    std::string out(ZSTD_compressBound(text.size()), '\0');
    out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), 3));
    return out;
}

std::string xz(const std::string& text) {
    std::string out(lzma_stream_buffer_bound(text.size()), '\0');
    std::size_t size = 0;
    EXPECT_EQ(lzma_easy_buffer_encode(6, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(text.data()),
                                      text.size(), reinterpret_cast<std::uint8_t*>(out.data()), &size, out.size()),
              LZMA_OK);
    out.resize(size);
    return out;
}

Source source(const std::string& bytes) {
    return {"run", {reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}, nullptr};
}

struct Packer {
    const char* name;
    std::function<std::string(const std::string&)> pack;
};
const Packer packers[] = {{"gzip", gzip}, {"zstd", zstd}, {"xz", xz}};

/// Incompressible bytes, which packers store unchanged.
std::string noise() {
    std::mt19937_64 random(5);
    std::string bytes(4000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    return bytes;
}

const std::string text = "time,cmd.x,line\n0,1.5,3\n0.002,2,3\n0.004,2.5,4\n";

TEST(Compressed, UnpacksWhatWasPacked) {
    const std::string large(300'000, 'x');
    for (const Packer& packer : packers) {
        EXPECT_EQ(unpacked(source(packer.pack(text))).text(), text) << packer.name;
        EXPECT_EQ(unpacked(source(packer.pack(large))).text(), large) << packer.name;
        EXPECT_EQ(unpacked(source(packer.pack(""))).text(), "") << packer.name;
    }
    EXPECT_EQ(unpacked(source(text)).text(), text);
}

TEST(Compressed, JoinsMembersThatFollowEachOther) {
    for (const Packer& packer : packers) {
        EXPECT_EQ(unpacked(source(packer.pack("ab") + packer.pack("cd"))).text(), "abcd") << packer.name;
    }
}

TEST(Compressed, ReadsZstandardBehindASkippableFrame) {
    const auto zstd = std::find_if(std::begin(packers), std::end(packers),
                                   [](const Packer& packer) { return std::string(packer.name) == "zstd"; });
    ASSERT_NE(zstd, std::end(packers));
    EXPECT_EQ(unpacked(source(std::string("\x50\x2a\x4d\x18\x04\0\0\0abcd", 12) + zstd->pack(text))).text(), text);
}

TEST(Compressed, NamesThePlaceWhereTheDataAreCut) {
    for (const Packer& packer : packers) {
        const std::string whole = packer.pack(text);
        for (std::size_t size = 6; size < whole.size(); ++size) {
            try {
                (void)unpacked(source(whole.substr(0, size)));
                FAIL() << packer.name << " of " << size << " bytes";
            } catch (const InputError& error) {
                EXPECT_EQ(error.diagnostic().where.kind, Place::Kind::byte) << packer.name;
                EXPECT_LE(error.diagnostic().where.number, size) << packer.name;
            }
        }
    }
}

TEST(Compressed, SurvivesDamageOfAnyByte) {
    for (const Packer& packer : packers) {
        const std::string whole = packer.pack(text);
        for (std::size_t i = 0; i < whole.size(); ++i) {
            std::string damaged = whole;
            damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
            try {
                (void)unpacked(source(damaged));
            } catch (const InputError&) {  // most damage is detected; nothing worse than this error may happen
            }
        }
    }
}

/// A byte of the text itself in an uncompressed block: the data unpack, and only the checksum is wrong.
TEST(Compressed, FindsDamageThatUnpacks) {
    for (const Packer& packer : {Packer{"gzip", stored_gzip}, Packer{"xz", xz}}) {
        std::string packed = packer.pack(noise());
        const std::size_t at = packed.find(noise().substr(2000, 20));
        ASSERT_NE(at, std::string::npos) << packer.name << " does not store it";
        EXPECT_EQ(unpacked(source(packed)).text(), noise());
        packed[at + 3] = static_cast<char>(packed[at + 3] ^ 1);
        EXPECT_THROW((void)unpacked(source(packed)), InputError) << packer.name;
    }
}

TEST(Compressed, StopsABomb) {
    std::string zeros = zstd(std::string(std::size_t{64} << 20, '\0'));
    std::string bomb;
    for (int i = 0; i < 6; ++i) bomb += zeros;  // 384 MiB
    try {
        (void)unpacked(source(bomb));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("decompression bomb"), std::string::npos);
    }
}

TEST(Compressed, LogsAndProgramsComeCompressed) {
    const test::TemporaryFolder folder;
    for (const Packer& packer : packers) {
        const Log log = open_log(folder.write("run.log", packer.pack(text)), LogOptions{});
        EXPECT_EQ(log.records, 3) << packer.name;
        const Program program =
            read_program(folder.write("part", packer.pack("G21 G90\nG1 X10 F100\nM30\n")), ProgramOptions{});
        EXPECT_EQ(program.motions.size(), 1u) << packer.name;
    }
}

}  // namespace
}  // namespace clsurf::io::compressed_test
