#include "cli/programs/front_output.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/options/output_format.h"
#include "core/error.h"
#include "core/units.h"
#include "io/reports/tradeoff_report.h"
#include "viz/front_chart.h"

namespace clsurf::cli {
namespace {

viz::FrontPicture picture_of(const TradeoffFront& front) {
    viz::FrontPicture picture;
    for (const TradeoffRow& row : front.rows)
        picture.rows.push_back(
            {row.quality.duration, row.quality.mismatch * seconds_per_minute, row.quality.jerk, row.on_front});
    picture.chosen = front.chosen;
    picture.reference = front.rows.front().name;
    return picture;
}

}  // namespace

void declare_front(po::options_description& options, const char* of, const char* choice) {
    // clang-format off
    options.add_options()
        ("tradeoff", po::value<std::string>()->value_name("FILE"), of)
        ("weight", po::value<double>()->value_name("W"), choice);
    // clang-format on
}

bool trades_off(const po::variables_map& values) { return values.count("tradeoff") + values.count("weight") > 0; }

std::optional<double> read_weight(const po::variables_map& values) {
    if (values.count("weight") == 0) return std::nullopt;
    const double weight = values["weight"].as<double>();
    if (!(weight >= 0 && weight <= 1)) throw UsageError("--weight must be 0 (time alone) to 1 (surface alone)");
    return weight;
}

FrontOutput::FrontOutput(const po::variables_map& values) {
    if (values.count("tradeoff") == 0) return;
    const std::string path = values["tradeoff"].as<std::string>();
    if (is_standard_output(path)) throw UsageError("--tradeoff writes a file, not standard output");
    format_ = output_format(path, front_formats(), {}, "--tradeoff").name;
    if (format_ == "csv" || format_ == "json")
        table_ = std::make_unique<io::AtomicFile>(path);
    else
        picture_ = std::make_unique<PictureOutput>(path, "--tradeoff", PictureKind::drawing);
}

void FrontOutput::write(const TradeoffFront& front, std::span<const PlanSettings> settings, const std::string& title,
                        const Diagnostics& diagnostics) {
    if (table_) {
        table_->write(format_ == "csv" ? io::tradeoff_csv(front) : io::tradeoff_json(front, settings, diagnostics));
        table_->commit();
    }
    if (!picture_) return;
    viz::ChartLook look;
    look.height = 1100;
    look.title = title;
    look.x_label = "Time [s]";
    look.subtitle = fmt::format("{} of {} runs on the front",
                                std::ranges::count(front.rows, true, &TradeoffRow::on_front), front.rows.size());
    if (front.chosen) {
        const std::string by = front.weight ? fmt::format(" by weight {:g}", *front.weight) : std::string();
        look.subtitle += fmt::format("; chosen{}: {}, {}", by, *front.chosen + 1, front.rows[*front.chosen].name);
    }
    look.keep_drawing = picture_->wants_drawing();
    picture_->write(viz::draw_front(picture_of(front), look), title);
}

}  // namespace clsurf::cli
