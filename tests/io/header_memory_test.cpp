// No field of a header may request more memory than the file can need: crafted files are read in a separate
// process with limited and measured memory.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lzma.h>
#include <zlib.h>

#include "fuzz/fuzz_input.h"
#include "io/files/crc32c.h"
#include "support/temporary_folder.h"

namespace clsurf::io::header_memory_test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // with shadow memory neither limit nor measurement is meaningful
#else
constexpr bool sanitized = false;
#endif

constexpr rlim_t most_address_space = rlim_t{2} << 30;
constexpr long most_growth = 24 * 1024;  ///< largest growth of the resident memory [KiB], for any small file
constexpr double huge = 9e18;

/// Reads in a child process. Returns how many KiB its memory grew, −1: it ended without an answer.
template <typename Read>
long growth_of(const Read& read) {
    const pid_t child = ::fork();
    if (child == 0) {
        struct rusage before {};
        ::getrusage(RUSAGE_SELF, &before);
        const rlimit limit{most_address_space, most_address_space};
        ::setrlimit(RLIMIT_AS, &limit);
        try {
            (void)fuzz::answer(read);
        } catch (...) {
            ::_exit(255);  // out of memory
        }
        struct rusage after {};
        ::getrusage(RUSAGE_SELF, &after);
        ::_exit(static_cast<int>(std::clamp<long>((after.ru_maxrss - before.ru_maxrss) / 1024, 0, 254)));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) < 255 ? WEXITSTATUS(status) * 1024L : -1;
}

/// Opens any log, packed or not, and reads all its values.
void expect_small(const std::string& bytes, const std::string& what, const LogOptions& given = {}) {
    if (sanitized) GTEST_SKIP() << "not under a sanitizer";
    LogOptions options = given;
    if (!options.period) options.period = 0.001;
    const long growth = growth_of([&] { fuzz::look_at(open_log(unpacked(fuzz::source_of(bytes)), options)); });
    EXPECT_GE(growth, 0) << what << ": no answer";
    EXPECT_LE(growth, most_growth) << what;
}

template <typename Value>
void put(std::string& bytes, std::size_t at, Value value) {
    if (bytes.size() < at + sizeof(value)) bytes.resize(at + sizeof(value), '\0');
    std::memcpy(bytes.data() + at, &value, sizeof(value));
}

std::uint32_t u32_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

constexpr std::size_t channel_bytes = 48, first_channel = 48;

/// Forty records of cmd.x, cmd.y and line.
std::string small_biip() {
    constexpr std::uint32_t header = first_channel + 3 * channel_bytes;
    constexpr std::uint32_t record = 20;
    std::string bytes("\x89\x42\x49\x49\x50\x0d\x0a\x1a", 8);
    put<std::uint16_t>(bytes, 8, 1);
    put<std::uint32_t>(bytes, 12, header);
    put<std::uint32_t>(bytes, 16, record);
    put<std::uint32_t>(bytes, 20, 3);
    put<std::uint64_t>(bytes, 24, 40);
    put<double>(bytes, 32, 0.001);
    put<std::uint32_t>(bytes, 40, 0);
    const char* names[] = {"cmd.x", "cmd.y", "line"};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = first_channel + k * channel_bytes;
        put<double>(bytes, at + 40, 1.0);
        std::memcpy(bytes.data() + at, names[k], std::strlen(names[k]));
        bytes[at + 32] = k < 2 ? 10 : 6;
        put<std::uint32_t>(bytes, at + 36, static_cast<std::uint32_t>(8 * k));
    }
    bytes.resize(header + 40 * record, '\x01');
    return bytes;
}

/// Updates the checksum of the header; a header length beyond the end of the file keeps its old one.
std::string sealed(std::string bytes) {
    const std::size_t header = u32_at(bytes, 12);
    put<std::uint32_t>(bytes, 44, 0);
    if (header > bytes.size() || header < first_channel) return bytes;
    std::string counted = bytes.substr(0, header);
    put<std::uint64_t>(counted, 24, 0);
    put<std::uint32_t>(bytes, 44, crc32c({reinterpret_cast<const std::byte*>(counted.data()), counted.size()}));
    return bytes;
}

TEST(HeaderMemory, TheBiipThatIsCraftedCanBeRead) {
    const std::string bytes = sealed(small_biip());
    const Log log = open_log(fuzz::source_of(bytes), {});
    EXPECT_EQ(log.records, 40);
    EXPECT_EQ(log.channels.size(), 3u);
    EXPECT_TRUE(log.closed);
}

