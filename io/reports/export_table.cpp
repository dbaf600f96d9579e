#include "io/reports/export_table.h"

#include <cmath>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/parallel.h"
#include "io/files/atomic_file.h"
#include "io/formats/biip.h"

namespace clsurf::io {
namespace {

constexpr PointIndex rows_at_once = 1 << 16;  ///< per thread
constexpr PointIndex rows_in_memory = 1 << 20;

void put_value(fmt::memory_buffer& out, const ExportColumn& column, std::size_t row) {
    if (!column.counts.empty()) {
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), column.counts[row]);
    } else if (!column.exact.empty()) {
        if (!std::isnan(column.exact[row]))
            fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), column.exact[row]);
    } else if (!std::isnan(column.values[row])) {
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), column.values[row]);
    }
}

}  // namespace

PointIndex ExportColumn::size() const {
    return static_cast<PointIndex>(!counts.empty() ? counts.size() : !exact.empty() ? exact.size() : values.size());
}

void write_csv(const std::string& path, const std::vector<ExportColumn>& columns) {
    AtomicFile file(path);
    std::string header;
    for (const ExportColumn& c : columns)
        header += (header.empty() ? "" : ",") + c.name + (c.unit.empty() ? "" : " [" + c.unit + "]");
    file.write(header + "\n");
    const PointIndex rows = columns.empty() ? 0 : columns.front().size();
    for (PointIndex begin = 0; begin < rows; begin += rows_in_memory) {
        const PointIndex count = std::min(rows_in_memory, rows - begin);
        std::vector<fmt::memory_buffer> pieces(static_cast<std::size_t>((count + rows_at_once - 1) / rows_at_once));
        parallel_for(count, rows_at_once, [&](std::int64_t first, std::int64_t last) {
            fmt::memory_buffer& out = pieces[static_cast<std::size_t>(first / rows_at_once)];
            for (std::int64_t row = begin + first; row < begin + last; ++row) {
                for (std::size_t c = 0; c < columns.size(); ++c) {
                    if (c > 0) out.push_back(',');
                    put_value(out, columns[c], static_cast<std::size_t>(row));
                }
                out.push_back('\n');
            }
        });
        for (const fmt::memory_buffer& piece : pieces) file.write(std::string_view(piece.data(), piece.size()));
    }
    file.commit();
}

void write_biip_table(const std::string& path, const std::vector<ExportColumn>& columns, double period,
                      const std::string& metadata) {
    std::vector<Channel> channels;
    for (const ExportColumn& c : columns) {
        const ChannelView view = !c.counts.empty()  ? view_of(c.counts)
                                 : !c.exact.empty() ? view_of(c.exact)
                                                    : view_of(c.values);
        channels.push_back({c.name, c.unit, view});
    }
    write_biip(path, channels, columns.empty() ? 0 : columns.front().size(), period, metadata);
}

}  // namespace clsurf::io
