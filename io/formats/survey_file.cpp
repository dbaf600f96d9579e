// A survey, little-endian: magic "CLSURVEY" · u32 layout · u32 count of survey_sections · u32 CRC-32C of all bytes up to the
// first section, with the CRC itself zero · u32 0 · per section u64 offset, u64 bytes, u32 CRC-32C, u32 0 · the origin and
// the numbers as JSON text · sections in sequence, each at a multiple of 4096.
//
// The CRC of a section covers its bytes up to the next section. Sections with a value per point are not read
// completely: their CRC here is 0, and the section block_crcs has one for each block of 16,384 points, which is checked
// when one of the points is first read.
#include "io/formats/survey_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/error.h"
#include "core/version.h"
#include "io/files/atomic_file.h"
#include "io/files/crc32c.h"
#include "io/files/json_value.h"
#include "io/files/sha256.h"

namespace clsurf::io {
namespace {

static_assert(std::endian::native == std::endian::little, "a survey is read in place");

constexpr std::string_view survey_magic = "CLSURVEY";
constexpr std::uint32_t survey_layout = 3;
constexpr std::size_t survey_head = 24;
constexpr std::size_t survey_page = 4096;
constexpr std::size_t survey_crc_at = 16;

/// The sections, in the order of the file.
enum class SurveySection : std::size_t {
    arc_lengths,
    boxes,
    surface_boxes,
    passes,
    low_links,
    moves,
    left,
    right,
    pieces,
    thresholds,
    lines,
    motions,
    confidences,
    block_crcs,
    count,
};
constexpr auto survey_sections = static_cast<std::size_t>(SurveySection::count);
constexpr std::size_t survey_entry = 24;  ///< bytes of a section's entry in the head

/// Sections with a value per point, in the order of their blocks in block_crcs.
constexpr std::array<SurveySection, 5> survey_point_sections{SurveySection::left, SurveySection::right,
                                                             SurveySection::lines, SurveySection::motions,
                                                             SurveySection::confidences};
bool is_point_section(std::size_t section) {
    return std::ranges::find(survey_point_sections, static_cast<SurveySection>(section)) != survey_point_sections.end();
}

std::size_t whole_survey_pages(std::size_t bytes) { return (bytes + survey_page - 1) / survey_page * survey_page; }

using Corners = std::array<float, 6>;  ///< corners of a box: the lowest coordinates, then the highest
using SurveyBytes = std::span<const std::byte>;

/// The bytes of block `block` of a section with `width` bytes per point; the last block extends to the end of its page.
SurveyBytes block_of_section(SurveyBytes padded, std::size_t width, std::size_t block) {
    const std::size_t size = width * static_cast<std::size_t>(block_points), at = block * size;
    return at >= padded.size() ? SurveyBytes() : padded.subspan(at, std::min(size, padded.size() - at));
}

template <typename T>
SurveyBytes survey_bytes(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span(values, count));
}

/// Numbers as bits in a JSON text, so that they are read back unchanged.
template <typename Matrix>
Json numbers_by_bits(const Matrix& m) {
    Json list = Json::array();
    for (Eigen::Index k = 0; k < m.size(); ++k) list.push_back(std::bit_cast<std::uint64_t>(m.data()[k]));
    return list;
}

template <typename Matrix>
void read_bits(const Json& list, Matrix& m) {
    for (Eigen::Index k = 0; k < m.size(); ++k)
        m.data()[k] = std::bit_cast<double>(list.at(static_cast<std::size_t>(k)).get<std::uint64_t>());
}

/// The numbers of a survey that are not in columns.
Eigen::VectorXd survey_numbers(const Survey& s) {
    Eigen::VectorXd numbers(7);
    numbers << s.step_over, s.cut_length, s.facts.usual_speed, static_cast<double>(s.facts.path_quantum),
        static_cast<double>(s.facts.quantum), s.facts.scatter, s.match.missing;
    return numbers;
}

void set_survey_numbers(const Eigen::VectorXd& numbers, Survey& s) {
    s.step_over = numbers[0];
    s.cut_length = numbers[1];
    s.facts.usual_speed = numbers[2];
    s.facts.path_quantum = static_cast<float>(numbers[3]);
    s.facts.quantum = static_cast<float>(numbers[4]);
    s.facts.scatter = numbers[5];
    s.match.missing = numbers[6];
}

std::string survey_text(const Survey& s, const SurveyOrigin& origin) {
    Json json;
    json["clsurf"] = version;
    json["log"] = origin.log_sha256;
    json["program"] = origin.program_sha256;
    json["options"] = origin.options;
    json["points"] = s.points;
    json["role"] = static_cast<int>(s.role);
    json["offset"] = numbers_by_bits(s.offset);
    json["turn"] = numbers_by_bits(s.turn);
    json["origin"] = numbers_by_bits(s.origin);
    json["numbers"] = numbers_by_bits(survey_numbers(s));
    json["not_finishing"] = s.not_finishing;
    json["unfit"] = s.facts.unfit;
    json["lines_of_log"] = s.lines_of_log;
    json["edited"] = s.match.edited;
    json["foreign"] = s.match.foreign;
    return dump_compact(json);
}

template <typename T>
void put_survey(std::string& head, std::size_t at, const T& value) {
    std::memcpy(head.data() + at, &value, sizeof value);
}

constexpr std::array<std::byte, survey_page> survey_zeros{};

SurveyBytes survey_padding(std::size_t bytes) {
    return std::span(survey_zeros).first(whole_survey_pages(bytes) - bytes);
}

/// CRC of bytes and the zeros that pad them to the end of a page.
std::uint32_t padded_crc(SurveyBytes bytes) { return crc32c({bytes, survey_padding(bytes.size())}); }

class SurveyReader {
public:
    explicit SurveyReader(Source source) : source_(std::move(source)) {
        const SurveyBytes all = source_.bytes;
        if (all.size() < survey_head || std::memcmp(all.data(), survey_magic.data(), survey_magic.size()) != 0)
            fail("is not a survey of clsurf");
        if (get<std::uint32_t>(8) != survey_layout || get<std::uint32_t>(12) != survey_sections) fail(other_version);
        text_at_ = survey_head + survey_sections * survey_entry;
        if (all.size() < text_at_) fail(cut);
        const std::size_t end = get<std::uint64_t>(survey_head);
        if (end < text_at_ || end > all.size()) fail(cut);
        const std::array<std::byte, 4> zeros{};
        if (crc32c({all.first(survey_crc_at), zeros, all.subspan(survey_crc_at + 4, end - survey_crc_at - 4)}) !=
            get<std::uint32_t>(survey_crc_at))
            fail("is damaged: the checksum of its head differs");
        find_sections(end);
        const char* const text = reinterpret_cast<const char*>(all.data()) + text_at_;
        json_ = parse_bounded(std::string_view(text, strnlen(text, end - text_at_)));
        if (!json_.is_object()) fail(cut);
        if (json_.at("clsurf").get<std::string>() != version) fail(other_version);
    }

    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(Place::of_file(source_.name), std::string(what), "`clsurf survey` makes another one");
    }

