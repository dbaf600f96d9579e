// clsurf._clsurf: what the package clsurf (src/python/clsurf) is made of. Reports are JSON texts; the package makes Python
// objects of them. All work is done without the interpreter's lock.

#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "core/error.h"
#include "core/version.h"
#include "python/arrays.h"
#include "python/calls.h"
#include "python/loaded_part.h"
#include "python/optimize.h"
#include "python/picture.h"
#include "python/tradeoff.h"

namespace py = pybind11;

namespace clsurf::python {
namespace {

using SharedPart = std::shared_ptr<const LoadedPart>;
using Unlocked = py::call_guard<py::gil_scoped_release>;

/// A text of a foreign file: bytes that are no UTF-8 become U+FFFD, as in reports.
py::str text(const std::string& bytes) {
    return py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}

/// A class of clsurf/errors.py, raised with its arguments.
template <typename... Arguments>
void raise(const char* name, Arguments&&... arguments) {
    const py::object type = py::module_::import("clsurf.errors").attr(name);
    const py::object error = type(std::forward<Arguments>(arguments)...);
    PyErr_SetObject(type.ptr(), error.ptr());
}

py::object number_at(const Place& place, Place::Kind kind) {
    return place.kind == kind ? py::object(py::int_(place.number)) : py::object(py::none());
}

void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(std::move(thrown));
    } catch (const InputError& error) {
        const Diagnostic& d = error.diagnostic();
        const py::object column = d.where.column > 0 ? py::object(py::int_(d.where.column)) : py::object(py::none());
        raise("InputError", text(error.what()), text(d.text), text(d.hint), text(d.where.file),
              number_at(d.where, Place::Kind::line), column, number_at(d.where, Place::Kind::point),
              number_at(d.where, Place::Kind::byte));
    } catch (const UsageError& error) {
        raise("UsageError", text(error.what()), text(error.hint()));
    } catch (const SystemError& error) { raise("SystemError", text(error.what())); }
}

/// What a computation gives without the interpreter's lock.
template <typename Compute>
auto unlocked(const Compute& compute) {
    const py::gil_scoped_release released;
    return compute();
}

/// A method whose column becomes an array.
template <typename T>
auto column(SharedColumn<T> (LoadedPart::*get)() const) {
    return [get](const SharedPart& part) { return shared_array(unlocked([&] { return (*part.*get)(); })); };
}

/// The same with so many values a row.
template <typename T>
auto rows(SharedColumn<T> (LoadedPart::*get)() const, py::ssize_t width) {
    return [get, width](const SharedPart& part) {
        const SharedColumn<T> values = unlocked([&] { return (*part.*get)(); });
        return shared_array(values, {static_cast<py::ssize_t>(values->size()) / width, width});
    };
}

/// What the log calls the channel that Python knows by `name`; `name` where there is none.
std::string stored_name(const SharedPart& part, const std::string& name) {
    for (const Channel& channel : part->part().log.channels) {
        if (text(channel.name).cast<std::string>() == name) return channel.name;
    }
    return name;
}

py::array field_array(const SharedPart& part, const std::string& name) {
    const std::string stored = stored_name(part, name);
    return shared_array(unlocked([&] { return part->field(stored); }));
}

/// Where a value is what is stored, the array lies in the file.
py::array channel_array(const SharedPart& part, const std::string& name) {
    const std::string stored = stored_name(part, name);
    const ChannelView& view = part->channel(stored).values;
    if (view.scale == 1 && view.bias == 0) return raw_array(view, part->part().log.keep_alive);
    return shared_array(unlocked([&] { return part->channel_values(stored); }));
}

/// Name and unit.
using NamesWithUnits = std::vector<std::pair<py::str, py::str>>;

/// Of each field that can be computed.
NamesWithUnits fields_with_units(const SharedPart& part) {
    NamesWithUnits found;
    for (const FieldInfo& info : unlocked([&] { return part->fields().fields(); })) {
        if (part->fields().can_compute(info.name)) found.emplace_back(text(info.name), text(info.unit.name));
    }
    return found;
}

NamesWithUnits channels_with_units(const SharedPart& part) {
    NamesWithUnits found;
    for (const Channel& channel : part->part().log.channels) found.emplace_back(text(channel.name), text(channel.unit));
    return found;
}

std::string query(const SharedPart& part, std::optional<PointIndex> point, std::optional<LineNumber> line,
                  const std::string& file, std::optional<double> time, const std::optional<std::vector<double>>& at,
                  bool of_tip, int nearest) {
    constexpr int most_nearest = 100'000;
    Wanted wanted{point, line, file, time, std::nullopt};
    if (nearest < 1 || nearest > most_nearest) throw UsageError("nearest must be 1 … " + std::to_string(most_nearest));
    if (at) {
        if (at->size() != 2 && at->size() != 3) throw UsageError("at is a place: (x, y, z), or (x, y) seen from above");
        WantedPlace& place = wanted.at.emplace();
        place.from_above = at->size() == 2;
        place.at = Vec3((*at)[0], (*at)[1], place.from_above ? 0 : (*at)[2]);
        place.pieces = static_cast<std::size_t>(nearest);
        place.of_tip = of_tip;
    }
    return part->query(wanted);
}