TEST(HeaderMemory, OfABiipWhateverItsFieldsSay) {
    const std::vector<std::uint64_t> numbers{0,
                                             1,
                                             7,
                                             8,
                                             255,
                                             65535,
                                             (1u << 24) + 8,
                                             0x7ffffff8,
                                             0x7fffffff,
                                             0x80000000,
                                             0xfffffff8,
                                             0xffffffff,
                                             std::uint64_t{1} << 40,
                                             std::uint64_t{1} << 62,
                                             std::numeric_limits<std::uint64_t>::max()};
    for (const std::uint64_t number : numbers) {
        for (const std::size_t at :
             {12u, 16u, 20u, 40u, 84u, 132u}) {  // header, record, channels, metadata, offsets of channels
            std::string bytes = small_biip();
            put<std::uint32_t>(bytes, at, static_cast<std::uint32_t>(number));
            expect_small(sealed(bytes), fmt::format("byte {}: {}", at, number));
        }
        std::string bytes = small_biip();
        put<std::uint64_t>(bytes, 24, number);
        expect_small(sealed(bytes), fmt::format("record count {}", number));
        bytes = small_biip();
        bytes[first_channel + 32] = static_cast<char>(number);
        expect_small(sealed(bytes), fmt::format("type {}", number));
    }
    for (const double number : {0.0, -1.0, 1e-323, 1e-300, 1e300, std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()}) {
        for (const std::size_t at : {std::size_t{32}, first_channel + 40}) {
            std::string bytes = small_biip();
            put<double>(bytes, at, number);
            expect_small(sealed(bytes), fmt::format("byte {}: {}", at, number));
        }
    }
}

TEST(HeaderMemory, OfPackedDataWhateverTheySayToUnpackTo) {
    const std::string text = "cmd.x,cmd.y\n1,2\n3,4\n";
    // gzip: the length at its end.
    std::string gzip(256, '\0');
    z_stream stream{};
    ASSERT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(gzip.data());
    stream.avail_out = static_cast<uInt>(gzip.size());
    ASSERT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    gzip.resize(stream.total_out);
    deflateEnd(&stream);
    expect_small(gzip, "gzip as it is");
    put<std::uint32_t>(gzip, gzip.size() - 4, 0xffffffff);
    expect_small(gzip, "gzip of 4 GiB");
    // zstd: one raw block, in one segment of 2^40 and 2^62 bytes; then windows of up to 3.75 · 2^41.
    const auto block = [&](std::string head) {
        const auto header = static_cast<std::uint32_t>(text.size() << 3 | 1);
        head.append(reinterpret_cast<const char*>(&header), 3);
        return head + text;
    };
    for (const int power : {20, 31, 40, 62}) {
        std::string head("\x28\xb5\x2f\xfd\xe0", 5);
        put<std::uint64_t>(head, 5, std::uint64_t{1} << power);
        expect_small(block(head), fmt::format("zstd of 2^{} bytes", power));
    }
    for (const int window : {0, 0x50, 0x88, 0x90, 0xa8, 0xf8, 0xff})
        expect_small(block(std::string("\x28\xb5\x2f\xfd\x00", 5) + static_cast<char>(window)),
                     fmt::format("zstd, window {:#x}", window));
    // xz: the dictionary size in the block header, which has its own checksum.
    std::string xz(256, '\0');
    std::size_t size = 0;
    ASSERT_EQ(lzma_easy_buffer_encode(0, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(text.data()),
                                      text.size(), reinterpret_cast<std::uint8_t*>(xz.data()), &size, xz.size()),
              LZMA_OK);
    xz.resize(size);
    constexpr std::size_t block_header = 12;
    const std::size_t header_bytes = 4 * (static_cast<unsigned char>(xz[block_header]) + 1u);
    const std::size_t dictionary = xz.find("\x21\x01", block_header) + 2;
    ASSERT_LT(dictionary, block_header + header_bytes);
    for (const int bits : {0, 20, 31, 36, 40}) {
        xz[dictionary] = static_cast<char>(bits);
        put<std::uint32_t>(
            xz, block_header + header_bytes - 4,
            lzma_crc32(reinterpret_cast<const std::uint8_t*>(xz.data()) + block_header, header_bytes - 4, 0));
        expect_small(xz, fmt::format("xz, dictionary {}", bits));
    }
}