    [[nodiscard]] const Json& json() const { return json_; }

    /// Checks the CRC of a block of points of a section; does nothing if the section is empty. `width`: bytes per point.
    void check_block(SurveySection section, std::size_t width, std::size_t block) const {
        const SurveyBytes padded = padded_[static_cast<std::size_t>(section)];
        if (padded.empty()) return;
        const std::size_t place = block_crc_at_[static_cast<std::size_t>(section)] + block;
        const auto crcs = column<std::uint32_t>(SurveySection::block_crcs);
        if (place >= crcs.size() || crc32c(block_of_section(padded, width, block)) != crcs[place]) {
            const std::size_t first = block * static_cast<std::size_t>(block_points);
            fail(fmt::format("is damaged: the checksum of section {} differs for the points from {} on",
                             static_cast<std::size_t>(section), first));
        }
    }

    /// A column of `count` values.
    template <typename T>
    [[nodiscard]] std::span<const T> column(SurveySection section, std::size_t count) const {
        const std::span<const T> values = column<T>(section);
        if (values.size() != count) fail(cut);
        return values;
    }
    /// A column of any length.
    template <typename T>
    [[nodiscard]] std::span<const T> column(SurveySection section) const {
        const SurveyBytes bytes = sections_[static_cast<std::size_t>(section)];
        if (bytes.size() % sizeof(T) != 0) fail(cut);
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }

