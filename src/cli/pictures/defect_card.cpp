#include "cli/pictures/defect_card.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/pictures/defect_map.h"
#include "cli/pictures/picture_output.h"
#include "cli/stage_clock.h"
#include "core/counted.h"
#include "core/file_name.h"
#include "core/not_finite.h"
#include "core/units.h"
#include "io/reports/defect_names.h"
#include "io/reports/quality_words.h"
#include "pipeline/judge.h"
#include "pipeline/signals_of.h"
#include "predictor/defect_profile.h"
#include "viz/defect_card.h"
#include "viz/scene.h"

namespace clsurf::cli {
namespace {

constexpr viz::Rgb far_colour{176, 176, 182};
constexpr viz::Rgb near_colour{96, 96, 104};
constexpr double least_surroundings = 8;  ///< step-overs around a section in the map
constexpr double surroundings = 0.4;      ///< share of the section's size around it
constexpr std::size_t most_labelled_lines = 400;

/// A view along the normal of the surface, so that the section is not foreshortened.
viz::View view_along(const Eigen::Vector3f& normal) {
    if (!normal.allFinite() || std::abs(normal.z()) > 0.999F) return viz::parse_view("top");
    const Vec3 n = normal.cast<double>().normalized();
    return {std::atan2(n.x(), -n.y()) * deg_per_rad, std::asin(n.z()) * deg_per_rad};
}

viz::CardBearings bearings_of(const viz::Camera& camera, const Eigen::Vector3f& feed) {
    const auto seen = [&](const Vec3& direction) {
        return Vec2(camera.right.dot(direction), camera.up.dot(direction));
    };
    viz::CardBearings bearings;
    bearings.mm_per_pixel = camera.mm_per_pixel;
    if (feed.allFinite() && feed.norm() > 0) bearings.feed = seen(feed.cast<double>().normalized());
    for (int k = 0; k < 3; ++k) bearings.axes[static_cast<std::size_t>(k)] = seen(Vec3::Unit(k));
    return bearings;
}

/// Draws the map of a card, and sets its orientation.
void draw_place(const JudgedPart& judged, std::size_t index, const viz::CardMapSize& size, const std::string& gl,
                bool keep_drawing, viz::DefectCard& card) {
    const Defect& d = judged.report.defects[index];
    QualityReport one;
    one.defects = {d};
    viz::DefectMap map = defect_map_of(one);
    // There is only one kind; a double line across the whole strip would look like a hole.
    map.kinds.front().style = viz::StrokeStyle::solid;
    viz::MapPanel panel;
    panel.surface = &judged.surface;
    const Field none{{}, Column<float>(static_cast<std::size_t>(judged.surface.positions.size()), 0.0F)};
    panel.field = &none;
    panel.defects = &map;
    viz::Look look;
    look.width = size.width;
    look.height = size.height;
    look.legend = false;
    look.gl = gl;
    look.keep_drawing = keep_drawing;
    look.view = view_along(judged.signals.normal(d.point));
    Box3 box;
    for (const DefectSection& section : d.sections) {
        if (d.point < section.points.first || d.point > section.points.last) continue;
        for (PointIndex i = section.points.first; i <= section.points.last; ++i)
            box.extend(judged.surface.positions.absolute(i));
    }
    if (box.isEmpty()) box = d.bounds;
    const double room = std::max(least_surroundings * judged.surface.step_over, surroundings * box.sizes().maxCoeff());
    look.box = Box3(box.min() - Vec3::Constant(room), box.max() + Vec3::Constant(room));
    const viz::PlacedMap placed = viz::placed_map({panel}, look);
    card.map = viz::draw_map({panel}, placed, {}, {}, look);
    card.bearings = bearings_of(placed.camera, judged.signals.feed(d.point));
}

/// Curves of one quantity along the section, with the band of usual values.
viz::CardChart chart_along(const DefectProfile& profile,
                           const std::array<std::vector<float>, DefectProfile::passes>& of,
                           const std::vector<float>& usual, double unit, const std::vector<double>& threshold,
                           const viz::Rgb& rgb) {
    viz::CardChart chart;
    chart.x_label = "along the pass [mm]";
    chart.x = profile.along;
    chart.marked_to = profile.section_length;
    const auto add = [&](std::size_t pass, const viz::Rgb& colour, double width) {
        viz::CardCurve curve{{}, colour, width};
        for (const float v : of[pass]) curve.values.push_back(v * unit);
        chart.curves.push_back(std::move(curve));
    };
    for (const std::size_t pass : {std::size_t{0}, DefectProfile::passes - 1}) add(pass, far_colour, 1.4);
    for (const std::size_t pass : {DefectProfile::at_fault - 1, DefectProfile::at_fault + 1})
        add(pass, near_colour, 1.6);
    add(DefectProfile::at_fault, rgb, 2.8);
    for (std::size_t i = 0; i < usual.size(); ++i) {
        chart.band_low.push_back((usual[i] - threshold[i]) * unit);
        chart.band_high.push_back((usual[i] + threshold[i]) * unit);
    }
    for (const DefectProfile::LineStart& start : profile.lines) chart.ticks.push_back(start.along);
    if (chart.ticks.size() > most_labelled_lines) chart.ticks.clear();
    return chart;
}

/// "line 3065" at the beginning and at the end of the section.
void label_lines(viz::CardChart& chart, const DefectProfile& profile) {
    const DefectProfile::LineStart* first = nullptr;
    const DefectProfile::LineStart* last = nullptr;
    for (const DefectProfile::LineStart& start : profile.lines) {
        if (start.along <= 1e-6 || first == nullptr) first = &start;
        if (start.along <= profile.section_length) last = &start;
    }
    if (first != nullptr)
        chart.tick_labels.emplace_back(std::max(0.0, first->along), fmt::format("line {}", first->line));
    if (last != nullptr && last != first)
        chart.tick_labels.emplace_back(last->along, fmt::format("line {}", last->line));
}

/// "pass 14": that of the strongest section.
std::string pass_name(const Defect& d) {
    for (const DefectSection& section : d.sections) {
        if (d.point >= section.points.first && d.point <= section.points.last)
            return fmt::format("pass {}", section.pass);
    }
    return "pass at fault";
}

viz::CardChart chart_across(const DefectProfile& profile, float threshold, const viz::Rgb& rgb) {
    viz::CardChart chart;
    chart.title = "Height across the feed [µm]";
    chart.x_label = "to the right of the pass [mm]";
    chart.x = profile.across;
    chart.dots = true;
    viz::CardCurve all{{}, near_colour, 1.6};
    viz::CardCurve at_fault{{}, rgb, 2.8};
    for (std::size_t i = 0; i < profile.across.size(); ++i) {
        const double height = profile.across_height[i] * um_per_mm;
        all.values.push_back(height);
        at_fault.values.push_back(profile.across[i] == 0 ? height : missing<double>);
    }
    chart.curves = {std::move(all), std::move(at_fault)};
    const double usual = profile.usual_across;
    if (!std::isfinite(usual)) return chart;
    chart.band_low.assign(profile.across.size(), (usual - threshold) * um_per_mm);
    chart.band_high.assign(profile.across.size(), (usual + threshold) * um_per_mm);
    return chart;
}

std::string title_of(DefectProfile::HeightOf height, Cause cause) {
    switch (height) {
        case DefectProfile::HeightOf::measured: return "Height of the measured path [µm]";
        case DefectProfile::HeightOf::programmed:
            return cause == Cause::path_tolerance ? "Height of the commanded path [µm]"
                                                  : "Height of the programmed path [µm]";
        case DefectProfile::HeightOf::relief: return "Height over adjacent passes [µm]";
    }
    return {};
}

/// " · formed 5.0 µm high": the mark in the as-machined surface.
std::string formed_text(const JudgedPart& judged, std::size_t index) {
    if (judged.as_machined == nullptr) return {};
    const AsMachinedMark& mark = judged.as_machined->marks[index];
    if (!std::isfinite(mark.depth) || judged.report.defects[index].systematic) return {};
    const std::string text = fmt::format(" · formed {:.1f} µm", mark.depth * um_per_mm);
    constexpr double least_shown = 5e-5;  // mm: 0.0 µm is neither deep nor high
    return mark.depth < least_shown ? text : fmt::format("{} {}", text, deep_or_high(judged.report.defects[index].pit));
}

}  // namespace

viz::Image draw_defect_card(const JudgedPart& judged, std::size_t index, int width, int height, const std::string& gl,
                            bool keep_drawing) {
    const Defect& d = judged.report.defects[index];
    const HeightPeers peers = height_peers_of(d, judged.report);
    const DefectProfile profile = profile_of(d, judged.surface, judged.signals, *judged.part.lines,
                                             ProgrammedMarks(judged.surface, judged.signals, judged.report), peers);
    const Thresholds& thresholds = judged.report.thresholds;
    QualityReport one;
    one.defects = {d};
    const viz::Rgb rgb = defect_map_of(one).kinds.front().rgb;

    viz::DefectCard card;
    const std::string lines = io::lines_label(d);
    card.title = fmt::format("Defect {}: {}{}", index + 1, io::label_of(d), lines.empty() ? "" : ", " + lines);
    card.subtitle =
        fmt::format("{} · {}{} · {} · {}", io::sentence_of(d), io::place_text(d.place), formed_text(judged, index),
                    file_name(judged.part.program.main().name()), file_name(judged.part.log.name));
    draw_place(judged, index, viz::card_map_size(width, height), gl, keep_drawing, card);
    card.key = {{pass_name(d), rgb}, {"next passes", near_colour}, {"second next", far_colour}};
    card.band_name = peers == HeightPeers::same_direction ? "usual ± threshold; heights: in the same direction"
                                                          : "usual ± threshold, passes without a fault";
    std::vector<double> speed_threshold;
    for (const float usual : profile.usual_speed)
        speed_threshold.push_back(thresholds.of[index_of(Quantity::speed)] * std::max(usual, thresholds.least_speed));
    viz::CardChart speed =
        chart_along(profile, profile.speed, profile.usual_speed, seconds_per_minute, speed_threshold, rgb);
    speed.title = "Speed [mm/min]";
    label_lines(speed, profile);
    const bool by_lag = profile.height_of == DefectProfile::HeightOf::measured && d.quantity != Quantity::relief;
    const float height_threshold = thresholds.of[index_of(by_lag ? Quantity::normal_deviation : Quantity::relief)];
    viz::CardChart heights = chart_along(profile, profile.height, profile.usual_height, um_per_mm,
                                         std::vector<double>(profile.along.size(), height_threshold), rgb);
    heights.title = title_of(profile.height_of, d.cause);
    card.charts = {std::move(speed), std::move(heights), chart_across(profile, height_threshold, rgb)};
    return viz::draw_card(card, width, height, gl);
}

ExitCode plot_defect(const po::variables_map& values, const PartOptions& options, long long number,
                     const std::string& output_name, int width, int height, const std::string& gl) {
    if (options.program.empty()) throw UsageError("--defect needs the program: PROGRAM LOG");
    PictureOutput output(output_name, "-o", PictureKind::drawing);
    StageClock clock(read_common(values), 8);
    Part part = load_part(options, clock);
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    clock.begin("derive the signals");
    const PartSignals read = signals_of(part, surface);
    const Quality quality = judge(part, surface, read, std::nullopt, {}, clock.stages());
    const QualityReport& report = quality.report;
    part.diagnostics.append(quality.diagnostics);
    print(part.diagnostics, values);
    if (number < 1 || number > static_cast<long long>(report.defects.size()))
        throw UsageError(fmt::format("--defect {}: there {} only {}", number, report.defects.size() == 1 ? "is" : "are",
                                     counted(report.defects.size(), "defect")));
    clock.begin("draw");
    const auto index = static_cast<std::size_t>(number - 1);
    const viz::Image image =
        draw_defect_card({part, surface, read.signals, report, quality.as_machined ? &*quality.as_machined : nullptr},
                         index, width, height, gl, output.wants_drawing());
    output.write(image, fmt::format("clsurf defect {} of {} from {}: {}", number, file_name(options.program),
                                    file_name(options.log), io::label_of(report.defects[index])));
    return ExitCode::done;
}

}  // namespace clsurf::cli
