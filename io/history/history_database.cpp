#include "io/history/history_database.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"
#include "io/files/sha256.h"
#include "io/files/utc.h"
#include "io/history/history_schema.h"

namespace clsurf::io {
namespace {

constexpr std::string_view run_columns =
    "id, time, recorded, program, program_sha256, log, log_sha256, machine, tool, version, duration_s, points, passes, judged, "
    "not_judged_reasons, within_budget, coverage_percent, speed_p50_percent, speed_p99_percent, acceleration_p50_mm_s2, "
    "acceleration_p99_mm_s2, lag_p50_um, lag_p99_um, defects, worst_severity, worst_score, deepest_um, area_mm2, ra_um, rz_um, settings, failure";

/// Reads the columns of a row in the order of run_columns.
class RowReader {
public:
    explicit RowReader(const SqliteStatement& row) : row_(row) {}
    RowReader& operator>>(std::string& value) { return value = row_.text(column_++), *this; }
    RowReader& operator>>(double& value) { return value = row_.number(column_++), *this; }
    RowReader& operator>>(std::int64_t& value) { return value = row_.integer(column_++), *this; }
    RowReader& operator>>(int& value) { return value = static_cast<int>(row_.integer(column_++)), *this; }
    RowReader& operator>>(bool& value) { return value = row_.integer(column_++) != 0, *this; }
    RowReader& operator>>(RunMismatch& value) { return *this >> value.median >> value.p99; }
    RowReader& operator>>(Vec3& value) { return *this >> value.x() >> value.y() >> value.z(); }

private:
    const SqliteStatement& row_;
    int column_ = 0;
};

RunRecord read_run(const SqliteStatement& row) {
    RunRecord run;
    RowReader(row) >> run.id >> run.time >> run.recorded >> run.program >> run.program_sha256 >> run.log >>
        run.log_sha256 >> run.machine >> run.tool >> run.version >> run.duration_s >> run.points >> run.passes >>
        run.judged >> run.not_judged_reasons >> run.within_budget >> run.coverage_percent >> run.speed_percent >>
        run.acceleration_mm_s2 >> run.lag_um >> run.defects >> run.worst_severity >> run.worst_score >>
        run.deepest_um >> run.area_mm2 >> run.ra_um >> run.rz_um >> run.settings >> run.failure;
    return run;
}

std::string identity_of(const RunRecord& run) {
    const std::string text = identity_text(run);
    return sha256(std::as_bytes(std::span(text.data(), text.size())));
}

std::int64_t flag(bool value) { return value ? 1 : 0; }

void bind_run(SqliteStatement& row, const RunRecord& run, const std::string& identity, std::int64_t id) {
    if (id > 0)
        row.bind(id);
    else
        row.bind(std::numeric_limits<double>::quiet_NaN());
    row.bind(run.time).bind(run.recorded).bind(run.program).bind(run.program_sha256).bind(run.log).bind(run.log_sha256);
    row.bind(run.machine).bind(run.tool).bind(run.version).bind(run.duration_s).bind(run.points).bind(run.passes);
    row.bind(flag(run.judged)).bind(run.not_judged_reasons).bind(flag(run.within_budget)).bind(run.coverage_percent);
    for (const RunMismatch& m : {run.speed_percent, run.acceleration_mm_s2, run.lag_um}) row.bind(m.median).bind(m.p99);
    row.bind(run.defects)
        .bind(static_cast<std::int64_t>(run.worst_severity))
        .bind(run.worst_score)
        .bind(run.deepest_um);
    row.bind(run.area_mm2).bind(run.ra_um).bind(run.rz_um).bind(run.settings).bind(run.failure).bind(identity);
}

void write_defects(const SqliteConnection& connection, std::int64_t id, const std::vector<RecordedDefect>& defects) {
    SqliteStatement row(connection,
                        "INSERT INTO defects VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    SqliteStatement section_row(connection, "INSERT INTO sections VALUES (?, ?, ?, ?, ?, ?)");
    for (std::size_t i = 0; i < defects.size(); ++i) {
        const RecordedDefect& d = defects[i];
        const auto rank = static_cast<std::int64_t>(i + 1);
        row.bind(id)
            .bind(rank)
            .bind(d.cause)
            .bind(d.quantity)
            .bind(static_cast<std::int64_t>(d.severity))
            .bind(d.score);
        row.bind(d.depth_um).bind(flag(d.pit)).bind(flag(d.systematic)).bind(d.speed_jump_percent);
        row.bind(d.length_mm).bind(d.area_mm2);
        for (const Vec3& at : {d.tip, d.position}) row.bind(at.x()).bind(at.y()).bind(at.z());
        row.run();
        for (std::size_t k = 0; k < d.sections.size(); ++k) {
            const RecordedSection& s = d.sections[k];
            section_row.bind(id).bind(rank).bind(static_cast<std::int64_t>(k)).bind(s.pass);
            section_row.bind(static_cast<std::int64_t>(s.first_line)).bind(static_cast<std::int64_t>(s.last_line));
            section_row.run();
        }
    }
}

void write_rules(const SqliteConnection& connection, const ParameterRules& rules) {
    connection.execute("DELETE FROM parameter_rules");
    SqliteStatement row(connection, "INSERT INTO parameter_rules VALUES (?, ?, ?, ?, ?, ?)");
    SqliteStatement value_row(connection, "INSERT INTO parameter_values VALUES (?, ?, ?)");
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (const ParameterRule& rule : rules.rules) {
        row.bind(rule.name).bind(std::string(name_of(rule.kind))).bind(rule.unit).bind(rule.low.value_or(none));
        row.bind(rule.high.value_or(none)).bind(flag(rule.required)).run();
        for (std::size_t k = 0; k < rule.values.size(); ++k)
            value_row.bind(rule.name).bind(static_cast<std::int64_t>(k)).bind(rule.values[k]).run();
    }
}

/// The condition of a filter, and the values of its parameters.
struct Condition {
    std::string sql = "1";
    std::vector<std::string> values;
};

Condition condition_of(const RunFilter& filter) {
    Condition condition;
    if (filter.id) condition.sql += fmt::format(" AND id = {}", *filter.id);
    if (!filter.program.empty()) {
        condition.sql += " AND (program = ? OR substr(program, -length(?)) = ?)";
        const std::string behind_a_folder = "/" + filter.program;
        condition.values.insert(condition.values.end(), {filter.program, behind_a_folder, behind_a_folder});
    }
    if (!filter.log_sha256.empty()) {
        condition.sql += " AND log_sha256 = ?";
        condition.values.push_back(filter.log_sha256);
    }
    if (!filter.since.empty()) {
        condition.sql += " AND time >= ?";
        condition.values.push_back(filter.since);
    }
    if (filter.failed) condition.sql += " AND failure <> ''";
    for (const RunParameter& parameter : filter.parameters) {
        condition.sql += " AND EXISTS (SELECT 1 FROM parameters WHERE run = runs.id AND name = ? AND value = ?)";
        condition.values.insert(condition.values.end(), {parameter.name, parameter.value});
    }
    return condition;
}

std::map<std::int64_t, RunRecord*> by_id(std::vector<RunRecord>& runs) {
    std::map<std::int64_t, RunRecord*> all;
    for (RunRecord& run : runs) all.emplace(run.id, &run);
    return all;
}

RecordedDefect read_defect(const SqliteStatement& row) {
    RecordedDefect d;
    std::int64_t run = 0;
    std::int64_t rank = 0;
    RowReader(row) >> run >> rank >> d.cause >> d.quantity >> d.severity >> d.score >> d.depth_um >> d.pit >>
        d.systematic >> d.speed_jump_percent >> d.length_mm >> d.area_mm2 >> d.tip >> d.position;
    return d;
}

}  // namespace

HistoryDatabase::HistoryDatabase(const std::string& path)
    : connection_(std::make_unique<SqliteConnection>(readable_history(path))) {}
HistoryDatabase::HistoryDatabase(std::unique_ptr<SqliteConnection> connection) : connection_(std::move(connection)) {}
HistoryDatabase::HistoryDatabase(HistoryDatabase&&) noexcept = default;
HistoryDatabase::~HistoryDatabase() = default;

const std::string& HistoryDatabase::path() const { return connection_->path(); }

std::vector<RunRecord> HistoryDatabase::runs(const RunFilter& filter) const {
    const Condition condition = condition_of(filter);
    SqliteStatement rows(*connection_,
                         fmt::format("SELECT {} FROM runs WHERE {} ORDER BY time DESC, id DESC LIMIT {}", run_columns,
                                     condition.sql, filter.last == 0 ? -1 : static_cast<std::int64_t>(filter.last)));
    for (const std::string& value : condition.values) rows.bind(value);
    std::vector<RunRecord> runs;
    while (rows.step()) runs.push_back(read_run(rows));
    std::ranges::reverse(runs);
    const std::map<std::int64_t, RunRecord*> wanted = by_id(runs);
    SqliteStatement parameters(
        *connection_,
        fmt::format(
            "SELECT run, name, value FROM parameters WHERE run IN (SELECT id FROM runs WHERE {}) ORDER BY run, name",
            condition.sql));
    for (const std::string& value : condition.values) parameters.bind(value);
    while (parameters.step()) {
        const auto run = wanted.find(parameters.integer(0));
        if (run != wanted.end()) run->second->parameters.push_back({parameters.text(1), parameters.text(2)});
    }
    return runs;
}

void HistoryDatabase::read_defects(std::vector<RunRecord>& runs, const DefectFilter& filter) const {
    const std::map<std::int64_t, RunRecord*> wanted = by_id(runs);
    // The index finds the defects of one pass; the other conditions of a filter are checked here.
    const std::string of_pass =
        filter.pass
            ? fmt::format(" WHERE (run, rank) IN (SELECT run, rank FROM sections WHERE pass = {})", *filter.pass)
            : "";
    SqliteStatement rows(*connection_, "SELECT * FROM defects" + of_pass + " ORDER BY run, rank");
    SqliteStatement sections(
        *connection_, "SELECT pass, first_line, last_line FROM sections WHERE run = ? AND rank = ? ORDER BY number");
    while (rows.step()) {
        const auto run = wanted.find(rows.integer(0));
        if (run == wanted.end()) continue;
        RecordedDefect defect = read_defect(rows);
        sections.bind(rows.integer(0)).bind(rows.integer(1));
        while (sections.step())
            defect.sections.push_back({sections.integer(0), static_cast<LineNumber>(sections.integer(1)),
                                       static_cast<LineNumber>(sections.integer(2))});
        sections.reset();
        if (filter.matches(defect)) run->second->found.push_back(std::move(defect));
    }
}

std::vector<CauseCount> HistoryDatabase::causes() const {
    SqliteStatement rows(
        *connection_,
        "SELECT run, cause, count(*), total(area_mm2) FROM defects GROUP BY run, cause ORDER BY run, cause");
    std::vector<CauseCount> all;
    while (rows.step()) all.push_back({rows.integer(0), rows.text(1), rows.integer(2), rows.number(3)});
    return all;
}

ParameterRules HistoryDatabase::parameter_rules() const {
    ParameterRules rules;
    SqliteStatement rows(*connection_,
                         "SELECT name, kind, unit, low, high, required FROM parameter_rules ORDER BY rowid");
    SqliteStatement values(*connection_, "SELECT value FROM parameter_values WHERE name = ? ORDER BY number");
    while (rows.step()) {
        ParameterRule rule;
        rule.name = rows.text(0);
        for (const ParameterKind kind : {ParameterKind::text, ParameterKind::number, ParameterKind::integer}) {
            if (rows.text(1) == name_of(kind)) rule.kind = kind;
        }
        rule.unit = rows.text(2);
        if (rows.number(3) == rows.number(3)) rule.low = rows.number(3);
        if (rows.number(4) == rows.number(4)) rule.high = rows.number(4);
        rule.required = rows.integer(5) != 0;
        values.bind(rule.name);
        while (values.step()) rule.values.push_back(values.text(0));
        values.reset();
        rules.rules.push_back(std::move(rule));
    }
    return rules;
}

HistoryWriter::HistoryWriter(const std::string& path)
    : HistoryDatabase(std::make_unique<SqliteConnection>(path, DatabaseAccess::write)) {
    prepare_history(connection());
}

bool HistoryDatabase::has_verdict(const RunRecord& failed) const {
    if (failed.failure.empty()) return false;
    for (const RunRecord& run : runs({.log_sha256 = failed.log_sha256, .parameters = failed.parameters})) {
        if (supersedes(run, failed)) return true;
    }
    return false;
}

bool HistoryDatabase::has_log(const std::string& log_sha256) const {
    SqliteStatement row(*connection_, "SELECT 1 FROM runs WHERE log_sha256 = ? LIMIT 1");
    row.bind(log_sha256);
    return row.step();
}

std::optional<RunRecord> HistoryDatabase::find_same(const RunRecord& run) const {
    SqliteStatement row(*connection_, fmt::format("SELECT {} FROM runs WHERE identity = ?", run_columns));
    row.bind(identity_of(run));
    if (!row.step()) return std::nullopt;
    return read_run(row);
}

AddedRun HistoryWriter::add(const RunRecord& run) {
    RunRecord now = run;
    now.recorded = utc_now();
    SqliteTransaction transaction(connection());
    std::vector<RunRecord> failed = runs({.failed = true});
    const AddedRun added = put(now, failed);
    transaction.commit();
    return added;
}

AddedRun HistoryWriter::put(const RunRecord& run, std::vector<RunRecord>& failed) {
    const std::string identity = identity_of(run);
    AddedRun added;
    if (const std::optional<RunRecord> known = find_same(run)) added = {known->id, true};
    std::vector<std::int64_t> old;
    if (added.replaced) old.push_back(added.id);
    for (const RunRecord& f : failed) {
        if (f.id == added.id || !supersedes(run, f)) continue;
        old.push_back(f.id);
        if (added.id == 0) added.id = f.id;
    }
    std::erase_if(failed, [&](const RunRecord& f) { return std::ranges::find(old, f.id) != old.end(); });
    SqliteStatement remove(connection(), "DELETE FROM runs WHERE id = ?");
    for (const std::int64_t id : old) remove.bind(id).run();
    std::string marks = "?, ?";  // for the first column and the identity
    for (std::ptrdiff_t k = std::ranges::count(run_columns, ','); k > 0; --k) marks += ", ?";
    SqliteStatement row(connection(), fmt::format("INSERT INTO runs ({}, identity) VALUES ({})", run_columns, marks));
    bind_run(row, run, identity, added.id);
    row.run();
    if (added.id == 0) added.id = connection().last_row();
    SqliteStatement parameter_row(connection(), "INSERT INTO parameters VALUES (?, ?, ?)");
    for (const RunParameter& parameter : run.parameters)
        parameter_row.bind(added.id).bind(parameter.name).bind(parameter.value).run();
    write_defects(connection(), added.id, run.found);
    if (!run.failure.empty()) {
        failed.push_back(run);
        failed.back().id = added.id;
    }
    return added;
}

ParameterRules common_rules(const HistoryDatabase* into, std::span<const HistoryDatabase> histories) {
    const HistoryDatabase* first = into;
    ParameterRules common = into == nullptr ? ParameterRules{} : into->parameter_rules();
    for (const HistoryDatabase& history : histories) {
        ParameterRules rules = history.parameter_rules();
        if (rules.rules.empty()) continue;
        if (common.rules.empty()) {
            common = std::move(rules);
            first = &history;
        } else if (const std::string name = first_difference(common, rules); !name.empty()) {
            throw InputError(
                Place::of_file(history.path()),
                fmt::format("has another rule for the parameter '{}' than {}", name, first->path()),
                "record both with the same --parameters FILE; `clsurf history DB add … --parameters FILE` changes the rules of DB");
        }
    }
    return common;
}

std::size_t HistoryWriter::merge(std::span<const HistoryDatabase> others) {
    const auto rank = [](const RunRecord& r) { return std::tuple(r.failure.empty(), r.recorded); };
    SqliteTransaction transaction(connection());
    write_rules(connection(), common_rules(this, others));
    std::vector<RunRecord> failed = runs({.failed = true});
    std::size_t taken = 0;
    for (const HistoryDatabase& other : others) {
        std::vector<RunRecord> all = other.runs();
        other.read_defects(all);
        for (const RunRecord& run : all) {
            const std::optional<RunRecord> known = find_same(run);
            if (known ? rank(*known) >= rank(run) : has_verdict(run)) continue;
            put(run, failed);
            ++taken;
        }
    }
    transaction.commit();
    return taken;
}

void HistoryWriter::set_parameter_rules(const ParameterRules& rules) {
    SqliteTransaction transaction(connection());
    write_rules(connection(), rules);
    transaction.commit();
}

}  // namespace clsurf::io