    static constexpr std::string_view cut = "is cut or damaged";
    static constexpr std::string_view other_version = "is a survey of another version of clsurf";

private:
    /// Checks that sections follow each other up to the end of the file, and the CRC of those that are read completely.
    void find_sections(std::size_t end) {
        std::uint64_t next = end;
        std::size_t blocks = 0;
        for (std::size_t k = 0; k < survey_sections; ++k) {
            const std::size_t entry = survey_head + survey_entry * k;
            const auto offset = get<std::uint64_t>(entry), bytes = get<std::uint64_t>(entry + 8);
            const SurveyBytes all = source_.bytes;
            if (offset != next || bytes > all.size() - offset) fail(cut);
            next += whole_survey_pages(bytes);
            if (next > all.size()) fail(cut);
            sections_[k] = all.subspan(offset, bytes);
            padded_[k] = all.subspan(offset, next - offset);
            if (is_point_section(k)) {
                block_crc_at_[k] = blocks;
                const std::size_t width = k == static_cast<std::size_t>(SurveySection::confidences) ? 1 : 4;
                blocks += (bytes / width + block_points - 1) / block_points;
            } else if (crc32c(padded_[k]) != get<std::uint32_t>(entry + 16)) {
                fail(fmt::format("is damaged: the checksum of section {} differs", k));
            }
        }
        if (next != source_.bytes.size()) fail("is damaged: there are bytes after its last section");
        if (column<std::uint32_t>(SurveySection::block_crcs).size() != blocks) fail(cut);
    }

    template <typename T>
    [[nodiscard]] T get(std::size_t at) const {
        T value;
        std::memcpy(&value, source_.bytes.data() + at, sizeof value);
        return value;
    }

    Source source_;
    std::array<SurveyBytes, survey_sections> sections_;
    std::array<SurveyBytes, survey_sections> padded_;          ///< with the padding up to the next section
    std::array<std::size_t, survey_sections> block_crc_at_{};  ///< index in block_crcs of a section's first block
    std::size_t text_at_ = 0;
    Json json_;
};

/// Throws if ranges do not increase, or are outside the log.
template <typename Range>
void check_survey_ranges(const SurveyReader& reader, std::span<const Range> ranges, PointIndex points, bool whole) {
    PointIndex next = 0;
    for (const Range& range : ranges) {
        if (range.first < next || (whole && range.first != next) || range.last < range.first)
            reader.fail(SurveyReader::cut);
        next = range.last + 1;
    }
    if (next > points || (whole && next != points)) reader.fail(SurveyReader::cut);
}

std::vector<Corners> corners_of(const std::vector<Eigen::AlignedBox3f>& boxes) {
    std::vector<Corners> corners;
    for (const Eigen::AlignedBox3f& b : boxes)
        corners.push_back({b.min().x(), b.min().y(), b.min().z(), b.max().x(), b.max().y(), b.max().z()});
    return corners;
}

std::vector<Eigen::AlignedBox3f> boxes_of(std::span<const Corners> corners) {
    std::vector<Eigen::AlignedBox3f> boxes;
    for (const Corners& c : corners)
        boxes.emplace_back(Eigen::Vector3f(c[0], c[1], c[2]), Eigen::Vector3f(c[3], c[4], c[5]));
    return boxes;
}

void read_survey_columns(const SurveyReader& reader, Survey& s) {
    const auto points = static_cast<std::size_t>(s.points);
    s.arc_lengths =
        Column<double>::borrowed(reader.column<double>(SurveySection::arc_lengths, ArcLength::sum_count(s.points)));
    const std::size_t blocks = (points + block_points - 1) / block_points;
    s.boxes = boxes_of(reader.column<Corners>(SurveySection::boxes, blocks));
    s.surface_boxes = boxes_of(reader.column<Corners>(SurveySection::surface_boxes, blocks));
    s.passes = Passes::borrowed(reader.column<Pass>(SurveySection::passes));
    if (std::ranges::any_of(s.passes, [](const Pass& pass) { return pass.kind > PassKind::other; }))
        reader.fail(SurveyReader::cut);
    check_survey_ranges(reader, std::span<const Pass>(s.passes), s.points, true);
    for (const std::uint8_t low : reader.column<std::uint8_t>(SurveySection::low_links, s.passes.size()))
        s.low_links.push_back(low != 0);
    const auto move = reader.column<PointRange>(SurveySection::moves);
    s.step_over_moves.assign(move.begin(), move.end());
    check_survey_ranges(reader, move, s.points, false);
    s.neighbours.left = Column<std::int32_t>::borrowed(reader.column<std::int32_t>(SurveySection::left, points));
    s.neighbours.right = Column<std::int32_t>::borrowed(reader.column<std::int32_t>(SurveySection::right, points));
    const auto piece = reader.column<PointRange>(SurveySection::pieces);
    s.pieces.assign(piece.begin(), piece.end());
    check_survey_ranges(reader, piece, s.points, false);
    s.thresholds = reader.column<Thresholds>(SurveySection::thresholds, 1).front();
    s.lines = Column<std::uint32_t>::borrowed(reader.column<std::uint32_t>(SurveySection::lines));
    s.motions = Column<std::uint32_t>::borrowed(reader.column<std::uint32_t>(SurveySection::motions));
    s.confidences = Column<std::uint8_t>::borrowed(reader.column<std::uint8_t>(SurveySection::confidences));
    for (const std::size_t size : {s.lines.size(), s.motions.size(), s.confidences.size()}) {
        if (size != 0 && size != points) reader.fail(SurveyReader::cut);
    }
}

