// A survey, little-endian: magic "CLSURVEY" · u32 layout · u32 count of survey_sections · u32 CRC-32C of all up to the first
// section, with itself zero · u32 0 · per section u64 offset, u64 bytes · the text of the origin and the numbers, as
// JSON · sections, each from a multiple of 4096 on.
#include "io/formats/survey_file.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include <fmt/format.h>

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
constexpr std::uint32_t survey_layout = 1;
constexpr std::size_t survey_head = 24;
constexpr std::size_t survey_page = 4096;
constexpr std::size_t survey_crc_at = 16;

/// The sections, in the order of the file.
enum class SurveySection : std::size_t {
    arc_lengths,
    boxes,
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
    count,
};
constexpr auto survey_sections = static_cast<std::size_t>(SurveySection::count);

using Corners = std::array<float, 6>;  ///< of a box: the lowest coordinates, then the highest
using SurveyBytes = std::span<const std::byte>;

template <typename T>
SurveyBytes survey_bytes(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span(values, count));
}

/// Numbers of a JSON text as their bits, so that they come back as they were.
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

class SurveyReader {
public:
    explicit SurveyReader(const Source& source) : source_(source) {
        const SurveyBytes all = source.bytes;
        if (all.size() < survey_head || std::memcmp(all.data(), survey_magic.data(), survey_magic.size()) != 0)
            fail("is no survey of clsurf");
        if (get<std::uint32_t>(8) != survey_layout || get<std::uint32_t>(12) != survey_sections) fail(other_version);
        text_at_ = survey_head + survey_sections * 2 * sizeof(std::uint64_t);
        if (all.size() < text_at_) fail(cut);
        for (std::size_t k = 0; k < survey_sections; ++k) {
            const auto offset = get<std::uint64_t>(survey_head + 16 * k),
                       bytes = get<std::uint64_t>(survey_head + 16 * k + 8);
            if (offset > all.size() || bytes > all.size() - offset || offset % survey_page != 0) fail(cut);
            sections_[k] = all.subspan(offset, bytes);
        }
        const std::size_t end = get<std::uint64_t>(survey_head);
        if (end < text_at_) fail(cut);
        const std::array<std::byte, 4> zeros{};
        if (crc32c({all.first(survey_crc_at), zeros, all.subspan(survey_crc_at + 4, end - survey_crc_at - 4)}) !=
            get<std::uint32_t>(survey_crc_at))
            fail("is damaged: its checksum differs");
        const char* const text = reinterpret_cast<const char*>(all.data()) + text_at_;
        json_ = parse_bounded(std::string_view(text, strnlen(text, end - text_at_)));
        if (!json_.is_object()) fail(cut);
        if (json_.at("clsurf").get<std::string>() != version) fail(other_version);
    }

    [[noreturn]] void fail(std::string_view what) const {
        throw InputError(Place::of_file(source_.name), std::string(what), "`clsurf survey` makes another one");
    }

    [[nodiscard]] const Json& json() const { return json_; }

    /// A column of `count` values.
    template <typename T>
    [[nodiscard]] std::span<const T> column(SurveySection section, std::size_t count) const {
        const std::span<const T> values = column<T>(section);
        if (values.size() != count) fail(cut);
        return values;
    }
    /// The same of any length.
    template <typename T>
    [[nodiscard]] std::span<const T> column(SurveySection section) const {
        const SurveyBytes bytes = sections_[static_cast<std::size_t>(section)];
        if (bytes.size() % sizeof(T) != 0) fail(cut);
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }

    static constexpr std::string_view cut = "is cut or damaged";
    static constexpr std::string_view other_version = "is a survey of another version of clsurf";

private:
    template <typename T>
    [[nodiscard]] T get(std::size_t at) const {
        T value;
        std::memcpy(&value, source_.bytes.data() + at, sizeof value);
        return value;
    }

    const Source& source_;
    std::array<SurveyBytes, survey_sections> sections_;
    std::size_t text_at_ = 0;
    Json json_;
};

/// Throws where ranges do not rise, or lie outside the log.
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

void read_survey_columns(const SurveyReader& reader, Survey& s) {
    const auto points = static_cast<std::size_t>(s.points);
    s.arc_lengths = Column<double>::borrowed(reader.column<double>(SurveySection::arc_lengths));
    for (const Corners& box : reader.column<Corners>(SurveySection::boxes)) {
        s.boxes.emplace_back(Eigen::Vector3f(box[0], box[1], box[2]), Eigen::Vector3f(box[3], box[4], box[5]));
    }
    s.passes = Passes::borrowed(reader.column<Pass>(SurveySection::passes));
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
    std::vector<Corners> box;
    for (const Eigen::AlignedBox3f& b : s.boxes)
        box.push_back({b.min().x(), b.min().y(), b.min().z(), b.max().x(), b.max().y(), b.max().z()});
    const std::array<SurveyBytes, survey_sections> columns{
        survey_bytes(s.arc_lengths.data(), s.arc_lengths.size()),
        survey_bytes(box.data(), box.size()),
        survey_bytes(s.passes.data(), s.passes.size()),
        survey_bytes(low.data(), low.size()),
        survey_bytes(s.step_over_moves.data(), s.step_over_moves.size()),
        survey_bytes(s.neighbours.left.data(), s.neighbours.left.size()),
        survey_bytes(s.neighbours.right.data(), s.neighbours.right.size()),
        survey_bytes(s.pieces.data(), s.pieces.size()),
        survey_bytes(&s.thresholds, 1),
        survey_bytes(s.lines.data(), s.lines.size()),
        survey_bytes(s.motions.data(), s.motions.size()),
        survey_bytes(s.confidences.data(), s.confidences.size()),
    };
    const auto whole_pages = [](std::size_t bytes) { return (bytes + survey_page - 1) / survey_page * survey_page; };
    std::string head(survey_head + survey_sections * 16, '\0');
    head += survey_text(s, origin);
    head.resize(whole_pages(head.size() + 1), '\0');
    const auto put = [&](std::size_t at, const auto& value) { std::memcpy(head.data() + at, &value, sizeof value); };
    std::memcpy(head.data(), survey_magic.data(), survey_magic.size());
    put(8, survey_layout);
    put(12, static_cast<std::uint32_t>(survey_sections));
    std::uint64_t offset = head.size();
    for (std::size_t k = 0; k < survey_sections; ++k) {
        put(survey_head + 16 * k, offset);
        put(survey_head + 16 * k + 8, std::uint64_t{columns[k].size()});
        offset += whole_pages(columns[k].size());
    }
    put(survey_crc_at, crc32c({std::as_bytes(std::span(head))}));
    AtomicFile file(path);
    file.write(head);
    const std::string zeros(survey_page, '\0');
    for (const SurveyBytes column : columns) {
        file.write(column);
        file.write(std::string_view(zeros).substr(0, whole_pages(column.size()) - column.size()));
    }
    file.commit();
}

Survey read_survey(const std::string& path, const SurveyOrigin& origin) {
    const Source source = map_file(path);
    const SurveyReader reader(source);
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
    return s;
}

}  // namespace clsurf::io
