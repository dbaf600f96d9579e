// clsurf history DB report: the page of a shop.

#include "cli/history/history_options.h"
#include "cli/history/history_verbs.h"
#include "cli/options/output_format.h"
#include "io/files/atomic_file.h"
#include "io/page/shop_page.h"

namespace clsurf::cli {

ExitCode write_shop_page(const HistoryCall& call) {
    const std::string path = required(call.values, "output");
    static_cast<void>(output_format(path, page_formats()));
    io::guard_input(call.database);
    io::AtomicFile file(path);
    const io::HistoryDatabase history(call.database);
    const std::vector<RunRecord> runs = history.runs(read_run_choice(call.values));
    if (runs.empty()) throw InputError(Place::of_file(call.database), "has no such runs");
    const std::vector<io::CauseCount> causes = history.causes();
    const std::vector<RunOutlier> outliers = find_outliers(runs);
    file.write(io::write_shop_page({call.database, runs, causes, outliers}));
    file.commit();
    return ExitCode::done;
}

}  // namespace clsurf::cli