/// Blocks of points are checked when they are first read. Neighbours must be points of the log.
void check_columns_when_read(const std::shared_ptr<const SurveyReader>& reader, Survey& s) {
    s.check_neighbours = [reader, left = std::span<const std::int32_t>(s.neighbours.left),
                          right = std::span<const std::int32_t>(s.neighbours.right),
                          points = s.points](PointIndex first, PointIndex last) {
        const auto block = static_cast<std::size_t>(first / block_points);
        reader->check_block(SurveySection::left, sizeof(std::int32_t), block);
        reader->check_block(SurveySection::right, sizeof(std::int32_t), block);
        for (PointIndex i = first; i < last; ++i) {
            for (const auto& side : {left, right}) {
                const std::int32_t delta = side[static_cast<std::size_t>(i)];
                if (delta != Adjacency::none && (i + delta < 0 || i + delta >= points))
                    reader->fail(fmt::format("is damaged: point {} has a neighbour outside the log", i));
            }
        }
    };
    if (s.lines.empty() && s.motions.empty() && s.confidences.empty()) return;
    s.check_lines = [reader](PointIndex first, PointIndex) {
        const auto block = static_cast<std::size_t>(first / block_points);
        reader->check_block(SurveySection::lines, sizeof(std::uint32_t), block);
        reader->check_block(SurveySection::motions, sizeof(std::uint32_t), block);
        reader->check_block(SurveySection::confidences, 1, block);
    };
}

/// The head with zeros in place of the section entries and the CRC.
std::string survey_head_text(const Survey& s, const SurveyOrigin& origin) {
    std::string head(survey_head + survey_sections * survey_entry, '\0');
    head += survey_text(s, origin);
    head.resize(whole_survey_pages(head.size() + 1), '\0');
    std::memcpy(head.data(), survey_magic.data(), survey_magic.size());
    put_survey(head, 8, survey_layout);
    put_survey(head, 12, static_cast<std::uint32_t>(survey_sections));
    return head;
}

/// CRCs of the blocks of all point sections. O(points), parallel.
std::vector<std::uint32_t> block_crcs_of(const std::array<SurveyBytes, survey_sections>& columns) {
    std::vector<std::uint32_t> crcs;
    for (const SurveySection section : survey_point_sections) {
        const SurveyBytes column = columns[static_cast<std::size_t>(section)];
        const std::size_t width = section == SurveySection::confidences ? 1 : 4;
        const std::size_t block = width * static_cast<std::size_t>(block_points);
        const std::size_t first = crcs.size(), blocks = (column.size() + block - 1) / block;
        crcs.resize(first + blocks);
        parallel_for(static_cast<std::int64_t>(blocks), 1, [&](std::int64_t from, std::int64_t to) {
            for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k)
                crcs[first + k] = padded_crc(block_of_section(column, width, k));
        });
    }
    return crcs;
}

/// Passes in their in-memory layout, with zeros as padding between members.
std::vector<std::byte> bytes_of_passes(const Passes& passes) {
    std::vector<std::byte> bytes(passes.size() * sizeof(Pass));
    std::byte* out = bytes.data();
    for (const Pass& pass : passes) {
        std::memcpy(out + offsetof(Pass, first), &pass.first, sizeof pass.first);
        std::memcpy(out + offsetof(Pass, last), &pass.last, sizeof pass.last);
        std::memcpy(out + offsetof(Pass, kind), &pass.kind, sizeof pass.kind);
        out += sizeof(Pass);
    }
    return bytes;
}

}  // namespace

