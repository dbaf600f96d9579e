#include "cli/pictures/plot_profile.h"

#include <limits>

#include <fmt/format.h>

#include "cli/pictures/as_machined.h"
#include "cli/pictures/picture_output.h"
#include "core/file_name.h"
#include "io/reports/profile_report.h"
#include "machined/as_machined_profile.h"

namespace clsurf::cli {

void declare_profile(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("profile", po::value<std::string>()->value_name("X0,Y0,X1,Y1"), "instead of curves, a section through the as-machined surface between two places [mm], with Ra and Rz; needs --tool");
    // clang-format on
    declare_tool(options);
}

bool asks_for_profile(const po::variables_map& values) {
    const bool asked = values.count("profile") > 0;
    if (!asked && given(values, "tool") && values.count("defect") == 0)
        throw UsageError("--tool needs --profile or --defect", "--profile 10,0,10,5 --tool ball:6");
    if (!asked && given(values, "json")) throw UsageError("--json needs --profile: curves are only drawn");
    if (!asked) return false;
    for (const char* name : {"fields", "over", "from", "to", "line", "mark-point"}) {
        if (given(values, name))
            throw UsageError(fmt::format("--{} does not apply to --profile, only to curves", name));
    }
    return true;
}

ExitCode plot_profile(const po::variables_map& values, PartOptions options, viz::ChartLook look,
                      const std::string& output_name) {
    const bool json = read_json_with_output(values);
    if (options.program.empty()) throw UsageError("--profile needs the program: PROGRAM LOG");
    const std::vector<double> ends = parse_numbers(values["profile"].as<std::string>(), "--profile", 4);
    const Vec2 from(ends[0], ends[1]);
    const Vec2 to(ends[2], ends[3]);
    constexpr double longest = 1000;  // mm: some 10^7 values
    if (!((to - from).norm() > 0 && (to - from).norm() <= longest))
        throw UsageError(fmt::format("--profile: from one place to another, at most {:g} mm apart", longest));
    const std::optional<Role> role = take_measured_role(options);
    PictureOutput output(output_name, "-o", PictureKind::drawing);
    look.keep_drawing = output.wants_drawing();
    StageClock clock(read_common(values), 7);
    const Part part = load_part(options, clock);
    if (!json) print(part.diagnostics, values);
    const CuttingTool tool = required_tool(part, "--profile", "--profile 10,0,10,5 --tool ball:6");
    clock.begin("stitch the surface");
    const ClSurface surface = stitch(part);
    clock.begin("sweep the tool");
    const AsMachinedPart as_machined(part, surface, role, tool);
    const AsMachinedProfile profile = measure_profile(as_machined.surface(), from, to);
    if (profile.count < 2) throw UsageError("--profile: nothing was cut between the two places");

    std::vector<double> x(profile.deviation.size());
    viz::Curve whole{"As-machined surface over its form (µm)", {}};
    viz::Curve rough{fmt::format("Roughness: waviness taken off, cut-off {:g} mm (µm)", profile.roughness.cutoff),
                     std::vector<double>(x.size(), std::numeric_limits<double>::quiet_NaN())};
    for (std::size_t k = 0; k < x.size(); ++k) {
        x[k] = profile.step * static_cast<double>(k);
        whole.values.push_back(profile.deviation[k] * um_per_mm);
    }
    const std::span<const double> known = std::span(profile.deviation).subspan(profile.first, profile.count);
    const std::vector<double> waviness = gaussian_mean_line(
        known, std::span(profile.along).subspan(profile.first, profile.count), profile.roughness.cutoff);
    for (std::size_t k = 0; k < known.size(); ++k)
        rough.values[profile.first + k] = (known[k] - waviness[k]) * um_per_mm;

    const Roughness& r = profile.roughness;
    look.title = fmt::format("Profile of the as-machined surface: Ra {:.2f} µm, Rz {:.2f} µm", r.ra * um_per_mm,
                             r.rz * um_per_mm);
    look.subtitle = fmt::format("{} · {} · X {:g} Y {:g} to X {:g} Y {:g}", file_name(options.program),
                                file_name(options.log), ends[0], ends[1], ends[2], ends[3]);
    look.x_label = "along the profile (mm)";
    look.footnote = fmt::format(
        "{}, {}; {} of {:.3g} mm evaluated", to_text(tool), as_machined.surface().note(),
        r.sampling_lengths == 1 ? "one sampling length" : fmt::format("{} sampling lengths", r.sampling_lengths),
        r.length / r.sampling_lengths);
    clock.begin("draw");
    output.write(viz::draw_chart(x, {whole, rough}, {}, look), look.title);
    clock.end();
    const io::ProfileReport report{from, to, profile.step * static_cast<double>(profile.count), r};
    if (json)
        write_to_stdout(io::profile_json(report, part.diagnostics));
    else
        write_answer(io::profile_text(report), values);
    return ExitCode::done;
}

}  // namespace clsurf::cli