py::bytes picture(const SharedPart& part, const std::string& field, const std::string& view,
                  std::optional<std::pair<double, double>> range, const std::string& colour_map,
                  std::pair<int, int> size) {
    const std::string stored = stored_name(part, field);
    return py::bytes(unlocked([&] {
        return draw_picture(*part, {stored, view, range, colour_map, size.first, size.second});
    }));
}

std::string text_of(const std::optional<CuttingTool>& tool) { return tool ? to_text(*tool) : std::string(); }

void bind_part(py::module_& module) {
    py::class_<LoadedPart, std::shared_ptr<LoadedPart>>(module, "Part")
        .def(py::init([](const PartOptions& options) { return read_part(options); }), Unlocked())
        .def_property_readonly("records", [](const SharedPart& part) { return part->part().log.records; })
        .def_property_readonly("period", [](const SharedPart& part) { return part->part().log.period; })
        .def_property_readonly("program", [](const SharedPart& part) { return part->part().program.main().name(); })
        .def_property_readonly("log", [](const SharedPart& part) { return part->part().log.name; })
        .def_property_readonly("tool", [](const SharedPart& part) { return text_of(part->part().tool); })
        .def_property_readonly("role", [](const SharedPart& part) { return name_of(part->part().path.role); })
        .def_property_readonly("simulation", [](const SharedPart& part) { return part->simulation(); })
        .def(
            "step_over", [](const SharedPart& part) { return part->surface().step_over; }, Unlocked())
        .def("time", column(&LoadedPart::time))
        .def("line", column(&LoadedPart::line))
        .def("pass_number", column(&LoadedPart::pass_number))
        .def("position", rows(&LoadedPart::position, 3))
        .def("passes", rows(&LoadedPart::passes, 2))
        .def("vertices", rows(&LoadedPart::vertices, 3))
        .def("triangles", rows(&LoadedPart::triangles, 3))
        .def("field", &field_array)
        .def("fields", &fields_with_units)
        .def("channel", &channel_array)
        .def("channels", &channels_with_units)
        .def(
            "check", [](const SharedPart& part) { return part->check(); }, Unlocked())
        .def("query", &query, Unlocked(), py::arg("point"), py::arg("line"), py::arg("file"), py::arg("time"),
             py::arg("at"), py::arg("of_tip"), py::arg("nearest"))
        .def("picture", &picture);
}

void bind_options(py::module_& module) {
    py::class_<PartOptions>(module, "PartOptions")
        .def(py::init<>())
        .def_readwrite("program", &PartOptions::program)
        .def_readwrite("log", &PartOptions::log)
        .def_readwrite("tool", &PartOptions::tool)
        .def_readwrite("machine", &PartOptions::machine)
        .def_readwrite("surface", &PartOptions::surface)
        .def_readwrite("dialect", &PartOptions::dialect)
        .def_readwrite("tools", &PartOptions::tools)
        .def_readwrite("block_delete", &PartOptions::block_delete)
        .def_readwrite("layout", &PartOptions::layout)
        .def_readwrite("mapping", &PartOptions::mapping)
        .def_readwrite("period", &PartOptions::period)
        .def_readwrite("work_offset", &PartOptions::work_offset)
        .def_readwrite("ignore_lines", &PartOptions::ignore_lines)
        .def_readwrite("force", &PartOptions::force)
        .def_readwrite("derivative", &PartOptions::derivative);
}

}  // namespace
}  // namespace clsurf::python

PYBIND11_MODULE(_clsurf, module) {
    using namespace clsurf::python;
    module.attr("version") = std::string(clsurf::version);
    py::register_exception_translator(&translate);
    bind_options(module);
    bind_part(module);
    module.def("simulate", &simulate_part, Unlocked());
    module.def("identify", &identify_machine, Unlocked());
    py::class_<RepairOptions>(module, "RepairOptions")
        .def(py::init<>())
        .def_readwrite("tolerance", &RepairOptions::tolerance)
        .def_readwrite("more_time_percent", &RepairOptions::more_time_percent)
        .def_readwrite("machines", &RepairOptions::machines)
        .def_readwrite("decimals", &RepairOptions::decimals)
        .def_readwrite("feeds", &RepairOptions::feeds)
        .def_readwrite("tradeoff", &RepairOptions::tradeoff)
        .def_readwrite("weight", &RepairOptions::weight);
    py::class_<RepairedProgram>(module, "RepairedProgram")
        .def_readonly("report", &RepairedProgram::report)
        .def_readonly("text", &RepairedProgram::text)
        .def_readonly("front", &RepairedProgram::front);
    module.def("optimize", &optimize_program, Unlocked());
    py::class_<TradeoffOptions>(module, "TradeoffOptions")
        .def(py::init<>())
        .def_readwrite("start", &TradeoffOptions::start)
        .def_readwrite("more_time_percent", &TradeoffOptions::more_time_percent)
        .def_readwrite("runs", &TradeoffOptions::runs)
        .def_readwrite("weight", &TradeoffOptions::weight);
    module.def("tradeoff", &trade_off_settings, Unlocked());
    module.def("diff", &diff_parts, Unlocked());
}