std::string hash_of_ends(const Source& log) {
    constexpr std::size_t end = 1 << 20;
    std::string text = fmt::format("{} ", log.bytes.size());
    const std::string_view all = log.text();
    text += all.substr(0, end);
    if (all.size() > end) text += all.substr(std::max(end, all.size() - std::min(end, all.size())));
    return sha256(std::as_bytes(std::span(text)));
}

void write_survey(const std::string& path, const Survey& s, const SurveyOrigin& origin) {
    const std::vector<std::uint8_t> low(s.low_links.begin(), s.low_links.end());
    const std::vector<Corners> box = corners_of(s.boxes), surface_box = corners_of(s.surface_boxes);
    const std::vector<std::byte> passes = bytes_of_passes(s.passes);
    std::array<SurveyBytes, survey_sections> columns{
        survey_bytes(s.arc_lengths.data(), s.arc_lengths.size()),
        survey_bytes(box.data(), box.size()),
        survey_bytes(surface_box.data(), surface_box.size()),
        passes,
        survey_bytes(low.data(), low.size()),
        survey_bytes(s.step_over_moves.data(), s.step_over_moves.size()),
        survey_bytes(s.neighbours.left.data(), s.neighbours.left.size()),
        survey_bytes(s.neighbours.right.data(), s.neighbours.right.size()),
        survey_bytes(s.pieces.data(), s.pieces.size()),
        survey_bytes(&s.thresholds, 1),
        survey_bytes(s.lines.data(), s.lines.size()),
        survey_bytes(s.motions.data(), s.motions.size()),
        survey_bytes(s.confidences.data(), s.confidences.size()),
        {},
    };
    const std::vector<std::uint32_t> crcs = block_crcs_of(columns);
    columns.back() = survey_bytes(crcs.data(), crcs.size());
    std::string head = survey_head_text(s, origin);
    std::uint64_t offset = head.size();
    for (std::size_t k = 0; k < survey_sections; ++k) {
        const std::size_t entry = survey_head + survey_entry * k;
        put_survey(head, entry, offset);
        put_survey(head, entry + 8, std::uint64_t{columns[k].size()});
        if (!is_point_section(k)) put_survey(head, entry + 16, padded_crc(columns[k]));
        offset += whole_survey_pages(columns[k].size());
    }
    put_survey(head, survey_crc_at, crc32c({std::as_bytes(std::span(head))}));
    AtomicFile file(path);
    file.write(head);
    for (const SurveyBytes column : columns) {
        file.write(column);
        file.write(survey_padding(column.size()));
    }
    file.commit();
}

Survey read_survey(const std::string& path, const SurveyOrigin& origin) {
    const Source source = map_file(path);
    const auto shared = std::make_shared<const SurveyReader>(source);
    const SurveyReader& reader = *shared;
    const Json& json = reader.json();
    Survey s;
    try {
        if (json.at("log").get<std::string>() != origin.log_sha256) reader.fail("is the survey of another log");
        if (json.at("program").get<std::string>() != origin.program_sha256)
            reader.fail("is the survey of a log with another program");
        if (const auto options = json.at("options").get<std::string>(); options != origin.options) {
            reader.fail(fmt::format("was made with {}, not with {}", options.empty() ? "no options" : options,
                                    origin.options.empty() ? "none" : origin.options));
        }
        s.points = json.at("points").get<PointIndex>();
        s.role = static_cast<Role>(json.at("role").get<int>());
        read_bits(json.at("offset"), s.offset);
        read_bits(json.at("turn"), s.turn);
        read_bits(json.at("origin"), s.origin);
        Eigen::VectorXd numbers = survey_numbers(s);
        read_bits(json.at("numbers"), numbers);
        set_survey_numbers(numbers, s);
        s.not_finishing = json.at("not_finishing").get<PointIndex>();
        s.facts.unfit = json.at("unfit").get<std::vector<std::string>>();
        s.lines_of_log = json.at("lines_of_log").get<bool>();
        s.match.edited = json.at("edited").get<bool>();
        s.match.foreign = json.at("foreign").get<std::string>();
    } catch (const Json::exception&) { reader.fail(SurveyReader::cut); }
    read_survey_columns(reader, s);
    s.keep_alive = source.keep_alive;
    s.file = source.name;
    check_columns_when_read(shared, s);
    return s;
}

}  // namespace clsurf::io