TEST(HeaderMemory, OfALayoutWhateverItSays) {
    const test::TemporaryFolder folder;
    for (const char* key : {"header_bytes", "record_bytes", "offset", "period_s", "scale"}) {
        for (const char* value : {"0", "1", "4294967296", "9223372036854775807", "1e-323", "1e300"}) {
            const auto of = [&](const char* name, const char* usual) {
                return fmt::format("{} = {}\n", name, std::string(name) == key ? value : usual);
            };
            LogOptions options;
            options.layout =
                folder.write("layout.toml", "[log]\n" + of("header_bytes", "0") + of("record_bytes", "16") +
                                                of("period_s", "0.001") +
                                                "[[channel]]\nname = \"cmd.x\"\ntype = \"f64\"\nunit = \"mm\"\n" +
                                                of("offset", "8") + of("scale", "1.0"));
            expect_small(std::string(1600, '\x01'), fmt::format("{} = {}", key, value), options);
        }
    }
}

TEST(HeaderMemory, OfTextLogsWhateverTheirNumbersSay) {
    for (const double number : {0.0, -1.0, 1e-323, 1e-9, 2147483648.0, 4294967296.0, huge, 1e300}) {
        expect_small(
            fmt::format(
                "{{\"Header\":{{\"CycleTimeMs\":{0},\"SignalListHFData\":[{{\"Name\":\"CYCLE\",\"Axis\":\"Cycle\"}},{{\"Name\":\"DES_POS|1\",\"Axis\":\"X1\"}}]}},\n"
                "\"Payload\":[{{\"HFBlockEvent\":{{\"HFProbeCounter\":{0},\"SeekOffset\":{0}}}}},\n"
                "{{\"HFCallEvent\":{{\"HFProbeCounter\":1,\"SeekOffset\":{0},\"CallStackLevel\":{0},\"Path\":\"/_P\"}}}},\n"
                "{{\"HFData\":[[1,1.5],[{0},1.6],[3,1.7]]}}],\"Footer\":null}}\n",
                number),
            fmt::format("Edge, {}", number));
        expect_small(
            fmt::format(
                "<?xml version=\"1.0\"?>\n<traceSession version=\"2.0\"><traceData dataFrames=\"{0}\"><dataFrame><frameHeader dropOuts=\"{0}\"/>\n"
                "<dataSignal id=\"f1\" name=\"/Nck/!SEMA/cmdContrPos [u1, 1]\" interval=\"{0}\"/>\n"
                "<rec time=\"0\" f1=\"1.5\"/><rec time=\"{0}\" f1=\"{0}\"/><rec time=\"1\" f1=\"2\"/></dataFrame></traceData></traceSession>\n",
                number),
            fmt::format("trace, {}", number));
        expect_small(
            fmt::format("# Sampling period is {0} ns\njoint.0.motor-pos-cmd;motion.program-line\n+1.5;{0}\n+1.75;8\n",
                        number),
            fmt::format("halscope, {}", number));
        expect_small(
            fmt::format(
                "Name\tscope\nFile\tscope.csv\nStarttime of export\t{0}\tMontag\n\n\nName\tcmd.x\tName\tload\nSampleTime[ms]\t{0}\tSampleTime[ms]\t2\n\n"
                "0\t1.5\t0\t17\n{0}\t1.6\t2\t18\nEOF\n",
                number),
            fmt::format("TwinCAT, {}", number));
        expect_small(fmt::format("time[s],cmd.x[mm],line\n0,1,1\n{0},{0},{0}\n0.002,2,3\n", number),
                     fmt::format("CSV, {}", number));
        LogOptions options;
        options.period = number;
        expect_small("cmd.x,cmd.y\n1,2\n3,4\n", fmt::format("--period {}", number), options);
    }
}

TEST(HeaderMemory, OfMetadataWhateverItSays) {
    for (const std::string_view metadata :
         {R"({"programs":[{"name":"a","size":1e300}]})",
          R"({"programs":[{"size":18446744073709551615}],"work_offset":[1e300,1e300,1e300]})",
          R"({"work_offset":[1,2]})"}) {
        std::string bytes = small_biip();
        std::string padded(metadata);
        padded.resize((padded.size() + 7) / 8 * 8, '\0');
        const std::uint32_t header = u32_at(bytes, 12);
        bytes.insert(header, padded);
        put<std::uint32_t>(bytes, 12, header + static_cast<std::uint32_t>(padded.size()));
        put<std::uint32_t>(bytes, 40, static_cast<std::uint32_t>(metadata.size()));
        expect_small(sealed(bytes), std::string(metadata));
    }
}

}  // namespace
}  // namespace clsurf::io::header_memory_test
