// BIIP v1, little-endian:
//   0 magic 89 42 49 49 50 0D 0A 1A · 8 u16 major · 10 u16 minor · 12 u32 header_bytes (multiple of 8)
//   16 u32 record_bytes · 20 u32 channel_count · 24 u64 record_count (0 while open) · 32 f64 period_s
//   40 u32 metadata_bytes · 44 u32 CRC-32C of [0, header_bytes) with itself and record_count zero
//   48 channel table: 48 bytes each: name char[24], unit char[8], u8 type, 3 zero bytes, u32 offset,
//   f64 scale · metadata (JSON) · zero padding · records from header_bytes on.
#include "io/formats/biip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/block.h"
#include "core/error.h"
#include "io/files/crc32c.h"
#include "io/files/json_value.h"
#include "io/formats/known_formats.h"
#include "io/formats/owned_columns.h"

namespace clsurf::io {
namespace {

static_assert(std::endian::native == std::endian::little, "BIIP is read in place");

constexpr std::array<unsigned char, 8> magic{0x89, 'B', 'I', 'I', 'P', 0x0D, 0x0A, 0x1A};
constexpr std::size_t fixed_bytes = 48;
constexpr std::size_t count_at = 24;
constexpr std::size_t entry_bytes = 48;
constexpr std::size_t name_bytes = 24;
constexpr std::size_t unit_bytes = 8;

template <typename T>
T get(std::span<const std::byte> bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::string padded_text(std::span<const std::byte> bytes) {
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t end = text.find('\0');
    if (end != std::string::npos) text.resize(end);
    return text;
}

class Header {
public:
    explicit Header(const Source& source) : source_(source), bytes_(source.bytes) {
        if (bytes_.size() < fixed_bytes) {
            fail(0, fmt::format("file of {} bytes is too short for a BIIP header of {} bytes", bytes_.size(),
                                fixed_bytes));
        }
        major_ = get<std::uint16_t>(bytes_, 8);
        minor_ = get<std::uint16_t>(bytes_, 10);
        header_bytes_ = get<std::uint32_t>(bytes_, 12);
        record_bytes_ = get<std::uint32_t>(bytes_, 16);
        channel_count_ = get<std::uint32_t>(bytes_, 20);
        record_count_ = get<std::uint64_t>(bytes_, count_at);
        period_ = get<double>(bytes_, 32);
        metadata_bytes_ = get<std::uint32_t>(bytes_, 40);
        if (major_ != 1) fail(8, fmt::format("BIIP version {}.{}, expected 1.x", major_, minor_));
        const std::uint64_t needed = fixed_bytes + std::uint64_t{channel_count_} * entry_bytes + metadata_bytes_;
        if (header_bytes_ < needed || header_bytes_ % 8 != 0) {
            fail(
                12,
                fmt::format(
                    "header of {} bytes, expected a multiple of 8 that holds {} channels and {} bytes of metadata ({} bytes)",
                    header_bytes_, channel_count_, metadata_bytes_, needed));
        }
        if (header_bytes_ > bytes_.size()) {
            fail(12, fmt::format("header of {} bytes in a file of {} bytes: the file is cut", header_bytes_,
                                 bytes_.size()));
        }
        check_crc();
        if (channel_count_ == 0 || record_bytes_ == 0) fail(16, "no channels: nothing was recorded");
        if (!(period_ > 0) || !std::isfinite(period_))
            fail(32, fmt::format("period of {} s, expected more than 0", period_));
    }

    [[noreturn]] void fail(std::size_t byte, const std::string& what) const {
        throw InputError(Place::of_byte(source_.name, byte), what);
    }

    [[nodiscard]] Channel channel(std::uint32_t index, PointIndex records) const {
        const std::size_t at = fixed_bytes + std::size_t{index} * entry_bytes;
        Channel channel;
        channel.name = padded_text(bytes_.subspan(at, name_bytes));
        channel.unit = padded_text(bytes_.subspan(at + name_bytes, unit_bytes));
        const auto type = get<std::uint8_t>(bytes_, at + 32);
        const auto offset = get<std::uint32_t>(bytes_, at + 36);
        if (channel.name.empty()) fail(at, fmt::format("channel {} has no name", index));
        if (type < 1 || type > 10)
            fail(at + 32, fmt::format("channel '{}' has type {}, expected 1 … 10", channel.name, type));
        channel.values.type = static_cast<ScalarType>(type);
        if (std::uint64_t{offset} + size_of(channel.values.type) > record_bytes_) {
            fail(at + 36,
                 fmt::format("channel '{}' at byte {} of a record of {} bytes", channel.name, offset, record_bytes_));
        }
        channel.values.scale = get<double>(bytes_, at + 40);
        if (!std::isfinite(channel.values.scale))
            fail(at + 40, fmt::format("channel '{}' has scale {}", channel.name, channel.values.scale));
        channel.values.first = bytes_.data() + header_bytes_ + offset;
        channel.values.stride = record_bytes_;
        channel.values.count = records;
        return channel;
    }

    [[nodiscard]] std::string metadata() const {
        const std::size_t at = fixed_bytes + std::size_t{channel_count_} * entry_bytes;
        return padded_text(bytes_.subspan(at, metadata_bytes_));
    }
    [[nodiscard]] std::uint64_t records_there() const { return (bytes_.size() - header_bytes_) / record_bytes_; }
    [[nodiscard]] std::uint64_t bytes_left() const { return (bytes_.size() - header_bytes_) % record_bytes_; }
    [[nodiscard]] std::uint64_t record_count() const { return record_count_; }
    [[nodiscard]] std::uint32_t channel_count() const { return channel_count_; }
    [[nodiscard]] double period() const { return period_; }
    [[nodiscard]] std::uint16_t minor() const { return minor_; }
    [[nodiscard]] RecordFrame frame() const { return {header_bytes_, record_bytes_, false, count_at}; }

private:
    void check_crc() const {
        const auto stored = get<std::uint32_t>(bytes_, 44);
        const std::array<std::byte, 8> zeros{};
        const std::uint32_t crc =
            crc32c({bytes_.subspan(0, 24), std::span(zeros).first(8), bytes_.subspan(32, 12), std::span(zeros).first(4),
                    bytes_.subspan(fixed_bytes, header_bytes_ - fixed_bytes)});
        if (crc != stored)
            fail(44, fmt::format("header checksum {:08x}, computed {:08x}: the header is damaged", stored, crc));
    }

    const Source& source_;
    std::span<const std::byte> bytes_;
    std::uint16_t major_ = 0, minor_ = 0;
    std::uint32_t header_bytes_ = 0, record_bytes_ = 0, channel_count_ = 0, metadata_bytes_ = 0;
    std::uint64_t record_count_ = 0;
    double period_ = 0;
};

void read_metadata(Log& log, const Source& source) {
    if (log.metadata.empty()) return;
    const Json json = parse_bounded(log.metadata);
    if (!json.is_object()) {
        log.diagnostics.add({Severity::warning,
                             "log.metadata",
                             Place::of_file(source.name),
                             "the metadata is not a JSON object of at most 64 levels and 10,000 keys and is left out",
                             {}});
        log.metadata.clear();
        return;
    }
    if (const auto programs = json.find("programs"); programs != json.end() && programs->is_array()) {
        for (const Json& entry : *programs) {
            if (!entry.is_object()) continue;
            const auto text = [&](const char* key) {
                const auto found = entry.find(key);
                return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
            };
            const auto size = entry.find("size");
            log.programs.push_back({text("name"), text("sha256"), {}, text("sha256_lf")});
            if (size != entry.end() && size->is_number_unsigned())
                log.programs.back().size = size->get<std::uint64_t>();
        }
    }
    if (const auto offset = json.find("work_offset");
        offset != json.end() && offset->is_array() && offset->size() >= 3) {
        Vec3 value = Vec3::Zero();
        bool numbers = true;
        for (int axis = 0; axis < 3; ++axis) {
            const Json& part = (*offset)[static_cast<std::size_t>(axis)];
            numbers = numbers && part.is_number();
            if (part.is_number()) value[axis] = part.get<double>();
        }
        if (numbers) log.work_offset = value;
        if (numbers && offset->size() > 3 && (*offset)[3].is_number()) log.work_rotation = (*offset)[3].get<double>();
    }
}

int probe_biip(std::span<const std::byte> head, const LogOptions&) {
    if (head.size() < magic.size()) return 0;
    if (std::memcmp(head.data(), magic.data(), magic.size()) == 0) return 100;
    // Damaged by a copy in text mode: still recognised as BIIP; opening it reports the damage.
    return std::memcmp(head.data(), magic.data(), 5) == 0 ? 90 : 0;
}

void refuse_damaged_signature(const Source& source) {
    if (source.bytes.size() >= 8 && std::memcmp(source.bytes.data(), magic.data(), magic.size()) != 0) {
        throw InputError(Place::of_byte(source.name, 5), "the BIIP signature is damaged, as after a copy in text mode",
                         "copy the log in binary mode");
    }
}

RecordFrame frame_biip(const Source& beginning, const LogOptions&) {
    refuse_damaged_signature(beginning);
    return Header(beginning).frame();
}

/// Checks every rule of the format page; channels are views on the mapping. Throws InputError; adds
/// `log.unclosed`, `log.minor-version`.
Log open_biip(const Source& source, const LogOptions& options) {
    refuse_damaged_signature(source);
    const Header header(source);
    refuse_too_many_channels(header.channel_count(), Place::of_file(source.name));
    Log log;
    log.name = source.name;
    log.format = "biip";
    log.period = options.period.value_or(header.period());
    log.keep_alive = source.keep_alive;
    const std::uint64_t there = header.records_there();
    const std::uint64_t said = header.record_count();
    const bool whole = said == there && header.bytes_left() == 0;
    log.closed = whole;
    log.records = static_cast<PointIndex>(there);
    if (!whole) {
        log.diagnostics.add(
            {Severity::warning,
             "log.unclosed",
             Place::of_byte(source.name, count_at),
             fmt::format(
                 "the log was not closed: its header gives {} records, the file has {} complete ones and {} more bytes",
                 said, there, header.bytes_left()),
             {}});
    }
    if (header.minor() != 0) {
        log.diagnostics.add({Severity::note,
                             "log.minor-version",
                             Place::of_byte(source.name, 10),
                             fmt::format("BIIP 1.{}: features newer than 1.0 are ignored", header.minor()),
                             {}});
    }
    for (std::uint32_t i = 0; i < header.channel_count(); ++i) {
        Channel channel = header.channel(i, log.records);
        if (log.find(channel.name) != nullptr) {
            log.diagnostics.add({Severity::warning,
                                 "log.duplicate-channel",
                                 Place::of_byte(source.name, fixed_bytes + i * entry_bytes),
                                 fmt::format("channel '{}' appears twice; the first one is used", channel.name),
                                 {}});
            continue;
        }
        log.channels.push_back(std::move(channel));
    }
    log.metadata = header.metadata();
    read_metadata(log, source);
    return log;
}

template <typename T>
void put(std::string& bytes, std::size_t at, const T& value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Copies values of one channel into records, in their stored type or as doubles.
void store(const ChannelView& view, std::size_t offset, PointIndex begin, PointIndex end,
           std::vector<std::byte>& records, std::size_t record_bytes, std::vector<double>& scratch) {
    const std::size_t n = static_cast<std::size_t>(end - begin);
    if (view.bias == 0) {
        const std::size_t size = size_of(view.type);
        for (std::size_t i = 0; i < n; ++i) {
            const std::byte* from = view.first + (static_cast<std::size_t>(begin) + i) * view.stride;
            std::byte* to = records.data() + i * record_bytes + offset;
            if (view.big_endian)
                std::reverse_copy(from, from + size, to);
            else
                std::memcpy(to, from, size);
        }
        return;
    }
    scratch.resize(n);
    copy_block(view, begin, scratch);
    for (std::size_t i = 0; i < n; ++i) std::memcpy(records.data() + i * record_bytes + offset, &scratch[i], 8);
}

}  // namespace

const LogFormat biip_format{
    "biip", "BIIP v1: self-describing fixed records (docs/formats/biip.md)", probe_biip, open_biip, frame_biip, true};

BiipWriter::BiipWriter(const std::string& path, const std::vector<StoredChannel>& channels, double period,
                       const std::string& metadata, Unfinished unfinished)
    : file_(path, Replaces::no_input, unfinished) {
    if (channels.empty()) throw UsageError("no channels to write");
    for (const StoredChannel& channel : channels) {
        if (channel.name.size() >= name_bytes)
            throw UsageError("channel name '" + channel.name + "' is longer than 23 bytes");
        if (channel.unit.size() > unit_bytes)
            throw UsageError("unit '" + channel.unit + "' of channel '" + channel.name + "' is longer than 8 bytes");
        offsets_.push_back(record_bytes_);
        record_bytes_ += size_of(channel.type);
    }
    std::string header(fixed_bytes + channels.size() * entry_bytes, '\0');
    header += metadata;
    header.resize((header.size() + 7) / 8 * 8, '\0');
    std::memcpy(header.data(), magic.data(), magic.size());
    put(header, 8, std::uint16_t{1});
    put(header, 12, static_cast<std::uint32_t>(header.size()));
    put(header, 16, static_cast<std::uint32_t>(record_bytes_));
    put(header, 20, static_cast<std::uint32_t>(channels.size()));
    put(header, 32, period);
    put(header, 40, static_cast<std::uint32_t>(metadata.size()));
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const std::size_t at = fixed_bytes + i * entry_bytes;
        std::memcpy(header.data() + at, channels[i].name.data(), channels[i].name.size());
        std::memcpy(header.data() + at + name_bytes, channels[i].unit.data(), channels[i].unit.size());
        put(header, at + 32, static_cast<std::uint8_t>(channels[i].type));
        put(header, at + 36, static_cast<std::uint32_t>(offsets_[i]));
        put(header, at + 40, channels[i].scale);
    }
    put(header, 44, crc32c(std::as_bytes(std::span(header))));
    file_.write(header);
}

void BiipWriter::append(std::span<const std::byte> records) {
    file_.write(records);
    records_ += records.size() / record_bytes_;
}

void BiipWriter::close() {
    // The count is written last: a file without it was not finished.
    file_.write_at(count_at, std::as_bytes(std::span(&records_, 1)));
    file_.commit();
}

Diagnostics fit_biip(Log& log) {
    Diagnostics notes;
    const auto taken = [&](const std::string& name) {
        return std::any_of(log.channels.begin(), log.channels.end(), [&](const Channel& c) { return c.name == name; });
    };
    for (Channel& channel : log.channels) {
        if (channel.unit.size() > unit_bytes) {
            notes.add({Severity::note,
                       "log.name",
                       Place::of_file(log.name),
                       fmt::format("the unit '{}' of channel '{}' is too long for a BIIP log: left out", channel.unit,
                                   channel.name),
                       {}});
            channel.unit.clear();
        }
        if (channel.name.size() < name_bytes) continue;
        // The end is the most specific part: "/Nck/!SD/nckServoDataCmdTorque32 [u1, 4]".
        std::string name;
        for (int number = 1; name.empty() || taken(name); ++number) {
            const std::string mark = number == 1 ? "" : fmt::format("~{}", number);
            std::size_t begin = channel.name.size() - (name_bytes - 1 - mark.size());
            while (begin < channel.name.size() && (static_cast<unsigned char>(channel.name[begin]) & 0xc0) == 0x80)
                ++begin;  // cut at the beginning of a UTF-8 character
            name = channel.name.substr(begin) + mark;
        }
        notes.add({Severity::note,
                   "log.name",
                   Place::of_file(log.name),
                   fmt::format("the name '{}' is too long for a BIIP log and becomes '{}'", channel.name, name),
                   {}});
        channel.name = name;
    }
    return notes;
}

void write_biip(const std::string& path, const std::vector<Channel>& channels, PointIndex records, double period,
                const std::string& metadata) {
    std::vector<StoredChannel> stored;
    for (const Channel& channel : channels) {
        const bool as_it_is = channel.values.bias == 0;
        stored.push_back({channel.name, channel.unit, as_it_is ? channel.values.type : ScalarType::f64,
                          as_it_is ? channel.values.scale : 1.0});
    }
    BiipWriter writer(path, stored, period, metadata);
    std::vector<std::byte> block;
    std::vector<double> scratch;
    for (PointIndex begin = 0; begin < records; begin += block_points) {
        const PointIndex end = std::min(records, begin + block_points);
        block.resize(static_cast<std::size_t>(end - begin) * writer.record_bytes());
        for (std::size_t i = 0; i < channels.size(); ++i) {
            store(channels[i].values, writer.offset_of(i), begin, end, block, writer.record_bytes(), scratch);
        }
        writer.append(block);
    }
    writer.close();
}

}  // namespace clsurf::io
